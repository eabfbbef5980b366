// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/draco_profile.h"

#include <algorithm>

namespace anicodec {
namespace {

constexpr uint8_t kPosition = 0, kGeneric = 4;  // kinds of attribute
constexpr uint8_t kInt32 = 5;
constexpr uint8_t kIntegers = 1;                     // values are coded as integers
constexpr uint8_t kParallelogram = 1, kSeveral = 4;  // predictions
constexpr uint8_t kWrap = 1;                         // what residuals are
constexpr uint8_t kByLength = 0, kByValue = 1;       // codings of the residuals
constexpr uint32_t kMaxLengths = 33;                 // bits of a residual, and none
constexpr uint32_t kMaxAlphabetBits = 18;

uint32_t bit_length(uint64_t x) {
  uint32_t bits = 0;
  for (; x > 0; x >>= 1)
    ++bits;
  return bits;
}

/// Bits by which a writer numbers the different symbols among so many values, at most.
uint32_t alphabet_bits(uint64_t values) {
  return std::min(bit_length(values) + 2, kMaxAlphabetBits);
}

/// Checks the alphabet of a list of so many symbols.
bool check_symbols(ByteReader& r, uint64_t values) {
  const uint8_t coding = r.u8();
  if (coding == kByLength)
    return r.varint() <= kMaxLengths && r.ok();
  const uint8_t bits = r.u8();
  return coding == kByValue && bits <= alphabet_bits(values) && r.varint() <= kMaxDracoSymbols &&
         r.ok();
}

}  // namespace

uint32_t draco_table_bits(uint64_t values) {
  return std::clamp(3 * alphabet_bits(values) / 2, 12U, 20U);
}

bool check_draco_attributes(ByteView bytes, uint32_t poses) {
  ByteReader r(bytes);
  if (r.u8() != 1)  // one decoder for all attributes
    return false;
  const uint64_t attributes = r.varint(kMaxDracoAttributes);
  uint64_t components = 0;
  for (uint64_t i = 0; i < attributes; ++i) {
    if (r.u8() != (i == 0 ? kPosition : kGeneric) || r.u8() != kInt32)
      return false;
    const uint8_t width = r.u8(), normalised = r.u8();
    if (width == 0 || width % 3 != 0 || (i == 0 && width != 3) || normalised != 0 ||
        r.varint() != i)
      return false;
    components += width;
  }
  for (uint64_t i = 0; i < attributes; ++i) {
    if (r.u8() != kIntegers)
      return false;
  }
  return r.ok() && components == uint64_t{3} * poses;
}

bool check_draco_values(ByteView rest, uint64_t values) {
  ByteReader r(rest);
  const uint8_t prediction = r.u8();
  return (prediction == kParallelogram || prediction == kSeveral) && r.u8() == kWrap &&
         r.u8() == 1 && check_symbols(r, values);
}

}  // namespace anicodec
