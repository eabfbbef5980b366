// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Multi-scale geometry interpolation of the clips and poses of the corpus.
#include "codec/surface/closest_point.h"
#include "codec/surface/edge_network.h"
#include "corpus/clips.h"
#include "corpus/poses.h"
#include "sdk/msgi/msgi.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Between {
  Between(const MeshSequence& clip, uint32_t a, uint32_t b, uint32_t leaf_faces)
      : triangles(fan_triangles(clip.polygons)),
        inputs{clip.frame(a).data(), clip.frame(b).data()} {
    Msgi::Options options;
    options.leaf_faces = leaf_faces;
    EXPECT_EQ(msgi.init(triangles.data(), triangles.size() / 3, clip.vertex_count, inputs.data(), 2,
                        options),
              Status::kOk);
    scratch.resize((msgi.scratch_bytes() + 7) / 8);
    out.resize(3 * size_t{clip.vertex_count});
  }

  std::span<const float> at(double t) {
    const double weights[] = {1 - t, t};
    EXPECT_EQ(msgi.evaluate(weights, nullptr, scratch.data(), out.data()), Status::kOk);
    return out;
  }

  std::vector<uint32_t> triangles;
  std::vector<const float*> inputs;
  Msgi msgi;
  std::vector<double> scratch;
  std::vector<float> out;
};

EdgeError error_halfway(std::string_view poses, uint32_t leaf_faces) {
  MeshSequence clip = corpus::make_poses(poses);
  Between between(clip, 0, 1, leaf_faces);
  EdgeNetwork network(between.triangles, clip.vertex_count);
  std::vector<Points> inputs{to_points(clip.frame(0)), to_points(clip.frame(1))};
  const double half[] = {0.5, 0.5};
  double volume = (enclosed_volume(network, inputs[0]) + enclosed_volume(network, inputs[1])) / 2;
  return edge_error(network, to_points(between.at(0.5)),
                    blend_edges(measure_edges(network, inputs), half), volume);
}

TEST(MsgiPoses, ReproduceTheInputsOfAllClips) {
  for (const std::string& name : corpus::clip_names()) {
    MeshSequence clip = corpus::make_clip(name);
    uint32_t other = clip.frame_count / 2;
    Between between(clip, 0, other, 8);
    double size = diagonal(clip);
    for (uint32_t k = 0; k < 2; ++k) {
      std::span<const float> x = between.at(k), wanted = clip.frame(k == 0 ? 0 : other);
      double largest = 0;
      for (size_t i = 0; i < x.size(); ++i)
        largest = std::max(largest, std::abs(double{x[i]} - double{wanted[i]}));
      EXPECT_LE(largest, 5e-7 * size) << name << " " << k;
    }
  }
}

TEST(MsgiPoses, KeepTheLengthsOfBentTwistedAndCoiledCylinders) {
  EXPECT_LE(error_halfway("bend", 8).length, 0.0025);
  EXPECT_LE(error_halfway("twist", 8).length, 0.0080);
  EXPECT_LE(error_halfway("coil", 8).length, 0.0050);
}

TEST(MsgiPoses, KeepTheLengthsOfNeedlesInSmallPatches) {
  EXPECT_LE(error_halfway("needles", 2).length, 0.01);
}

TEST(MsgiPoses, KeepTheVolumeOfABentCylinder) {
  EdgeError error = error_halfway("bend", 8);
  EXPECT_LE(error.volume, 0.005);
  EXPECT_LE(error.angle, 0.2 * 3.1416 / 180);
}

}  // namespace
}  // namespace anicodec
