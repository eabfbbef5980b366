// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_SIGNED_AXES_H_
#define ANICODEC_TOOLS_IO_BASE_SIGNED_AXES_H_

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace anicodec::tools {

/// A coordinate: one of another point, or its negative.
struct SignedAxis {
  size_t axis = 0;
  float sign = 1;

  bool operator==(const SignedAxis&) const = default;
};

/// A turn that puts axes on axes: coordinate i is that of axes[i].
using SignedAxes = std::array<SignedAxis, 3>;

inline constexpr SignedAxes kSameAxes = {{{0, 1}, {1, 1}, {2, 1}}};

/// "x,z,-y".
std::string text_of(const SignedAxes& axes);

struct ScaledTurn {
  SignedAxes axes = kSameAxes;
  double scale = 1;
};

/// The axis-aligned rotation (one of 24) and uniform scale that map `from` to `to` (3 numbers a
/// point) within a thousandth of its extent; the identity if it does. None if there is no such map.
/// Cost: O(points).
std::optional<ScaledTurn> find_turn(std::span<const float> from, std::span<const float> to);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_SIGNED_AXES_H_
