// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_LINEAR_CHOICE_H_
#define ANICODEC_CODEC_SEARCH_LINEAR_CHOICE_H_

#include "codec/segment/linear_basis.h"
#include "codec/segment/linear_segment_encode.h"

#include <vector>

namespace anicodec {

/// How a linear basis is made and coded.
struct LinearChoice {
  ReferencePose pose = ReferencePose::kMean;
  Base base = Base::kPose;
  uint32_t regions = 1;  ///< of the surface; more than one with Base::kAffine
  LinearSettings settings;
  double components_of_whole = 0;  ///< that the clip takes without regions, about
  size_t components_made = 0;      ///< of the basis, at most, that the settings are for
  double aim = 1;    ///< what estimates of the error are to be told, over what they are to meet
  double price = 0;  ///< squared steps of the coefficients that a bit is worth; 0: not known yet
  /// The factor by which the step that met the last error was off the one estimated; 0: none did.
  double step_factor = 0;
  /// Errors go about as step^exponent; 0.6 to 0.9 on face, dance and horse.
  double exponent = 0.75;
  std::vector<const char*> steps;  ///< names of the steps of the search that were kept
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_LINEAR_CHOICE_H_
