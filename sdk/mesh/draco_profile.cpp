// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/draco_profile.h"

#include <algorithm>

namespace anicodec {
namespace {

constexpr uint8_t kTriangles = 1, kEdgebreaker = 1;
constexpr uint8_t kStandardTraversal = 0, kValenceTraversal = 2;
constexpr uint8_t kPosition = 0, kGeneric = 4;  // kinds of attribute
constexpr uint8_t kInt32 = 5;
constexpr uint8_t kIntegers = 1;                     // values are coded as integers
constexpr uint8_t kOfVertices = 0;                   // an attribute without seams
constexpr uint8_t kDepthFirst = 0, kByDegree = 1;    // orders of its values
constexpr uint8_t kParallelogram = 1, kSeveral = 4;  // predictions
constexpr uint8_t kWrap = 1;                         // what residuals are
constexpr uint8_t kByLength = 0, kByValue = 1;       // codings of the residuals
constexpr uint32_t kMaxLengths = 33;                 // bits of a residual, and none
constexpr uint32_t kMaxAlphabetBits = 18;

/// A stream of bits that begins with their probability.
void skip_bits(ByteReader& r) {
  r.u8();
  if (r.block().size == 0)
    r.fail();
}

/// Pairs of symbols where the surface is split, and a bit for each.
void skip_splits(ByteReader& r, uint64_t most) {
  const uint64_t splits = r.varint(most);
  uint64_t last = 0;
  for (uint64_t i = 0; r.ok() && i < splits; ++i) {
    last += r.varint(UINT32_MAX);
    if (last > most || r.varint(UINT32_MAX) > last)
      r.fail();
  }
  r.raw((splits + 7) / 8);
}

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

}  // namespace

uint32_t most_draco_attributes(uint32_t components) {
  return std::clamp(components / 3, 2U, 64U);
}

uint32_t draco_table_bits(uint64_t values) {
  return std::clamp(3 * alphabet_bits(values) / 2, 12U, 20U);
}

bool read_draco_head(ByteView bytes, const DracoCounts& counts, DracoSeams* seams) {
  constexpr uint8_t kHead[] = {'D', 'R', 'A', 'C', 'O', 2, 2, kTriangles, kEdgebreaker};
  ByteReader r(bytes);
  const ByteView head = r.raw(sizeof kHead);
  if (!r.ok() || !std::equal(kHead, kHead + sizeof kHead, head.data) || r.u16() != 0)
    return false;
  const uint8_t traversal = r.u8();
  const uint64_t vertices = r.varint(), faces = r.varint();
  seams->streams = r.u8();
  const uint64_t symbols = r.varint(), splits = r.varint();
  if (!r.ok() || (traversal != kStandardTraversal && traversal != kValenceTraversal) ||
      vertices > counts.points || faces != counts.triangles || seams->streams == 0 ||
      seams->streams >= most_draco_attributes(counts.components) || symbols > faces ||
      splits > symbols)
    return false;
  skip_splits(r, symbols);
  if (traversal == kStandardTraversal)
    r.block();
  skip_bits(r);  // which components begin inside the surface
  seams->begin = r.position();
  for (uint32_t i = 0; i < seams->streams; ++i)
    skip_bits(r);
  seams->end = r.position();
  seams->symbols = traversal == kValenceTraversal ? static_cast<uint32_t>(symbols) : 0;
  return r.ok();
}

bool check_draco_attributes(ByteView rest, const DracoCounts& counts, uint32_t attributes) {
  ByteReader r(rest);
  if (r.u8() != attributes)
    return false;
  for (uint32_t i = 0; i < attributes; ++i) {
    const auto connectivity = static_cast<uint8_t>(i - 1);  // 255: that of the positions
    if (r.u8() != connectivity || r.u8() != kOfVertices ||
        r.u8() > (i == 0 ? kByDegree : kDepthFirst))
      return false;
  }
  uint64_t components = 0;
  for (uint32_t i = 0; i < attributes; ++i) {
    if (r.varint() != 1 || r.u8() != (i == 0 ? kPosition : kGeneric) || r.u8() != kInt32)
      return false;
    const uint8_t width = r.u8(), normalised = r.u8();
    if (width == 0 || (i == 0 && width != 3) || normalised != 0 || r.varint() != i ||
        r.u8() != kIntegers)
      return false;
    components += width;
  }
  return r.ok() && components == counts.components;
}

bool check_draco_symbols(ByteView rest, uint64_t values) {
  ByteReader r(rest);
  const uint8_t coding = r.u8();
  if (coding == kByLength)
    return r.varint() <= kMaxLengths && r.ok();
  const uint8_t bits = r.u8();
  return coding == kByValue && bits <= alphabet_bits(values) && r.varint() <= kMaxDracoSymbols &&
         r.ok();
}

bool check_draco_values(ByteView rest, uint64_t values) {
  ByteReader r(rest);
  const uint8_t prediction = r.u8();
  return (prediction == kParallelogram || prediction == kSeveral) && r.u8() == kWrap &&
         r.u8() == 1 && check_draco_symbols(r.raw(r.remaining()), values);
}

}  // namespace anicodec
