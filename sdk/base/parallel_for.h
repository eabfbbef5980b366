// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_BASE_PARALLEL_FOR_H_
#define ANICODEC_SDK_BASE_PARALLEL_FOR_H_

#include <algorithm>
#include <cstddef>

namespace anicodec {

/// The host's threads, or none. `run` calls body(context, i) once for every i below count, in any
/// order and from any thread, and returns when all calls have. No result depends on it.
struct HostThreads {
  void (*run)(void* host, size_t count, void (*body)(void* context, size_t i),
              void* context) = nullptr;
  void* host = nullptr;
};

/// Calls work(first, last) for ranges of at most `grain` items that make up 0 .. count-1.
template <class Work>
void for_ranges(const HostThreads& threads, size_t count, size_t grain, const Work& work) {
  if (!threads.run || count <= grain) {
    if (count > 0)
      work(size_t{0}, count);
    return;
  }

  struct Ranges {
    const Work& work;
    size_t count, grain;
  } ranges{work, count, grain};

  threads.run(
      threads.host, (count + grain - 1) / grain,
      [](void* context, size_t i) {
        const Ranges& r = *static_cast<const Ranges*>(context);
        r.work(i * r.grain, std::min(r.count, (i + 1) * r.grain));
      },
      &ranges);
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_PARALLEL_FOR_H_
