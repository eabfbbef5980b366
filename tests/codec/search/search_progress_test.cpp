// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The share of the progress is near that of the time: replays what searches told, and when.
#include "codec/search/search_progress.h"

#include "tests/codec/search/recorded_searches.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

class RecordedSearch : public testing::TestWithParam<RecordedRun> {};

TEST_P(RecordedSearch, TellsNearlyTheTruth) {
  constexpr double kFrom = 0.1;
  const RecordedRun& run = GetParam();
  double now = 0, told = 0;
  const Progress note = [&](std::string_view, double part) {
    EXPECT_GE(part, told);
    told = part;
  };
  SearchProgress progress(note, [&] { return now; });
  const auto check = [&](const char* when) {
    const double truth = 100 * now / run.end;
    if (truth >= kFrom) {
      EXPECT_NEAR(told, truth, run.off) << when << " of " << now;
    }
  };
  for (const RecordedEvent& event : run.events) {
    now = event.at / 100.0;
    check("before");
    if (event.what == 'e')
      progress.expect({event.plain, event.thorough});
    else
      progress.begin(event.what == 'p'   ? SearchStep::kTrial
                     : event.what == 't' ? SearchStep::kThoroughTrial
                                         : SearchStep::kAnalysis);
    check("after");
  }
  now = run.end / 100.0;
  check("at the end");
}

INSTANTIATE_TEST_SUITE_P(Clips, RecordedSearch, testing::ValuesIn(recorded_runs()),
                         [](const auto& run) { return std::string(run.param.name); });

TEST(SearchProgress, NeverFallsNorEndsBeforeTheSearch) {
  double now = 0, told = 0;
  const Progress note = [&](std::string_view, double part) {
    EXPECT_GE(part, told);
    EXPECT_LT(part, 1);
    told = part;
  };
  SearchProgress progress(note, [&] { return now; });
  progress.expect({10, 5});
  for (int i = 0; i < 60; ++i, now += 1 + i % 3) {
    progress.begin(i % 4 == 3 ? SearchStep::kThoroughTrial : SearchStep::kTrial);
    if (i == 30)
      progress.expect({20, 20});
  }
  EXPECT_GT(told, 0.5);
}

}  // namespace
}  // namespace anicodec
