// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/learnt_segment.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

VertexOrder order_of_four() {
  VertexOrder order;
  order.order = {2, 0, 1, 3};
  order.level_start = {0, 2, 4};
  order.neighbour_count = 8;
  order.neighbours = Vector<int32_t>(32, -1);
  order.neighbours[16] = 1;
  return order;
}

TEST(LearntSegment, SuitsTheSameOrderOfVertices) {
  const VertexOrder order = order_of_four();
  LearntSegment learnt;
  learnt.order = LearntSegment::hash_of(order);
  EXPECT_FALSE(learnt.suits(BasisKind::kEigentrajectories, order));  // nothing has been learnt
  learnt.coefficients.emplace_back(1, order.neighbours.data(), 8, order.level_start);
  EXPECT_TRUE(learnt.suits(BasisKind::kEigentrajectories, order));
  EXPECT_FALSE(learnt.suits(BasisKind::kEigenshapes, order));
  VertexOrder other = order;
  other.neighbours[24] = 0;
  EXPECT_FALSE(learnt.suits(BasisKind::kEigentrajectories, other));
  other = order;
  other.order = {0, 2, 1, 3};
  EXPECT_FALSE(learnt.suits(BasisKind::kEigentrajectories, other));
  other = order;
  other.level_start = {0, 1, 4};
  EXPECT_FALSE(learnt.suits(BasisKind::kEigentrajectories, other));
}

}  // namespace
}  // namespace anicodec
