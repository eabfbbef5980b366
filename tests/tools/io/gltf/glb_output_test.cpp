// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/glb_output.h"

#include "corpus/clips.h"
#include "tests/real_data.h"
#include "tests/tools/clip_testing.h"
#include "tests/tools/command_testing.h"
#include "tests/tools/gltf_testing.h"
#include "tests/two_boxes.h"
#include "tools/io/gltf/gltf.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

double largest_difference(const MeshSequence& a, const MeshSequence& b) {
  double largest = a.positions.size() == b.positions.size() ? 0 : HUGE_VAL;
  for (size_t i = 0; i < a.positions.size() && largest < HUGE_VAL; ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a.positions[i]) -
                                         static_cast<double>(b.positions[i])));
  return largest;
}

TEST(GlbOutput, ReadsBackTheSameClip) {
  TemporaryFolder folder;
  MeshSequence clip = gltf_limb();
  clip.rate = {25, 1, false};
  write_sequence(folder / "a.glb", clip);
  MeshSequence back = load_file(folder / "a.glb");
  EXPECT_EQ(back.frame_count, clip.frame_count);
  EXPECT_EQ(back.rate.numerator, 25U) << "less than 30, but written down";
  EXPECT_LT(largest_difference(back, clip), 1e-6 * diagonal(clip));
}

TEST(GlbOutput, KeepsMaterialsAndAttributesOfVertices) {
  TemporaryFolder folder;
  GltfScene scene = triangle_scene();
  scene.primitive()["attributes"]["TEXCOORD_0"] =
      scene.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 5126, 2);
  scene.primitive()["attributes"]["COLOR_0"] = scene.quads({1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0.5});
  scene.primitive()["material"] = 1;
  scene.document["materials"] = {{{"name", "red"}}, {{"name", "blue"}}};
  folder.write("a.glb", scene.glb());
  MeshSequence first = load_file(folder / "a.glb");
  write_sequence(folder / "b.glb", first);
  MeshSequence back = load_file(folder / "b.glb");
  EXPECT_EQ(back.materials, first.materials);
  ASSERT_EQ(back.attributes.size(), 2U);
  for (size_t i = 0; i < 2; ++i)
    EXPECT_EQ(back.attributes[i].values, first.attributes[i].values);
}

TEST(GlbOutput, MakesAMeshOfEachObjectAndKeepsTheirNames) {
  TemporaryFolder folder;
  MeshSequence scene = two_boxes();
  write_sequence(folder / "a.glb", scene);
  const MeshSequence back = load_file(folder / "a.glb");
  const size_t quads = scene.polygons.size() / 2;  // of an object
  EXPECT_EQ(back.parts.names, scene.parts.names);
  EXPECT_EQ(back.polygons.size(), 4 * quads);
  EXPECT_EQ(std::ranges::count(back.parts.of_polygon, 1U), 2 * quads);
  EXPECT_LT(largest_difference(back, scene), 1e-6 * diagonal(scene));
  LoadOptions one;
  one.mesh = "still";
  EXPECT_EQ(load_sequence(std::vector<std::string>{folder / "a.glb"}, one).vertex_count,
            scene.vertex_count / 2);

  std::vector<uint32_t>& part = scene.parts.of_polygon;
  std::swap(part[1], part[quads + 1]);
  part[2] = kNoLabel;
  write_sequence(folder / "b.glb", scene);
  const MeshSequence mixed = load_file(folder / "b.glb");
  EXPECT_GT(mixed.vertex_count, scene.vertex_count) << "corners of two objects";
  EXPECT_EQ(std::ranges::count(mixed.parts.of_polygon, kNoLabel), 2);
  EXPECT_EQ(std::ranges::count(mixed.parts.of_polygon, 0U), 2 * (quads - 1));
}

TEST(GlbOutput, CutsConcavePolygonsSoThatTrianglesCoverThemOnce) {
  MeshSequence clip;  // an L that begins at a corner from which no fan covers it; its area is 5
  clip.polygons.add(std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
  clip.vertex_count = 6;
  clip.frame_count = 1;
  clip.positions = {3, 0, 0, 3, 1, 0, 1, 1, 0, 1, 3, 0, 0, 3, 0, 0, 0, 0};
  GlbOutput output(clip, false);
  output.add_frame(clip.positions, {});
  const MeshSequence back = parse_gltf(output.finish(std::vector<float>{0}), "l.glb", {}, {});
  ASSERT_EQ(back.polygons.size(), 4U);
  double whole = 0;
  for (size_t p = 0; p < 4; ++p) {
    const auto at = [&](size_t corner, size_t axis) {
      return static_cast<double>(back.positions[3 * back.polygons[p][corner] + axis]);
    };
    const double area = (at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) -
                        (at(2, 0) - at(0, 0)) * (at(1, 1) - at(0, 1));
    EXPECT_GT(area, 0);
    whole += area / 2;
  }
  EXPECT_DOUBLE_EQ(whole, 5);
}

TEST(GlbOutput, TurnsClipsWithZUpAndScalesUnits) {
  TemporaryFolder folder;
  MeshSequence clip;
  clip.vertex_count = 3;
  clip.frame_count = 1;
  clip.positions = {0, 0, 0, 1, 0, 0, 0, 0, 100};
  clip.polygons.add(std::vector<uint32_t>{0, 1, 2});
  clip.up = UpAxis::kZ;
  clip.metres_per_unit = 0.01;
  write_sequence(folder / "a.glb", clip);
  EXPECT_NEAR(load_file(folder / "a.glb").positions[7], 1, 1e-6) << "y";
}

TEST(GlbOutput, IsSparseWhereLittleMoves) {
  TemporaryFolder folder;
  MeshSequence clip = gltf_limb();
  for (uint32_t f = 1; f < clip.frame_count; ++f) {
    std::copy(clip.frame(0).begin(), clip.frame(0).end(), clip.frame(f).begin());
    clip.frame(f)[0] += 1.0F;
  }
  write_sequence(folder / "a.glb", clip);
  EXPECT_LT(std::filesystem::file_size(folder / "a.glb"), size_t{12} * clip.vertex_count +
                                                              4 * clip.polygons.corners.size() * 2 +
                                                              size_t{900} * clip.frame_count);
  EXPECT_LT(largest_difference(load_file(folder / "a.glb"), clip), 1e-6 * diagonal(clip));
}

TEST(GlbOutput, StepsWhereAskedTo) {
  TemporaryFolder folder;
  MeshSequence clip = corpus::make_clip("limb");
  for (bool step : {false, true}) {
    write_sequence(folder / "a.glb", clip, {.overwrite = true, .step = step});
    EXPECT_THAT(folder.read("a.glb"), HasSubstr(step ? "\"STEP\"" : "\"LINEAR\""));
  }
}

}  // namespace
}  // namespace anicodec::tools
