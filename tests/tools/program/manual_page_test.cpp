// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/program/manual_page.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

TEST(ManualPage, HasAllOptionsOfACommand) {
  const Program program{"brush", "Paints", "Exit status:\n  0  done", {}};
  CommonOptions common;
  Commands commands;
  std::string file;
  Options& options =
      add_command(commands, common, kQuiet,
                  {"mix twice", "FILE", "Mixes", "Examples:\n.dots and \\ stay"}, [] {});
  options.argument("FILE", file, "What is mixed");
  options.option("-o,--output", file, "OUT", "What is written");
  const std::string page = manual_page(program, commands[0]);
  EXPECT_TRUE(page.starts_with(".TH \"BRUSH\\-MIX\\-TWICE\" 1 ")) << page;
  EXPECT_THAT(page, HasSubstr("brush\\-mix\\-twice \\- Mixes\n"));
  EXPECT_THAT(page, HasSubstr(".SS Arguments\n.TP\n.B FILE\nWhat is mixed\n"));
  EXPECT_THAT(page, HasSubstr(".B \\-o, \\-\\-output \\fIOUT\\fR\nWhat is written\n"));
  EXPECT_THAT(page, HasSubstr("\\-\\-quiet"));
  EXPECT_THAT(page, HasSubstr("Examples:\n\\&.dots and \\e stay\n"));
}

TEST(ManualPage, OfTheProgramListsCommands) {
  const Program program{"brush", "Paints", "Exit status:\n  0  done", {}};
  CommonOptions common;
  Commands commands;
  add_command(commands, common, 0, {"mix twice", "", "Mixes", ""}, [] {});
  const std::string page = manual_page(program, commands);
  EXPECT_THAT(page, HasSubstr(".BR brush\\-mix\\-twice (1)\nMixes\n"));
  EXPECT_THAT(page, HasSubstr("  0  done"));
}

}  // namespace
}  // namespace anicodec::tools
