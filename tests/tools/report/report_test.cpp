// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/report/report.h"

#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/write_sequence.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Report, NeedsNothingButABrowser) {
  TemporaryFolder folder;
  write_sequence(folder / "limb.pc2", corpus::make_clip("limb"));
  Outcome outcome =
      anicodec({"analyze", folder / "limb.obj", folder / "limb.pc2", "--counts", "2,8", "--effort",
                "fast", "--full", "-o", folder / "r.html", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  std::string page = folder.read("r.html");
  const size_t player = page.find("<iframe");
  ASSERT_NE(player, std::string::npos);
  page.erase(player, page.find("</iframe>") - player);  // the viewer, which can open addresses
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(page, Not(HasSubstr("Nothing to draw")));
  const nlohmann::json json = outcome.json();
  EXPECT_EQ(json["frames"], 72);
  EXPECT_THAT(page, HasSubstr("Draco, every frame"));
  uint64_t shares = 0;
  for (const auto& [what, bytes] : json["shares"].items())
    shares += bytes.get<uint64_t>();
  EXPECT_EQ(json["shown_bytes"], shares);
  EXPECT_EQ(json["frame_errors"].size(), 72U);
  EXPECT_THAT(page, HasSubstr("Shape spaces"));
  ASSERT_EQ(json["shape_spaces"].size(), 6U);
  EXPECT_EQ(json["shape_spaces"][3]["space"], "edges");
  EXPECT_LT(json["shape_spaces"][3]["kg"], json["shape_spaces"][2]["kg"]);
  double before = 0;
  for (const auto& point : json["rates"]) {
    if (point["codec"] != "anicodec")
      continue;
    EXPECT_GT(point["bytes"], before);
    before = point["bytes"];
  }
  EXPECT_GT(before, 0);
}

TEST(Report, IsQuickUnlessInFull) {
  ReportOptions options;
  const Report report = make_report(corpus::make_clip("limb"), options);
  EXPECT_EQ(report.rates.size(), 2U);
  const std::string page = report_page(report);
  EXPECT_THAT(page, HasSubstr("--full"));
  EXPECT_THAT(page, HasSubstr("Where the bytes went"));
  EXPECT_THAT(page, Not(HasSubstr("Shape spaces")));
}

TEST(Report, HasThePlayerAsItIs) {
  Report report = make_report(corpus::make_clip("one_frame"), {});
  report.player = "<p title='a'>\n&amp;\t</p>";
  EXPECT_THAT(report_page(report),
              HasSubstr("srcdoc=\"&lt;p title=&#39;a&#39;&gt;\n&amp;amp;\t&lt;/p&gt;\""));
}

TEST(Report, TakesClipsWithoutFacesOrMotion) {
  for (const char* name : {"points", "one_frame", "one_vertex"}) {
    MeshSequence clip = corpus::make_clip(name);
    clip.name = "<b>";
    ReportOptions options;
    options.full = true;
    options.counts = {1};
    const std::string page = report_page(make_report(clip, options));
    EXPECT_THAT(page, HasSubstr("&lt;b&gt;")) << name;
    EXPECT_THAT(page, HasSubstr("</html>")) << name;
  }
}

}  // namespace
}  // namespace anicodec::tools
