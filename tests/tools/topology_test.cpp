// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Frames whose connectivity changes, by the command.
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

/// Six frames of a box, five of a limb, three of the box again.
class Topologies : public testing::Test {
 protected:
  void SetUp() override {
    add("painted_box", 6);
    add("limb", 5);
    add("painted_box", 3);
  }

  void add(const char* name, uint32_t frames) {
    MeshSequence clip = corpus::make_clip(name);
    clip.frame_count = frames;
    clip.positions.resize(size_t{3} * clip.vertex_count * frames);
    WriteOptions options;
    options.first_number = count_;
    write_sequence(folder_ / "in/f_%02d.obj", clip, options);
    count_ += frames;
  }

  Outcome encode(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{
        "encode", folder_ / "in/*.obj", "-o", folder_ / "a.anic", "--topology-changes", "keep",
        "-f"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return anicodec(arguments);
  }

  static MeshSequence frame(const std::string& path) {
    return load_sequence(std::vector<std::string>{path});
  }

  TemporaryFolder folder_;
  uint32_t count_ = 0;
};

TEST_F(Topologies, AreAnErrorUnlessAskedFor) {
  const Outcome outcome = anicodec({"encode", folder_ / "in/*.obj", "-o", folder_ / "a.anic"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("f_06.obj: "));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.anic"));
}

TEST_F(Topologies, PlayEachAtItsTime) {
  ASSERT_EQ(encode({"--max-error", "0.1%", "--fps", "30"}).status, 0);
  EXPECT_THAT(anicodec({"verify", folder_ / "a.anic"}).out, HasSubstr("14 frames of 3 meshes"));
  const nlohmann::json info = anicodec({"info", folder_ / "a.anic", "--json"}).json();
  EXPECT_EQ(info["frames"], 14);
  EXPECT_EQ(info["fps"], (nlohmann::json{30, 1}));
  ASSERT_EQ(info["meshes"].size(), 3U);
  EXPECT_EQ(info["meshes"][1]["frames"], (nlohmann::json{{6, 11}}));
  ASSERT_EQ(anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "out/f_%02d.obj"}).status, 0);
  for (const char* name : {"f_00", "f_05", "f_06", "f_10", "f_11", "f_13"}) {
    SCOPED_TRACE(name);
    const std::string file = std::string(name) + ".obj";
    const MeshSequence in = frame(folder_ / ("in/" + file)), out = frame(folder_ / ("out/" + file));
    EXPECT_EQ(in.vertex_count, out.vertex_count);
    // The order of polygons is not kept, so that another material may come first.
    EXPECT_THAT(out.materials.names, testing::UnorderedElementsAreArray(in.materials.names));
    const Outcome compared = anicodec(
        {"compare", folder_ / ("in/" + file), folder_ / ("out/" + file), "--json", "--no-sted"});
    EXPECT_LE(compared.json()["max_error"], info["max_error"].get<double>() * 1.0001);
    EXPECT_EQ(compared.json()["note"], "");
  }
}

TEST_F(Topologies, AreDecodedInPart) {
  ASSERT_EQ(encode().status, 0);
  ASSERT_EQ(anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "out/f_%d.ply", "--frames",
                      "4:13:3", "--start", "7"})
                .status,
            0);
  EXPECT_EQ(frame(folder_ / "out/f_7.ply").vertex_count, 98U);   // frame 4
  EXPECT_EQ(frame(folder_ / "out/f_8.ply").vertex_count, 794U);  // 7
  EXPECT_EQ(frame(folder_ / "out/f_9.ply").vertex_count, 794U);  // 10
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/f_10.ply"));
}

TEST_F(Topologies, AreRefusedWhereOneIsWanted) {
  ASSERT_EQ(encode().status, 0);
  const Outcome cache = anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "b.pc2"});
  EXPECT_EQ(cache.status, 1);
  EXPECT_THAT(cache.err, HasSubstr("write a file per frame"));
  EXPECT_EQ(anicodec({"compare", folder_ / "a.anic", folder_ / "a.anic"}).status, 4);
  EXPECT_EQ(encode({"--size", "10k"}).status, 1);
  EXPECT_EQ(encode({"--part", "0:3"}).status, 1);
  EXPECT_EQ(encode({"--massage", "on"}).status, 1);
}

TEST_F(Topologies, OfOneKindAreAPlainClip) {
  ASSERT_EQ(anicodec({"encode", folder_ / "in/f_0[0-5].obj", "-o", folder_ / "a.anic"}).status, 0);
  ASSERT_EQ(anicodec({"encode", folder_ / "in/f_0[0-5].obj", "-o", folder_ / "b.anic",
                      "--topology-changes", "keep"})
                .status,
            0);
  EXPECT_EQ(folder_.read("a.anic"), folder_.read("b.anic"));
}

}  // namespace
}  // namespace anicodec::tools
