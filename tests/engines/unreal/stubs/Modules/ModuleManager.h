// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#pragma once

class FDefaultModuleImpl {};

#define IMPLEMENT_MODULE(implementation, name) static implementation name##Module;
