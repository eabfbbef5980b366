// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_KEYFRAMES_KEYFRAME_COUNT_H_
#define ANICODEC_CODEC_KEYFRAMES_KEYFRAME_COUNT_H_

#include "codec/keyframes/keyframe_fit.h"

namespace anicodec {

/// Errors a fit must not exceed; an infinite one asks for nothing.
struct ErrorTarget {
  double kg = 0;    ///< per cent
  double rmse = 0;  ///< scene units
};

/// The fit with the fewest exact key-frames that meets both errors: one key-frame fewer does not.
/// (The error falls with the number of key-frames except for small ripples, across which the search
/// does not look.) At worst all frames, or all distinct ones, are key-frames. Starts at the number
/// below which principal components show it to be impossible, so about 2 log(excess) fits are made.
KeyframeFit fewest_keyframes(KeyframeFitter& fitter, const ErrorTarget& target,
                             KeyframeMethod method, KeyframeWeights kind);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_KEYFRAMES_KEYFRAME_COUNT_H_
