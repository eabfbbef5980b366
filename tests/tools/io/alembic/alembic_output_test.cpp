// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/alembic_output.h"

#include "tests/tools/io/alembic/alembic_testing.h"
#include "tests/tools/io_testing.h"

#include <ctime>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

/// A strip of quads that waves, with all that can stand beside positions.
MeshSequence painted_strip(uint32_t frames) {
  MeshSequence s;
  s.name = "strip";
  s.mesh_name = "/rig/strip";
  s.vertex_count = 10;
  s.frame_count = frames;
  s.rate = {30000, 1001, false};
  s.start_time = 0.5;
  s.up = UpAxis::kY;
  for (uint32_t v = 0; v + 3 < 10; v += 2)
    s.polygons.add(std::vector<uint32_t>{v, v + 1, v + 3, v + 2});
  for (uint32_t i = 0; i < frames * 30; ++i)
    s.positions.push_back(static_cast<float>((i * 37) % 101) / 7.0F);
  Attribute uv{
      .kind = AttributeKind::kUv, .name = "map1", .domain = AttributeDomain::kCorner, .values = {}};
  for (uint32_t c = 0; c < 32; ++c)
    uv.values.push_back(static_cast<float>(c % 5) / 4.0F);
  Attribute second{.kind = AttributeKind::kUv, .name = "map2", .values = {}};
  second.values.resize(20);
  std::iota(second.values.begin(), second.values.end(), 0.0F);
  Attribute heat{.kind = AttributeKind::kCustom, .name = "heat", .components = 1, .values = {}};
  heat.frames = frames;
  Attribute colour{.kind = AttributeKind::kColour, .name = "Cd", .components = 4, .values = {}};
  for (uint32_t i = 0; i < 10 * frames; ++i)
    heat.values.push_back(static_cast<float>(i));
  colour.values.assign(40, 0.25F);
  s.attributes = {uv, second, colour, heat};
  s.materials = {{"red", "blue"}, {0, 1, 1, kNoLabel}};
  return s;
}

const Attribute* find(const MeshSequence& clip, const std::string& name) {
  for (const Attribute& a : clip.attributes) {
    if (a.name == name)
      return &a;
  }
  return nullptr;
}

void expect_same(const MeshSequence& in, const MeshSequence& out) {
  EXPECT_EQ(out.vertex_count, in.vertex_count);
  EXPECT_EQ(out.frame_count, in.frame_count);
  EXPECT_EQ(out.polygons, in.polygons);
  EXPECT_EQ(out.positions, in.positions);
  EXPECT_EQ(out.materials, in.materials);
  for (const Attribute& a : in.attributes) {
    SCOPED_TRACE(a.name);
    const Attribute* b = find(out, a.name);
    ASSERT_NE(b, nullptr);
    EXPECT_EQ(b->kind, a.kind);
    EXPECT_EQ(b->per_corner(), a.per_corner());
    EXPECT_EQ(b->components, a.components);
    EXPECT_EQ(b->frames, a.frames);
    EXPECT_EQ(b->values, a.values);
  }
}

TEST(AlembicOutput, ReadsBackExactly) {
  const MeshSequence in = painted_strip(5);
  const std::string bytes = archive_of_scene(scene_of(in));
  const MeshSequence out = read_bytes_of_archive(bytes);
  expect_same(in, out);
  EXPECT_EQ(out.parts.names, (std::vector<std::string>{"/rig/strip"}));
  EXPECT_EQ(out.rate.numerator, 30000U);
  EXPECT_EQ(out.rate.denominator, 1001U);
  EXPECT_DOUBLE_EQ(out.start_time, 0.5);
  EXPECT_TRUE(out.times.empty());
  EXPECT_EQ(bytes, archive_of_scene(scene_of(in)));
}

TEST(AlembicOutput, ReadsBackWithinAMemoryThatAttributesShare) {
  const std::string bytes = archive_of_scene(scene_of(painted_strip(50)));
  constexpr uint64_t kPositions = uint64_t{12} * 10 * 50, kStill = 4 * (64 + 20 + 40),
                     kHeat = uint64_t{4} * 10 * 50;
  EXPECT_EQ(read_bytes_of_archive(bytes, {.memory_limit = kPositions + kStill + kHeat}).frame_count,
            50U);
  EXPECT_THAT(fault([&] { read_bytes_of_archive(bytes, {.memory_limit = kPositions + kHeat - 1}); },
                    ErrorKind::kInput),
              testing::HasSubstr("attributes that move take more memory"));
}

TEST(AlembicOutput, ReadsManyObjectsBackInLinearTime) {
  constexpr uint32_t kCount = 20'000;
  MeshSequence in;
  in.vertex_count = 3 * kCount;
  in.frame_count = 1;
  for (uint32_t i = 0; i < kCount; ++i) {
    in.polygons.add(std::vector<uint32_t>{3 * i, 3 * i + 1, 3 * i + 2});
    in.positions.insert(in.positions.end(), {0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(i)});
    in.parts.names.push_back("part" + std::to_string(i));
    in.parts.of_polygon.push_back(i);
  }
  const std::string bytes = archive_of_scene(scene_of(in));
  const std::clock_t before = std::clock();
  EXPECT_EQ(read_bytes_of_archive(bytes).polygons.size(), kCount);
  EXPECT_LT(std::clock() - before, 20 * CLOCKS_PER_SEC);  // the square would be a minute and more
}

TEST(AlembicOutput, KeepsAwkwardMeshes) {
  MeshSequence in = awkward_clip(3);
  const MeshSequence out = read_bytes_of_archive(archive_of_scene(scene_of(in)));
  expect_same(in, out);
  EXPECT_EQ(out.parts.names, (std::vector<std::string>{"/awkward/awkwardShape"}));
}

TEST(AlembicOutput, KeepsUnevenTimesAndOneFrame) {
  MeshSequence in = painted_strip(4);
  in.times = {0, 0.125, 0.5, 2};
  const MeshSequence out = read_bytes_of_archive(archive_of_scene(scene_of(in)));
  EXPECT_EQ(out.times, in.times);
  expect_same(painted_strip(1),
              read_bytes_of_archive(archive_of_scene(scene_of(painted_strip(1)))));
}

TEST(AlembicOutput, StoresEqualSamplesOnce) {
  MeshSequence still = painted_strip(1);
  still.attributes.clear();
  const size_t one = archive_of_scene(scene_of(still)).size();
  const FrameArray frame = still.positions;
  still.frame_count = 50;
  still.positions.clear();
  for (int f = 0; f < 50; ++f)
    still.positions.insert(still.positions.end(), frame.begin(), frame.end());
  EXPECT_LT(archive_of_scene(scene_of(still)).size(), one + 64);
  // There and back: two shapes, 50 samples.
  for (size_t f = 1; f < 50; f += 2)
    std::ranges::reverse(still.frame(f));
  const std::string bytes = archive_of_scene(scene_of(still));
  EXPECT_LT(bytes.size(), one + 200 + 50 * (8 + 8 + 8));
  EXPECT_EQ(read_bytes_of_archive(bytes).positions, still.positions);
}

TEST(AlembicOutput, WritesAnObjectForEachPart) {
  MeshSequence in = painted_strip(3);
  in.mesh_name.clear();
  in.parts = {{"left", "/a/right"}, {0, 0, 1, 1}};
  const MeshSequence out = read_bytes_of_archive(archive_of_scene(scene_of(in)));
  EXPECT_EQ(out.parts.names, (std::vector<std::string>{"/left/leftShape", "/a/right"}));
  EXPECT_EQ(out.parts.of_polygon, (std::vector<uint32_t>{0, 0, 1, 1}));
  EXPECT_EQ(out.vertex_count, in.vertex_count + 2);  // two that the parts share
  const MeshSequence right = read_bytes_of_archive(archive_of_scene(scene_of(in)), {.mesh = "/a"});
  EXPECT_EQ(right.polygons.size(), 2U);
  EXPECT_EQ(right.materials.names, (std::vector<std::string>{"blue"}));
  EXPECT_THAT(fault([&] { read_bytes_of_archive(archive_of_scene(scene_of(in)), {.mesh = "/b"}); },
                    ErrorKind::kUsage),
              testing::HasSubstr("the meshes are: /left/leftShape, /a/right"));
}

TEST(AlembicOutput, WritesConnectivitiesThatTakeTurns) {
  Scene in = scene_of(painted_strip(2));
  MeshSequence other = painted_strip(3);
  other.polygons = {};
  other.polygons.add(std::vector<uint32_t>{0, 1, 2});
  other.attributes.resize(1);
  other.attributes[0].values.resize(6);
  other.materials = {{"blue"}, {0}};
  in.meshes[0].present_in = {{1, 1}, {5, 1}};
  in.meshes.push_back({other, {{2, 3}}});
  in.clip.frame_count = 7;
  const std::string bytes = archive_of_scene(in);
  const Scene out = read_alembic_meshes(memory_source(bytes, "test.abc"));
  EXPECT_EQ(out.clip.frame_count, 7U);
  ASSERT_EQ(out.meshes.size(), 2U);
  for (size_t m : {0, 1}) {
    EXPECT_EQ(out.meshes[m].present_in, in.meshes[m].present_in);
    EXPECT_EQ(out.meshes[m].sequence.positions, in.meshes[m].sequence.positions);
    EXPECT_EQ(out.meshes[m].sequence.polygons, in.meshes[m].sequence.polygons);
    EXPECT_EQ(out.meshes[m].sequence.mesh_name, "/rig/strip");
  }
  EXPECT_THAT(fault([&] { read_bytes_of_archive(bytes); }),
              testing::HasSubstr("/rig/strip: its faces change at frame 2"));
}

TEST(AlembicOutput, TurnsWhatHasZUp) {
  MeshSequence in = painted_strip(1);
  in.up = UpAxis::kZ;
  const MeshSequence out = read_bytes_of_archive(archive_of_scene(scene_of(in)));
  for (uint32_t v = 0; v < in.vertex_count; ++v) {
    EXPECT_NEAR(out.positions[3 * v + 1], in.positions[3 * v + 2], 1e-6);
    EXPECT_NEAR(out.positions[3 * v + 2], -in.positions[3 * v + 1], 1e-6);
  }
}

TEST(AlembicOutput, WritesNormalsOnRequest) {
  const MeshSequence in = painted_strip(2);
  EXPECT_EQ(find(read_bytes_of_archive(archive_of_scene(scene_of(in))), "N"), nullptr);
  const MeshSequence out = read_bytes_of_archive(archive_of_scene(scene_of(in), true));
  const Attribute* normals = find(out, "N");
  ASSERT_NE(normals, nullptr);
  EXPECT_TRUE(normals->per_corner());
  EXPECT_EQ(normals->values.size(), in.polygons.corners.size() * 3);
}

TEST(AlembicOutput, RefusesAllThatIsTruncated) {
  const std::string bytes = archive_of_scene(scene_of(painted_strip(3)));
  for (size_t size = 0; size < bytes.size(); size += 7) {
    const std::string part = bytes.substr(0, size);
    EXPECT_THROW(read_bytes_of_archive(part), Error) << size;
  }
}

}  // namespace
}  // namespace anicodec::tools
