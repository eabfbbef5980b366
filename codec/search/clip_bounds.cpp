// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/clip_bounds.h"

#include <algorithm>
#include <utility>

namespace anicodec {

std::optional<CodedSegment> within_bounds(SegmentSearch& search, const EncoderInput& input,
                                          uint32_t first, double rmse) {
  if (!input.bounds_clips())
    return search.at_rmse(rmse);
  constexpr int kRounds = 5;
  constexpr double kClose = 0.985, kAim = 0.995;
  std::optional<CodedSegment> best;
  double asked = rmse;
  for (int round = 0; round < kRounds; ++round) {
    std::optional<CodedSegment> segment = search.at_rmse(asked);
    if (!segment)
      break;
    const double excess = std::ranges::max(input.excesses(segment->error, first, rmse));
    if (excess <= 1 && (!best || segment->encoded.bytes() < best->encoded.bytes()))
      best = std::move(segment);
    if ((excess <= 1 && excess >= kClose) || !(excess > 0))
      break;
    asked *= kAim / excess;
  }
  if (best)
    best->asked = rmse;
  return best;
}

}  // namespace anicodec
