// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

/// limb.pc2 of 24 frames.
MeshSequence write_limb(const TemporaryFolder& folder) {
  MeshSequence limb = corpus::make_scaled("limb", 300, 24);
  write_sequence(folder / "limb.pc2", limb);
  return limb;
}

double largest_difference(std::span<const float> a, std::span<const float> b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(double{a[i]} - double{b[i]}));
  return largest;
}

TEST(InterpolateCommand, GoesFromMeshToMesh) {
  TemporaryFolder folder;
  const MeshSequence limb = write_limb(folder);
  for (const char* method : {"linear", "gradients", "bfs", "pml", "pmln", "msgi"}) {
    Outcome outcome = anicodec({"interpolate", folder / "limb.pc2@0", folder / "limb.pc2@9",
                                folder / "limb.pc2@20", "-f", "-o", folder / "out.pc2",
                                "--frame-count", "5", "--method", method});
    ASSERT_EQ(outcome.status, 0) << outcome;
    const std::string files[] = {folder / "out.pc2"};
    const MeshSequence out = load_sequence(files);
    ASSERT_EQ(out.frame_count, 5U);
    EXPECT_EQ(out.polygons, limb.polygons);
    EXPECT_LE(largest_difference(out.frame(0), limb.frame(0)), 1e-5) << method;
    EXPECT_LE(largest_difference(out.frame(2), limb.frame(9)), 1e-5) << method;
    EXPECT_LE(largest_difference(out.frame(4), limb.frame(20)), 1e-5) << method;
    EXPECT_GE(largest_difference(out.frame(1), limb.frame(0)), 1e-2) << method;
  }
}

TEST(InterpolateCommand, TakesWeightsFromAFile) {
  TemporaryFolder folder;
  const MeshSequence limb = write_limb(folder);
  folder.write("weights.txt", "# two frames\n1 0\n\n-0.25, 1.25 # beyond\n");
  Outcome outcome =
      anicodec({"interpolate", folder / "limb.pc2@3", folder / "limb.pc2@7", "-o",
                folder / "out_%d.obj", "--weights", folder / "weights.txt", "--method", "linear"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const std::string files[] = {folder / "out_0.obj", folder / "out_1.obj"};
  const MeshSequence out = load_sequence(files);
  std::vector<float> beyond;
  for (size_t i = 0; i < limb.frame(3).size(); ++i)
    beyond.push_back(-0.25F * limb.frame(3)[i] + 1.25F * limb.frame(7)[i]);
  EXPECT_LE(largest_difference(out.frame(0), limb.frame(3)), 1e-5);
  EXPECT_LE(largest_difference(out.frame(1), beyond), 1e-5);
}

TEST(InterpolateCommand, HoldsPins) {
  TemporaryFolder folder;
  write_limb(folder);
  folder.write("pins.txt", "0 0 0\n0.5 0 0\n1 2 3\n");
  Outcome outcome = anicodec({"interpolate", folder / "limb.pc2@0", folder / "limb.pc2@9", "-o",
                              folder / "out.pc2", "--frame-count", "2", "--pin",
                              "4,7-8=" + (folder / "pins.txt")});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const std::string files[] = {folder / "out.pc2"};
  const MeshSequence out = load_sequence(files);
  for (uint32_t f = 0; f < 2; ++f) {
    const float wanted[] = {0.5F, 0, 0, 1, 2, 3};
    EXPECT_EQ(largest_difference(out.frame(f).subspan(3 * 7, 6), wanted), 0);
  }
}

TEST(InterpolateCommand, ComparesAllMethods) {
  TemporaryFolder folder;
  write_limb(folder);
  Outcome outcome = anicodec({"interpolate", folder / "limb.pc2@0", folder / "limb.pc2@9",
                              "--frame-count", "3", "--compare"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  for (const char* word :
       {"length", "linear", "gradients", "bfs", "pml", "pmln", "msgi-v", "msgi "})
    EXPECT_THAT(outcome.out, HasSubstr(word));

  outcome = anicodec({"interpolate", folder / "limb.pc2@0", folder / "limb.pc2@9", "--frame-count",
                      "3", "--compare", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const auto methods = nlohmann::json::parse(outcome.out)["methods"];
  ASSERT_EQ(methods.size(), 7U);
  EXPECT_EQ(methods[0]["method"], "linear");
  EXPECT_GT(methods[0]["length_percent"], methods[6]["length_percent"]);
}

TEST(InterpolateCommand, RefinesLengthsAndAngles) {
  TemporaryFolder folder;
  write_limb(folder);
  auto length_error = [&](const std::string& steps) {
    Outcome outcome = anicodec({"interpolate", folder / "limb.pc2@0", folder / "limb.pc2@9",
                                "--frame-count", "3", "--compare", "--refine", steps});
    EXPECT_EQ(outcome.status, 0) << outcome;
    return std::stod(outcome.out.substr(outcome.out.find("msgi ") + 4));
  };
  EXPECT_LT(length_error("2"), 0.9 * length_error("0"));
}

TEST(InterpolateCommand, SaysWhatIsWrong) {
  TemporaryFolder folder;
  write_limb(folder);
  write_sequence(folder / "cloth.pc2", corpus::make_scaled("cloth", 300, 2));
  write_sequence(folder / "other.pc2", corpus::make_scaled("limb", 300, 2));
  folder.write("sum.txt", "1 0\n0.5 0.6\n");
  folder.write("few.txt", "1\n");
  folder.write("junk.txt", "1 x\n");
  folder.write("pin.txt", "0 0\n");
  const std::string a = folder / "limb.pc2@0", b = folder / "limb.pc2@9";
  auto expect = [&](std::vector<std::string> arguments, int status, const char* text) {
    arguments.insert(arguments.begin(), "interpolate");
    arguments.insert(arguments.end(), {"-o", folder / "out.pc2"});
    Outcome outcome = anicodec(arguments);
    EXPECT_EQ(outcome.status, status) << outcome;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.pc2"));
  };
  expect({a, "--frame-count", "3"}, 1, "two meshes");
  expect({a, folder / "limb.pc2", "--frame-count", "3"}, 1, "24 frames");
  expect({a, folder / "limb.pc2@24", "--frame-count", "3"}, 1, "no frame 24");
  expect({a, folder / "cloth.pc2@0", "--frame-count", "3"}, 2, "vertices");
  expect({a, b}, 1, "--frame-count");
  expect({a, b, "--frame-count", "3", "--range", "1"}, 1, "FROM:TO");
  expect({a, b, "--weights", folder / "sum.txt"}, 2, "sum.txt:2: the weights sum to 1.1");
  expect({a, b, "--weights", folder / "few.txt"}, 2, "few.txt:1: 1 weights for 2");
  expect({a, b, "--weights", folder / "junk.txt"}, 2, "junk.txt:1: 'x'");
  expect({a, b, "--frame-count", "3", "--pin", "9999=" + (folder / "pin.txt")}, 1, "vertex 9999");
  expect({a, b, "--frame-count", "3", "--pin", "7-3=" + (folder / "pin.txt")}, 1, "7-3");
  expect({a, b, "--frame-count", "3", "--pin", "7=" + (folder / "pin.txt")}, 2, "pin.txt:1");
  folder.write("pin.txt", "0 0 0\n");
  expect({a, b, "--frame-count", "3", "--pin", "7,7=" + (folder / "pin.txt")}, 2, "1 positions");
  folder.write("pin.txt", "0 0 0\n0 0 0\n");
  expect({a, b, "--frame-count", "3", "--pin", "7,7=" + (folder / "pin.txt")}, 1, "twice");
  expect({a, b, "--frame-count", "3", "--method", "pml", "--pin", "7,8=" + (folder / "pin.txt")}, 1,
         "only msgi");
  expect({a, b, "--frame-count", "3", "--method", "spline"}, 1, "spline");
}

}  // namespace
}  // namespace anicodec::tools
