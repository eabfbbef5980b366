// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_COEFFICIENT_ENCODER_H_
#define ANICODEC_CODEC_SEGMENT_COEFFICIENT_ENCODER_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/segment/coefficient_costs.h"
#include "codec/segment/joint_rounding.h"
#include "codec/segment/linear_settings.h"
#include "format/bytes.h"
#include "format/coding/rans_coder.h"
#include "sdk/prediction/encoder_predictor.h"
#include "sdk/prediction/vertex_order.h"
#include "sdk/segment/segment.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Coefficients in steps, a row per vertex: channels of component 0, of component 1, ...
using Coefficients = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The order of the coefficients. `pose`: vertices x 3 on its grid; `regions`: of each vertex, or null.
/// Cost: O(vertices), some microseconds each.
VertexOrder coefficient_order(const LinearSettings& settings, const MeshLayout& layout,
                              const Vector<int32_t>& pose, const uint8_t* regions);

/// Predicts, rounds and codes the coefficients of a basis, component by component.
class CoefficientEncoder {
 public:
  /// `order`: coefficient_order(); `target`: what the coefficients would best be; `continued`: where prediction and models
  /// go on, null: they begin anew.
  CoefficientEncoder(const LinearSettings& settings, VertexOrder order, const Vector<int32_t>& pose,
                     Coefficients target, uint32_t channels, const LearntSegment* continued);

  struct Component {
    uint8_t omega = 0;  ///< for the next component
    bool wide = false;  ///< whether 16 bits do not hold it in memory
  };

  /// Codes component j, after all those before it. Nothing if a coefficient is too large.
  /// Cost: O(vertices m^2); rounding together takes about three times as long.
  std::optional<Component> code(size_t j);

  /// The stream of the components since the layer before.
  Bytes finish_layer();

  /// The coefficients of the components coded so far, as a decoder gets them.
  const Coefficients& decoded() const { return decoded_; }

  /// The same with their order in the form of a decoder. Ends the use of the object.
  void take_decoded(DecodedBasis* to) &&;

 private:
  CoefficientCosts first_model(const LearntSegment* continued) const;

  uint32_t ranks() const { return static_cast<uint32_t>(target_.rows()); }

  size_t place(uint32_t rank, uint32_t channel) const { return size_t{channel} * ranks() + rank; }

  template <class Coder, class Choose>
  bool pass(CoefficientCosts& model, Coder& coder, const Choose& choose);
  std::optional<int32_t> nearest(CoefficientCosts& model, uint32_t i, uint32_t c,
                                 float prediction) const;
  bool round_each();
  bool round_together();
  bool commit_chosen();
  void write_chosen();

  double lambda_, joint_lambda_;
  Coefficients target_, decoded_;
  uint32_t channels_;
  VertexOrder order_;
  CoefficientCosts model_;
  std::optional<CoefficientCosts> rehearsed_;  ///< a copy that learns what will not be written
  RansEncoder encoder_;
  EncoderPredictor predictor_;
  JointRounding joint_;
  bool new_weights_ = true, layers_anew_;
  // The component at hand, channels x ranks.
  std::vector<float> component_;
  std::vector<int32_t> residuals_;
  std::vector<int32_t> chosen_;  ///< of the component before, until they are written
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_COEFFICIENT_ENCODER_H_
