// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_STUDIES_BASIS_ERROR_H_
#define ANICODEC_CODEC_STUDIES_BASIS_ERROR_H_

#include "codec/keyframes/keyframe_fit.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Error of a clip expressed by k exact basis elements.
struct BasisError {
  /// Key-frames by choice and kind of weights ("gas-linear", "pivot-sum-to-one", "uniform-rigid"
  /// ...), or principal components: "pca" (of positions relative to the clip's mean position),
  /// "pca-mean" (k components and the mean shape), "pca-mean-rigid" (the same of the aligned
  /// frames).
  std::string method;
  size_t k = 0;     ///< elements asked for
  double kg = 0;    ///< per cent
  double rmse = 0;  ///< scene units
};

/// Error against the number of elements (thesis table 5.1 and figure 5.7), for every method and
/// every k that the clip has frames for, method by method. Principal components come from the
/// eigenvalues alone. Without with_rigid the methods that align frames are left out.
std::vector<BasisError> basis_errors(KeyframeFitter& fitter, std::span<const size_t> counts,
                                     bool with_rigid = true);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_STUDIES_BASIS_ERROR_H_
