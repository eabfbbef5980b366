// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_SECANT_H_
#define ANICODEC_CODEC_SEARCH_SECANT_H_

#include <vector>

namespace anicodec {

/// Finds the largest setting whose outcome keeps to a bound: the step of a quantiser for an error,
/// the fineness of a file for its size. Outcomes go about as a power of the setting, and scatter by
/// some thousandths.
class Secant {
 public:
  /// The exponent: the usual one until trials tell it, and the least and the most to believe.
  struct Exponent {
    double usual, least, most;
  };

  explicit Secant(const Exponent& exponent) : exponent_(exponent) {}

  bool empty() const { return trials_.empty(); }

  /// The outcome of a trial; both above 0.
  void add(double setting, double outcome);

  /// The setting to try next, to come to `aim`, which is at most `bound`: by the line through the
  /// logarithms of the two trials nearest to the aim, and between the settings known to keep to the
  /// bound and those known not to, never one again. At most 16 times or parts of the nearest.
  /// @pre !empty()
  double next(double aim, double bound);

  /// The exponent that the last next() went by.
  double exponent() const { return exponent_.usual; }

 private:
  struct Trial {
    double setting, outcome;  ///< logarithms
  };

  Exponent exponent_;
  std::vector<Trial> trials_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_SECANT_H_
