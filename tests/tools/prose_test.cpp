// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Comments, help texts and pages are plain English.
#include "tests/tools/command_testing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

Outcome check_prose(const std::string& checkout) {
  return run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_prose.py", checkout});
}

TEST(Prose, HasNoRiddles) {
  const Outcome outcome = check_prose(ANICODEC_SOURCE_DIR);
  EXPECT_EQ(outcome.status, 0) << outcome;
}

TEST(Prose, FindsRiddlesOfEachKindOfFile) {
  TemporaryFolder folder;
  folder.write("codec/attic/opens.h",
               "/// How large it is. Where it is small,\n/// nothing.\nint a;\n");
  folder.write("codec/attic/beside.cpp", "int b;  // of those that move\n");
  folder.write("codec/attic/block.c", "/* What is left. */\n");
  folder.write("tools/help.cpp", "add(\"--size\",\n    \"Of the file \"\n    \"in bytes\");\n");
  folder.write("attic.py",
               "def f():\n    \"\"\"Those of a frame.\"\"\"\n    # That which moves.\n");
  folder.write("attic.js", "/** Of all clips. */\n");
  folder.write("attic.rs", "/// Numbers of it that change.\n");
  folder.write("attic.cs", "/// <summary>What it is.</summary>\n");
  folder.write("attic.md", "| word | use |\n|---|---|\n| a | Whichever of them |\n");
  folder.write("three.md", "It keeps what those had which went and that is all.\n");
  const Outcome outcome = check_prose(folder / "");
  EXPECT_EQ(outcome.status, 1);
  for (const char* riddle :
       {"codec/attic/opens.h:1: opens with Where: Where it is small, nothing.",
        "codec/attic/beside.cpp:1: chain of of those that",
        "codec/attic/block.c:1: opens with What", "tools/help.cpp:2: opens with Of: Of the file in",
        "attic.py:2: opens with Those", "attic.py:3: opens with That which",
        "attic.js:1: opens with Of", "attic.rs:1: chain of of it that",
        "attic.cs:1: opens with What", "attic.md:3: opens with Whichever of",
        "three.md:1: chain of what those"})
    EXPECT_THAT(outcome.out, HasSubstr(riddle));
  EXPECT_THAT(outcome.out, HasSubstr("11 riddles"));
}

TEST(Prose, LetsPlainSentencesPass) {
  TemporaryFolder folder;
  folder.write("codec/attic/plain.h",
               "/// The corners that move, and those of the mesh: what a decoder needs.\n"
               "/// Where is the frame? `Of those that` is code, \"what that\" a quotation.\n");
  folder.write("codec/attic/text.cpp", "print(\"Of\"); fail(name + \" of those\");\n");
  folder.write(
      "attic.md",
      "# What it is\n\n| Where | What |\n|---|---|\n| here | this |\n\n```\nWhat runs\n```\n");
  const Outcome outcome = check_prose(folder / "");
  EXPECT_EQ(outcome.status, 0) << outcome;
  EXPECT_THAT(outcome.out, Not(HasSubstr("attic")));
}

}  // namespace
}  // namespace anicodec::tools
