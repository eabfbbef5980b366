// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/reference_pose_encode.h"

#include "codec/search/encoder_input.h"
#include "corpus/clips.h"
#include "sdk/pose/pose_coding.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::MatrixXd;

TEST(ReferencePoseOfCorpus, EveryClipsFirstFrameComesBackWithTheErrorOfItsStep) {
  for (const std::string& name : corpus::clip_names()) {
    SCOPED_TRACE(name);
    const EncoderInput input(corpus::make_clip(name));
    Eigen::Vector3d origin;
    const MatrixXd pose = input.centred_first_pose(&origin);
    const double step = std::max(pose.cwiseAbs().maxCoeff(), 1e-3) / 4096;
    const CornerTable table(input.layout.topology);
    const auto encoded = encode_pose_by(nullptr, pose, origin, step, table);
    Vector<int32_t> decoded;
    ASSERT_EQ(decode_pose(encoded->stream, table, PoseSteps::kDependent, &decoded), Status::kOk);
    EXPECT_EQ(decoded, encoded->grid.points);
    double largest = 0;
    for (Eigen::Index i = 0; i < pose.size(); ++i)
      largest = std::max(largest, std::abs(decoded[static_cast<size_t>(i)] * encoded->grid.step -
                                           pose(i / 3, i % 3)));
    EXPECT_LE(largest, 1.2 * step);
  }
}

TEST(DependentIntegers, TheirMeanErrorIsThatOfRoundingToTheStepTheyStandFor) {
  const MatrixXd values = 1000 * MatrixXd::Random(4000, 3);
  const Vector<int32_t> integers = dependent_integers(values);
  double squared = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    squared += std::pow(integers[static_cast<size_t>(i)] - values(i / 3, i % 3), 2);
  constexpr double kStep = 1 / 0.565;
  EXPECT_NEAR(squared / static_cast<double>(values.size()), kStep * kStep / 12, 0.005);
}

TEST(ReferencePoseOfCorpus, IsCodedByPartnersIfThatIsSmaller) {
  const EncoderInput input(corpus::make_clip("quad_box"));
  Eigen::Vector3d origin;
  const MatrixXd pose = input.centred_first_pose(&origin);
  const double step = pose.cwiseAbs().maxCoeff() / 4096;
  const CornerTable table(input.layout.topology);
  const size_t best = encode_reference_pose(pose, origin, step, input.layout)->stream.size();
  EXPECT_LE(best, encode_pose_by(nullptr, pose, origin, step, table)->stream.size());
}

}  // namespace
}  // namespace anicodec
