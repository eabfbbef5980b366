// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/edge_refinement.h"

#include "codec/interpolation/interpolation.h"
#include "codec/surface/closest_point.h"
#include "corpus/clips.h"
#include "corpus/poses.h"

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Points disturbed(Points x, double size) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, size);
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x.data()[i] += normal(random);
  return x;
}

TEST(EdgeRefinement, FindsAShapeAgainFromItsLengthsAndAngles) {
  const MeshSequence clip = corpus::make_clip("limb");
  const EdgeNetwork network(fan_triangles(clip.polygons), clip.vertex_count);
  const Points wanted = to_points(clip.frame(10));
  const EdgeShape target = measure_edges(network, wanted);
  Points x = disturbed(wanted, 0.01);
  EdgeRefinement refinement(network);
  EXPECT_GE(refinement.energy(target, x), 1);
  EXPECT_LE(refinement.refine(target, 8, x), 1e-9);
  EXPECT_LE(edge_error(network, x, target, 0).length, 1e-6);
}

TEST(EdgeRefinement, NeverRaisesTheEnergy) {
  for (const char* name : {"cloth", "nonmanifold", "leftovers", "one_triangle", "points"}) {
    const MeshSequence clip = corpus::make_clip(name);
    const EdgeNetwork network(fan_triangles(clip.polygons), clip.vertex_count);
    const EdgeShape target = measure_edges(network, to_points(clip.frame(0)));
    Points x = disturbed(to_points(clip.frame(clip.frame_count / 2)), 0.02);
    EdgeRefinement refinement(network);
    double before = refinement.energy(target, x);
    for (int step = 0; step < 3; ++step) {
      const double after = refinement.refine(target, 1, x);
      EXPECT_LE(after, before) << name;
      EXPECT_TRUE(x.allFinite()) << name;
      before = after;
    }
  }
}

TEST(EdgeRefinement, LowersTheEnergyOfAnInterpolation) {
  const MeshSequence poses = corpus::make_poses("twist", 2000);
  const std::vector<uint32_t> triangles = fan_triangles(poses.polygons);
  const EdgeNetwork network(triangles, poses.vertex_count);
  const std::vector<std::span<const float>> inputs{poses.frame(0), poses.frame(1)};
  const std::vector<Points> points{to_points(inputs[0]), to_points(inputs[1])};
  const double half[] = {0.5, 0.5};
  const EdgeShape target = blend_edges(measure_edges(network, points), half);
  EdgeRefinement refinement(network);
  double energy[2];
  for (int refined = 0; refined < 2; ++refined) {
    InterpolationOptions options;
    options.leaf_faces = 8;
    options.refinement_steps = 2 * refined;
    auto interpolation = make_interpolation(triangles, poses.vertex_count, inputs, options);
    energy[refined] = refinement.energy(target, to_points(interpolation->evaluate(half)));
  }
  EXPECT_LE(energy[1], 0.5 * energy[0]);
}

}  // namespace
}  // namespace anicodec
