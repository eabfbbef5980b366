// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#pragma once
#include "CoreMinimal.h"

class FFeedbackContext {
 public:
  template <typename... Values>
  void Logf(ELogVerbosity::Type, const TCHAR* format, Values... values) {
    logged.push_back(*FString::Printf(format, values...));
  }
};
