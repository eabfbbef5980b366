// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_LINEAR_STEPS_H_
#define ANICODEC_CODEC_SEARCH_LINEAR_STEPS_H_

#include "codec/plan/encode_options.h"
#include "codec/search/linear_choice.h"
#include "format/coding/time_weights.h"

#include <string>
#include <vector>

namespace anicodec {

/// One change of settings that the search tries.
struct LinearStep {
  const char* name;  ///< for EncodeOptions::without
  void (*change)(LinearChoice& choice, BasisKind kind);
  Effort least = Effort::kNormal;  ///< at which it is tried
};

/// The steps in the order in which they are tried: those that pay most often first, those of the best effort last. A
/// step that helps is kept, and the next ones start from it.
const std::vector<LinearStep>& linear_steps();

/// Steps that may open sooner, for searches to which that is worth bytes: tried last.
const std::vector<LinearStep>& opening_steps();

/// The change that a step made to a choice, for `encode -v`: one of "finer or yet coarser".
const char* meaning_of(const LinearStep& step, const LinearChoice& changed);

/// Names of further features of a search, beside the steps.
inline constexpr const char *kRegionsMean = "regions", *kJointRoundingMean = "joint rounding",
                            *kRefittedWeightsMean = "refitted weights";

/// Names of all that a search may do, each of which can be left out: EncodeOptions::without.
std::vector<std::string> search_means();

/// The name of a predictor of time weights among them; null: it cannot be left out.
const char* mean_of(WeightPredictor predictor);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_LINEAR_STEPS_H_
