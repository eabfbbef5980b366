// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_SDK_THREADS_H_
#define ANICODEC_TESTS_SDK_THREADS_H_

#include "sdk/base/parallel_for.h"

#include <cstdint>
#include <thread>
#include <vector>

namespace anicodec {

/// A host that deals tasks out to three threads, last task first.
inline HostThreads three_threads() {
  HostThreads threads;
  threads.run = [](void*, size_t count, void (*body)(void*, size_t), void* context) {
    std::vector<std::thread> team;
    for (size_t t = 0; t < 3; ++t) {
      team.emplace_back([=] {
        for (size_t i = count; i-- > 0;) {
          if (i % 3 == t)
            body(context, i);
        }
      });
    }
    for (std::thread& thread : team)
      thread.join();
  };
  return threads;
}

/// Calls work(t) for every t below count, each in a thread, and waits for all.
template <typename Work>
void in_threads(uint32_t count, const Work& work) {
  std::vector<std::thread> threads;
  for (uint32_t t = 0; t < count; ++t)
    threads.emplace_back([&work, t] { work(t); });
  for (std::thread& thread : threads)
    thread.join();
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_SDK_THREADS_H_
