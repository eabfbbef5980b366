// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/basis_layer.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Bytes text(const char* letters) {
  Bytes bytes;
  while (*letters)
    bytes.push_back(static_cast<uint8_t>(*letters++));
  return bytes;
}

bool same(ByteView view, const Bytes& bytes) {
  return Bytes(view.data, view.data + view.size) == bytes;
}

TEST(BasisLayer, ReadsWhatItWrites) {
  const Bytes weights = text("weights");
  const Bytes parts[4] = {text("one"), text(""), text("three"), text("4")};
  for (const uint32_t slices : {1U, 2U, 4U}) {
    BasisLayer layer;
    layer.count = 5;
    layer.weights = weights;
    for (uint32_t s = 0; s < slices; ++s)
      layer.slices[s] = parts[s];
    const Bytes chunk = layer.write(slices);
    Vector<BasisLayer> read;
    ASSERT_EQ(read_layers({chunk, chunk}, slices, 10, 10, &read), Status::kOk);
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[1].first, 5U);
    EXPECT_EQ(read[1].count, 5U);
    EXPECT_TRUE(same(read[1].weights, weights));
    for (uint32_t s = 0; s < slices; ++s)
      EXPECT_TRUE(same(read[1].slices[s], parts[s]));
  }
}

TEST(BasisLayer, StopsAtTheComponentsWanted) {
  BasisLayer layer;
  layer.count = 5;
  const Bytes good = layer.write(1), damaged = text("\x7f");
  Vector<BasisLayer> read;
  EXPECT_EQ(read_layers({good, damaged}, 1, 10, 5, &read), Status::kOk);
  EXPECT_EQ(read.size(), 1U);
  EXPECT_EQ(read_layers({good, damaged}, 1, 10, 6, &read), Status::kRecord);
}

TEST(BasisLayer, RefusesCountsThatTheSegmentOrTheChunkDoesNotHave) {
  BasisLayer layer;
  layer.count = 5;
  const Bytes weights = text("weights"), slice = text("slice");
  layer.weights = weights;
  layer.slices[0] = layer.slices[1] = slice;
  const Bytes chunk = layer.write(2);
  Vector<BasisLayer> read;
  EXPECT_EQ(read_layers({chunk}, 2, 4, 4, &read), Status::kRecord);
  EXPECT_EQ(read_layers({chunk}, 2, 6, 6, &read), Status::kChunkMissing);
  for (size_t size = 0; size < chunk.size() - slice.size(); ++size)
    EXPECT_EQ(read_layers({ByteView{chunk.data(), size}}, 2, 5, 5, &read), Status::kRecord) << size;
}

TEST(BasisLayer, HasAPowerOfTwoSlices) {
  for (uint32_t slices = 0; slices < 300; ++slices)
    EXPECT_EQ(is_slice_count(slices), slices == 1 || slices == 2 || slices == 4 || slices == 8);
}

}  // namespace
}  // namespace anicodec
