// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_LINEAR_CODER_H_
#define ANICODEC_CODEC_SEARCH_LINEAR_CODER_H_

#include "codec/search/encoder_input.h"
#include "codec/search/linear_choice.h"
#include "codec/search/segment_coder.h"
#include "codec/segment/linear_basis.h"
#include "codec/segment/linear_segment_encode.h"

#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace anicodec {

/// Codes a segment by eigenshapes or eigentrajectories: finds the pose, the base and the settings
/// that give the smallest streams, and the step that meets an error.
class LinearCoder : public SegmentCoder {
 public:
  /// `effort` 1..9: how many settings are tried. The analysis must outlive the coder.
  LinearCoder(const EncoderInput& input, const LinearAnalysis& analysis, BasisKind kind, int effort,
              uint32_t layers);

  std::optional<CodedPart> at_rmse(double rmse) override;

  BasisKind kind() const { return kind_; }

  /// Makes the coder use a pose that the file has already, with a base that is an affine image of
  /// it, and the settings as they are.
  void share_pose(std::shared_ptr<const EncodedPose> pose);

  /// Takes over the settings of another coder.
  void settings_of(const LinearCoder& other) {
    choice_.settings = other.choice_.settings;
    choice_.steps = other.choice_.steps;
  }

  /// About the bytes that an error costs, from one trial.
  double probe(double rmse);

 private:
  struct Measured {
    CodedPart part;
    double rmse = 0;
    double bytes = 0;  ///< as they would be at the error asked for
  };

  const LinearBasis& basis(ReferencePose pose, Base base);
  size_t pose_bytes(const EncodedSegment& encoded) const;
  LinearChoice started(LinearChoice choice, double rmse);
  Measured measured(const LinearChoice& choice, double rmse);
  void choose_settings(double rmse);

  const EncoderInput& input_;
  const LinearAnalysis& analysis_;
  BasisKind kind_;
  int effort_;
  LinearChoice choice_;
  bool chosen_ = false;
  std::shared_ptr<const EncodedPose> pose_;
  Eigen::MatrixXd given_pose_;
  std::map<std::pair<ReferencePose, Base>, LinearBasis> bases_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_LINEAR_CODER_H_
