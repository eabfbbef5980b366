// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_SIZE_CURVE_H_
#define ANICODEC_CODEC_SEARCH_SIZE_CURVE_H_

#include <map>

namespace anicodec {

/// What files take by their errors, as far as trials told. Their logarithms lie on a line, nearly.
class SizeCurve {
 public:
  bool empty() const { return sizes_.empty(); }

  /// Both above 0.
  void add(double rmse, double bytes);

  /// The error of a file of that size, by the line through the two trials next to it; by a usual
  /// slope where there is one trial, or where the two contradict each other. At most `kFurthest`
  /// times or parts of an error that was tried. Not for an empty curve.
  double rmse_of(double bytes) const;

  static constexpr double kFurthest = 16;

 private:
  std::map<double, double> sizes_;  ///< logarithms of bytes by those of errors
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_SIZE_CURVE_H_
