// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips that come to a file and leave it, events, and the motion of the whole, on the command line.
#include "tests/tools/command_testing.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

class AddCommand : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"walk", "run"})
      ASSERT_EQ(anicodec({"corpus", "limb", "-q", "-o", at(name) + ".pc2", "--vertices", "100",
                          "--frame-count", "10"})
                    .status,
                0);
    ASSERT_EQ(
        anicodec({"encode", at("walk.obj"), at("walk.pc2"), "-q", "-o", at("hero.anic"), "--fps",
                  "10", "--kg", "0.5", "--effort", "fast", "--event", "left=0.2", "--root-motion"})
            .status,
        0);
  }

  std::string at(const std::string& name) { return folder_ / name; }

  Outcome add(std::vector<std::string> more = {}) {
    more.insert(more.begin(),
                {"add", at("hero.anic"), at("run.obj"), at("run.pc2"), "--effort", "fast"});
    return anicodec(more);
  }

  TemporaryFolder folder_;
};

TEST_F(AddCommand, AddsAClipAndTakesItOutAgain) {
  const Outcome before = anicodec({"info", at("hero.anic"), "--json"});
  EXPECT_EQ(before.json()["clips"][0]["events"][0]["name"], "left");
  ASSERT_EQ(add({"--event", "jump=0.3"}).status, 0);
  const nlohmann::json both = anicodec({"info", at("hero.anic"), "--json"}).json();
  ASSERT_EQ(both["clips"].size(), 2U);
  EXPECT_EQ(both["clips"][1]["name"], "run");
  EXPECT_EQ(both["clips"][1]["events"][0]["seconds"], 0.3);
  EXPECT_THAT(anicodec({"info", at("hero.anic")}).out, testing::HasSubstr("events     jump 0.3 s"));
  EXPECT_EQ(both["clips"][1]["asked"]["value"], 0.5);
  EXPECT_EQ(anicodec({"verify", at("hero.anic")}).status, 0);
  EXPECT_EQ(
      anicodec({"compare", at("run.pc2"), at("hero.anic"), "--clip-b", "run", "--no-sted"}).status,
      0);
  ASSERT_EQ(anicodec({"remove", at("hero.anic"), "run"}).status, 0);
  EXPECT_EQ(anicodec({"info", at("hero.anic"), "--json"}).out, before.out);
}

TEST_F(AddCommand, SaysWhatItLeavesOut) {
  const Outcome seen = add({"--meta", "author=somebody"});
  EXPECT_EQ(seen.status, 0);
  EXPECT_THAT(seen.err,
              HasSubstr("run.obj: leaves out chunk META: only that of the first file is kept\n"));
}

TEST_F(AddCommand, RefusesInOneLineAndWritesNothing) {
  ASSERT_EQ(add().status, 0);
  const std::string before = anicodec({"info", at("hero.anic"), "--json"}).out;
  EXPECT_THAT(add().err, HasSubstr("has a clip 'run' already"));
  EXPECT_THAT(anicodec({"remove", at("hero.anic"), "fly"}).err, HasSubstr("has no clip 'fly'"));
  EXPECT_THAT(anicodec({"remove", at("hero.anic"), "run", "walk"}).err, HasSubstr("the last clip"));
  EXPECT_THAT(anicodec({"remove", at("hero.anic")}).err, HasSubstr("NAME are required"));
  EXPECT_EQ(anicodec({"corpus", "quad_box", "-q", "-o", at("box.pc2")}).status, 0);
  const Outcome other = anicodec({"add", at("hero.anic"), at("box.obj"), at("box.pc2")});
  EXPECT_EQ(other.status, 2) << other;
  EXPECT_THAT(other.err, HasSubstr("another connectivity"));
  EXPECT_EQ(anicodec({"info", at("hero.anic"), "--json"}).out, before);
  for (const char* event : {"left", "left=x", "=1", "left=-1", "left=99"})
    EXPECT_EQ(
        anicodec({"encode", at("walk.obj"), at("walk.pc2"), "-o", at("no.anic"), "--event", event})
            .status,
        1)
        << event;
}

}  // namespace
}  // namespace anicodec::tools
