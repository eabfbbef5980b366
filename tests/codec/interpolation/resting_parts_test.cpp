// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/resting_parts.h"

#include "codec/interpolation/interpolation.h"
#include "codec/surface/closest_point.h"
#include "corpus/clips.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// A limb, and the same bent about its middle: the lower half rests.
struct Limb {
  Limb() : clip(corpus::make_clip("limb")), triangles(fan_triangles(clip.polygons)) {
    const std::span<const float> pose = std::as_const(clip).frame(0);
    first.assign(pose.begin(), pose.end());
    const Eigen::Map<const Eigen::Matrix3Xf> x(first.data(), 3, clip.vertex_count);
    const Eigen::Vector3f low = x.rowwise().minCoeff(), high = x.rowwise().maxCoeff();
    Eigen::Index along = 0;
    const float length = (high - low).maxCoeff(&along);
    const float middle = (low + high)[along] / 2;
    second = first;
    for (uint32_t v = 0; v < clip.vertex_count; ++v) {
      Eigen::Map<Eigen::Vector3f> p(&second[3 * size_t{v}]);
      const float above = (p[along] - middle) / length;
      if (above <= 0) {
        resting.push_back(v);
        continue;
      }
      const Eigen::Vector3f hinge = Eigen::Vector3f::Unit(along) * middle;
      const Eigen::AngleAxisf turn(4 * above, Eigen::Vector3f::Unit((along + 1) % 3));
      p = (turn * (p - hinge) + hinge).eval();
    }
  }

  double off(std::span<const float> x) const {
    double most = 0;
    for (const uint32_t v : resting) {
      for (size_t k = 0; k < 3; ++k)
        most = std::max(most, std::abs(static_cast<double>(x[3 * v + k] - first[3 * v + k])));
    }
    return most / diagonal(clip);
  }

  MeshSequence clip;
  std::vector<uint32_t> triangles;
  std::vector<float> first, second;
  std::vector<uint32_t> resting;
};

TEST(RestingParts, StayAtTheirPlaceByMethodsThatPlaceTheWhole) {
  const Limb limb;
  ASSERT_GE(limb.resting.size(), 20U);
  const std::span<const float> inputs[] = {limb.first, limb.second};
  const auto largest_off = [&](InterpolationMethod method, double t) {
    InterpolationOptions options;
    options.method = method;
    const double weights[] = {1 - t, t};
    return limb.off(make_interpolation(limb.triangles, limb.clip.vertex_count, inputs, options)
                        ->evaluate(weights));
  };
  for (const double t : {0.25, 0.5, 1.25})
    EXPECT_LE(largest_off(InterpolationMethod::kMsgi, t), 2e-3) << t;
  // Its seams bend what rests, too, and a motion of the whole cannot undo that.
  for (const double t : {0.25, 0.5})
    EXPECT_LE(largest_off(InterpolationMethod::kVertexBlending, t), 4e-3) << t;
}

TEST(RestingParts, AreMovedBackAsAWholeAndOthersAreLeft) {
  const Limb limb;
  const std::span<const float> inputs[] = {limb.first, limb.second};
  const RestingParts parts(limb.triangles, limb.clip.vertex_count, inputs);
  ASSERT_FALSE(parts.empty());
  const Eigen::AngleAxisf turn(0.4F, Eigen::Vector3f(1, 2, 3).normalized());
  std::vector<float> moved = limb.second;
  for (size_t v = 0; v < limb.clip.vertex_count; ++v) {
    Eigen::Map<Eigen::Vector3f> p(&moved[3 * v]);
    p = (turn * p + Eigen::Vector3f(1, 0, -2)).eval();
  }
  parts.anchor(moved);
  for (size_t i = 0; i < moved.size(); ++i)
    ASSERT_NEAR(moved[i], limb.second[i], 1e-3 * diagonal(limb.clip)) << i;

  const std::vector<float> away(limb.first.size(), 5.0F);
  const std::span<const float> apart[] = {limb.first, away};
  EXPECT_TRUE(RestingParts(limb.triangles, limb.clip.vertex_count, apart).empty());
}

}  // namespace
}  // namespace anicodec
