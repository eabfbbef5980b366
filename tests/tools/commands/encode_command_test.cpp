// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/mesh_sequence.h"
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/write_sequence.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A folder with a clip of the corpus as a.pc2 and a.obj.
class EncodeCommand : public testing::Test {
 protected:
  EncodeCommand() { write_sequence(folder_ / "a.pc2", corpus::make_clip("limb")); }

  Outcome encode(std::vector<std::string> options, const std::string& output = "a.anic") {
    std::vector<std::string> arguments{"encode", folder_ / "a.pc2", "-o", folder_ / output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return anicodec(arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(EncodeCommand, PromisesATwentiethPerCentByDefault) {
  Outcome outcome = encode({"--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_LE(outcome.json()["max_error_percent"], 0.05);
  EXPECT_EQ(outcome.json()["bytes"], folder_.read("a.anic").size());
  nlohmann::json info = anicodec({"info", folder_ / "a.anic", "--json"}).json();
  EXPECT_EQ(info["asked"]["metric"], "max_error");
  EXPECT_NEAR(info["asked"]["value"], 0.0005 * double(info["diagonal"]), 1e-9);
}

/// Frames of a mesh of 2 m in coordinates of a survey.
std::string survey_frame(double t) {
  std::string text;
  for (int v = 0; v < 9; ++v)
    text += fmt::format("v {:.4f} {:.4f} {:.4f}\n", 500000 + v % 3 + t, 4649776 + v / 3 + t * v / 9,
                        120 + v * 0.01 + t);
  for (const char* face : {"1 2 5 4", "2 3 6 5", "4 5 8 7", "5 6 9 8"})
    text += std::string("f ") + face + "\n";
  return text;
}

TEST_F(EncodeCommand, KeepsTheDigitsOfSurveyCoordinates) {
  for (int f = 0; f < 3; ++f)
    folder_.write(fmt::format("s{}.obj", f), survey_frame(f * 0.1234));
  const std::string source = folder_ / "s*.obj", file = folder_ / "s.anic";
  for (const bool lossless : {false, true}) {
    std::vector<std::string> command{"encode", source, "-o", file, "-f"};
    if (lossless)
      command.emplace_back("--lossless");
    const Outcome outcome = anicodec(command);
    ASSERT_EQ(outcome.status, 0) << outcome;
    EXPECT_THAT(outcome.err, HasSubstr("coordinates up to 4649778 of a mesh of 3.03"));
    EXPECT_EQ(outcome.err.find("float32 takes up to") != std::string::npos, lossless) << outcome;
    const nlohmann::json info = anicodec({"info", file, "--json"}).json();
    EXPECT_EQ(info["origin"], nlohmann::json({500000, 4649776, 120}));
    ASSERT_EQ(anicodec({"decode", file, "-o", folder_ / "d%d.obj", "-f"}).status, 0);
    const nlohmann::json errors =
        anicodec({"compare", source, folder_ / "d*.obj", "--json"}).json();
    EXPECT_LE(errors["max_error"], lossless ? 0 : 0.0005 * double(info["diagonal"]));
    EXPECT_LE(anicodec({"compare", source, file, "--json"}).json()["max_error"],
              lossless ? 0 : 0.0005 * double(info["diagonal"]));
  }
  EXPECT_THAT(anicodec({"info", file}).out,
              HasSubstr("origin     500000,4649776,120: positions count from it"));
  EXPECT_THAT(anicodec({"decode", file, "-o", folder_ / "d.pc2"}).out,
              HasSubstr("its positions count from 500000,4649776,120; .obj"));
  EXPECT_EQ(anicodec({"decode", file, "-o", folder_ / "d.pc2", "-f", "--json"}).json()["origin"],
            nlohmann::json({500000, 4649776, 120}));
  EXPECT_THAT(anicodec({"encode", source, "-o", file, "-f", "--origin", "none"}).err,
              HasSubstr("a local origin (encode --origin) keeps more"));
  for (const char* origin : {"1,2", "1,2,x", "1,2,inf", "here"})
    EXPECT_EQ(anicodec({"encode", source, "-o", file, "-f", "--origin", origin}).status, 1)
        << origin;
  // Parts count from one point; a clip that is added counts from that of the file.
  ASSERT_EQ(anicodec({"encode", source, "-o", folder_ / "p0.anic", "--part", "0:2"}).status, 0);
  ASSERT_EQ(anicodec({"encode", source, "-o", folder_ / "p1.anic", "--part", "2:3"}).status, 0);
  EXPECT_EQ(
      anicodec({"join", folder_ / "p0.anic", folder_ / "p1.anic", "-o", folder_ / "p.anic"}).status,
      0);
  ASSERT_EQ(anicodec({"encode", source, "-o", folder_ / "p1.anic", "-f", "--part", "2:3",
                      "--origin", "500000,4649777,120"})
                .status,
            0);
  EXPECT_THAT(
      anicodec({"join", folder_ / "p0.anic", folder_ / "p1.anic", "-o", folder_ / "p.anic", "-f"})
          .err,
      HasSubstr("counts positions from another origin than"));
  folder_.write("t.obj", survey_frame(64));
  ASSERT_EQ(anicodec({"add", file, folder_ / "t.obj", "--name", "more"}).status, 0);
  ASSERT_EQ(anicodec({"decode", file, "-o", folder_ / "t2.obj", "--clip", "more"}).status, 0);
  EXPECT_LE(
      anicodec({"compare", folder_ / "t.obj", folder_ / "t2.obj", "--json"}).json()["max_error"],
      2e-3);
}

TEST_F(EncodeCommand, GivesEveryBitBackWithoutLoss) {
  ASSERT_EQ(encode({"--lossless", "--effort", "fast"}).status, 0);
  const std::string file = folder_ / "a.anic";
  EXPECT_EQ(anicodec({"verify", file}).status, 0);
  ASSERT_EQ(anicodec({"decode", file, "-o", folder_ / "b.pc2", "-q"}).status, 0);
  EXPECT_EQ(folder_.read("b.pc2"), folder_.read("a.pc2"));
  EXPECT_THAT(anicodec({"info", file}).out, HasSubstr("bit for bit"));
  EXPECT_EQ(anicodec({"info", file, "--json"}).json()["max_error"], 0);
  for (const std::vector<std::string>& with :
       {std::vector<std::string>{"--kg", "1"}, {"--max-error", "1"}, {"--massage", "on"}}) {
    std::vector<std::string> options{"--lossless", "-f"};
    options.insert(options.end(), with.begin(), with.end());
    EXPECT_EQ(encode(options).status, 1) << with[0];
  }
}

TEST_F(EncodeCommand, MakesOneFileOfSeveralClips) {
  write_sequence(folder_ / "b.pc2", corpus::make_clip("limb"));
  const std::string library = folder_ / "library.anic";
  const std::vector<std::string> encode_all{"encode",
                                            folder_ / "a.obj",
                                            folder_ / "a.pc2",
                                            folder_ / "b.pc2",
                                            "-o",
                                            library,
                                            "-f",
                                            "--json",
                                            "--kg",
                                            "1",
                                            "--effort",
                                            "fast"};
  nlohmann::json report = anicodec(encode_all).json();
  ASSERT_EQ(report["clips"].size(), 2U);
  EXPECT_EQ(report["clips"][1]["name"], "b");
  for (const nlohmann::json& clip : report["clips"])
    EXPECT_LE(clip["kg"], 1);
  std::vector<std::string> named = encode_all;
  named.insert(named.end(), {"--name", "walk,run"});
  anicodec(named);
  EXPECT_EQ(anicodec({"info", library, "--json"}).json()["clips"][1]["name"], "run");
  EXPECT_THAT(anicodec({"info", library}).out, HasSubstr("2 clips"));
  EXPECT_EQ(anicodec({"verify", library}).status, 0);
  EXPECT_THAT(anicodec({"dump", library}).out, HasSubstr("clip 1 name"));
  EXPECT_THAT(anicodec({"decode", library, "-o", folder_ / "c.pc2"}).err,
              HasSubstr("one of them must be chosen, or all: 'walk', 'run'"));
  EXPECT_THAT(anicodec({"decode", library, "--clip", "fly", "-o", folder_ / "c.pc2"}).err,
              HasSubstr("there is no clip 'fly'"));
  EXPECT_EQ(anicodec({"decode", library, "--clip", "run", "-o", folder_ / "c.pc2"}).status, 0);
  nlohmann::json same =
      anicodec({"compare", folder_ / "a.pc2", folder_ / "c.pc2", "--json"}).json();
  EXPECT_LE(same["kg"], 1);
  named.back() = "walk,walk";
  EXPECT_THAT(anicodec(named).err, HasSubstr("two clips have the name 'walk'"));
  named.back() = "walk";
  EXPECT_THAT(anicodec(named).err, HasSubstr("1 names for 2 clips"));
}

TEST_F(EncodeCommand, KeepsEveryKindOfTarget) {
  auto encoded = [&](std::vector<std::string> options, const std::string& file) {
    options.insert(options.end(), {"--effort", "fast", "--json"});
    return encode(options, file).json();
  };
  EXPECT_LE(encoded({"--kg", "0.5"}, "1.anic")["kg"], 0.5);
  EXPECT_LE(encoded({"--kg", "0.5%"}, "1p.anic")["kg"], 0.5);
  nlohmann::json rmse = encoded({"--rmse", "0.02%"}, "2.anic");
  EXPECT_LE(rmse["rmse"], 0.0002 * double(rmse["diagonal"]));
  const nlohmann::json moves = encoded({"--displacement", "0.1%"}, "6.anic");
  EXPECT_LE(moves["max_displacement_error"], 0.001 * double(moves["diagonal"]));
  EXPECT_GE(moves["max_displacement_error"], 0.0008 * double(moves["diagonal"]));
  EXPECT_LE(encoded({"--size", "9k"}, "3.anic")["bytes"], 9000);
  EXPECT_LE(encoded({"--bpfv", "1.5"}, "4.anic")["bpfv"], 1.5);
  nlohmann::json capped = encoded({"--kg", "2", "--max-error", "0.5%"}, "5.anic");
  EXPECT_LE(capped["kg"], 2);
  EXPECT_LE(capped["max_error_percent"], 0.5);
}

// The visible error is measured on the decoded file; better qualities are larger.
TEST_F(EncodeCommand, KeepsAnErrorOfWhatViewersSee) {
  size_t before = 0;
  for (const auto& [options, bound] :
       {std::pair{std::vector<std::string>{"--sted", "0.1"}, 0.1},
        std::pair{std::vector<std::string>{"--quality", "good"}, 0.05},
        std::pair{std::vector<std::string>{"--quality", "better"}, 0.02},
        std::pair{std::vector<std::string>{"--quality", "best"}, 0.01}}) {
    std::vector<std::string> with{"--effort", "fast", "-f"};
    with.insert(with.end(), options.begin(), options.end());
    ASSERT_EQ(encode(with).status, 0);
    const std::string file = folder_ / "a.anic";
    const double sted =
        anicodec({"compare", folder_ / "a.pc2", file, "--json"}).json()["sted"].get<double>();
    EXPECT_LE(sted, bound);
    EXPECT_GE(sted, 0.7 * bound);
    EXPECT_EQ(anicodec({"info", file, "--json"}).json()["asked"],
              (nlohmann::json{{"metric", "sted"}, {"value", bound}}));
    EXPECT_GT(folder_.read("a.anic").size(), before);
    before = folder_.read("a.anic").size();
  }
}

TEST_F(EncodeCommand, UsesTheNumberOfKeyframesAskedFor) {
  for (const char* select : {"gas", "pivot", "uniform"}) {
    Outcome outcome = encode({"--keyframes", "7", "--keyframe-selection", select, "--json", "-f"});
    ASSERT_EQ(outcome.status, 0) << outcome;
    EXPECT_EQ(outcome.json()["components"], 7) << select;
    EXPECT_EQ(outcome.json()["basis"], "keyframes");
  }
}

TEST_F(EncodeCommand, RebuildsFramesAsAskedFor) {
  auto kg = [&](const std::string& interpolation) {
    Outcome outcome =
        encode({"--keyframes", "5", "--interpolation", interpolation, "--json", "-f"});
    EXPECT_EQ(outcome.status, 0) << outcome;
    EXPECT_EQ(anicodec({"verify", folder_ / "a.anic"}).status, 0);
    return outcome.json()["kg"].get<double>();
  };
  const double linear = kg("linear"), msgi = kg("msgi");
  nlohmann::json info = anicodec({"info", folder_ / "a.anic", "--json"}).json();
  EXPECT_EQ(info["segments"][0]["reconstruction"], "msgi");
  EXPECT_THAT(anicodec({"info", folder_ / "a.anic"}).out, HasSubstr("by msgi"));
  EXPECT_THAT(anicodec({"dump", folder_ / "a.anic"}).out, HasSubstr("required features"));
  EXPECT_LE(kg("auto"), std::min(linear, msgi) * 1.000001);
  Outcome wrong = encode({"--basis", "eigenshapes", "--interpolation", "msgi", "-f"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.err, HasSubstr("--interpolation msgi goes with"));
}

TEST_F(EncodeCommand, CodesKeyframesAsAskedFor) {
  const auto coded = [&](const std::string& coder) {
    Outcome outcome = encode({"--keyframes", "5", "--keyframe-coder", coder, "-f"});
    EXPECT_EQ(outcome.status, 0) << outcome;
    EXPECT_EQ(anicodec({"verify", folder_ / "a.anic"}).status, 0);
    return anicodec({"info", folder_ / "a.anic", "--json"}).json();
  };
  const nlohmann::json draco = coded("draco"), native = coded("native"), best = coded("auto");
  EXPECT_EQ(draco["segments"][0]["coder"], "draco");
  EXPECT_EQ(draco["features"], nlohmann::json({"draco"}));
  EXPECT_EQ(native["segments"][0]["coder"], "native");
  EXPECT_TRUE(native["features"].empty());
  EXPECT_LT(native["bytes"], draco["bytes"]);
  EXPECT_EQ(best["bytes"], native["bytes"]);
  ASSERT_EQ(encode({"--keyframes", "5", "-f"}).status, 0);
  EXPECT_EQ(anicodec({"info", folder_ / "a.anic", "--json"}).json()["bytes"], native["bytes"]);
  Outcome wrong = encode({"--keyframe-coder", "draco", "-f"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.err, HasSubstr("--keyframe-coder goes with"));
}

TEST_F(EncodeCommand, NeedsNoDracoUnlessAskedFor) {
  // One that ends with a basis, and two with key-frames.
  for (const std::string name : {"limb", "one_frame", "one_triangle"}) {
    const std::string source = folder_ / (name + ".pc2");
    write_sequence(source, corpus::make_clip(name));
    ASSERT_EQ(anicodec({"encode", source, "-o", folder_ / "clip.anic", "-f"}).status, 0);
    EXPECT_THAT(anicodec({"info", folder_ / "clip.anic"}).out, Not(HasSubstr("draco"))) << name;
  }
}

TEST_F(EncodeCommand, UsesTheBasisAskedFor) {
  for (const char* basis : {"keyframes", "eigenshapes", "eigentrajectories"}) {
    Outcome outcome = encode({"--basis", basis, "--json", "-f"});
    ASSERT_EQ(outcome.status, 0) << outcome;
    EXPECT_EQ(outcome.json()["basis"], basis);
    EXPECT_LE(outcome.json()["max_error_percent"], 0.05);
    EXPECT_EQ(anicodec({"verify", folder_ / "a.anic"}).status, 0);
  }
}

TEST_F(EncodeCommand, GivesTheSameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(encode({"-j1", "--effort", "normal"}, "1.anic").status, 0);
  ASSERT_EQ(encode({"-j2", "--effort", "normal"}, "2.anic").status, 0);
  ASSERT_EQ(encode({"-j2", "--effort", "normal"}, "3.anic").status, 0);
  EXPECT_EQ(folder_.read("1.anic"), folder_.read("2.anic"));
  EXPECT_EQ(folder_.read("2.anic"), folder_.read("3.anic"));
}

TEST_F(EncodeCommand, RefusesImpossibleOptionsAndLeavesNoFile) {
  const std::vector<std::vector<std::string>> impossible = {
      {"--kg", "1", "--size", "20k"},
      {"--kg", "0"},
      {"--sted", "0"},
      {"--displacement", "-1"},
      {"--quality", "good", "--sted", "0.1"},
      {"--quality", "worst"},
      {"--displacement", "1%", "--root-motion"},
      {"--kg", "-1"},
      {"--max-error", "0"},
      {"--max-error", "nan"},
      {"--max-error", "1e-30"},
      {"--size", "12"},
      {"--size", "lots"},
      {"--keyframes", "0"},
      {"--keyframes", "100000"},
      {"--keyframes", "2", "--kg", "0.01"},
      {"--basis", "magic"},
      {"--basis", "eigenshapes", "--keyframes", "5"},
      {"--keyframe-selection", "best"},
      {"--order", "none"},
      {"--fps", "0"},
      {"--fps", "24/0"},
      {"--effort", "10"},
      {"--up", "x"},
      {"--unit", "-1"},
      {"--mesh", "absent.obj", "--mesh", "again.obj"}};
  for (const auto& options : impossible) {
    Outcome outcome = encode(options);
    EXPECT_EQ(outcome.status, 1) << testing::PrintToString(options) << outcome;
    EXPECT_THAT(outcome.err, StartsWith("anicodec: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(folder_.files(), ElementsAre("a.obj", "a.pc2")) << testing::PrintToString(options);
  }
}

TEST_F(EncodeCommand, StatesWhatCanBeReached) {
  Outcome outcome = encode({"--keyframes", "2", "--kg", "0.01"});
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("2 key-frames"), HasSubstr("%")));
}

TEST_F(EncodeCommand, OverwritesOnlyWhenForced) {
  folder_.write("a.anic", "precious");
  Outcome refused = encode({"--kg", "1"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, HasSubstr("a.anic"));
  EXPECT_EQ(folder_.read("a.anic"), "precious");
  EXPECT_EQ(encode({"--kg", "1", "-f"}).status, 0);
  EXPECT_NE(folder_.read("a.anic"), "precious");
}

TEST_F(EncodeCommand, KeepsAnExistingFileWhenItFails) {
  folder_.write("a.anic", "precious");
  folder_.write("a.pc2", "POINTCACHE2");
  EXPECT_EQ(encode({"-f"}).status, 2);
  EXPECT_EQ(folder_.read("a.anic"), "precious");
}

TEST_F(EncodeCommand, DoesNotWriteOverItsInput) {
  std::string before = folder_.read("a.pc2");
  Outcome outcome = encode({"-f"}, "a.pc2");
  EXPECT_EQ(outcome.status, 1) << outcome;
  EXPECT_EQ(folder_.read("a.pc2"), before);
}

TEST_F(EncodeCommand, SpeaksOnlyWhenAsked) {
  Outcome quiet = encode({"--kg", "1", "-q"});
  EXPECT_EQ(quiet.out + quiet.err, "");
  Outcome loud = encode({"--kg", "1", "-v", "-f"});
  EXPECT_THAT(loud.out, HasSubstr("tried"));
  EXPECT_EQ(loud.err, "");
}

TEST_F(EncodeCommand, NamesFrameAndFileOfANumberThatIsNotFinite) {
  MeshSequence clip = corpus::make_clip("limb");
  clip.frame(7)[5] = std::numeric_limits<float>::quiet_NaN();
  write_sequence(folder_ / "bad.pc2", clip);
  Outcome outcome = anicodec({"encode", folder_ / "bad.pc2", "-o", folder_ / "bad.anic"});
  EXPECT_EQ(outcome.status, 2) << outcome;
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("bad.pc2"), HasSubstr("frame 7"), HasSubstr("vertex 1")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad.anic"));
}

TEST_F(EncodeCommand, NamesAFrameThatDoesNotFit) {
  folder_.write("f/1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder_.write("f/2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n");
  Outcome counts = anicodec({"encode", folder_ / "f/*.obj", "-o", folder_ / "f.anic"});
  EXPECT_EQ(counts.status, 2);
  EXPECT_THAT(counts.err, AllOf(HasSubstr("2.obj"), HasSubstr("4 vertices")));
  folder_.write("f/2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n");
  Outcome faces = anicodec({"encode", folder_ / "f/*.obj", "-o", folder_ / "f.anic"});
  EXPECT_EQ(faces.status, 2);
  EXPECT_THAT(faces.err, AllOf(HasSubstr("2.obj"), HasSubstr("face 0")));
  Outcome none = anicodec({"encode", folder_ / "g*.obj", "-o", folder_ / "f.anic"});
  EXPECT_EQ(none.status, 2);
  Outcome cache =
      anicodec({"encode", folder_ / "f/1.obj", folder_ / "a.pc2", "-o", folder_ / "f.anic"});
  EXPECT_EQ(cache.status, 2);
  EXPECT_THAT(cache.err, AllOf(HasSubstr("a.pc2"), HasSubstr("1.obj")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f.anic"));
}

TEST_F(EncodeCommand, KeepsFramesInFilesWhereTheMemoryIsSmall) {
  write_sequence(folder_ / "big.pc2", corpus::make_wave_grid(8000, 100, 8));
  const auto arguments = [&](const std::string& output) {
    return std::vector<std::string>{"encode", folder_ / "big.pc2", "--effort", "fast",
                                    "-o",     folder_ / output};
  };
  std::vector<std::string> small = arguments("files.anic");
  small.insert(small.end(), {"--memory", "28M"});
  std::vector<std::string> without_room{"env", "TMPDIR=/no/such/folder", ANICODEC_COMMAND};
  without_room.insert(without_room.end(), small.begin(), small.end());
  const Outcome failed = run_program(without_room);
  EXPECT_EQ(failed.status, 5) << failed;
  EXPECT_THAT(failed.err,
              AllOf(HasSubstr("big.pc2: /no/such/folder: "), HasSubstr("No such file")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "files.anic"));
  const Outcome outcome = anicodec(small);
  EXPECT_EQ(outcome.status, 0) << outcome;
  EXPECT_EQ(anicodec(arguments("memory.anic")).status, 0);
  EXPECT_EQ(folder_.read("files.anic"), folder_.read("memory.anic"));
}

TEST_F(EncodeCommand, LeavesNothingBehindWhenInterrupted) {
  write_sequence(folder_ / "big.pc2", corpus::make_wave_grid(20000, 80, 40));
  // The output waits in a folder of its own before the search begins, which takes seconds.
  const auto has_begun = [&] {
    return std::ranges::any_of(folder_.files(), [](const std::string& name) {
      return name.starts_with(".anicodec-stage-");
    });
  };
  for (int signal : {SIGINT, SIGTERM}) {
    Outcome outcome = run_program({ANICODEC_COMMAND, "encode", folder_ / "big.pc2", "-o",
                                   folder_ / "big.anic", "--effort", "best", "-f"},
                                  signal, has_begun);
    EXPECT_EQ(outcome.status, 128 + signal) << outcome;
    EXPECT_THAT(folder_.files(), ElementsAre("a.obj", "a.pc2", "big.obj", "big.pc2"));
  }
}

TEST_F(EncodeCommand, RefusesWhatCannotBeEncodedWithStatusTwo) {
  folder_.write("huge.obj", "v 0 0 0\nv 1e20 0 0\nv 0 1e20 3\nf 1 2 3\n");
  for (const char* threads : {"1", "2", "4"}) {
    for (int run = 0; run < 25; ++run) {
      Outcome outcome = anicodec(
          {"encode", folder_ / "huge.obj", "-o", folder_ / "huge.anic", "--json", "-j", threads});
      ASSERT_EQ(outcome.status, 2) << outcome;
      EXPECT_EQ(outcome.json()["status"], 2);
      EXPECT_THAT(outcome.json()["error"], HasSubstr("the coordinates are too large"));
    }
  }
  Outcome outcome = encode({"--json"}, std::string(300, 'x') + ".anic");
  EXPECT_EQ(outcome.status, 2) << outcome;
  EXPECT_EQ(outcome.json()["status"], 2);
  EXPECT_THAT(outcome.json()["error"], HasSubstr("the name is too long"));
}

TEST_F(EncodeCommand, EndsWithStatusFiveWithoutMemory) {
#if !defined(__SANITIZE_ADDRESS__)
  for (const char* kilobytes : {"40000", "45000", "50000", "60000", "80000"}) {
    Outcome outcome = run_program(
        {"sh", "-c",
         std::string("ulimit -v ") + kilobytes + "; exec \"$0\" encode -q -f -j 4 \"$1\" -o \"$2\"",
         ANICODEC_COMMAND, folder_ / "a.pc2", folder_ / "a.anic"});
    EXPECT_THAT(outcome.status, testing::AnyOf(0, 5, 127))
        << kilobytes << outcome;  // 127: not even started
  }
#endif
}

}  // namespace
}  // namespace anicodec::tools
