// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "corpus/clips.h"
#include "tests/tools/gltf_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/gltf/gltf.h"
#include "tools/peers/draco_frames.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

/// Frame 0 of a clip as a mesh whose primitive is a Draco bitstream, moved by its node.
class GltfDraco : public testing::Test {
 protected:
  GltfDraco() : source_(corpus::make_clip("limb")), triangles_(fan_triangles(source_.polygons)) {
    const std::vector<char> coded = peers::draco_frame(source_, triangles_, 0, 14);
    bitstream_.assign(coded.begin(), coded.end());
  }

  GltfScene scene(const std::vector<int8_t>& bitstream) const {
    GltfScene scene;
    const size_t view = scene.view(bitstream);
    scene.document["asset"] = {{"version", "2.0"}};
    scene.document["scenes"] = {{{"nodes", {0}}}};
    scene.document["nodes"] = {{{"mesh", 0}}};
    scene.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    scene.document["accessors"] = nlohmann::json::array(
        {{{"componentType", 5126}, {"count", source_.vertex_count}, {"type", "VEC3"}},
         {{"componentType", 5125}, {"count", triangles_.size()}, {"type", "SCALAR"}}});
    const nlohmann::json coded = {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
    scene.document["meshes"] = {{{"primitives",
                                  {{{"attributes", {{"POSITION", 0}}},
                                    {"indices", 1},
                                    {"extensions", {{"KHR_draco_mesh_compression", coded}}}}}}}};
    scene.animate(0, "translation", {0, 1}, scene.vectors({0, 0, 0, 5, 0, 0}));
    return scene;
  }

  static MeshSequence parse(const GltfScene& scene) {
    return parse_gltf(scene.glb(), "a.glb", {}, GltfOptions{.rate = FrameRate{10, 1, false}});
  }

  MeshSequence source_;
  std::vector<uint32_t> triangles_;
  std::vector<int8_t> bitstream_;
};

using Points = std::vector<std::array<double, 3>>;

Points middles(std::span<const float> positions, const std::vector<uint32_t>& triangles) {
  Points out(triangles.size() / 3);
  for (size_t i = 0; i < triangles.size(); ++i) {
    for (size_t c = 0; c < 3; ++c)
      out[i / 3][c] += double{positions[size_t{3} * triangles[i] + c]} / 3;
  }
  return out;
}

/// The largest distance of a point of `a` to the nearest of `b`.
double distance(const Points& a, const Points& b) {
  double largest = 0;
  for (const auto& p : a) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& q : b)
      nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST_F(GltfDraco, ReadsTheMeshThatWasCompressed) {
  const MeshSequence read = parse(scene(bitstream_));
  check(read);
  ASSERT_EQ(read.vertex_count, source_.vertex_count);
  ASSERT_EQ(read.polygons.size(), triangles_.size() / 3);
  ASSERT_EQ(read.frame_count, 11U);
  const Points before = middles(source_.frame(0), triangles_);
  const Points after = middles(read.frame(0), fan_triangles(read.polygons));
  const double step = diagonal(source_) / (1 << 14);
  EXPECT_LT(distance(before, after), step);
  EXPECT_LT(distance(after, before), step);
  for (size_t i = 0; i < read.frame(0).size(); i += 3)
    EXPECT_NEAR(read.frame(10)[i] - read.frame(0)[i], 5, 1e-5);
}

TEST_F(GltfDraco, SaysWhereADamagedBitstreamIs) {
  for (size_t size : {size_t{0}, size_t{4}, size_t{11}, bitstream_.size() / 2}) {
    const std::vector<int8_t> part(bitstream_.begin(),
                                   bitstream_.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THAT(fault([&] { parse(scene(part)); }), HasSubstr("a.glb: /")) << size;
  }
  GltfScene other = scene(bitstream_);
  other.document["accessors"][0]["count"] = source_.vertex_count + 1;
  EXPECT_THAT(fault([&] { parse(other); }),
              HasSubstr("/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: the Draco"));
  GltfScene absent = scene(bitstream_);
  absent.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 7;
  EXPECT_THAT(fault([&] { parse(absent); }), HasSubstr("the Draco bitstream is damaged"));
}

TEST_F(GltfDraco, SurvivesAnyChangedByte) {
  for (size_t at = 0; at < bitstream_.size(); at += 37) {
    std::vector<int8_t> changed = bitstream_;
    changed[at] = static_cast<int8_t>(~changed[at]);
    try {
      check(parse(scene(changed)));
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kInput) << at;
    }
  }
}

}  // namespace
}  // namespace anicodec::tools
