// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_CODEC_KEYFRAMES_KEYFRAME_TESTING_H_
#define ANICODEC_TESTS_CODEC_KEYFRAMES_KEYFRAME_TESTING_H_

#include "codec/algebra/gram.h"
#include "codec/keyframes/keyframe_selection.h"
#include "tests/codec/moving_points.h"

namespace anicodec {

inline constexpr KeyframeMethod kMethods[] = {KeyframeMethod::kGas, KeyframeMethod::kPivot,
                                              KeyframeMethod::kUniform};

inline Eigen::MatrixXd gram_of(const MovingPoints& clip) {
  return frame_gram(clip.view()).clip_centred();
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CODEC_KEYFRAMES_KEYFRAME_TESTING_H_
