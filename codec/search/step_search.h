// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_STEP_SEARCH_H_
#define ANICODEC_CODEC_SEARCH_STEP_SEARCH_H_

#include <vector>

namespace anicodec {

/// Finds the step of a quantiser that meets an error. Logarithms of errors lie on a line over those
/// of steps, nearly: they scatter by some thousandths.
class StepSearch {
 public:
  /// `aim`: the error to come to, over the one asked for. `slope`: that of the line, about.
  StepSearch(double aim, double slope);

  /// The step to try after one whose error is `ratio` times the one asked for. Both above 0.
  double next(double step, double ratio);

  /// That of the two trials nearest to the aim, where they tell it.
  double slope() const { return slope_; }

 private:
  struct Trial {
    double step, ratio;  ///< logarithms
  };

  double within_bracket(double step) const;

  double aim_, slope_;
  std::vector<Trial> trials_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_STEP_SEARCH_H_
