// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/clip_bounds.h"

#include <algorithm>
#include <utility>

namespace anicodec {

std::optional<CodedPart> within_bounds(SegmentCoder& coder, const EncoderInput& input,
                                       uint32_t first, double rmse) {
  if (!input.bounds_clips())
    return coder.at_rmse(rmse);
  constexpr int kRounds = 5;
  constexpr double kClose = 0.985, kAim = 0.995;
  std::optional<CodedPart> best;
  double asked = rmse;
  for (int round = 0; round < kRounds; ++round) {
    std::optional<CodedPart> part = coder.at_rmse(asked);
    if (!part)
      break;
    const double excess = std::ranges::max(input.excesses(part->error, first, rmse));
    if (excess <= 1 && (!best || part->encoded.bytes() < best->encoded.bytes()))
      best = std::move(part);
    if ((excess <= 1 && excess >= kClose) || !(excess > 0))
      break;
    asked *= kAim / excess;
  }
  if (best)
    best->asked = rmse;
  return best;
}

}  // namespace anicodec
