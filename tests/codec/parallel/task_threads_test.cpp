// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/parallel/task_threads.h"

#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(TaskThreads, WorkOnEveryRangeOnce) {
  std::vector<int> times(1000, 0);
  for_ranges(task_threads(), times.size(), 7, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i)
      ++times[i];
  });
  EXPECT_EQ(times, std::vector<int>(1000, 1));
}

}  // namespace
}  // namespace anicodec
