// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PARALLEL_THREAD_COUNT_H_
#define ANICODEC_CODEC_PARALLEL_THREAD_COUNT_H_

#include <cstddef>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace anicodec {

/// How many threads work here, this one among them.
inline size_t thread_count() {
  return static_cast<size_t>(tbb::this_task_arena::max_concurrency());
}

/// Calls work() with this many threads, or with all if 0. Throws what it throws.
template <class Work>
void with_threads(size_t threads, const Work& work) {
  tbb::task_arena arena(threads > 0 ? static_cast<int>(threads) : tbb::task_arena::automatic);
  arena.execute(work);
}

/// While it lives, the process works with at most this many threads, or as before if 0.
class ThreadLimit {
 public:
  explicit ThreadLimit(size_t threads)
      : control_(kMost, threads > 0 ? threads : tbb::global_control::active_value(kMost)) {}

 private:
  static constexpr tbb::global_control::parameter kMost =
      tbb::global_control::max_allowed_parallelism;
  tbb::global_control control_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PARALLEL_THREAD_COUNT_H_
