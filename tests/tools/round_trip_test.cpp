// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips of the corpus through the command and back, by every kind of file.
#include "codec/metrics/metrics.h"
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/inputs/compared_clip.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

MeshSequence load(const std::string& path) {
  return load_sequence(std::vector<std::string>{path});
}

/// A file that a clip can be written to, and the name to read it by.
struct Kind {
  std::string output, input;
};

const Kind kPc2{"clip.pc2", "clip.pc2"};
const Kind kMdd{"clip.mdd", "clip.mdd"};
const Kind kObj{"f/frame_%04d.obj", "f/*.obj"};
const Kind kPly{"f/frame_%d.ply", "f/*.ply"};
const Kind kOff{"f/frame_%03d.off", "f/*.off"};

struct Journey {
  std::string clip;
  Kind source, result;
};

class RoundTrip : public testing::TestWithParam<Journey> {};

TEST_P(RoundTrip, KeepsThePromiseAndThePolygons) {
  const Journey& journey = GetParam();
  TemporaryFolder folder;
  std::string source = folder / ("source/" + journey.source.input);
  ASSERT_EQ(
      anicodec({"corpus", journey.clip, "-o", folder / ("source/" + journey.source.output)}).status,
      0);
  Outcome encoded = anicodec({"encode", source, "-o", folder / "clip.anic", "--max-error", "0.1%"});
  ASSERT_EQ(encoded.status, 0) << encoded;
  Outcome verified = anicodec({"verify", folder / "clip.anic"});
  ASSERT_EQ(verified.status, 0) << verified;
  Outcome decoded = anicodec(
      {"decode", folder / "clip.anic", "-o", folder / ("result/" + journey.result.output)});
  ASSERT_EQ(decoded.status, 0) << decoded;

  MeshSequence original = corpus::make_clip(journey.clip);
  MeshSequence result = load(folder / ("result/" + journey.result.input));
  ASSERT_EQ(result.vertex_count, original.vertex_count);
  ASSERT_EQ(result.frame_count, original.frame_count);
  EXPECT_TRUE(same_faces(result.polygons, original.polygons));
  CompareOptions options;
  options.sted = false;
  Comparison c = compare(original, result, options);
  // A box of no size keeps no error at all, up to what float32 resolves.
  EXPECT_LE(c.max_error, 0.001 * c.diagonal + 1e-6 * (c.diagonal == 0));
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, RoundTrip,
    testing::Values(Journey{"limb", kPc2, kPc2}, Journey{"cloth", kMdd, kMdd},
                    Journey{"polygons", kObj, kObj}, Journey{"quad_box", kPly, kOff},
                    Journey{"nonmanifold", kOff, kPly}, Journey{"leftovers", kObj, kPc2},
                    Journey{"open_pair", kPc2, kObj}, Journey{"one_triangle", kObj, kPly},
                    Journey{"one_vertex", kPly, kPc2}, Journey{"points", kPc2, kPly},
                    Journey{"static", kPc2, kMdd}, Journey{"one_frame", kObj, kOff},
                    Journey{"repeats", kPc2, kPc2}, Journey{"cuts", kPc2, kPc2},
                    Journey{"soup", kPc2, kPc2}, Journey{"tiny", kPly, kPc2},
                    Journey{"large", kPc2, kPly}, Journey{"moebius", kOff, kOff}),
    [](const auto& test) { return test.param.clip; });

TEST(RoundTripOrder, AllBringsFacesBackAsTheyWere) {
  TemporaryFolder folder;
  ASSERT_EQ(anicodec({"corpus", "polygons", "-o", folder / "a.pc2"}).status, 0);
  ASSERT_EQ(
      anicodec({"encode", folder / "a.pc2", "-o", folder / "a.anic", "--order", "all"}).status, 0);
  ASSERT_EQ(anicodec({"decode", folder / "a.anic", "-o", folder / "b.pc2"}).status, 0);
  EXPECT_EQ(load(folder / "b.pc2").polygons, corpus::make_clip("polygons").polygons);
}

TEST(RoundTripOrder, FreeGivesEveryVertexOnceAndASmallerFile) {
  TemporaryFolder folder;
  ASSERT_EQ(anicodec({"corpus", "limb", "-o", folder / "a.pc2"}).status, 0);
  ASSERT_EQ(
      anicodec({"encode", folder / "a.pc2", "-o", folder / "free.anic", "--order", "free"}).status,
      0);
  ASSERT_EQ(anicodec({"encode", folder / "a.pc2", "-o", folder / "kept.anic"}).status, 0);
  ASSERT_EQ(anicodec({"decode", folder / "free.anic", "-o", folder / "b.pc2"}).status, 0);
  MeshSequence a = load(folder / "a.pc2"), b = load(folder / "b.pc2");
  EXPECT_EQ(a.vertex_count, b.vertex_count);
  EXPECT_EQ(a.polygons.size(), b.polygons.size());
  EXPECT_LT(folder.read("free.anic").size(), folder.read("kept.anic").size());
  Outcome compared = anicodec({"compare", folder / "a.pc2", folder / "free.anic", "--json"});
  ASSERT_EQ(compared.status, 0) << compared;
  EXPECT_EQ(compared.json()["method"], "surface");
  EXPECT_THAT(compared.json()["note"], testing::HasSubstr("order"));
  EXPECT_LE(compared.json()["hausdorff_percent"], 0.1);
}

TEST(RoundTripMetadata, SurvivesTheFile) {
  TemporaryFolder folder;
  ASSERT_EQ(anicodec({"corpus", "limb", "-o", folder / "arm.pc2"}).status, 0);
  ASSERT_EQ(anicodec({"encode", folder / "arm.pc2", "-o", folder / "a.anic", "--fps", "30000/1001",
                      "--up", "z", "--unit", "cm", "--loop", "--kg", "1"})
                .status,
            0);
  nlohmann::json info = anicodec({"info", folder / "a.anic", "--json"}).json();
  EXPECT_EQ(info["name"], "arm");
  EXPECT_EQ(info["fps"], (nlohmann::json{30000, 1001}));
  EXPECT_EQ(info["fps_assumed"], false);
  EXPECT_EQ(info["up"], "z");
  EXPECT_NEAR(info["metres_per_unit"], 0.01, 1e-9);
  EXPECT_EQ(info["loop"], true);
  EXPECT_EQ(info["asked"], (nlohmann::json{{"metric", "kg"}, {"value", 1.0}}));
}

TEST(RoundTripMetadata, MddBringsItsRate) {
  TemporaryFolder folder;
  MeshSequence clip = corpus::make_clip("limb");
  clip.rate = {25, 1, false};
  write_sequence(folder / "a.mdd", clip);
  ASSERT_EQ(anicodec({"encode", folder / "a.mdd", "-o", folder / "a.anic", "--kg", "1"}).status, 0);
  ASSERT_EQ(
      anicodec({"decode", folder / "a.anic", "-o", folder / "b.mdd", "--frames", "::5"}).status, 0);
  FrameRate rate = load(folder / "b.mdd").rate;
  EXPECT_FALSE(rate.assumed);
  EXPECT_DOUBLE_EQ(rate.value(), 5);
}

TEST(RoundTripFrames, GivesTheFramesAskedFor) {
  TemporaryFolder folder;
  ASSERT_EQ(anicodec({"corpus", "limb", "-o", folder / "a.pc2"}).status, 0);
  ASSERT_EQ(anicodec({"encode", folder / "a.pc2", "-o", folder / "a.anic", "--kg", "1"}).status, 0);
  ASSERT_EQ(anicodec({"decode", folder / "a.anic", "-o", folder / "all.pc2"}).status, 0);
  ASSERT_EQ(anicodec({"decode", folder / "a.anic", "-o", folder / "some.pc2", "--frames", "3:9:2"})
                .status,
            0);
  MeshSequence all = load(folder / "all.pc2"), some = load(folder / "some.pc2");
  ASSERT_EQ(some.frame_count, 3U);
  for (uint32_t i = 0; i < 3; ++i)
    EXPECT_THAT(some.frame(i), testing::ElementsAreArray(all.frame(3 + 2 * i)));
  EXPECT_EQ(
      anicodec({"decode", folder / "a.anic", "-o", folder / "x.pc2", "--frames", "3:900"}).status,
      1);
}

}  // namespace
}  // namespace anicodec::tools
