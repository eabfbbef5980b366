// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/mixing.h"

namespace anicodec {
namespace {

constexpr uint64_t kUnit = uint64_t{1} << 32;
constexpr uint64_t kDecay = 4290775039;  // floor(2^32 exp(-1/1024))

}  // namespace

constexpr Logistic::Tables::Tables() : stretch{}, squash{} {
  // e runs through 2^32 exp(-x / 1024) for x = 0, 1, ...
  constexpr int kHalf = kLimit >> kSquashShift;
  uint64_t e = kUnit;
  for (int32_t x = 0; x <= kLimit; ++x) {
    if (x % (1 << kSquashShift) == (1 << kSquashShift) / 2) {  // the middle of a table entry
      const int i = x >> kSquashShift;
      const auto p = static_cast<uint32_t>((kUnit << 16) / (kUnit + e));
      squash[kHalf + i] = static_cast<uint16_t>(p);
      squash[kHalf - 1 - i] = static_cast<uint16_t>(kProbabilityOne - p);
    }
    e = (e * kDecay) >> 32;
  }
  constexpr int kEntries = kStretchEntries;
  e = kUnit;
  int32_t x = 0;
  for (int i = kEntries / 2 - 1; i >= 0;
       --i) {  // p = (2i + 1) / (2 kEntries), the middle of an entry
    const auto odds = static_cast<uint64_t>(2 * i + 1);
    while (e * (2 * kEntries - odds) > odds * kUnit) {
      e = (e * kDecay) >> 32;
      ++x;
    }
    stretch[i] = static_cast<int16_t>(-x);
    stretch[kEntries - 1 - i] = static_cast<int16_t>(x);
  }
}

constexpr Logistic::Tables Logistic::kTables;

}  // namespace anicodec
