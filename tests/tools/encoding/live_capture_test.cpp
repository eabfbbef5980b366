// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Captures that are encoded while they go on.
#include "tests/tools/command_testing.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

class LiveCapture : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(anicodec({"corpus", "limb", "-q", "-o", at("limb.pc2"), "--vertices", "100",
                        "--frame-count", "25"})
                  .status,
              0);
    const std::string cache = folder_.read("limb.pc2");
    folder_.write("frames", cache.substr(32));  // behind the header
  }

  std::string at(const std::string& name) { return folder_ / name; }

  /// Encodes the first bytes of the frames that the shell writes.
  Outcome encode(const std::string& input, const std::string& more = "-o live.anic") {
    return run_program(
        {"sh", "-c",
         "cd " + at(".") + "; " + input +
             " | " ANICODEC_COMMAND " encode --live limb.obj --fps 10 --effort fast " + more});
  }

  TemporaryFolder folder_;
};

TEST_F(LiveCapture, WritesAStreamThatCommandsTakeForAClip) {
  const Outcome outcome = encode("cat frames");
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("2.00 s: 5 frames"));
  const auto bytes = static_cast<double>(std::filesystem::file_size(at("live.anic")));
  EXPECT_THAT(outcome.err, HasSubstr(fmt::format(" bytes, {:.1f} kbit/s", 8e-3 * bytes / 2.5)));
  const nlohmann::json info = anicodec({"info", at("live.anic"), "--json"}).json();
  EXPECT_EQ(info["clips"][0]["frames"], 25);
  EXPECT_EQ(anicodec({"verify", at("live.anic")}).status, 0);
  const Outcome compared =
      anicodec({"compare", at("limb.pc2"), at("live.anic"), "--no-sted", "--json"});
  EXPECT_LT(compared.json()["max_error_percent"], 0.06) << compared;
  ASSERT_EQ(anicodec({"join", at("live.anic"), "-o", at("clip.anic"), "-q"}).status, 0);
  EXPECT_EQ(anicodec({"info", at("clip.anic"), "--json"}).json()["clips"], info["clips"]);
  EXPECT_LT(std::filesystem::file_size(at("clip.anic")),
            std::filesystem::file_size(at("live.anic")));
}

TEST_F(LiveCapture, LeavesWhatIsThereWhereTheInputEnds) {
  const Outcome outcome = encode("head -c 20000 frames");  // 17 frames and a bit
  EXPECT_EQ(outcome.status, 2) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("ends inside a frame"));
  EXPECT_EQ(anicodec({"info", at("live.anic"), "--json"}).json()["clips"][0]["frames"], 17);
  // The file of a capture that was killed.
  const Outcome cut = encode("cat frames", "-o cut.anic -q");
  ASSERT_EQ(cut.status, 0);
  EXPECT_EQ(cut.err, "");
  std::filesystem::resize_file(at("cut.anic"), std::filesystem::file_size(at("cut.anic")) - 5);
  const Outcome info = anicodec({"info", at("cut.anic"), "--json"});
  EXPECT_EQ(info.json()["clips"][0]["frames"], 20);
  EXPECT_THAT(info.err, HasSubstr("not complete"));
}

TEST_F(LiveCapture, BeginsAnewAsOftenAsAskedFor) {
  ASSERT_EQ(encode("cat frames").status, 0);
  ASSERT_EQ(encode("cat frames", "-o anew.anic --key-every 0").status, 0);
  EXPECT_EQ(anicodec({"info", at("live.anic"), "--json"}).json()["features"],
            nlohmann::json({"learning"}));
  EXPECT_EQ(anicodec({"info", at("anew.anic"), "--json"}).json()["features"],
            nlohmann::json::array());
  EXPECT_LT(std::filesystem::file_size(at("live.anic")),
            std::filesystem::file_size(at("anew.anic")));
}

TEST_F(LiveCapture, SaysWhatAPercentageIs) {
  const Outcome first = encode("cat frames", "-o first.anic --max-error 0.1%");
  const nlohmann::json asked = anicodec({"info", at("first.anic"), "--json"}).json()["asked"];
  EXPECT_EQ(asked["metric"], "max_error");
  EXPECT_THAT(first.err, HasSubstr(fmt::format("0.1 % is {:.4g}, of the diagonal",
                                               asked["value"].get<double>())));
  const Outcome given = encode("cat frames", "-o given.anic --max-error 0.1% --box 5");
  EXPECT_THAT(given.err, Not(HasSubstr("of the diagonal")));
  EXPECT_NEAR(anicodec({"info", at("given.anic"), "--json"}).json()["asked"]["value"].get<double>(),
              0.005, 1e-12);
  EXPECT_EQ(encode("cat frames", "-o none.anic --box 5%").status, 1);
  EXPECT_EQ(encode("cat frames", "-o none.anic --box 0").status, 1);
}

TEST_F(LiveCapture, ListsItsFilesAndNamesALostOne) {
  ASSERT_EQ(encode("cat frames", "-o live.anic --piece 0.5 --key-every 1 -q").status, 0);
  const nlohmann::json files =
      anicodec({"info", at("live.anic"), "--json"}).json()["stream"]["files"];
  ASSERT_EQ(files.size(), 5U);
  std::string stream = folder_.read("live.anic"), bytes;
  for (size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(files[i]["has_mesh"], i == 0);
    EXPECT_EQ(files[i]["key"], i % 2 == 0);
    EXPECT_EQ(files[i]["plays"], true);
    EXPECT_EQ(files[i]["offset"], bytes.size());
    EXPECT_EQ(files[i]["start_time"], 0.5 * static_cast<double>(i));
    bytes += stream.substr(files[i]["offset"], files[i]["bytes"]);
  }
  EXPECT_EQ(bytes, stream);
  EXPECT_THAT(anicodec({"verify", at("live.anic")}).out,
              HasSubstr("5 files of a live stream, 3 of which begin anew, 25 frames"));
  const Outcome dump = anicodec({"dump", at("live.anic")});
  EXPECT_EQ(dump.status, 0) << dump;
  EXPECT_THAT(dump.out, HasSubstr("a continuation"));
  EXPECT_THAT(dump.out, HasSubstr("SEGM field 1"));

  const auto without = [&](size_t lost) {
    std::string rest = stream;
    folder_.write("lost.anic", rest.erase(files[lost]["offset"], files[lost]["bytes"]));
  };
  without(2);
  Outcome lost = anicodec({"verify", at("lost.anic")});
  EXPECT_EQ(lost.status, 3);
  EXPECT_THAT(lost.err, HasSubstr("1.00 s to 2.00 s: a file continues one that was lost"));
  lost = anicodec({"info", at("lost.anic"), "--json"});
  EXPECT_EQ(lost.status, 3);
  EXPECT_EQ(
      nlohmann::json::parse(lost.out.substr(0, lost.out.find('\n')))["stream"]["files"][2]["plays"],
      false);
  EXPECT_EQ(anicodec({"dump", at("lost.anic")}).status, 0);
  EXPECT_THAT(anicodec({"info", at("lost.anic")}).out, HasSubstr("continues a lost one"));
  lost = anicodec({"join", at("lost.anic"), "-o", at("clip.anic")});
  EXPECT_NE(lost.status, 0);
  EXPECT_THAT(lost.err, HasSubstr("lost.anic, file 3"));
  without(1);
  lost = anicodec({"verify", at("lost.anic")});
  EXPECT_THAT(lost.err, HasSubstr("0.50 s to 1.00 s: a file was lost"));
}

TEST_F(LiveCapture, RefusesWhatItCannotDo) {
  EXPECT_EQ(encode("cat frames").status, 0);
  EXPECT_EQ(encode("cat frames").status, 1);  // the output is there
  EXPECT_EQ(encode("true", "-o none.anic").status, 2);
  const std::string before = folder_.read("live.anic");
  EXPECT_EQ(encode("true", "-o live.anic -f").status, 2);
  EXPECT_EQ(folder_.read("live.anic"), before);
  EXPECT_EQ(encode("cat frames", "-o full.anic --size 5k").status, 1);
  EXPECT_EQ(encode("cat frames", "-o loop.anic --loop").status, 1);
  EXPECT_NE(encode("cat frames", "-o /dev/full -f").status, 0);
  const Outcome bad = encode("(head -c 16000 frames; head -c 16000 /dev/zero | tr '\\0' '\\377')",
                             "-o nan.anic -q");
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("frame 13"));
}

TEST_F(LiveCapture, WritesToAPipe) {
  const Outcome outcome = encode("cat frames", "-o - -q | " ANICODEC_COMMAND " info - --json");
  EXPECT_EQ(outcome.json()["clips"][0]["frames"], 25) << outcome;
}

}  // namespace
}  // namespace anicodec::tools
