// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/load_sequence.h"

#include "tests/real_data.h"
#include "tests/tools/io_testing.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/formats/stl.h"
#include "tools/io/formats/vertex_cache.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

MeshSequence load_clip(std::vector<std::string> inputs, const LoadOptions& options = {}) {
  return load_sequence(inputs, options);
}

std::string load_fault(std::vector<std::string> inputs, const LoadOptions& options = {}) {
  return fault([&] { load_sequence(inputs, options); });
}

std::string usage_fault(std::vector<std::string> inputs, const LoadOptions& options = {}) {
  return fault([&] { load_sequence(inputs, options); }, ErrorKind::kUsage);
}

std::string triangle(const std::string& x) {
  return "v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
}

std::string pc2(uint32_t vertices, uint32_t frames) {
  std::string bytes;
  append_pc2_header(vertices, frames, bytes);
  for (uint32_t i = 0; i < vertices * frames * 3; ++i)
    append(static_cast<float>(i), std::endian::little, bytes);
  return bytes;
}

TEST(LoadSequence, ReadsOneMeshAsOneFrame) {
  TemporaryFolder folder;
  MeshSequence clip = load_clip({folder.write("a.b.OBJ", triangle("7"))});
  EXPECT_EQ(clip.name, "a.b");
  EXPECT_EQ(clip.frame_count, 1U);
  EXPECT_EQ(clip.positions[0], 7);
  EXPECT_TRUE(clip.rate.assumed);
  EXPECT_EQ(clip.up, UpAxis::kUnknown);
}

TEST(LoadSequence, TellsOfACacheBesideAMeshAlone) {
  TemporaryFolder folder;
  const std::vector<std::string> inputs{folder.write("a.obj", triangle("7"))};
  std::string note;
  LoadOptions options;
  options.note = [&](const std::string& text) { note += text; };
  load_sequence(inputs, options);
  EXPECT_EQ(note, "");
  folder.write("a.mdd", "");
  load_sequence(inputs, options);
  EXPECT_THAT(note, HasSubstr("a.mdd beside it"));
}

TEST(LoadSequence, SortsGlobsNaturallyAndKeepsListsAsGiven) {
  TemporaryFolder folder;
  for (const char* x : {"1", "2", "10"})
    folder.write(std::string("f_") + x + ".obj", triangle(x));
  MeshSequence globbed = load_clip({folder / "f_*.obj"});
  EXPECT_THAT((std::vector<float>{globbed.frame(0)[0], globbed.frame(1)[0], globbed.frame(2)[0]}),
              ElementsAre(1, 2, 10));
  MeshSequence listed = load_clip({folder / "f_10.obj", folder / "f_1.obj"});
  EXPECT_EQ(listed.name, "f_10");
  EXPECT_EQ(listed.frame(0)[0], 10);
  EXPECT_EQ(listed.frame(1)[0], 1);
}

/// All notes of a load, one a line.
std::string notes_of(std::vector<std::string> inputs, LoadOptions options = {}) {
  std::string notes;
  options.note = [&](const std::string& text) { notes += text + "\n"; };
  load_sequence(inputs, options);
  return notes;
}

TEST(LoadSequence, TellsOfFramesThatAreNotInTheOrderOfTheirNumbers) {
  TemporaryFolder folder;
  std::vector<std::string> paths;
  for (const char* number : {"-0010", "-0009", "0000"})
    paths.push_back(folder.write(std::string("sim.") + number + ".obj", triangle(number)));
  EXPECT_EQ(notes_of(paths), "");
  EXPECT_EQ(notes_of({folder / "sim.*.obj"}), "");
  std::swap(paths[0], paths[1]);
  EXPECT_THAT(notes_of(paths), HasSubstr("sim.-0009.obj before " + folder / "sim.-0010.obj"));
}

TEST(LoadSequence, TellsWhatChangesBesideThePositions) {
  TemporaryFolder folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n",
                    face = "f 1/1 2/2 3/3\n";
  const std::string first = folder.write("0.obj", mesh + "usemtl a\n" + face);
  const auto notes = [&](const std::string& text) {
    return notes_of({first, folder.write("1.obj", text)});
  };
  EXPECT_EQ(notes(mesh + "usemtl a\n" + face), "");
  EXPECT_EQ(notes(mesh + "usemtl b\n" + face),
            folder /
                "1.obj: the material changes, here from 'a' to 'b'; the clip keeps what the first "
                "frame has\n");
  EXPECT_EQ(notes(mesh + "usemtl a\nf 1/2 2/2 3/3\n"), "") << "texture coordinates move";
  EXPECT_THAT(notes(mesh + "o x\nusemtl a\n" + face), HasSubstr("objects of faces change"));
  EXPECT_THAT(notes("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nusemtl a\nf 1 2 3\n"),
              testing::AllOf(HasSubstr("has no texture coordinates 'uv'"),
                             HasSubstr("has colours 'colour'")));
}

TEST(LoadSequence, TellsOfMaterialsThatLookOtherwiseFromFrameToFrame) {
  TemporaryFolder folder;
  std::vector<std::string> paths;
  for (const std::string n : {"0", "1"}) {
    folder.write(n + ".mtl", "newmtl a\nKd 1 1 1\nmap_Kd scan_" + n + ".jpg\n");
    paths.push_back(folder.write(n + ".obj", "mtllib " + n + ".mtl\nusemtl a\n" + triangle("0")));
  }
  EXPECT_THAT(notes_of(paths), HasSubstr("1.obj: colours or images of materials change"));
}

TEST(LoadSequence, TakesFirstFrameAndFramesOfASampleFromAPc2) {
  TemporaryFolder folder;
  const std::string mesh = folder.write("a.obj", triangle("0"));
  std::string bytes = pc2(3, 3);
  const auto put = [&](size_t offset, float number) {
    std::string four;
    append(number, std::endian::little, four);
    bytes.replace(offset, 4, four);
  };
  put(20, 100);
  put(24, 0.5F);
  const std::string cache = folder.write("a.pc2", bytes);
  const MeshSequence asked = load_clip({mesh, cache}, {.rate = parse_frame_rate("24")});
  EXPECT_DOUBLE_EQ(asked.start_time, 100.0 / 24);
  EXPECT_DOUBLE_EQ(asked.rate.value(), 48);  // two samples a frame
  EXPECT_FALSE(asked.rate.assumed);
  const MeshSequence assumed = load_clip({mesh, cache});
  EXPECT_DOUBLE_EQ(assumed.rate.value(), 48);
  EXPECT_TRUE(assumed.rate.assumed);
  EXPECT_THAT(notes_of({mesh, cache}),
              HasSubstr("0.5 frames a sample: at 24 frames per second, which are assumed"));
  put(20, 0);
  put(24, 30);  // no step of a cache, but a rate
  folder.write("a.pc2", bytes);
  EXPECT_DOUBLE_EQ(load_clip({mesh, cache}).rate.value(), 24);
  EXPECT_THAT(notes_of({mesh, cache}), HasSubstr("which is not used"));
}

TEST(LoadSequence, TakesANameThatExistsAsNoPattern) {
  TemporaryFolder folder;
  EXPECT_EQ(load_clip({folder.write("a[1].obj", triangle("5"))}).positions[0], 5);
}

TEST(LoadSequence, PairsCachesWithMeshesInEitherOrder) {
  TemporaryFolder folder;
  std::string mesh = folder.write("mesh.obj", triangle("0"));
  std::string cache = folder.write("cache.pc2", pc2(3, 2));
  for (auto inputs : {std::vector{mesh, cache}, std::vector{cache, mesh}}) {
    MeshSequence clip = load_clip(inputs);
    EXPECT_EQ(clip.frame_count, 2U);
    EXPECT_EQ(clip.positions[17], 17);
    EXPECT_EQ(clip.polygons.size(), 1U);
  }
  EXPECT_EQ(load_clip({cache}, {.mesh = mesh}).name, "cache");
  EXPECT_THAT(load_fault({cache}), HasSubstr("cache.pc2: a vertex cache has no faces"));
  folder.write("cache.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 2 1 0\n");
  EXPECT_THAT(load_clip({cache}).polygons[0], ElementsAre(2, 1, 0));
  folder.write("cache.obj", triangle("0"));
  EXPECT_THAT(load_clip({cache}).polygons[0], ElementsAre(0, 1, 2));
}

TEST(LoadSequence, FindsTheAxisThatIsUpInACacheOfAMesh) {
  TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", "v 0 1 2\nv 1 0 0\nv 0 3 0\nf 1 2 3\n");
  const auto cache = [&](std::vector<float> frame) {
    std::string bytes;
    append_pc2_header(3, 1, bytes);
    for (const float x : frame)
      append(x, std::endian::little, bytes);
    return folder.write("cache.pc2", bytes);
  };
  std::string note;
  const auto up_of = [&](const std::string& path) {
    note.clear();
    LoadOptions options;
    options.note = [&](const std::string& text) { note += text; };
    return load_clip({mesh, path}, options).up;
  };
  EXPECT_EQ(up_of(cache({0, -2, 1, 1, 0, 0, 0, 0, 3})), UpAxis::kZ);
  EXPECT_THAT(note, HasSubstr("cache.pc2: its axes are x,-z,y of the mesh; z is up (--up)"));
  EXPECT_EQ(up_of(cache({0, 4, -2, 2, 0, 0, 0, 0, -6})), UpAxis::kY);
  EXPECT_THAT(note, HasSubstr("x,z,-y of the mesh, lengths 2.0"));
  EXPECT_EQ(up_of(cache({0, 1, 2, 1, 0, 0, 0, 3, 0})), UpAxis::kUnknown);
  EXPECT_EQ(note, "");
  EXPECT_EQ(up_of(cache({0, 10, 20, 10, 0, 0, 0, 30, 0})), UpAxis::kUnknown);
  EXPECT_THAT(note, HasSubstr("its unit is not that of the mesh, lengths 10"));
  EXPECT_EQ(up_of(cache({5, 1, 2, 1, 0, 0, 0, 3, 0})), UpAxis::kUnknown) << "another pose";
  EXPECT_EQ(note, "");
}

TEST(LoadSequence, RejectsCachesThatDoNotFitTheMesh) {
  TemporaryFolder folder;
  std::string mesh = folder.write("a.obj", triangle("0"));
  std::string cache = folder.write("a.pc2", pc2(4, 2));
  EXPECT_EQ(load_fault({cache, mesh}), cache + ": 4 vertices, but the mesh " + mesh + " has 3");
  EXPECT_THAT(load_fault({cache, folder.write("a.stl", "solid")}),
              HasSubstr("no order of vertices"));
}

TEST(LoadSequence, RejectsInputsThatMakeNoClip) {
  TemporaryFolder folder;
  std::string mesh = folder.write("a.obj", triangle("0"));
  std::string other = folder.write("b.off", "OFF\n");
  std::string cache = folder.write("a.pc2", pc2(3, 2));
  EXPECT_THAT(usage_fault({}), HasSubstr("no input"));
  EXPECT_THAT(usage_fault({mesh, cache, mesh}), HasSubstr("one mesh, but 2 are given"));
  EXPECT_THAT(usage_fault({mesh, cache}, {.mesh = mesh}), HasSubstr("one mesh, but 2 are given"));
  EXPECT_THAT(usage_fault({mesh}, {.mesh = mesh}), HasSubstr("but there is none"));
  EXPECT_THAT(usage_fault({mesh, other}), HasSubstr("b.off: frames are of one format"));
}

TEST(LoadSequence, CachesOfOneMeshAreClips) {
  TemporaryFolder folder;
  const std::string mesh = folder.write("a.obj", triangle("0"));
  const std::vector<std::string> inputs{mesh, folder.write("walk.pc2", pc2(3, 2)),
                                        folder.write("run.pc2", pc2(3, 4))};
  const MeshSequence library = load_sequence(inputs, {.rate = FrameRate{30, 1, false}});
  ASSERT_EQ(library.clips.size(), 2U);
  EXPECT_EQ(library.frame_count, 6U);
  EXPECT_EQ(library.clips[0].name, "walk");
  EXPECT_EQ(library.clips[1].name, "run");
  EXPECT_EQ(library.clips[1].frame_count, 4U);
  EXPECT_EQ(library.clips[1].rate.numerator, 30U);
  EXPECT_THAT(usage_fault({mesh, inputs[1]}, {.clips = {"all"}}), HasSubstr("no scene with clips"));
}

TEST(LoadSequence, RejectsFilesThatCannotBeRead) {
  TemporaryFolder folder;
  EXPECT_EQ(load_fault({folder / "none.obj"}), folder / "none.obj: No such file or directory");
  EXPECT_EQ(load_fault({folder / "*.obj"}), folder / "*.obj: no file matches");
  EXPECT_THAT(load_fault({folder / ""}),
              HasSubstr("is a directory; name its frames with a pattern"));
  EXPECT_THAT(load_fault({folder.write("a.xyz", "")}), HasSubstr("a.xyz: is of unknown kind"));
  EXPECT_THAT(load_fault({folder.write("a.usda", "")}), HasSubstr("pip install 'anicodec[usd]'"));
  EXPECT_THAT(load_fault({folder.write("a.pvd", "")}), HasSubstr("pip install 'anicodec[vtk]'"));
  EXPECT_THAT(load_fault({folder.write("a.abc", "")}), HasSubstr("a.abc: is not an Alembic file"));
  EXPECT_THAT(fault([&] { load_clip({folder.write("b.abc", "\x89HDF\r\n\x1a\n old")}); },
                    ErrorKind::kUnsupported),
              HasSubstr("abcconvert"));
  EXPECT_THAT(load_fault({"/dev/null"}), HasSubstr("unknown kind"));
  std::filesystem::create_symlink("/dev/zero", folder / "zero.obj");
  EXPECT_THAT(load_fault({folder / "zero.obj"}), HasSubstr("is not a regular file"));
  for (const char* extension : {"obj", "ply", "off", "stl", "pc2", "mdd"}) {
    std::string path = folder.write(std::string("empty.") + extension, "");
    EXPECT_THAT(load_fault({path}, {.mesh = ""}), HasSubstr(extension)) << path;
  }
}

TEST(LoadSequence, RejectsFramesOfOtherConnectivityNamingTheDifference) {
  TemporaryFolder folder;
  std::string first = folder.write("1.obj", triangle("0"));
  std::string frame = folder.write("2.obj", "v 0 0 0\n" + triangle("0"));
  EXPECT_EQ(load_fault({first, frame}), frame + ": 4 vertices, but " + first + " has 3");
  folder.write("2.obj", triangle("0") + "f 1 2 3\n");
  EXPECT_EQ(load_fault({first, frame}), frame + ": 2 faces, but " + first + " has 1");
  folder.write("2.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 3 2\n");
  EXPECT_EQ(load_fault({first, frame}),
            frame + ": face 0 has vertices 0 2 1, but 0 1 2 in " + first + " (counted from 0)");
  folder.write("2.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3 1\n");
  EXPECT_THAT(load_fault({first, frame}), HasSubstr("has vertices 0 1 2 0, but 0 1 2 in"));
}

TEST(LoadSequence, WeldsStlSequencesOnRequest) {
  Polygons quad;
  quad.add(std::vector<uint32_t>{0, 1, 2, 3});
  std::vector<float> first = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, second = first;
  second[2] = 5;
  TemporaryFolder folder;
  std::vector<std::string> paths;
  for (const auto& positions : {first, second}) {
    std::string bytes;
    append_stl(quad, positions, paths.empty(), bytes);
    paths.push_back(folder.write(std::to_string(paths.size()) + ".stl", bytes));
  }
  MeshSequence clip = load_clip(paths);
  EXPECT_EQ(clip.vertex_count, 4U);
  EXPECT_EQ(clip.frame_count, 2U);
  EXPECT_EQ(clip.frame(1)[2], 5);
  EXPECT_EQ(load_clip(paths, {.weld_stl = false}).vertex_count, 6U);
  // Frame 1 first: its corners coincide in the other order, which is no fault.
  EXPECT_EQ(load_clip({paths[1], paths[0]}).vertex_count, 4U);
}

std::string mdd(const std::vector<float>& times) {
  std::string bytes;
  append_mdd_header(3, times, bytes);
  for (size_t i = 0; i < times.size() * 9; ++i)
    append(1.0F, std::endian::big, bytes);
  return bytes;
}

TEST(LoadSequence, TakesTheRateOfMddUnlessOneIsGiven) {
  TemporaryFolder folder;
  folder.write("a.obj", triangle("0"));
  std::string path = folder.write("a.mdd", mdd({0.5F, 0.75F, 1.5F}));
  EXPECT_THAT(load_clip({path}).times, ElementsAre(0, 0.25, 1));
  EXPECT_EQ(load_clip({path}).start_time, 0.5);
  MeshSequence clip = load_clip({path}, {.rate = parse_frame_rate("30000/1001")});
  EXPECT_TRUE(clip.times.empty());
  EXPECT_EQ(clip.rate.numerator, 30000U);
  EXPECT_FALSE(clip.rate.assumed);
  path = folder.write("a.mdd", mdd({0, 0, 0}));
  EXPECT_THAT(load_fault({path}), HasSubstr("a.mdd: the time of frame 1 is not after"));
  EXPECT_EQ(load_clip({path}, {.rate = parse_frame_rate("24")}).rate.numerator, 24U);
}

TEST(LoadSequence, ReportsProgressAndCanBeCancelled) {
  TemporaryFolder folder;
  folder.write("a.obj", triangle("0"));
  std::string cache = folder.write("a.pc2", pc2(3, 2));
  double last = 0;
  load_clip({cache}, {.progress = [&](std::string_view, double done) { last = done; }});
  EXPECT_EQ(last, 1);
  EXPECT_THROW(load_clip({cache}, {.progress = [](std::string_view, double) { throw 1; }}), int);
}

// Real clips: in the folder that ANICODEC_DATA names.
class RealDataLoadSequence : public testing::Test {
 protected:
  void SetUp() override {
    data_ = real_data_folder();
    if (!std::filesystem::exists(data_ / "classic"))
      GTEST_SKIP() << "no real clips: set ANICODEC_DATA to their folder";
  }

  std::string operator[](const std::string& name) const { return (data_ / name).string(); }

  std::filesystem::path data_;
};

double largest_difference(std::span<const float> a, std::span<const float> b) {
  double largest = a.size() == b.size() ? 0 : std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < a.size() && i < b.size(); ++i)
    largest = std::max(largest, static_cast<double>(std::abs(a[i] - b[i])));
  return largest;
}

TEST_F(RealDataLoadSequence, ReadsACache) {
  MeshSequence dance = load_clip({(*this)["classic/dance.obj"], (*this)["classic/dance.pc2"]});
  EXPECT_EQ(dance.name, "dance");
  EXPECT_EQ(dance.vertex_count, 7061U);
  EXPECT_EQ(dance.frame_count, 201U);
  EXPECT_EQ(dance.polygons.size(), 14118U);
  EXPECT_NO_THROW(check(dance));
}

TEST_F(RealDataLoadSequence, ReadsFramesLikeTheirCache) {
  MeshSequence frames = load_clip({(*this)["classic/horse_obj/*.obj"]});
  MeshSequence cache = load_clip({(*this)["classic/horse.pc2"]});
  EXPECT_EQ(frames.vertex_count, 8431U);
  EXPECT_EQ(frames.frame_count, 48U);
  EXPECT_LT(largest_difference(frames.positions, cache.positions), 1e-6 * diagonal(cache));
  EXPECT_EQ(frames.polygons, cache.polygons);
}

TEST_F(RealDataLoadSequence, ReadsMddLikePc2) {
  LoadOptions options{.mesh = (*this)["exported/obj/cesium1.obj"]};
  MeshSequence mdd = load_clip({(*this)["exported/cesium.mdd"]}, options);
  MeshSequence pc2 = load_clip({(*this)["exported/cesium.pc2"]}, options);
  EXPECT_EQ(largest_difference(mdd.positions, pc2.positions), 0);
  EXPECT_EQ(mdd.polygons, pc2.polygons);
  EXPECT_EQ(mdd.rate.numerator, 24U);
  EXPECT_FALSE(mdd.rate.assumed);
  EXPECT_TRUE(pc2.rate.assumed);

  MeshSequence frames = load_clip({(*this)["exported/obj/cesium*.obj"]});
  ASSERT_EQ(frames.positions.size(), pc2.positions.size());
  float largest = 0;
  for (size_t i = 0; i < frames.positions.size(); i += 3) {
    const float* z_up = &pc2.positions[i];
    const float* y_up = &frames.positions[i];
    largest = std::max({largest, std::abs(y_up[0] - z_up[0]), std::abs(y_up[1] - z_up[2]),
                        std::abs(y_up[2] + z_up[1])});
  }
  EXPECT_LT(largest, 1e-6 * diagonal(pc2));
}

}  // namespace
}  // namespace anicodec::tools
