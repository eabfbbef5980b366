// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Modules include only what stands below them; pages point to what exists.
#include "tests/tools/command_testing.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

Outcome check_layering(const std::string& checkout) {
  return run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_layering.py", checkout});
}

TEST(Layering, EveryIncludeIsAllowed) {
  Outcome outcome = check_layering(ANICODEC_SOURCE_DIR);
  EXPECT_EQ(outcome.status, 0) << outcome;
}

TEST(Layering, FindsWhatPointsUpwards) {
  TemporaryFolder folder;
  folder.write("format/a.h", "#include \"sdk/clip.h\"\n");
  folder.write("sdk/b.cpp", "#include <iostream>\nvoid f() { throw 1; }\n");
  folder.write("codec/c.cpp", "# include <draco/core/status.h>\n#include \"tools/version.h\"\n");
  folder.write("sdk/mesh/draco_poses.cpp", "#include <draco/core/status.h>\n");
  folder.write("codec/parallel/p.h", "#include <tbb/parallel_for.h>\n");
  folder.write("codec/search/t.cpp", "#include <tbb/parallel_for.h>\n");
  folder.write("tools/u.cpp", "int v = std::reduce(std::execution::par, a, b);\n");
  Outcome outcome = check_layering(folder / "");
  EXPECT_EQ(outcome.status, 1);
  for (const char* fault :
       {"format/a.h must not include \"sdk/clip.h\"", "sdk/b.cpp must not include <iostream>",
        "sdk/b.cpp must not throw", "codec/c.cpp must not include <draco/core/status.h>",
        "codec/c.cpp must not include \"tools/version.h\"",
        "codec/search/t.cpp must not include <tbb/parallel_for.h>",
        "tools/u.cpp must work in parallel by codec/parallel"})
    EXPECT_THAT(outcome.out, HasSubstr(fault));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("draco_poses")));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("codec/parallel/p.h")));
}

TEST(Layering, FindsArrowsBetweenRoomsThatPointBack) {
  TemporaryFolder folder;
  folder.write("codec/segment/README.md", "a room\n");
  folder.write("codec/segment/a.cpp",
               "#include \"codec/search/b.h\"\n#include \"codec/algebra/c.h\"\n");
  folder.write("codec/attic/d.cpp", "");
  folder.write("tools/io/gltf/e.cpp", "#include \"codec/encode.h\"\n");
  for (int unit = 0; unit < 21; ++unit)
    folder.write("sdk/play/u" + std::to_string(unit) + ".cpp", "");
  Outcome outcome = check_layering(folder / "");
  EXPECT_EQ(outcome.status, 1);
  for (const char* fault : {"codec/segment/a.cpp must not include \"codec/search/b.h\"",
                            "codec/attic is not among the rooms", "sdk/play has no README.md",
                            "tools/io/gltf/e.cpp must not include \"codec/encode.h\"",
                            "sdk/play has 21 units, more than 20"})
    EXPECT_THAT(outcome.out, HasSubstr(fault));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("algebra")));
}

TEST(Layering, FindsWhatReachesPastTheRoomsThatAreNamed) {
  TemporaryFolder folder;
  folder.write("codec/metrics/a.cpp", "#include \"sdk/mesh/b.h\"\n#include \"sdk/clip/c.h\"\n");
  folder.write("tools/commands/command_decode.cpp", "#include \"sdk/clip/clip.h\"\n");
  folder.write("tools/commands/command_verify.cpp", "#include \"sdk/clip/clip.h\"\n");
  Outcome outcome = check_layering(folder / "");
  EXPECT_EQ(outcome.status, 1);
  for (const char* fault :
       {"codec/metrics/a.cpp must not include \"sdk/clip/c.h\"",
        "tools/commands/command_decode.cpp must not include \"sdk/clip/clip.h\""})
    EXPECT_THAT(outcome.out, HasSubstr(fault));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("sdk/mesh/b.h")));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("command_verify")));
}

TEST(Layering, FindsUnitsOfOneName) {
  TemporaryFolder folder;
  folder.write("sdk/play/memory.h", "");
  folder.write("sdk/play/memory.cpp", "");
  folder.write("format/memory.h", "");
  folder.write("format/bytes.h", "");
  Outcome outcome = check_layering(folder / "");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("memory is the name of a unit in format and in sdk/play"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("bytes is the name")));
}

TEST(Layering, FindsHeadersThatDoNotCompileAlone) {
  TemporaryFolder folder;
  folder.write("format/bare.h", "inline std::string name() { return {}; }\n");
  folder.write("format/whole.h", "#include <string>\ninline std::string title() { return {}; }\n");
  folder.write("format/first.h", "inline std::string shown() { return {}; }\n");
  folder.write("format/first.cpp", "#include \"format/first.h\"\n");
  const nlohmann::json commands = {{{"directory", folder / ""},
                                    {"file", folder / "format/first.cpp"},
                                    {"command", "c++ -I. -c " + (folder / "format/first.cpp")}}};
  folder.write("commands.json", commands.dump());
  Outcome outcome = run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_headers.py",
                                 folder / "", folder / "commands.json"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("format/bare.h does not compile alone"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("whole.h")));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("first.h")));  // the build compiles that one
}

TEST(Layering, EveryUnitIsTested) {
  Outcome outcome = run_program(
      {"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_tests.py", ANICODEC_SOURCE_DIR});
  EXPECT_EQ(outcome.status, 0) << outcome;
}

TEST(Layering, FindsUnitsWithoutATest) {
  TemporaryFolder folder;
  for (const char* source :
       {"codec/attic/own.cpp", "codec/attic/included.cpp", "codec/attic/bare.cpp"})
    folder.write(source, "");
  folder.write("tests/codec/attic/own_test.cpp", "#include \"codec/attic/included.h\"\n");
  Outcome outcome =
      run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_tests.py", folder / ""});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out,
              HasSubstr("codec/attic/bare has no test: add tests/codec/attic/bare_test.cpp"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("attic/own has")));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("attic/included has")));
}

TEST(Layering, FindsSuitesInTheFilesOfOtherUnits) {
  TemporaryFolder folder;
  for (const char* source : {"codec/attic/own.h", "codec/attic/other_unit.h"})
    folder.write(source, "");
  folder.write("tests/codec/attic/own_test.cpp",
               "TEST(Own, Works) {}\nTEST(OtherUnit, Works) {}\n");
  Outcome outcome =
      run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_tests.py", folder / ""});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("own_test.cpp has OtherUnit, the suite of another unit"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("has Own,")));
}

TEST(Formatting, IsThatOfClangFormat) {
  Outcome outcome = run_program(
      {"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_format.py", ANICODEC_SOURCE_DIR});
  if (outcome.status == 77)
    GTEST_SKIP() << outcome.out;
  EXPECT_EQ(outcome.status, 0) << outcome;
}

TEST(Formatting, NamesFilesThatDiffer) {
  TemporaryFolder folder;
  folder.write(".clang-format", "BasedOnStyle: Google\n");
  folder.write("codec/attic/wide.cpp", "int  width ;\n");
  folder.write("codec/attic/narrow.cpp", "int width;\n");
  Outcome outcome =
      run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_format.py", folder / ""});
  if (outcome.status == 77)
    GTEST_SKIP() << outcome.out;
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("codec/attic/wide.cpp is not formatted"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("narrow")));
}

TEST(Documents, PointToWhatExists) {
  Outcome outcome = run_program(
      {"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_links.py", ANICODEC_SOURCE_DIR});
  EXPECT_EQ(outcome.status, 0) << outcome;
}

// Pages of docs/howto/ run it on their own tables.
TEST(Documents, NameAllFilesThatTheirTablesAreAbout) {
  TemporaryFolder folder;
  folder.write("codec/named.cpp", "Kind::kNew\n");
  folder.write("codec/missed.cpp", "Kind::kNew\n");
  folder.write("codec/old.cpp", "Kind::kept\n");
  folder.write("docs/page.md",
               "`codec/missed.cpp`\n\n| `codec/named.cpp`, `codec/old.cpp` | x |\n");
  const Outcome outcome =
      run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_places.py", "--at",
                   folder / "", "docs/page.md", "Kind::k[A-Z]", "codec"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out,
            "docs/page.md does not name codec/missed.cpp\n"
            "codec/old.cpp, named by docs/page.md, has no Kind::k[A-Z]\n");
}

TEST(Documents, ShowARangeCodedStreamAsTheirTextDecodesIt) {
  Outcome outcome = run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/range_coder.py",
                                 "check", ANICODEC_SOURCE_DIR "/spec/A-examples.md"});
  EXPECT_EQ(outcome.status, 0) << outcome;
}

TEST(Documents, ShowNumbersAsTheirTextWorksThemOut) {
  Outcome outcome = run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/check_numbers.py",
                                 ANICODEC_SOURCE_DIR "/spec/09-reconstruction.md",
                                 ANICODEC_SOURCE_DIR "/spec/09b-reference-pose.md",
                                 ANICODEC_SOURCE_DIR "/spec/09d-exact-positions.md"});
  EXPECT_EQ(outcome.status, 0) << outcome;
}

}  // namespace
}  // namespace anicodec::tools
