// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/write_sequence.h"

#include "tests/tools/io_testing.h"
#include "tools/io/load_sequence.h"

#include <bit>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

MeshSequence load(std::vector<std::string> inputs) {
  return load_sequence(inputs);
}

void expect_same(const MeshSequence& a, const MeshSequence& b) {
  EXPECT_EQ(a.polygons, b.polygons);
  EXPECT_EQ(a.vertex_count, b.vertex_count);
  EXPECT_EQ(a.frame_count, b.frame_count);
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (size_t i = 0; i < a.positions.size(); ++i)
    ASSERT_EQ(std::bit_cast<uint32_t>(a.positions[i]), std::bit_cast<uint32_t>(b.positions[i]))
        << i;
}

TEST(WriteSequence, RoundTripsFramesOfEveryFormat) {
  MeshSequence clip = awkward_clip(12);
  for (std::string extension : {"obj", "ply", "off"}) {
    for (bool ascii : {true, false}) {
      TemporaryFolder folder;
      write_sequence(folder / "f_%d." + extension, clip, {.ascii = ascii});
      EXPECT_EQ(folder.files().size(), 12U);
      MeshSequence back = load({folder / "f_*." + extension});
      expect_same(back, clip);
      EXPECT_EQ(back.name, "f_0");
      EXPECT_TRUE(back.rate.assumed);
    }
  }
}

TEST(WriteSequence, CutsConcavePolygonsOfStlOnce) {
  MeshSequence clip;  // an L that begins at a corner from which no fan covers it; its area is 5
  clip.polygons.add(std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
  clip.vertex_count = 6;
  clip.frame_count = 2;
  for (const float z : {0.F, 1.F})
    clip.positions.insert(clip.positions.end(),
                          {3, 0, z, 3, 1, z, 1, 1, z, 1, 3, z, 0, 3, z, 0, 0, z});
  TemporaryFolder folder;
  write_sequence(folder / "f_%d.stl", clip);
  const MeshSequence back = load({folder / "f_*.stl"});
  ASSERT_EQ(back.polygons.size(), 4U);
  double whole = 0;
  for (size_t p = 0; p < 4; ++p) {
    const auto at = [&](size_t corner, size_t axis) {
      return static_cast<double>(back.frame(1)[3 * back.polygons[p][corner] + axis]);
    };
    const double area = (at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) -
                        (at(2, 0) - at(0, 0)) * (at(1, 1) - at(0, 1));
    EXPECT_GT(area, 0);
    whole += area / 2;
  }
  EXPECT_DOUBLE_EQ(whole, 5);
}

TEST(WriteSequence, RoundTripsCachesWithTheirMesh) {
  MeshSequence clip = awkward_clip(12);
  clip.rate = {24000, 1001, false};
  clip.start_time = 0.5;
  for (std::string extension : {"pc2", "mdd"}) {
    TemporaryFolder folder;
    write_sequence(folder / "clip." + extension, clip);
    EXPECT_THAT(folder.files(), testing::UnorderedElementsAre("clip.obj", "clip." + extension));
    MeshSequence back = load({folder / "clip." + extension});
    expect_same(back, clip);
    EXPECT_EQ(back.name, "clip");
    EXPECT_EQ(back.rate.assumed, extension == "pc2");
    if (extension == "mdd") {
      EXPECT_EQ(back.rate.numerator, 24000U);
      EXPECT_EQ(back.start_time, 0.5);
    }
  }
}

TEST(WriteSequence, KeepsUnevenTimesInMdd) {
  MeshSequence clip = awkward_clip(3);
  clip.times = {0, 0.25, 1};
  clip.start_time = 2;
  TemporaryFolder folder;
  write_sequence(folder / "clip.mdd", clip);
  MeshSequence back = load({folder / "clip.mdd"});
  EXPECT_EQ(back.times, clip.times);
  EXPECT_EQ(back.start_time, 2);
}

TEST(WriteSequence, StreamsFrameByFrame) {
  MeshSequence whole = awkward_clip(5), clip = awkward_clip(1);
  clip.positions.clear();
  clip.frame_count = 5;
  TemporaryFolder folder;
  std::vector<uint32_t> asked;
  std::vector<float> frame;
  auto source = [&](uint32_t f) {
    asked.push_back(f);
    frame.assign(whole.frame(f).begin(), whole.frame(f).end());
    return std::span<const float>(frame);
  };
  write_sequence(folder / "a.pc2", clip, source, {});
  EXPECT_THAT(asked, ElementsAre(0, 1, 2, 3, 4));
  expect_same(load({folder / "a.pc2"}), whole);
}

TEST(WriteSequence, NumbersFramesByThePattern) {
  MeshSequence clip = awkward_clip(2);
  TemporaryFolder folder;
  write_sequence(folder / "f%03d_x.obj", clip, {.first_number = 999});
  EXPECT_THAT(folder.files(), ElementsAre("f1000_x.obj", "f999_x.obj"));
}

TEST(WriteSequence, WritesASingleFrameUnderAPlainName) {
  MeshSequence clip = awkward_clip(1);
  TemporaryFolder folder;
  write_sequence(folder / "one.off", clip);
  EXPECT_THAT(folder.files(), ElementsAre("one.off"));
}

TEST(WriteSequence, RejectsBadNames) {
  auto name_fault = [](const char* name) {
    return fault([&] { write_sequence(name, awkward_clip(2)); }, ErrorKind::kUsage);
  };
  EXPECT_EQ(name_fault("a.obj"),
            "a.obj: 2 frames need a pattern with a number, such as frame_%04d.obj");
  for (const char* name : {"a%d%d.obj", "a%.obj", "a%4d.obj", "a%s.obj", "a%04x.obj", "a%%d.obj"})
    EXPECT_THAT(name_fault(name), HasSubstr("a pattern has one %d or %0Nd")) << name;
  EXPECT_THAT(name_fault("a.xyz"), HasSubstr("of unknown kind"));
  EXPECT_THAT(name_fault("a.usdc"), HasSubstr("pip install 'anicodec[usd]'"));
  EXPECT_THAT(name_fault("a.vtkhdf"), HasSubstr("pip install 'anicodec[vtk]'"));
  for (const char* name : {"a.fbx", "a_%d.md2", "a.dae"})
    EXPECT_THAT(name_fault(name), HasSubstr("of a kind that is not written")) << name;
}

TEST(WriteSequence, LeavesNothingWhenItFails) {
  MeshSequence clip = awkward_clip(3);
  for (std::string name : {"a.pc2", "a.mdd", "a%d.ply"}) {
    TemporaryFolder folder;
    auto source = [&](uint32_t f) -> std::span<const float> {
      if (f == 2)
        throw Error(ErrorKind::kCorrupt, "broken");
      return std::as_const(clip).frame(f);
    };
    EXPECT_EQ(fault([&] { write_sequence(folder / name, clip, source, {}); }, ErrorKind::kCorrupt),
              "broken");
    EXPECT_THAT(folder.files(), IsEmpty());
  }
}

TEST(WriteSequence, RefusesExistingOutputsUnlessOverwriting) {
  MeshSequence clip = awkward_clip(2);
  TemporaryFolder folder;
  folder.write("clip.obj", "mine");
  EXPECT_THAT(fault([&] { write_sequence(folder / "clip.pc2", clip); }, ErrorKind::kUsage),
              HasSubstr("clip.obj: the file exists already"));
  EXPECT_THAT(folder.files(), ElementsAre("clip.obj"));
  EXPECT_EQ(folder.read("clip.obj"), "mine");
  write_sequence(folder / "clip.pc2", clip, {.overwrite = true});
  expect_same(load({folder / "clip.pc2"}), clip);
  folder.write("f1.obj", "mine");
  EXPECT_THAT(fault([&] { write_sequence(folder / "f%d.obj", clip); }, ErrorKind::kUsage),
              HasSubstr("f1.obj: the file exists already"));
  EXPECT_FALSE(std::filesystem::exists(folder / "f0.obj"));
  EXPECT_THAT(fault([&] { check_sequence_output(folder / "f%d.obj", 2); }, ErrorKind::kUsage),
              HasSubstr("f1.obj: the file exists already"));
  EXPECT_NO_THROW(check_sequence_output(folder / "f%d.obj", 2, {.first_number = 2}));
}

TEST(WriteSequence, RejectsFramesOfTheWrongSize) {
  MeshSequence clip = awkward_clip(1);
  TemporaryFolder folder;
  auto source = [&](uint32_t) { return std::as_const(clip).frame(0).subspan(3); };
  EXPECT_THAT(
      fault([&] { write_sequence(folder / "a.obj", clip, source, {}); }, ErrorKind::kInternal),
      HasSubstr("frame 0 has 27 coordinates, not 3 x 10"));
}

}  // namespace
}  // namespace anicodec::tools
