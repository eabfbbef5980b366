// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_CODEC_KEYFRAMES_FRAME_OF_FIT_H_
#define ANICODEC_TESTS_CODEC_KEYFRAMES_FRAME_OF_FIT_H_

#include "codec/keyframes/keyframe_fit.h"

#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Frame f of a fit with the original key-frames, by definition: vertices x 3.
inline std::vector<float> frame_of_fit(const FrameView& clip, const KeyframeFit& fit,
                                       const Eigen::Vector3d& mean_position, uint32_t f) {
  std::vector<float> frame;
  for (size_t v = 0; v < clip.vertex_count; ++v) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t j = 0; j < fit.keyframes.size(); ++j) {
      const uint32_t k = fit.keyframes[j];
      const float* p = clip.frame(k) + 3 * v;
      const Eigen::Vector3d x(double{p[0]}, double{p[1]}, double{p[2]});
      const double w = fit.weights(Eigen::Index{f}, static_cast<Eigen::Index>(j));
      if (fit.motions.empty())
        sum += w * (x - mean_position);
      else
        sum += w * (fit.motions[k].rotation.transpose() * (x - fit.motions[k].translation));
    }
    if (fit.motions.empty())
      sum += mean_position;
    else
      sum = fit.motions[f].rotation * sum + fit.motions[f].translation;
    for (Eigen::Index c = 0; c < 3; ++c)
      frame.push_back(static_cast<float>(sum[c]));
  }
  return frame;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CODEC_KEYFRAMES_FRAME_OF_FIT_H_
