// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_WORDS_FIT_TABLE_H_
#define ANICODEC_TOOLS_WORDS_FIT_TABLE_H_

#include "codec/transfer/remesh_fit.h"

#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// Adds "improved", "before" and "after" to an object: distances of mesh and surface in scene units
/// and in per cent of the diagonal, the mean radius ratio, and how many triangles are turned.
void add_fit(const RemeshFit& fit, nlohmann::ordered_json* json);

/// Prints a table of the same on the standard output.
void print_fit(const RemeshFit& fit);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_FIT_TABLE_H_
