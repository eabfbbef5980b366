// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_METRICS_DIAMETER_H_
#define ANICODEC_CODEC_METRICS_DIAMETER_H_

#include <span>

namespace anicodec {

/// The largest distance between two of the points (x y z each), exact in double; 0 for less than
/// two. Cost: about n log n for n points of a usual surface; n^2 in the worst case.
double diameter(std::span<const float> points);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_METRICS_DIAMETER_H_
