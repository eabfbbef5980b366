// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Rows that follow one another, each a little behind the one before, on as many threads as a host
// lends.
#ifndef ANICODEC_SDK_BASE_WAVEFRONT_H_
#define ANICODEC_SDK_BASE_WAVEFRONT_H_

#include "sdk/base/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>

namespace anicodec {

/// Calls work(row, first, last) for ranges of the columns of every row. A range comes after the ranges
/// before it of its row, after the same columns of the row before, and after all of the row `lanes`
/// before. So rows of different lanes run at the same time, and what is done in them does not depend
/// on threads. work() returns false to end all.
///
/// No thread waits for one that does not run: a host may call one after the other what it is given.
template <class Work>
class Wavefront {
 public:
  static constexpr uint32_t kMostLanes = 8;

  /// @pre 0 < lanes <= kMostLanes, columns > 0
  Wavefront(uint32_t lanes, uint32_t rows, uint32_t columns, uint32_t grain, const Work& work)
      : lanes_(lanes),
        rows_(rows),
        columns_(columns),
        grain_(grain),
        ranges_((columns + grain - 1) / grain),
        work_(work) {}

  /// False if the work ended early.
  bool run(const HostThreads& threads) {
    const uint32_t workers = std::min(lanes_, rows_);
    if (!threads.run || workers < 2 || ranges_ < 2)
      follow(0);
    else
      threads.run(
          threads.host, workers,
          [](void* self, size_t i) { static_cast<Wavefront*>(self)->follow(i); }, this);
    return !stopped_.load(std::memory_order_acquire);
  }

 private:
  /// Takes whatever range is next in a lane that nobody is in, until nothing is left.
  void follow(size_t lane) {
    while (!stopped_.load(std::memory_order_acquire)) {
      bool left = false, moved = false;
      for (uint32_t i = 0; i < lanes_; ++i, lane = lane + 1 < lanes_ ? lane + 1 : 0) {
        const uint64_t done = done_[lane].load(std::memory_order_acquire);
        if (!is_left(lane, done))
          continue;
        left = true;
        if (!is_ready(lane, done) || busy_[lane].exchange(true, std::memory_order_acquire))
          continue;
        moved = advance(lane);
        busy_[lane].store(false, std::memory_order_release);
        break;
      }
      if (!left)
        return;
      if (!moved)
        std::this_thread::yield();  // somebody is in the lane that all others wait for
    }
  }

  /// Works in a lane as far as it goes.
  bool advance(size_t lane) {
    uint64_t done = done_[lane].load(std::memory_order_acquire);
    bool moved = false;
    while (is_left(lane, done) && is_ready(lane, done)) {
      const auto first = static_cast<uint32_t>(done % ranges_) * grain_;
      if (!work_(row_of(lane, done), first, std::min(columns_, first + grain_))) {
        stopped_.store(true, std::memory_order_release);
        return true;
      }
      done_[lane].store(++done, std::memory_order_release);
      moved = true;
    }
    return moved;
  }

  uint32_t row_of(size_t lane, uint64_t done) const {
    return static_cast<uint32_t>(lane + done / ranges_ * lanes_);
  }

  bool is_left(size_t lane, uint64_t done) const {
    return lane + done / ranges_ * lanes_ < rows_;
  }

  /// Whether the row before has the next range of a lane done.
  bool is_ready(size_t lane, uint64_t done) const {
    const uint32_t row = row_of(lane, done);
    if (row == 0 || lanes_ == 1)
      return true;
    const uint64_t needed = uint64_t{row - 1} / lanes_ * ranges_ + done % ranges_ + 1;
    return done_[(row - 1) % lanes_].load(std::memory_order_acquire) >= needed;
  }

  uint32_t lanes_, rows_, columns_, grain_, ranges_;
  const Work& work_;
  std::atomic<uint64_t> done_[kMostLanes] = {};  ///< ranges, by lane
  std::atomic<bool> busy_[kMostLanes] = {};
  std::atomic<bool> stopped_{false};
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_WAVEFRONT_H_
