// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"
#include "corpus/clips.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(SlowEffort, MoreOfItNeverEndsWithALargerFile) {
  for (const char* name : {"limb", "waves", "face", "soup", "repeats", "quad_box"}) {
    const MeshSequence clip = corpus::make_clip(name);
    size_t least = SIZE_MAX;
    for (const int effort : {1, 2, 3, 5, 7}) {
      EncodeOptions options;
      options.target = {ErrorMetric::kKg, 0.1, false};
      options.effort = effort;
      const size_t bytes = encode(clip, options).file.size();
      EXPECT_LE(bytes, least) << name << ", effort " << effort;
      least = std::min(least, bytes);
    }
  }
}

}  // namespace
}  // namespace anicodec
