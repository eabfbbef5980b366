// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Stand-alone program: prints the hash of every case, fails if one differs from the pinned one.
#include "tests/sdk/prediction_hash.h"

#include <cinttypes>
#include <cstdio>

int main() {
  int differing = 0;
  for (const anicodec::PredictionCase& c : anicodec::kPredictionCases) {
    const uint64_t hash = anicodec::reconstruction_hash(c);
    std::printf("m %d colours %d channels %d: %016" PRIx64 "%s\n", c.neighbours, c.colours,
                c.channels, hash, hash == c.hash ? "" : " differs");
    differing += hash != c.hash;
  }
  return differing ? 1 : 0;
}
