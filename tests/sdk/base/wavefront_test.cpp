// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/base/wavefront.h"

#include "tests/sdk/threads.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// A host that calls everything in turn, on its own thread, last task first.
HostThreads one_after_the_other() {
  HostThreads threads;
  threads.run = [](void*, size_t count, void (*body)(void*, size_t), void* context) {
    while (count-- > 0)
      body(context, count);
  };
  return threads;
}

/// Runs a wavefront that checks on its way that what a range depends on is done.
void expect_order(uint32_t lanes, uint32_t rows, uint32_t columns, uint32_t grain,
                  const HostThreads& threads) {
  std::vector<std::atomic<uint32_t>> done(rows);
  std::atomic<uint32_t> faults{0};
  const auto work = [&](uint32_t row, uint32_t first, uint32_t last) {
    faults += done[row].load() != first || last <= first || last > columns;
    faults += row > 0 && done[row - 1].load() < last;
    faults += row >= lanes && done[row - lanes].load() < columns;
    done[row] = last;
    return true;
  };
  EXPECT_TRUE(Wavefront(lanes, rows, columns, grain, work).run(threads));
  EXPECT_EQ(faults, 0U);
  for (const auto& row : done)
    EXPECT_EQ(row, columns);
}

TEST(Wavefront, KeepsRowsBehindOneAnother) {
  for (const HostThreads& threads : {HostThreads(), one_after_the_other(), three_threads()})
    for (const uint32_t lanes : {1U, 2U, 4U, 8U})
      for (const uint32_t rows : {1U, 2U, 7U, 40U})
        for (const uint32_t columns : {1U, 16U, 1000U})
          expect_order(lanes, rows, columns, 16, threads);
}

TEST(Wavefront, EndsWhenTheWorkSaysSo) {
  for (const HostThreads& threads : {HostThreads(), one_after_the_other(), three_threads()}) {
    std::atomic<uint32_t> calls{0};
    const auto work = [&](uint32_t row, uint32_t first, uint32_t) {
      ++calls;
      return !(row == 3 && first == 20);
    };
    EXPECT_FALSE(Wavefront(4, 40, 100, 10, work).run(threads));
    EXPECT_LT(calls, 200U);
  }
}

TEST(Wavefront, RunsRowsAtTheSameTime) {
  // Two threads that meet: the first row waits in its second range until the second row began.
  HostThreads two;
  two.run = [](void*, size_t count, void (*body)(void*, size_t), void* context) {
    std::vector<std::thread> team;
    for (size_t i = 0; i < count; ++i)
      team.emplace_back([=] { body(context, i); });
    for (std::thread& thread : team)
      thread.join();
  };
  std::atomic<bool> began{false};
  const auto work = [&](uint32_t row, uint32_t first, uint32_t) {
    if (row == 1)
      began = true;
    while (row == 0 && first == 10 && !began)
      std::this_thread::yield();
    return true;
  };
  EXPECT_TRUE(Wavefront(2, 2, 20, 10, work).run(two));
}

}  // namespace
}  // namespace anicodec
