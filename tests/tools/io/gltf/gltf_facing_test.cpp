// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The front of faces: the signed volume of a closed surface, the sum over the tetrahedra of its
// triangles and the origin, is positive if they point outwards.
#include "codec/sequence/scene.h"
#include "tests/tools/gltf_testing.h"
#include "tools/io/gltf/gltf.h"
#include "tools/io/gltf/moving_glb.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using nlohmann::json;
using testing::Each;
using testing::ElementsAre;

Eigen::Vector3d place(const MeshSequence& s, uint32_t frame, uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3f>(s.frame(frame).data() + 3 * vertex).cast<double>();
}

double volume(const MeshSequence& s, uint32_t frame) {
  double sum = 0;
  for (size_t p = 0; p < s.polygons.size(); ++p) {
    const std::span<const uint32_t> c = s.polygons[p];
    sum += place(s, frame, c[0]).dot(place(s, frame, c[1]).cross(place(s, frame, c[2])));
  }
  return sum / 6;
}

std::vector<double> volumes(const MeshSequence& s) {
  std::vector<double> out;
  for (uint32_t f = 0; f < s.frame_count; ++f)
    out.push_back(volume(s, f));
  return out;
}

MeshSequence read(const GltfScene& scene, const GltfOptions& options = {.rate = FrameRate{4, 1}}) {
  return parse_gltf(scene.glb(), "scene.glb", {}, options);
}

/// A tetrahedron of volume 1/6, shown by node 0 below node 1, which is at (2 0 0).
GltfScene tetrahedron() {
  GltfScene scene = triangle_scene();
  scene.primitive()["attributes"]["POSITION"] = scene.vectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  scene.primitive()["indices"] = scene.indices({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  scene.document["nodes"].push_back(
      {{"name", "parent"}, {"children", {0}}, {"translation", {2, 0, 0}}});
  scene.document["scenes"][0]["nodes"] = {1};
  return scene;
}

constexpr double kVolume = 1.0 / 6;
constexpr double kRounding = 1e-6;

TEST(GltfFacing, FacesTurnWhereTheGlobalTransformMirrors) {
  GltfScene scene = tetrahedron();
  json& nodes = scene.document["nodes"];
  EXPECT_NEAR(volume(read(scene), 0), kVolume, kRounding);
  nodes[0]["scale"] = {-1, 1, 1};
  EXPECT_NEAR(volume(read(scene), 0), kVolume, kRounding);
  nodes[1]["scale"] = {1, 1, -2};
  EXPECT_NEAR(volume(read(scene), 0), 2 * kVolume, kRounding) << "twice is not at all";
  nodes[0].erase("scale");
  EXPECT_NEAR(volume(read(scene), 0), 2 * kVolume, kRounding) << "a parent";
  nodes[1]["scale"] = {-1, -1, -1};
  nodes[1]["rotation"] = {0.5, 0.5, 0.5, 0.5};
  EXPECT_NEAR(volume(read(scene), 0), kVolume, kRounding);
  nodes[0]["matrix"] = {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 3, 0, 7, 8, 9, 1};
  EXPECT_NEAR(volume(read(scene), 0), 3 * kVolume, 10 * kRounding) << "matrix and parent";
}

TEST(GltfFacing, NormalsAndTangentsStayOutside) {
  GltfScene scene = triangle_scene();
  scene.primitive()["attributes"]["NORMAL"] = scene.vectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
  scene.primitive()["attributes"]["TANGENT"] = scene.quads({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
  scene.document["nodes"][0]["scale"] = {-2, 1, 1};
  const MeshSequence s = read(scene);
  ASSERT_EQ(s.attributes.size(), 2U);
  EXPECT_THAT(std::span(s.attributes[0].values).subspan(0, 3), ElementsAre(0, 0, 1));
  // The bitangent of a mirrored node is (0 1 0) as before: the normal x (-1 0 0) is (0 -1 0).
  EXPECT_THAT(std::span(s.attributes[1].values).subspan(0, 4), ElementsAre(-1, 0, 0, -1));
  const Eigen::Vector3d a = place(s, 0, s.polygons.corners[0]),
                        b = place(s, 0, s.polygons.corners[1]),
                        c = place(s, 0, s.polygons.corners[2]);
  EXPECT_GT((b - a).cross(c - a).z(), 0) << "towards the normals";
}

TEST(GltfFacing, ANodeThatMirrorsAtSomeTimesTurnsItsFacesThen) {
  for (const char* interpolation : {"STEP", "LINEAR"}) {
    GltfScene scene = tetrahedron();
    scene.animate(1, "scale", {0, 1, 2}, scene.vectors({1, 1, 1, -1, 1, 1, -1, 2, 1}),
                  interpolation);
    const MeshSequence s = read(scene, {.rate = FrameRate{3, 1}});
    for (uint32_t f = 0; f < s.frame_count; ++f) {
      const double t = f / 3.0;
      const bool step = std::string(interpolation) == "STEP";
      const double x = step ? 1 : std::abs(t < 1 ? 1 - 2 * t : 1);
      const double y = t < 1 || (step && t < 2) ? 1 : step ? 2 : t;
      EXPECT_NEAR(volume(s, f), x * y * kVolume, kRounding) << interpolation << f;
    }
    EXPECT_THAT(s.parts.names, ElementsAre("object", "object mirrored"));
    const Scene meshes = split_parts(s);
    ASSERT_EQ(meshes.meshes.size(), 2U);
    EXPECT_EQ(meshes.meshes[0].sequence.polygons.size(), 4U);
    EXPECT_EQ(meshes.meshes[0].sequence.frame_count + meshes.meshes[1].sequence.frame_count,
              s.frame_count);
  }
}

TEST(GltfFacing, ACubicSplineThatOvershootsMirrorsToo) {
  GltfScene scene = tetrahedron();
  // In-tangent, value, out-tangent of each key: the values are positive, the way between them is not.
  scene.animate(1, "scale", {0, 1},
                scene.vectors({0, 0, 0, 1, 1, 1, -9, 0, 0, 9, 0, 0, 1, 1, 1, 0, 0, 0}),
                "CUBICSPLINE");
  const MeshSequence s = read(scene);
  // By the Hermite form at 1/2: 1/2 + 1/2 - 9/8 - 9/8, of the second surface.
  ASSERT_EQ(s.vertex_count, 8U);
  EXPECT_NEAR(place(s, 2, 5).x() - place(s, 2, 4).x(), -1.25, kRounding);
  EXPECT_THAT(volumes(s), Each(testing::Gt(0)));
}

TEST(GltfFacing, AScaleThatNeverMirrorsGivesNoSecondSurface) {
  for (const std::vector<float>& keys :
       {std::vector<float>{1, 1, 1, -1, -1, 1}, {1, 1, 1, 0, 0, 0}, {1, 1, 1, 1, 1, 0}}) {
    GltfScene scene = tetrahedron();
    scene.animate(0, "scale", {0, 1}, scene.vectors(keys));
    EXPECT_EQ(read(scene).polygons.size(), 4U);
  }
  GltfScene scene = tetrahedron();  // the first factor is negative before the second is
  scene.animate(0, "scale", {0, 1}, scene.vectors({1, 1, 1, -3, -1, 1}));
  EXPECT_EQ(read(scene).polygons.size(), 8U);
}

TEST(GltfFacing, EveryInstanceHasItsPlaceAndItsFacing) {
  GltfScene scene = tetrahedron();
  json& nodes = scene.document["nodes"];
  nodes[0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", scene.vectors({0, 0, 0, 5, 0, 0, 0, 7, 0})},
      {"SCALE", scene.vectors({1, 1, 1, -1, 1, 1, 2, 2, 2})},
      {"_ID", scene.scalars({1, 2, 3})}};
  scene.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  MeshSequence s = read(scene);
  EXPECT_EQ(s.vertex_count, 12U);
  EXPECT_NEAR(volume(s, 0), (1 + 1 + 8) * kVolume, 10 * kRounding);
  EXPECT_THAT(s.frame(0).subspan(3 * 5, 3), ElementsAre(6, 0, 0));
  EXPECT_THAT(s.frame(0).subspan(3 * 10, 3), ElementsAre(2, 9, 0));
  scene.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  nodes[1]["scale"] = {1, -1, 1};
  EXPECT_NEAR(volume(read(scene), 0), (1 + 1 + 8) * kVolume, 10 * kRounding);
  nodes[0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
      scene.quads({0, 0, 0, 1});
  EXPECT_THROW(read(scene), std::exception);
}

TEST(GltfFacing, AMovingGlbHasTheTurnedFaces) {
  GltfScene scene = tetrahedron();
  scene.document["nodes"][1]["scale"] = {-1, 1, 1};
  scene.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", scene.vectors({0, 0, 0, 5, 0, 0})},
      {"SCALE", scene.vectors({1, 1, 1, 1, -1, 1})}};
  scene.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  const MeshSequence s = read(scene);
  const StillSurface still{{s.positions.begin(), s.positions.end()}, {}};
  const std::string glb = write_moving_glb(scene.glb(), "scene.glb", {}, {}, still, "the clip");
  const MeshSequence back = parse_gltf(glb, "moving.glb", {}, {});
  EXPECT_EQ(back.polygons.size(), 8U);
  EXPECT_NEAR(volume(back, 0), 2 * kVolume, kRounding);
  EXPECT_EQ(glb.find("EXT_mesh_gpu_instancing"), std::string::npos);
}

}  // namespace
}  // namespace anicodec::tools
