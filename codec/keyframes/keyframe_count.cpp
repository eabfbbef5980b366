// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_count.h"

#include "codec/algebra/gram.h"

#include <algorithm>
#include <utility>

namespace anicodec {

KeyframeFit fewest_keyframes(KeyframeFitter& fitter, const ErrorTarget& target,
                             KeyframeMethod method, KeyframeWeights kind) {
  const FrameView& clip = fitter.clip();
  const auto met = [&](double squared_error) {
    return kg_error(squared_error, fitter.gram().kg_reference()) <= target.kg &&
           rmse(squared_error, clip.vertex_count, clip.frame_count) <= target.rmse;
  };

  // Key-frames span no more than as many principal components; about the mean, one fewer.
  size_t impossible = 0;
  if (kind != KeyframeWeights::kRigid) {
    const bool affine = kind == KeyframeWeights::kSumToOne;
    const auto errors =
        principal_errors(affine ? about_mean(fitter.products(kind)) : fitter.products(kind));
    while (impossible < clip.frame_count && !met(errors[impossible])) {
      impossible++;
    }
    if (!affine && impossible > 0) {
      impossible--;
    }
    impossible = std::min(impossible, clip.frame_count - 1);
  }

  size_t step = 1;
  size_t high = impossible;
  KeyframeFit best;
  for (;;) {
    high = std::min(high + step, clip.frame_count);
    best = fitter.fit(high, method, kind);
    if (met(best.squared_error()) || high == clip.frame_count) {
      break;
    }
    impossible = high;
    step *= 2;
  }
  while (high - impossible > 1) {
    const size_t middle = impossible + (high - impossible) / 2;
    KeyframeFit fit = fitter.fit(middle, method, kind);
    if (met(fit.squared_error())) {
      high = middle;
      best = std::move(fit);
    } else {
      impossible = middle;
    }
  }
  return best;
}

}  // namespace anicodec
