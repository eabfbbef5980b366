// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/played_clip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(PlayedClip, CountsRunsInARange) {
  const std::vector<FrameRun> runs{{2, 3}, {10, 1}, {12, 8}};
  EXPECT_THAT(runs_in(runs, {0, 20, 1}),
              ElementsAre(FrameRun{2, 3}, FrameRun{10, 1}, FrameRun{12, 8}));
  EXPECT_THAT(runs_in(runs, {3, 13, 1}),
              ElementsAre(FrameRun{0, 2}, FrameRun{7, 1}, FrameRun{9, 1}));
  EXPECT_THAT(runs_in(runs, {5, 10, 1}), IsEmpty());
  // 1, 4, 7, 10, 13, 16, 19
  EXPECT_THAT(runs_in(runs, {1, 20, 3}), ElementsAre(FrameRun{1, 1}, FrameRun{3, 4}));
  EXPECT_THAT(runs_in(runs, {0, 20, 50}), IsEmpty());
}

TEST(PlayedClip, CountsRunsInARangeFrameByFrame) {
  const std::vector<FrameRun> runs{{1, 4}, {6, 2}, {9, 1}, {13, 7}, {31, 2}};
  for (uint32_t first = 0; first < 34; ++first) {
    for (uint32_t end = first + 1; end < 35; ++end) {
      for (uint32_t step = 1; step < 6; ++step) {
        const FrameRange range{first, end, step};
        std::vector<FrameRun> expected;
        for (uint32_t i = 0; i < range.size(); ++i) {
          const uint32_t f = first + i * step;
          for (const FrameRun& run : runs) {
            if (f < run.first || f >= run.first + run.count)
              continue;
            if (expected.empty() || expected.back().first + expected.back().count != i)
              expected.push_back({i, 0});
            ++expected.back().count;
          }
        }
        ASSERT_EQ(runs_in(runs, range), expected) << first << ":" << end << ":" << step;
      }
    }
  }
}

}  // namespace
}  // namespace anicodec::tools
