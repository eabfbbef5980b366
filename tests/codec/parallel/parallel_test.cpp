// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/parallel/parallel.h"

#include "codec/parallel/thread_count.h"

#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

TEST(Parallel, RunsEveryBodyOnce) {
  std::vector<int> calls(1000, 0);
  parallel_for(0, 1000, [&](int i) { ++calls[static_cast<size_t>(i)]; });
  parallel_tasks(calls.size(), [&](size_t i) { ++calls[i]; });
  parallel_invoke([&] { ++calls[0]; }, [&] { ++calls[1]; });
  EXPECT_EQ(calls[0] + calls[1], 6);
  calls[0] = calls[1] = 2;
  EXPECT_EQ(calls, std::vector<int>(1000, 2));
}

TEST(Parallel, TellsWhatABodyThrows) {
  for (const size_t threads : {1, 4}) {
    with_threads(threads, [] {
      EXPECT_THROW(parallel_for(0, 100, [](int) { throw std::out_of_range("a"); }),
                   std::out_of_range);
      EXPECT_THROW(parallel_tasks(9, [](size_t) { throw std::out_of_range("a"); }),
                   std::out_of_range);
      EXPECT_THROW(parallel_invoke([] { throw std::out_of_range("a"); }, [] {}), std::out_of_range);
    });
  }
}

/// Both results, or an exception: never one that was not made.
void check_results() {
  std::unique_ptr<int> one, other;
  isolated([&] {
    parallel_invoke([&] { one = std::make_unique<int>(1); },
                    [&] { other = std::make_unique<int>(2); });
  });
  ASSERT_TRUE(one && other);
  std::vector<int> made(100);
  parallel_for(size_t{0}, made.size(), [&](size_t i) { made[i] = 1; });
  ASSERT_EQ(made, std::vector<int>(100, 1));
}

TEST(Parallel, NoResultIsReadThatAFailureElsewhereKeptFromBeingMade) {
  for (const size_t threads : {1, 2, 4}) {
    with_threads(threads, [] {
      for (int run = 0; run < 100; ++run) {
        std::atomic<bool> begun = false;
        EXPECT_THROW(parallel_tasks(8,
                                    [&](size_t i) {
                                      if (i == 4) {  // what another thread takes first
                                        for (int wait = 0; wait < 1000 && !begun; ++wait)
                                          std::this_thread::yield();
                                        throw std::out_of_range("a trial");
                                      }
                                      begun = true;
                                      for (int more = 0; more < 50; ++more)
                                        check_results();
                                    }),
                     std::out_of_range);
      }
    });
  }
}

TEST(Parallel, LimitsTheThreads) {
  with_threads(3, [] { EXPECT_EQ(thread_count(), 3U); });
  EXPECT_THROW(with_threads(2, [] { throw std::out_of_range("a"); }), std::out_of_range);
  const auto limit = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const size_t before = limit();
  const ThreadLimit as_before(0);
  EXPECT_EQ(limit(), before);
  const ThreadLimit one(1);
  EXPECT_EQ(limit(), 1U);
}

}  // namespace
}  // namespace anicodec
