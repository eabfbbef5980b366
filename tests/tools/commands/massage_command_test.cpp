// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

TEST(MassageCommand, MassagesASequence) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_scaled("sliding", 400, 4));
  Outcome outcome = anicodec({"massage", folder / "a.pc2", "-o", folder / "b.pc2", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  nlohmann::json json = outcome.json();
  EXPECT_LT(json["after"]["conformal_mean"], json["before"]["conformal_mean"]);
  EXPECT_GT(json["hausdorff_percent"], 0);
  nlohmann::json compared =
      anicodec({"compare", folder / "a.pc2", folder / "b.pc2", "--surface", "--json"}).json();
  EXPECT_NEAR(compared["hausdorff"], json["hausdorff"], 1e-9);
}

TEST(MassageCommand, KeepsToATolerance) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_scaled("sliding", 400, 3));
  Outcome outcome = anicodec({"massage", folder / "a.pc2", "-o", folder / "b.pc2", "--json",
                              "--massage-tolerance", "0.2%"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_LT(outcome.json()["hausdorff_percent"], 0.2002);
  EXPECT_GT(outcome.json()["drawn_back"], 0);
}

/// Frames of a limb, every other one with vertices in other places.
void write_scans(const TemporaryFolder& folder, uint32_t frames) {
  for (uint32_t f = 0; f < frames; ++f) {
    MeshSequence clip = corpus::make_scaled("limb", f % 2 == 0 ? 1500 : 1900, 64);
    MeshSequence frame = clip;
    frame.frame_count = 1;
    frame.times.clear();
    frame.positions.assign(clip.frame(f).begin(), clip.frame(f).end());
    write_sequence(folder / ("scan_" + std::to_string(f) + ".obj"), frame);
  }
}

/// A limb whose faces look inwards, which no transfer can follow.
void write_inside_out(const std::string& path) {
  MeshSequence limb = corpus::make_scaled("limb", 1500, 2);
  limb.frame_count = 1;
  limb.times.clear();
  limb.positions.resize(size_t{3} * limb.vertex_count);
  for (size_t i = 0; i < limb.positions.size(); i += 3)
    std::swap(limb.positions[i], limb.positions[i + 1]);
  write_sequence(path, limb);
}

TEST(MassageCommand, TransfersOneConnectivity) {
  TemporaryFolder folder;
  write_scans(folder, 4);
  Outcome outcome = anicodec(
      {"massage", "transfer", folder / "scan_*.obj", "-o", folder / "fitted.pc2", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const nlohmann::json json = outcome.json();
  ASSERT_EQ(json["files"].size(), 1U) << outcome;
  EXPECT_EQ(json["files"][0]["frames"], 4);
  EXPECT_LT(json["hausdorff_mean_percent"], 0.3);
  EXPECT_EQ(anicodec({"compare", folder / "fitted.pc2", folder / "fitted.pc2"}).status, 0);
}

TEST(MassageCommand, WritesAFileForEverySegment) {
  TemporaryFolder folder;
  write_scans(folder, 3);
  write_inside_out(folder / "scan_3.obj");
  Outcome outcome = anicodec(
      {"massage", "transfer", folder / "scan_*.obj", "-o", folder / "fitted.pc2", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const nlohmann::json json = outcome.json();
  ASSERT_EQ(json["files"].size(), 2U) << outcome;
  EXPECT_EQ(json["files"][1]["file"], folder / "fitted_2.pc2");
  EXPECT_EQ(json["files"][1]["first_frame"], 3);
  EXPECT_NE(json["frames"][3]["alarms"], "");
}

TEST(MassageCommand, FitsAMeshToAnother) {
  TemporaryFolder folder;
  for (const auto& [name, vertices] : {std::pair("coarse", 300), std::pair("fine", 4000)}) {
    MeshSequence limb = corpus::make_scaled("limb", static_cast<uint32_t>(vertices), 2);
    limb.frame_count = 1;
    limb.positions.resize(size_t{3} * limb.vertex_count);
    write_sequence(folder / (std::string(name) + ".obj"), limb);
  }
  Outcome outcome = anicodec({"massage", "fit", folder / "coarse.obj", folder / "fine.obj", "-o",
                              folder / "fitted.obj", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const nlohmann::json json = outcome.json();
  EXPECT_TRUE(json["improved"]);
  EXPECT_LT(json["after"]["hausdorff_mean"], json["before"]["hausdorff_mean"]);
  EXPECT_EQ(json["after"]["turned"], 0);
}

TEST(MassageCommand, GivesAMeshFewerAndMoreVertices) {
  TemporaryFolder folder;
  MeshSequence limb = corpus::make_scaled("limb", 1500, 2);
  limb.frame_count = 1;
  limb.positions.resize(size_t{3} * limb.vertex_count);
  write_sequence(folder / "limb.obj", limb);
  Outcome outcome = anicodec({"massage", "remesh", folder / "limb.obj", "--vertices", "10%", "-o",
                              folder / "coarse.obj", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  nlohmann::json json = outcome.json();
  const uint32_t tenth = (limb.vertex_count + 5) / 10;
  EXPECT_EQ(json["vertices"], tenth);
  EXPECT_EQ(json["method"], "decimate");
  EXPECT_LT(json["after"]["hausdorff_mean"], 0.7 * json["before"]["hausdorff_mean"].get<double>());
  const std::string coarse = folder / "coarse.obj";
  EXPECT_EQ(load_sequence({&coarse, 1}).vertex_count, tenth);

  outcome = anicodec({"massage", "remesh", coarse, "--vertices", "700", "-o", folder / "even.ply"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("700 vertices"));
  EXPECT_THAT(outcome.out, HasSubstr("isotropic"));

  outcome = anicodec({"massage", "remesh", folder / "limb.obj", "--max-distance", "0.5%", "-o",
                      folder / "near.obj", "--json", "--no-fit"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_LT(outcome.json()["vertices"], limb.vertex_count / 2);
  EXPECT_LT(outcome.json()["after"]["hausdorff_percent"], 2);
}

TEST(MassageCommand, RefusesMeshesThatCannotBeRemeshed) {
  TemporaryFolder folder;
  const std::string fan = folder.write(
      "fan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n");
  auto refused = [&](std::vector<std::string> options, const char* text) {
    std::vector<std::string> words{"massage", "remesh", fan, "-o", folder / "out.obj"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = anicodec(words);
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr(text));
  };
  refused({"--vertices", "4"}, "fan.obj: the edge between vertices 0 and 1 has 3 faces");
  refused({"--vertices", "0"}, "--vertices: '0' is not a number");
  refused({}, "--vertices N or --max-distance LEN is needed");
  refused({"--vertices", "4", "--max-distance", "1%", "--method", "loop"}, "--method decimate");
}

TEST(MassageCommand, CarriesARemeshedMesh) {
  TemporaryFolder folder;
  write_scans(folder, 3);
  Outcome outcome = anicodec({"massage", "transfer", folder / "scan_*.obj", "--vertices", "400",
                              "-o", folder / "fitted.pc2", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const nlohmann::json json = outcome.json();
  ASSERT_EQ(json["files"].size(), 1U) << outcome;
  EXPECT_EQ(json["files"][0]["vertices"], 400);
  EXPECT_GT(json["frames"][0]["hausdorff"], 0);
  EXPECT_LT(json["hausdorff_mean_percent"], 0.5);
}

/// A ball of about as many vertices, drawn out along x.
void write_ball(const std::string& path, uint32_t vertices, float stretch) {
  MeshSequence ball = corpus::make_scaled("limb", vertices, 2);
  ball.frame_count = 1;
  ball.times.clear();
  ball.positions.resize(size_t{3} * ball.vertex_count);
  for (size_t i = 0; i < ball.positions.size(); i += 3)
    ball.positions[i] *= stretch;
  write_sequence(path, ball);
}

TEST(MassageCommand, MapsAMeshToAnother) {
  TemporaryFolder folder;
  write_ball(folder / "a.obj", 600, 1);
  write_ball(folder / "b.obj", 2000, 1.1F);
  Outcome outcome = anicodec({"massage", "map", folder / "a.obj", folder / "b.obj", "-o",
                              folder / "mapped.obj", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const nlohmann::json json = outcome.json();
  EXPECT_LT(json["hausdorff_mean_percent"], 0.5) << outcome;
  EXPECT_LT(json["after"]["conformal_mean"], 1.2);
  EXPECT_EQ(json["turned"], 0);
  const nlohmann::json compared =
      anicodec({"compare", folder / "b.obj", folder / "mapped.obj", "--surface", "--json"}).json();
  EXPECT_NEAR(compared["hausdorff_mean"], json["hausdorff_mean"], 1e-6);
}

TEST(MassageCommand, MapsByLandmarks) {
  TemporaryFolder folder;
  write_ball(folder / "a.obj", 600, 1);
  MeshSequence moved = load_sequence(std::vector<std::string>{folder / "a.obj"}, {});
  for (size_t i = 0; i < moved.positions.size(); i += 3) {  // a quarter turn about z, and away
    std::swap(moved.positions[i], moved.positions[i + 1]);
    moved.positions[i] = 5 - moved.positions[i];
  }
  write_sequence(folder / "b.obj", moved);
  folder.write("pairs.txt", "# A B\n0 0\n100 100\n200, 200\n300 300\n");
  Outcome outcome = anicodec({"massage", "map", folder / "a.obj", folder / "b.obj", "--landmarks",
                              folder / "pairs.txt", "-o", folder / "mapped.obj", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_LT(outcome.json()["hausdorff_percent"], 1) << outcome;
  EXPECT_LT(outcome.json()["after"]["conformal_mean"], 1.01);
}

TEST(MassageCommand, MapsTexturesFromEitherSide) {
  TemporaryFolder folder;
  write_ball(folder / "a.obj", 300, 1);
  write_ball(folder / "plain.obj", 900, 1);
  // Texture coordinates of B are its places, x and y.
  MeshSequence b = load_sequence(std::vector<std::string>{folder / "plain.obj"}, {});
  Attribute uv{.kind = AttributeKind::kUv, .name = "uv", .values = {}};
  for (size_t v = 0; v < b.vertex_count; ++v)
    uv.values.insert(uv.values.end(), {b.positions[3 * v], b.positions[3 * v + 1]});
  b.attributes = {uv};
  write_sequence(folder / "b.obj", b);
  const Outcome outcome =
      anicodec({"massage", "map", folder / "a.obj", folder / "b.obj", "--details", "b", "--map",
                folder / "map.txt", "-o", folder / "mapped.obj", "-q"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const MeshSequence mapped = load_sequence(std::vector<std::string>{folder / "mapped.obj"}, {});
  ASSERT_EQ(mapped.attributes.size(), 1U);
  ASSERT_TRUE(mapped.attributes[0].per_corner());
  for (size_t c = 0; c < mapped.polygons.corners.size(); ++c) {
    const size_t v = mapped.polygons.corners[c];
    for (size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(mapped.attributes[0].values[2 * c + k], mapped.positions[3 * v + k], 0.02);
  }
  const std::string map = folder.read("map.txt");
  EXPECT_EQ(static_cast<size_t>(std::count(map.begin(), map.end(), '\n')), mapped.vertex_count + 1);
  // The vertices of A, whose faces they are.
  ASSERT_EQ(anicodec({"massage", "map", folder / "b.obj", folder / "a.obj", "-o",
                      folder / "back.obj", "-q"})
                .status,
            0);
  EXPECT_THAT(folder.read("back.obj"), HasSubstr("\nvt "));
}

TEST(MassageCommand, RefusesBadLandmarks) {
  TemporaryFolder folder;
  write_ball(folder / "a.obj", 200, 1);
  auto map = [&](const std::string& pairs) {
    folder.write("pairs.txt", pairs);
    return anicodec({"massage", "map", folder / "a.obj", folder / "a.obj", "--landmarks",
                     folder / "pairs.txt", "-o", folder / "b.obj"});
  };
  EXPECT_EQ(map("").status, 2);
  EXPECT_THAT(map("0 0\n1 2 3\n").err, HasSubstr("pairs.txt:2: "));
  EXPECT_THAT(map("0 0\n1 1.5\n").err, HasSubstr("pairs.txt:2: "));
  EXPECT_THAT(map("0 0\n1 1\n").err, HasSubstr("three landmarks"));
  EXPECT_THAT(map("0 0\n1 1\n2 99999\n").err, HasSubstr("vertex 99999 of the surface"));
  EXPECT_THAT(map("0 0\n0 0\n0 0\n").err, HasSubstr("on a line"));
}

TEST(MassageCommand, HelpListsItsModes) {
  const Outcome help = anicodec({"massage", "--help"});
  for (const char* mode : {"  fit ", "  transfer ", "  map "})
    EXPECT_THAT(help.out, HasSubstr(mode));
  EXPECT_THAT(anicodec({"massage", "fit", "--help"}).out,
              HasSubstr("Usage: anicodec massage fit MESH SURFACE"));
}

TEST(MassageCommand, RefusesWhatIsMissing) {
  TemporaryFolder folder;
  EXPECT_EQ(anicodec({"massage", "-o", folder / "b.pc2"}).status, 1);
  EXPECT_EQ(anicodec({"massage", "fit", "a.obj", "-o", folder / "b.obj"}).status, 1);
  EXPECT_EQ(anicodec({"massage", "transfer", "-o", folder / "b.obj"}).status, 1);
  EXPECT_EQ(anicodec({"massage", "a.obj", "--fit", "b.obj", "-o", folder / "b.obj"}).status, 1);
}

TEST(EncodeMassage, RecordsWhatItDid) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_scaled("sliding", 400, 4));
  Outcome outcome = anicodec({"encode", folder / "a.pc2", "-o", folder / "a.anic", "--massage",
                              "on", "--massage-tolerance", "0.5%", "--effort", "fast", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_TRUE(outcome.json()["massaged"]);
  const nlohmann::json info = anicodec({"info", folder / "a.anic", "--json"}).json();
  EXPECT_TRUE(info["massaged"]);
  EXPECT_EQ(info["surface_error"], outcome.json()["surface_error"]);
  EXPECT_EQ(info["surface_error_mean"], outcome.json()["surface_error_mean"]);
  EXPECT_THAT(anicodec({"info", folder / "a.anic"}).out, HasSubstr("the surface moved by"));
}

TEST(EncodeMassage, TransfersMeshesOfOtherFaces) {
  TemporaryFolder folder;
  write_scans(folder, 3);
  EXPECT_EQ(anicodec({"encode", folder / "scan_*.obj", "-o", folder / "a.anic", "--effort", "fast"})
                .status,
            2);
  Outcome outcome = anicodec({"encode", folder / "scan_*.obj", "-o", folder / "a.anic",
                              "--topology-changes", "transfer", "--effort", "fast", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_EQ(outcome.json()["frames"], 3);
  EXPECT_TRUE(outcome.json()["massaged"]);
}

TEST(EncodeMassage, NamesTheFrameThatCannotBeFollowed) {
  TemporaryFolder folder;
  write_scans(folder, 2);
  write_inside_out(folder / "scan_2.obj");
  Outcome outcome = anicodec({"encode", folder / "scan_*.obj", "-o", folder / "a.anic",
                              "--topology-changes", "transfer", "--effort", "fast"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("frame 2 cannot be given the connectivity of frame 0"));
  EXPECT_THAT(outcome.err, HasSubstr("scan_2.obj: "));
}

TEST(MassageCommand, RefusesWhatHasNoSurface) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_clip("points"));
  Outcome outcome = anicodec({"massage", folder / "a.pc2", "-o", folder / "b.pc2"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no surface to massage"));
}

TEST(MassageCommand, RefusesOptionsOutOfRange) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_scaled("sliding", 400, 2));
  for (std::vector<std::string> extra :
       {std::vector<std::string>{"--massage-strength", "1.5"}, {"--reference", "7"}}) {
    extra.insert(extra.begin(), {"massage", folder / "a.pc2", "-o", folder / "b.pc2"});
    EXPECT_EQ(anicodec(extra).status, 1);
  }
}

}  // namespace
}  // namespace anicodec::tools
