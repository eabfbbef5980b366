// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"
#include "corpus/clips.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

// A balanced encoding may trade bytes for time of opening.
TEST(SlowEffort, MoreOfItNeverEndsWithALargerFile) {
  for (const char* name : {"limb", "waves", "face", "soup", "repeats", "quad_box"}) {
    const MeshSequence clip = corpus::make_clip(name);
    for (const auto& [smallest, traded] : {std::pair{true, 1.0}, std::pair{false, 1.02}}) {
      double least = INFINITY;
      for (const Effort effort : {Effort::kFast, Effort::kNormal, Effort::kBest}) {
        EncodeOptions options;
        options.target = {ErrorMetric::kKg, 0.1, false};
        options.effort = effort;
        options.smallest = smallest;
        const auto bytes = static_cast<double>(encode(clip, options).file.size());
        EXPECT_LE(bytes, traded * least)
            << name << ", effort " << static_cast<int>(effort) << ", smallest " << smallest;
        least = std::min(least, bytes);
      }
    }
  }
}

}  // namespace
}  // namespace anicodec
