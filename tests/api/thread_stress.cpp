// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Threads that play one asset together, and open and play others at the same time: for ThreadSanitizer, under which this
// program ends with a report and another status where two of them meet.
//
// usage: thread_stress FOLDER [ROUNDS]      a folder of .anic files, as tests/conformance; 1 round unless told
//   cmake --preset tsan && ninja -C build/tsan thread_stress && build/tsan/tests/thread_stress tests/conformance
#include "tests/fuzz/fuzz_asset.h"
#include "tests/random.h"
#include "tests/sdk/threads.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace anicodec;

namespace {

constexpr uint32_t kThreads = 4;

Bytes decisions(uint32_t seed) {
  Random random(seed);
  Bytes bytes(256);
  for (uint8_t& byte : bytes)
    byte = static_cast<uint8_t>(random());
  return bytes;
}

/// Plays an asset that others play, too.
void play(const anic_asset* asset, uint32_t seed) {
  const Bytes bytes = decisions(seed);
  CappedMemory nothing;
  const Script script(bytes.data(), bytes.size());
  sample(asset, &nothing, script);
  look(asset, script);
}

void open_and_play(const Bytes& file, uint32_t seed) {
  anic_asset* shared = nullptr;
  if (anic_open_asset(file.data(), file.size(), nullptr, &shared, nullptr) != ANIC_OK)
    return;
  in_threads(kThreads, [&](uint32_t t) {
    play(shared, seed + t);
    anic_options options = ANIC_INIT(anic_options);
    options.flags = t % 2 == 0 ? ANIC_OPEN_BOUNDS : 0;
    options.threads.run = three_threads().run;
    anic_asset* own = nullptr;
    require(anic_open_asset(file.data(), file.size(), &options, &own, nullptr) == ANIC_OK);
    require(anic_verify_asset(own) == anic_verify_asset(shared));
    play(own, seed);
    anic_close_asset(own);
  });
  anic_close_asset(shared);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: thread_stress FOLDER [ROUNDS]\n");
    return 2;
  }
  uint32_t opened = 0;
  for (int round = argc > 2 ? std::atoi(argv[2]) : 1; round > 0; --round) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
      if (entry.path().extension() != ".anic")
        continue;
      std::ifstream in(entry.path(), std::ios::binary);
      const Bytes file{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      open_and_play(file, opened++);
    }
  }
  std::printf("%u files, by %u threads each\n", opened, kThreads);
}
