// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/write_sequence.h"

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
