// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_LOCAL_ORIGIN_H_
#define ANICODEC_TOOLS_IO_BASE_LOCAL_ORIGIN_H_

#include "codec/sequence/mesh_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace anicodec::tools {

/// Rounds coordinates to float32, from a point that is taken away before.
struct LocalOrigin {
  Point at{};
  bool measures = false;  ///< what rounding takes
  double rounding = 0;    ///< the most that it took so far

  /// A coordinate of this axis needs no more than to be read as float32.
  bool is_plain(size_t axis) const { return !measures && at[axis] == 0; }

  float rounded(double coordinate, size_t axis) {
    const double exact = coordinate - at[axis];
    const auto x = static_cast<float>(exact);
    rounding = std::max(rounding, std::abs(exact - static_cast<double>(x)));
    return x;
  }
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_LOCAL_ORIGIN_H_
