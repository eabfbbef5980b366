// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any chunks through the opening of a file: checksums and places are repaired first, so that the
// contents of the chunks get decoded. An asset that opens plays, with finite positions, in the
// memory that the limits announce.
#include "sdk/clip/memory_estimate.h"
#include "sdk/clip/sample.h"
#include "tests/fuzz/fuzz_file.h"

#include <cmath>
#include <cstdlib>
#include <vector>

using namespace anicodec;

namespace {

void require(bool condition) {
  if (!condition)
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const Bytes file = repaired({data, size});
  OpenOptions options;
  options.limits.vertices = 20000;
  options.limits.resident_bytes = 64 << 20;
  Clip clip;
  if (!clip.open(file, options).ok())
    return 0;
  require(clip.resident_bytes() <= estimate_memory(clip.limits()).resident);
  for (uint32_t m = 0; m < clip.meshes().size(); ++m) {
    std::vector<float> frame(size_t{3} * clip.vertex_count(m));
    for (uint32_t f = 0; f < clip.frame_count() && f < 4; ++f) {
      if (show_positions(clip, m, f, frame.data()) != Status::kOk)
        continue;
      for (float x : frame)
        require(std::isfinite(x));
    }
  }
  return 0;
}
