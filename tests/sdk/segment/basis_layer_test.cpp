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
  const Bytes weights = text("weights"), coefficients = text("coefficients");
  BasisLayer layer;
  layer.count = 5;
  layer.weights = weights;
  layer.coefficients = coefficients;
  const Bytes chunk = layer.write();
  Vector<BasisLayer> read;
  ASSERT_EQ(read_layers({chunk, chunk}, 10, 10, &read), Status::kOk);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].first, 5U);
  EXPECT_EQ(read[1].count, 5U);
  EXPECT_TRUE(same(read[1].weights, weights));
  EXPECT_TRUE(same(read[1].coefficients, coefficients));
}

TEST(BasisLayer, StopsAtTheComponentsWanted) {
  BasisLayer layer;
  layer.count = 5;
  const Bytes good = layer.write(), damaged = text("\x7f");
  Vector<BasisLayer> read;
  EXPECT_EQ(read_layers({good, damaged}, 10, 5, &read), Status::kOk);
  EXPECT_EQ(read.size(), 1U);
  EXPECT_EQ(read_layers({good, damaged}, 10, 6, &read), Status::kRecord);
}

TEST(BasisLayer, RefusesCountsThatTheSegmentOrTheChunkDoesNotHave) {
  BasisLayer layer;
  layer.count = 5;
  const Bytes weights = text("weights");
  layer.weights = weights;
  const Bytes chunk = layer.write();
  Vector<BasisLayer> read;
  EXPECT_EQ(read_layers({chunk}, 4, 4, &read), Status::kRecord);
  EXPECT_EQ(read_layers({chunk}, 6, 6, &read), Status::kChunkMissing);
  for (size_t size = 0; size < chunk.size(); ++size)
    EXPECT_EQ(read_layers({ByteView{chunk.data(), size}}, 5, 5, &read), Status::kRecord) << size;
}

}  // namespace
}  // namespace anicodec
