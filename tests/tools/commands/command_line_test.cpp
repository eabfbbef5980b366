// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/tools/command_testing.h"
#include "tools/words/version.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> kCommands = {
    "encode",           "decode",      "join",           "info",       "verify",
    "compare",          "analyze",     "interpolate",    "massage",    "massage fit",
    "massage transfer", "massage map", "massage remesh", "dump",       "render",
    "corpus",           "add",         "remove",         "usd-plugin", "export-vat"};

/// The help that a command prints.
std::string help_of(const std::string& command) {
  const size_t blank = command.find(' ');
  if (blank == std::string::npos)
    return anicodec({command, "--help"}).out;
  return anicodec({command.substr(0, blank), command.substr(blank + 1), "--help"}).out;
}

/// Exit status 1 and one line on stderr that starts with the command's name.
void expect_usage_error(const Outcome& outcome) {
  EXPECT_EQ(outcome.status, 1) << outcome;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, StartsWith("anicodec: "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST(CommandLine, HelpListsTheCommandsAndExitStatuses) {
  Outcome help = anicodec({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const std::string& command : kCommands)
    EXPECT_THAT(help.out, HasSubstr("  " + command + " "));
  EXPECT_THAT(help.out, AllOf(StartsWith("Usage: anicodec COMMAND"), HasSubstr("Exit status"),
                              HasSubstr("3  a damaged .anic file")));
}

TEST(CommandLine, EveryCommandHasHelpWithinAHundredColumns) {
  for (const std::string& command : kCommands) {
    const std::string help = help_of(command);
    EXPECT_THAT(help, StartsWith("Usage: anicodec " + command + " "));
    for (const char* option : {"-h,--help", "--version"})
      EXPECT_THAT(help, HasSubstr(option)) << command;
    for (size_t begin = 0; begin < help.size();) {
      size_t end = std::min(help.find('\n', begin), help.size());
      EXPECT_LE(end - begin, 100U) << help.substr(begin, end - begin);
      begin = end + 1;
    }
  }
}

TEST(CommandLine, OptionsThatCommandsShareAreWhereTheyApply) {
  const std::vector<std::string> write = {"encode",      "decode",  "join",      "analyze",
                                          "interpolate", "massage", "render",    "corpus",
                                          "add",         "remove",  "export-vat"};
  for (const std::string& command : kCommands) {
    const std::string first = command.substr(0, command.find(' '));
    const bool writes = std::find(write.begin(), write.end(), first) != write.end();
    EXPECT_EQ(help_of(command).find("-f,--force") != std::string::npos, writes) << command;
  }
  for (const char* command : {"encode", "compare", "analyze", "massage", "render"})
    EXPECT_THAT(anicodec({command, "--help"}).out, HasSubstr("-j,--threads N")) << command;
}

TEST(CommandLine, PrintsItsVersion) {
  EXPECT_EQ(anicodec({"--version"}).out, "anicodec " + std::string(version()) + "\n");
  for (const char* word : {"version", "-V"})
    EXPECT_EQ(anicodec({word}).out, anicodec({"--version"}).out);
  EXPECT_EQ(anicodec({"encode", "-V"}).status, 0);
}

TEST(CommandLine, HelpsByTheWordHelp) {
  EXPECT_EQ(anicodec({"help"}).out, anicodec({"--help"}).out);
  EXPECT_EQ(anicodec({"help", "encode"}).out, anicodec({"encode", "--help"}).out);
  EXPECT_EQ(anicodec({"help", "massage", "fit"}).out, anicodec({"massage", "fit", "--help"}).out);
  expect_usage_error(anicodec({"help", "compress"}));
  expect_usage_error(anicodec({"help", "encode", "decode"}));
}

TEST(CommandLine, EveryCommandPrintsJson) {
  for (const std::string& command : kCommands)
    EXPECT_THAT(help_of(command), HasSubstr("--json")) << command;
  const Outcome unknown = anicodec({"info", "absent.anic", "--json"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_EQ(unknown.json()["status"], 2);
  EXPECT_EQ("anicodec: " + unknown.json()["error"].get<std::string>() + "\n", unknown.err);
  EXPECT_EQ(anicodec({"info", "--json", "--no-such-option"}).json()["status"], 1);
}

TEST(CommandLine, EscapesNamesWhereverItPrintsThem) {
  TemporaryFolder folder;
  const std::string name = "bell\x07 line\nend \xff \u202e", file = folder / (name + ".anic");
  for (const char* command : {"corpus", "encode"}) {
    const Outcome outcome =
        command == std::string("corpus")
            ? anicodec({command, "one_triangle", "-o", folder / (name + ".pc2")})
            : anicodec({command, folder / (name + ".pc2"), "-o", file});
    ASSERT_EQ(outcome.status, 0) << outcome;
    EXPECT_THAT(outcome.out, HasSubstr("bell\\x07 line\\nend \\xff \\u202e")) << command;
  }
  const std::string info = anicodec({"info", file, "--json"}).out;
  EXPECT_TRUE(std::all_of(info.begin(), info.end(),
                          [](char c) { return c == '\n' || (c >= 32 && c < 127); }));
  EXPECT_EQ(std::count(info.begin(), info.end(), '\n'), 1);
  EXPECT_THAT(anicodec({"verify", file}).out, HasSubstr("line\\nend"));
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  expect_usage_error(anicodec({}));
  EXPECT_THAT(anicodec({}).err, HasSubstr("one of encode, decode, "));
  expect_usage_error(anicodec({"compress"}));
  expect_usage_error(anicodec({"info", "a.anic", "--colour"}));
  expect_usage_error(anicodec({"info"}));
  expect_usage_error(anicodec({"dump", "a.anic", "b.anic"}));
  expect_usage_error(anicodec({"usd-plugin", "undo"}));
  expect_usage_error(anicodec({"encode", "a.pc2", "-o", "a.anic", "-j0"}));
}

TEST(CommandLine, RefusesOutputsOfUnknownKind) {
  TemporaryFolder folder;
  const std::string cache = folder / "a.pc2", mesh = folder / "a.obj", clip = folder / "a.anic",
                    output = folder / "b.xyz";
  ASSERT_EQ(
      anicodec({"corpus", "limb", "-o", cache, "--vertices", "100", "--frame-count", "4"}).status,
      0);
  ASSERT_EQ(anicodec({"encode", cache, "-o", clip}).status, 0);
  const std::vector<std::string> before = folder.files();
  for (std::vector<std::string> call : {std::vector<std::string>{"encode", cache},
                                        {"decode", clip},
                                        {"join", clip, clip},
                                        {"analyze", cache},
                                        {"interpolate", mesh, mesh, "--frame-count", "3"},
                                        {"massage", cache},
                                        {"massage", "fit", mesh, mesh},
                                        {"massage", "map", mesh, mesh},
                                        {"massage", "transfer", mesh, mesh, mesh},
                                        {"massage", "remesh", mesh, "--vertices", "80"},
                                        {"render", clip},
                                        {"corpus", "limb"},
                                        {"add", clip, cache},
                                        {"remove", clip, "a"}}) {
    call.insert(call.end(), {"-o", output});
    const Outcome outcome = anicodec(call);
    expect_usage_error(outcome);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(output + ": "),
                                   AnyOf(HasSubstr("of unknown kind"), HasSubstr("not .xyz"))))
        << call[0];
  }
  EXPECT_EQ(folder.files(), before);
}

TEST(CommandLine, NamesThePackageThatHasTheRest) {
  const Outcome outcome = anicodec({"usd-plugin", "install"});
  EXPECT_EQ(outcome.status, 4) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("pip install 'anicodec[usd]'"));
}

TEST(CommandLine, SuggestsWhatWasMeant) {
  EXPECT_EQ(anicodec({"encod", "a.pc2"}).err,
            "anicodec: there is no command 'encod'; did you mean encode?\n");
  EXPECT_EQ(anicodec({"encode", "a.pc2", "-o", "a.anic", "--max_error", "1"}).err,
            "anicodec: encode: there is no option --max_error; did you mean --max-error?\n");
}

TEST(CommandLine, SaysThatAFileIsMissing) {
  TemporaryFolder folder;
  std::string file = folder / "absent.anic";
  for (const char* command : {"info", "verify", "dump"}) {
    Outcome outcome = anicodec({command, file});
    EXPECT_EQ(outcome.status, 2) << outcome;
    EXPECT_THAT(outcome.err, StartsWith("anicodec: " + file + ": "));
  }
}

TEST(CommandLine, ListsTheCorpus) {
  Outcome list = anicodec({"corpus", "--list"});
  EXPECT_EQ(list.status, 0);
  EXPECT_THAT(list.out, HasSubstr("limb "));
  expect_usage_error(anicodec({"corpus"}));
  expect_usage_error(anicodec({"corpus", "no-such-clip", "-o", "x.pc2"}));
  expect_usage_error(anicodec({"corpus", "limb", "--list"}));
}

TEST(CommandLine, MakesTheFoldersOfItsOutput) {
  TemporaryFolder folder;
  EXPECT_EQ(anicodec({"corpus", "one_triangle", "-o", folder / "a/b/frame_%04d.ply"}).status, 0);
  EXPECT_THAT(folder.read("a/b/frame_0000.ply"), StartsWith("ply"));
  EXPECT_EQ(anicodec({"corpus", "limb", "-o", folder / "c/d/no_number.ply"}).status, 1);
  EXPECT_EQ(folder.files(), std::vector<std::string>{"a"});
  const std::string frame = folder / "a/b/frame_0000.ply";
  EXPECT_EQ(anicodec({"encode", frame, "-o", folder / "e/f.anic"}).status, 0);
  EXPECT_THAT(anicodec({"info", folder / "e/f.anic"}).out, HasSubstr(", 1 frame at"));
}

}  // namespace
}  // namespace anicodec::tools
