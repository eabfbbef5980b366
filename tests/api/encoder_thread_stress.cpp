// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Threads that encode at the same time, each by threads of its own: for ThreadSanitizer, as thread_stress. The files are
// the same, byte for byte.
//
//   ninja -C build/tsan encoder_thread_stress
//   LD_LIBRARY_PATH=FOLDER build/tsan/tests/encoder_thread_stress
// FOLDER has a libtbb.so.12 that was compiled by clang with -fsanitize=thread, of Debian's sources (apt-get source onetbb;
// -DTBB_STRICT=OFF). With that of the system thousands of races are reported: its waiting is not seen.
#include "tests/sdk/threads.h"

#include <anicodec/encode.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace anicodec;

namespace {

constexpr uint32_t kThreads = 4;

void require(bool condition) {
  if (!condition)
    std::abort();
}

/// A scene, and options to encode it by.
struct Job {
  uint64_t flags = 0;
  uint32_t meshes = 1;  ///< small ones, which an encoder takes at the same time
  anic_basis_choice basis = ANIC_CHOOSE_SMALLEST;
};

/// The bytes that it becomes.
std::vector<uint8_t> encode(uint32_t threads, const Job& job) {
  constexpr uint32_t kSide = 8, kFrames = 10;
  std::vector<uint32_t> corners;
  for (uint32_t v = 0; v + kSide + 1 < kSide * kSide; ++v)
    corners.insert(corners.end(), {v, v + 1, v + kSide, v + 1, v + kSide + 1, v + kSide});
  std::vector<float> positions;
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (uint32_t v = 0; v < kSide * kSide; ++v) {
      const auto x = static_cast<float>(v % kSide), y = static_cast<float>(v / kSide),
                 t = static_cast<float>(f);
      positions.insert(positions.end(),
                       {x + std::sin(t + y), y + std::cos(t * x), std::sin(0.3F * t * x)});
    }
  }
  anic_encoder* encoder = nullptr;
  require(anic_create_encoder(&encoder) == ANIC_OK);
  anic_source_clip clip = ANIC_INIT(anic_source_clip);
  clip.frame_count = kFrames;
  require(anic_set_source_clip(encoder, &clip) == ANIC_OK);
  anic_source_mesh mesh = ANIC_INIT(anic_source_mesh);
  mesh.vertex_count = kSide * kSide;
  mesh.polygon_count = static_cast<uint32_t>(corners.size() / 3);
  mesh.corners = corners.data();
  mesh.positions = positions.data();
  for (uint32_t m = 0; m < job.meshes; ++m) {
    require(anic_add_source_mesh(encoder, &mesh, nullptr) == ANIC_OK);
  }
  anic_encode_options options = ANIC_INIT(anic_encode_options);
  options.threads = threads;
  options.flags = job.flags;
  options.basis = job.basis;
  anic_encoding result = ANIC_INIT(anic_encoding);
  require(anic_encode(encoder, &options, &result) == ANIC_OK);
  const auto* bytes = static_cast<const uint8_t*>(result.file);
  std::vector<uint8_t> file(bytes, bytes + result.size);
  anic_destroy_encoder(encoder);
  return file;
}

void encode_together() {
  const Job jobs[] = {{},
                      {ANIC_ENCODE_LOSSLESS},
                      {ANIC_ENCODE_ROOT_MOTION},
                      {0, 12},
                      {0, 1, ANIC_CHOOSE_KEYFRAMES}};
  for (const Job& job : jobs) {
    const std::vector<uint8_t> expected = encode(1, job);
    in_threads(kThreads, [&](uint32_t t) { require(encode(1 + t % 3, job) == expected); });
  }
}

}  // namespace

int main() {
  encode_together();
  std::printf("the same files by %u threads\n", kThreads);
}
