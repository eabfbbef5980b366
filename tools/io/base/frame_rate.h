// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_FRAME_RATE_H_
#define ANICODEC_TOOLS_IO_BASE_FRAME_RATE_H_

#include "codec/sequence/mesh_sequence.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// Reads "24", "30000/1001" or "12.5"; decimals that abbreviate an NTSC rate (23.976, 23.98, 29.97,
/// 59.94 ...) are that rate. Not assumed. Throws Error(kUsage).
FrameRate parse_frame_rate(std::string_view text);

/// When the frames of a sequence stand.
struct Timing {
  FrameRate rate;             ///< average one, if uneven
  double start_time = 0;      ///< seconds
  std::vector<double> times;  ///< seconds from start_time if uneven, else empty
};

/// Finds the rate behind times in seconds that were rounded to float: a whole number, an NTSC rate
/// or the simplest rational within the rounding. Times are even if none is off by more than a
/// hundredth of a frame. A single frame has the assumed rate. Throws Error(kInput) "name: ..." for
/// times that are not finite or do not increase.
Timing timing_of(std::span<const float> times, std::string_view name);

/// The same for times that are off by at most `rounding` seconds.
Timing timing_of(std::span<const double> times, double rounding, std::string_view name);

/// The rate of a grid of frames on which all of these ascending times stand, the first on a frame:
/// that of their smallest gap, or a usual one of which they use some frames. No rate below 10, as
/// far as whole multiples of theirs go. Nothing for fewer than two times, and for times on no grid.
std::optional<FrameRate> grid_rate(std::span<const double> times, double rounding);

/// The least rate from `least` on at which `seconds` are whole frames.
FrameRate covering_rate(double seconds, double least);

/// Seconds of each frame of a clip.
std::vector<float> times_of(const MeshSequence& clip);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_FRAME_RATE_H_
