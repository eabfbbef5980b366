// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/mixing.h"

namespace anicodec {
namespace {

constexpr uint64_t kWholeUnit = uint64_t{1} << 32;
constexpr uint64_t kDecay = 4290775039;  // floor(2^32 exp(-1/1024))

}  // namespace

ANICODEC_CONSTANT Logistic::Tables::Tables() {
  // e runs through 2^32 exp(-x / 1024) for x = 0, 1, ...
  uint64_t e = kWholeUnit;
  for (int32_t x = 0; x < 4 * kSquashEntries; ++x) {
    if (x % 8 == 4) {  // the middle of an entry
      const int32_t i = x / 8, half = kSquashEntries / 2;
      const auto p = static_cast<uint32_t>((kWholeUnit << 16) / (kWholeUnit + e));
      squash[half + i] = static_cast<uint16_t>(p);
      squash[half - 1 - i] = static_cast<uint16_t>(kProbabilityOne - p);
    }
    e = (e * kDecay) >> 32;
  }
  e = kWholeUnit;
  int32_t x = 0;
  for (int i = kStretchEntries / 2 - 1; i >= 0;
       --i) {  // p = (2i + 1) / 8192, the middle of an entry
    const auto odds = static_cast<uint64_t>(2 * i + 1);
    while (e * (uint64_t{2} * kStretchEntries - odds) > odds * kWholeUnit) {
      e = (e * kDecay) >> 32;
      ++x;
    }
    stretch[i] = static_cast<int16_t>(-((x + 2) >> 2));
    stretch[kStretchEntries - 1 - i] = static_cast<int16_t>((x + 2) >> 2);
  }
}

ANICODEC_CONSTANT const Logistic::Tables Logistic::kTables;

}  // namespace anicodec
