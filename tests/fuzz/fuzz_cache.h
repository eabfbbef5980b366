// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_CACHE_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_CACHE_H_

#include "tests/fuzz/fuzz_mesh.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/formats/vertex_cache.h"

#include <cmath>

namespace anicodec::tools {

template <typename Open>
void fuzz_cache(std::string_view bytes, Open open) {
  ByteSource source = memory_source(bytes, "fuzz");
  try {
    VertexCache cache = open(source);
    std::vector<float> positions(size_t{cache.vertex_count} * cache.frame_count * 3);
    read_positions(cache, source, positions);
    for (float x : positions)
      require(std::isfinite(x));
    Timing timing = timing_of(cache.times, "fuzz");
    require(timing.rate.numerator > 0 && timing.rate.denominator > 0);
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::kInput && *error.what() != '\0');
  }
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TESTS_FUZZ_FUZZ_CACHE_H_
