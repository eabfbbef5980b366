// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/write_sequence.h"
#include "tools/render/shaded_view.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class RenderCommand : public testing::Test {
 protected:
  RenderCommand() {
    write_sequence(folder_ / "limb.pc2", corpus::make_clip("limb"));
    anicodec({"encode", folder_ / "limb.obj", folder_ / "limb.pc2", "-o", folder_ / "limb.anic",
              "--kg", "1", "--effort", "fast"});
  }

  Outcome render(const std::string& output, std::vector<std::string> options) {
    std::vector<std::string> arguments = {"render",         folder_ / "limb.anic", "-o",
                                          folder_ / output, "--resolution",        "64x48"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return anicodec(arguments);
  }

  /// A big-endian number of a PNG's header.
  static uint32_t header(const std::string& png, size_t at) {
    uint32_t x = 0;
    for (size_t i = 0; i < 4; ++i)
      x = x << 8 | static_cast<uint8_t>(png[at + i]);
    return x;
  }

  TemporaryFolder folder_;
};

TEST_F(RenderCommand, DrawsAPicturePerFrame) {
  Outcome outcome = render("f_%02d.png", {"--frames", "0:6:3"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const std::string first = folder_.read("f_00.png"), second = folder_.read("f_01.png");
  EXPECT_THAT(first, StartsWith("\x89PNG"));
  EXPECT_EQ(header(first, 16), 64U);
  EXPECT_EQ(header(first, 20), 48U);
  EXPECT_NE(first, second);
}

TEST_F(RenderCommand, PutsOriginalClipAndErrorSideBySide) {
  Outcome outcome = render("x.png", {"--frames", "5", "--against", folder_ / "limb.pc2"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_EQ(header(folder_.read("x.png"), 16), 3 * 64U);
  EXPECT_THAT(outcome.out, HasSubstr("black is an error of"));
}

TEST_F(RenderCommand, MakesAnAnimation) {
  Outcome outcome = render("x.gif", {"--frames", "0:4", "--turntable"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_THAT(folder_.read("x.gif"), StartsWith("GIF89a"));
}

TEST_F(RenderCommand, MakesAPageThatHoldsTheClip) {
  const Outcome outcome = render("x.html", {"--against", folder_ / "limb.anic"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  const std::string page = folder_.read("x.html");
  EXPECT_THAT(page, StartsWith("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("data-name=\"limb.anic\""));
  EXPECT_THAT(outcome.out, HasSubstr(std::to_string(page.size()) + " bytes"));
  EXPECT_THAT(render("x.html", {}).err, HasSubstr("x.html"));  // it exists
  EXPECT_THAT(render("y.html", {"--frames", "0:2"}).err, HasSubstr("--frames: is for pictures"));
  EXPECT_THAT(render("y.html", {"--against", folder_ / "limb.pc2"}).err,
              HasSubstr("a page shows .anic files"));
}

TEST_F(RenderCommand, SaysWhatItCannotDo) {
  EXPECT_THAT(render("x.jpg", {}).err, HasSubstr("x.jpg: is of unknown kind"));
  EXPECT_THAT(render("x.png", {}).err, HasSubstr("need a pattern with a number"));
  EXPECT_THAT(render("x.gif", {"--view", "error"}).err, HasSubstr("needs --against"));
  EXPECT_EQ(render("x.gif", {"--resolution", "9x9"}).status, 1);
  EXPECT_EQ(render("x.gif", {"--camera", "0,90"}).status, 1);
  write_sequence(folder_ / "points.pc2", corpus::make_clip("points"));
  Outcome outcome = anicodec({"render", folder_ / "points.pc2", "-o", folder_ / "p.gif"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no face to draw"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "p.gif"));
}

}  // namespace
}  // namespace anicodec::tools
