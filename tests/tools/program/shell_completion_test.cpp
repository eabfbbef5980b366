// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/program/shell_completion.h"

#include "tests/tools/io_testing.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

constexpr Word<int> kColours[] = {{0, "red"}, {1, "green"}};

/// A program with a command, and one with a mode.
class ShellCompletion : public testing::Test {
 protected:
  ShellCompletion() {
    Options& paint =
        add_command(commands_, common_, kForce, {"paint", "FILE", "It's colour", ""}, [] {});
    paint.argument("FILE", file_, "What is painted");
    paint.choice("-c,--colour", colour_, WordTable<int>(kColours), "Colour [of it]");
    paint.option("-o,--output", file_, "OUT", "What is written");
    add_command(commands_, common_, 0, {"mix", "", "Mixes", ""}, [] {});
    Options& twice =
        add_command(commands_, common_, 0, {"mix twice", "", "Mixes again", ""}, [] {});
    twice.number("--speed", colour_, "N", {1, 9}, "How fast");
    Options& brush = add_command(commands_, common_, 0, {"brush", "wet|dry", "Cares", ""}, [] {});
    brush.argument("ACTION", file_, "What is done").words = {"wet", "dry"};
  }

  std::string script(Shell shell) const { return shell_completion(program_, commands_, shell); }

  /// The output of a shell that runs a script; empty and `found` false without that shell.
  std::string run(const std::string& shell, const std::string& text, bool* found) {
    *found = std::system(("command -v " + shell + " > /dev/null").c_str()) == 0;
    const std::string file = folder_.write("script", text);
    std::string out;
    FILE* pipe = popen((shell + " " + file + " 2>&1").c_str(), "r");
    for (int c; (c = std::fgetc(pipe)) != EOF;)
      out += static_cast<char>(c);
    pclose(pipe);
    return out;
  }

  TemporaryFolder folder_;
  Program program_{"brush", "Paints", "", {}};
  CommonOptions common_;
  Commands commands_;
  std::string file_;
  int colour_ = 0;
};

TEST_F(ShellCompletion, CompletesInBash) {
  bool found = false;
  const auto completed = [&](const std::string& words, int at) {
    return run("bash",
               script(Shell::kBash) + "COMP_WORDS=(" + words +
                   ")\nCOMP_CWORD=" + std::to_string(at) + "\n_brush\necho \"${COMPREPLY[*]}\"\n",
               &found);
  };
  const std::string options = completed("brush paint --", 2);
  if (!found)
    GTEST_SKIP() << "no bash";
  EXPECT_EQ(options, "--help --version --force --colour --output\n");
  EXPECT_EQ(completed("brush p", 1), "paint\n");
  EXPECT_EQ(completed("brush ma", 1), "manual\n");
  EXPECT_EQ(completed("brush paint --colour ''", 3), "red green\n");
  EXPECT_EQ(completed("brush paint -o ''", 3), "\n") << "files, by the shell itself";
  EXPECT_EQ(completed("brush mix t", 2), "twice\n");
  EXPECT_EQ(completed("brush mix twice --s", 3), "--speed\n");
  EXPECT_EQ(completed("brush brush d", 2), "dry\n");
}

TEST_F(ShellCompletion, IsGoodZsh) {
  bool found = false;
  const std::string text = script(Shell::kZsh);
  EXPECT_THAT(text, HasSubstr("'paint:It'\\''s colour'"));
  EXPECT_THAT(text, HasSubstr("'[''Colour \\[of it\\]'']'':word:(red green)'"));
  EXPECT_THAT(text, HasSubstr("'1:mode:(wet dry)'"));
  const std::string said = run("zsh -n", text, &found);
  if (!found)
    GTEST_SKIP() << "no zsh";
  EXPECT_EQ(said, "");
}

TEST_F(ShellCompletion, CompletesInFish) {
  bool found = false;
  const std::string text = script(Shell::kFish);
  EXPECT_THAT(text, HasSubstr("-s c -l colour -xa 'red green'"));
  EXPECT_THAT(text, HasSubstr("'__fish_seen_subcommand_from brush' -xa 'wet dry'"));
  const std::string said = run("fish",
                               text +
                                   "complete -C 'brush paint --col'\n"
                                   "complete -C 'brush comp'\n"
                                   "complete -C 'brush mix twice --sp'\n",
                               &found);
  if (!found)
    GTEST_SKIP() << "no fish";
  EXPECT_THAT(said, HasSubstr("--colour\t"));
  EXPECT_THAT(said, HasSubstr("--speed\t"));
  EXPECT_THAT(said, HasSubstr("completion\t"));
}

}  // namespace
}  // namespace anicodec::tools
