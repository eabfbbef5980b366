// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/local_origin.h"

#include "tests/tools/gltf_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A triangle of 3 and 4, far away, whose coordinates float32 does not have.
const Point kPlace{500000.0625, 4649776.03125, -120.25};
const std::string kObj =
    "v 500000.0625 4649776.03125 -120.25\nv 500003.0625 4649776.03125 -120.25\n"
    "v 500003.0625 4649780.03125 -120.25\nf 1 2 3\n";

class LocalOrigins : public testing::Test {
 protected:
  MeshSequence load(const std::string& path) {
    notes_.clear();
    LoadOptions options;
    options.origin = origin_;
    options.measures_rounding = measures_;
    options.note = [&](const std::string& text) { notes_ += text + "\n"; };
    return load_sequence(std::vector<std::string>{path}, options);
  }

  /// The coordinates of the source are kept to the last digit.
  void expect_place(const MeshSequence& clip) {
    ASSERT_EQ(clip.vertex_count, 3U);
    const double moves[3][3] = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
    for (size_t v = 0; v < 3; ++v) {
      for (size_t k = 0; k < 3; ++k)
        EXPECT_EQ(clip.origin[k] + static_cast<double>(clip.positions[3 * v + k]),
                  kPlace[k] + moves[v][k]);
    }
  }

  TemporaryFolder folder_;
  std::optional<Point> origin_;
  bool measures_ = false;
  std::string notes_;
};

TEST(LocalOrigin, IsTakenAwayBeforeRounding) {
  LocalOrigin origin{.at = {1e6, 0, 0}};
  EXPECT_FALSE(origin.is_plain(0));
  EXPECT_TRUE(origin.is_plain(1));
  EXPECT_EQ(origin.rounded(1e6 + 0.0625, 0), 0.0625F);
  EXPECT_EQ(origin.rounding, 0);
  EXPECT_EQ(origin.rounded(0x1p24 + 1, 1), 0x1p24F);
  EXPECT_EQ(origin.rounding, 1);
}

TEST_F(LocalOrigins, AreFoundInText) {
  const MeshSequence clip = load(folder_.write("a.obj", kObj));
  EXPECT_EQ(clip.origin, (Point{500000, 4649776, -120}));
  expect_place(clip);
  EXPECT_EQ(notes_, folder_ /
                        "a.obj: coordinates up to 4649780 of a mesh of 5: they are kept from the "
                        "origin 500000,4649776,-120\n");
  expect_place(
      load(folder_.write("a.off",
                         "OFF 3 1 0\n500000.0625 4649776.03125 -120.25\n500003.0625 4649776.03125 "
                         "-120.25\n500003.0625 4649780.03125 -120.25\n3 0 1 2\n")));
  expect_place(load(folder_.write(
      "a.stl",
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 500000.0625 4649776.03125 -120.25\n"
      "vertex 500003.0625 4649776.03125 -120.25\nvertex 500003.0625 4649780.03125 -120.25\n"
      "endloop\nendfacet\nendsolid a\n")));
}

TEST_F(LocalOrigins, AreGivenOrNone) {
  const std::string path = folder_.write("a.obj", kObj);
  origin_ = Point{500001, 4649776, 0};
  MeshSequence clip = load(path);
  EXPECT_EQ(clip.origin, *origin_);
  expect_place(clip);
  EXPECT_EQ(notes_, "");
  origin_ = Point();
  clip = load(path);
  EXPECT_EQ(clip.origin, Point());
  EXPECT_EQ(clip.positions[1], 4649776.0F);
  EXPECT_THAT(
      notes_,
      HasSubstr("float32 rounds them by up to 0.25; a local origin (encode --origin) keeps more"));
  origin_.reset();
  EXPECT_EQ(load(folder_.write("near.obj", "v 1000 0 0\nv 1003 4 0\nv 1000 4 0\nf 1 2 3\n")).origin,
            Point());
  EXPECT_EQ(notes_, "");
}

TEST_F(LocalOrigins, MeasureWhatRoundingTakes) {
  const std::string path = folder_.write("a.obj", kObj);
  measures_ = true;
  load(path);
  EXPECT_THAT(notes_, testing::Not(HasSubstr("takes")));
  origin_ = Point();
  load(path);
  EXPECT_THAT(notes_, HasSubstr("a.obj: float32 takes up to 0.031 from the coordinates\n"));
}

TEST_F(LocalOrigins, AreTakenFromWhatNodesMove) {
  GltfScene scene = triangle_scene();
  scene.document["nodes"][0]["translation"] = kPlace;
  const MeshSequence near = load(folder_.write("near.glb", triangle_scene().glb()));
  const MeshSequence clip = load(folder_.write("a.glb", scene.glb()));
  ASSERT_NE(clip.origin, Point());
  for (size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(clip.origin[i % 3] + static_cast<double>(clip.positions[i]),
                kPlace[i % 3] + static_cast<double>(near.positions[i]), 1e-9);
}

TEST_F(LocalOrigins, ComeBackFromOutputsThatHaveRoom) {
  MeshSequence clip = load(folder_.write("a.obj", kObj));
  for (const UpAxis up : {UpAxis::kUnknown, UpAxis::kZ}) {
    clip.up = up;
    for (const char* name : {"b.obj", "b.off", "b.ply", "b.stl", "b.glb", "b.abc"}) {
      const bool ascii = std::string(name) == "b.stl";
      write_sequence(folder_ / name, clip, {.overwrite = true, .ascii = ascii});
      EXPECT_TRUE(keeps_origin(name, ascii));
      MeshSequence back = load(folder_ / name);
      if (up == UpAxis::kZ && back.up == UpAxis::kY) {  // scenes turn
        for (size_t i = 0; i < back.positions.size(); i += 3)
          back.positions[i + 1] = -std::exchange(back.positions[i + 2], back.positions[i + 1]);
        back.origin[1] = -std::exchange(back.origin[2], back.origin[1]);
      }
      SCOPED_TRACE(name);
      expect_place(back);
    }
  }
  write_sequence(folder_ / "c.ply", clip, {.ascii = true});
  expect_place(load(folder_ / "c.ply"));
  EXPECT_FALSE(keeps_origin("c.stl", false));
  EXPECT_FALSE(keeps_origin("c.pc2", false));
  EXPECT_FALSE(keeps_origin("c.mdd", true));
}

TEST_F(LocalOrigins, AreOfCachesAndTheirMeshAlike) {
  MeshSequence clip = load(folder_.write("a.obj", kObj));
  write_sequence(folder_ / "c.pc2", clip);
  EXPECT_EQ(load(folder_ / "c.pc2").positions[0], clip.positions[0]);
  origin_ = Point{1, 2, 3};
  const MeshSequence moved = load(folder_ / "c.pc2");
  EXPECT_EQ(moved.positions[0], clip.positions[0] - 1);
  EXPECT_EQ(moved.up, UpAxis::kUnknown);
}

}  // namespace
}  // namespace anicodec::tools
