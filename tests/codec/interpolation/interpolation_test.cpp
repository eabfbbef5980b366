// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/interpolation.h"

#include "codec/interpolation/deformation_gradients.h"
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "corpus/clips.h"
#include "corpus/poses.h"

#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Poses {
  explicit Poses(const MeshSequence& sequence)
      : clip(sequence), triangles(fan_triangles(clip.polygons)) {
    for (uint32_t f = 0; f < clip.frame_count; ++f)
      inputs.push_back(std::as_const(clip).frame(f));
  }

  EdgeError error(InterpolationMethod method, double t) const {
    const EdgeNetwork network(triangles, clip.vertex_count);
    const std::vector<Points> points{to_points(inputs[0]), to_points(inputs[1])};
    const double weights[] = {1 - t, t};
    InterpolationOptions options;
    options.method = method;
    const double volume =
        (1 - t) * enclosed_volume(network, points[0]) + t * enclosed_volume(network, points[1]);
    return edge_error(network, to_points(make(options)->evaluate(weights)),
                      blend_edges(measure_edges(network, points), weights), volume);
  }

  std::unique_ptr<Interpolation> make(const InterpolationOptions& options) const {
    return make_interpolation(triangles, clip.vertex_count, inputs, options);
  }

  MeshSequence clip;
  std::vector<uint32_t> triangles;
  std::vector<std::span<const float>> inputs;
};

MeshSequence frames_of_clip(const char* name, uint32_t a, uint32_t b) {
  MeshSequence clip = corpus::make_clip(name);
  FrameArray positions;
  for (uint32_t f : {a, b})
    positions.insert(positions.end(), clip.frame(f).begin(), clip.frame(f).end());
  clip.positions = positions;
  clip.frame_count = 2;
  return clip;
}

TEST(Interpolation, AllMethodsReproduceAPoseThatIsNotFar) {
  for (const char* name : {"limb", "cloth", "nonmanifold", "open_pair"}) {
    Poses poses(frames_of_clip(name, 0, 11));
    for (InterpolationMethod method : interpolation_methods()) {
      if (method == InterpolationMethod::kVertexBlending)
        continue;  // seams, and a rigid motion of its own
      InterpolationOptions options;
      options.method = method;
      auto interpolation = poses.make(options);
      for (size_t i = 0; i < 2; ++i) {
        const double weights[] = {i == 0 ? 1.0 : 0.0, i == 0 ? 0.0 : 1.0};
        const Points x = to_points(interpolation->evaluate(weights));
        EXPECT_LE((x - to_points(poses.inputs[i])).colwise().norm().maxCoeff(),
                  2e-6 * diagonal(poses.clip))
            << name << " " << name_of(method) << " " << i;
      }
    }
  }
}

TEST(Interpolation, VertexBlendingReproducesLengthsOfASmoothPose) {
  EXPECT_LE(
      Poses(frames_of_clip("limb", 0, 11)).error(InterpolationMethod::kVertexBlending, 0).length,
      1e-5);
}

TEST(Interpolation, TrackedGradientsBendFartherThanPlainOnes) {
  Poses poses(corpus::make_poses("bend", 3000));
  const double linear = poses.error(InterpolationMethod::kLinear, 0.5).length;
  const double plain = poses.error(InterpolationMethod::kGradients, 0.5).length;
  const double tracked = poses.error(InterpolationMethod::kPml, 0.5).length;
  EXPECT_LT(plain, linear / 3);
  EXPECT_LT(tracked, plain / 3);
  EXPECT_LE(tracked, 0.006);
}

TEST(Interpolation, MsgiWindsUpAHelixThatGradientsDoNot) {
  Poses poses(corpus::make_poses("coil", 3000));
  EXPECT_LE(poses.error(InterpolationMethod::kMsgi, 0.5).length, 0.006);
  EXPECT_GE(poses.error(InterpolationMethod::kPml, 0.5).length, 0.02);
}

TEST(Interpolation, NeedlesGetSmallerPatches) {
  Poses poses(corpus::make_poses("needles"));
  EXPECT_LT(choose_leaf_faces(poses.triangles, poses.clip.vertex_count, poses.inputs), 4U);
  EXPECT_LE(poses.error(InterpolationMethod::kMsgi, 0.5).length, 0.010);
  Poses bend(corpus::make_poses("bend", 3000));
  EXPECT_GE(choose_leaf_faces(bend.triangles, bend.clip.vertex_count, bend.inputs), 4U);
}

TEST(Interpolation, RefusesWhatCannotBeInterpolated) {
  Poses poses(frames_of_clip("limb", 0, 11));
  auto expect_usage = [](auto call) {
    try {
      call();
      ADD_FAILURE() << "no error";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUsage) << e.what();
    }
  };
  for (InterpolationMethod method : interpolation_methods()) {
    InterpolationOptions options;
    options.method = method;
    auto interpolation = poses.make(options);
    const double wrong[] = {0.5, 0.6}, few[] = {1.0};
    expect_usage([&] { interpolation->evaluate(wrong); });
    expect_usage([&] { interpolation->evaluate(few); });
    expect_usage([&] {
      make_interpolation(poses.triangles, poses.clip.vertex_count, std::span(poses.inputs).first(1),
                         options);
    });
  }
  InterpolationOptions options;
  options.pins = {poses.clip.vertex_count};
  expect_usage([&] { poses.make(options); });
  options.pins = {1, 2, 1};
  expect_usage([&] { poses.make(options); });
  options.pins = {1};
  options.method = InterpolationMethod::kPml;
  expect_usage([&] { poses.make(options); });
}

}  // namespace
}  // namespace anicodec
