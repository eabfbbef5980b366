// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/bench/play_peers.h"

#include "sdk/play/play.h"

#include <string_view>

namespace anicodec::bench {

const PlayPeers* play_peers() {
#if defined(__x86_64__)
  if (play_kernels_name() == std::string_view("avx512") && __builtin_cpu_supports("avx512dq"))
    return &kPlayPeers512;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    return nullptr;
#endif
  return &kPlayPeers256;
}

}  // namespace anicodec::bench
