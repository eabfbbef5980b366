// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PARALLEL_TASK_THREADS_H_
#define ANICODEC_CODEC_PARALLEL_TASK_THREADS_H_

#include "codec/parallel/parallel.h"
#include "sdk/base/parallel_for.h"

#include <cstddef>

namespace anicodec {

/// The threads of the encoder as those of a decoder's host.
inline HostThreads task_threads() {
  HostThreads threads;
  threads.run = [](void*, size_t count, void (*body)(void*, size_t), void* context) {
    parallel_for(size_t{0}, count, [=](size_t i) { body(context, i); });
  };
  return threads;
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PARALLEL_TASK_THREADS_H_
