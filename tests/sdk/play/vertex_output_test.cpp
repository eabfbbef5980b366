// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/vertex_output.h"

#include "sdk/play/play.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(VertexOutput, IsCheckedForWhatCannotBeStored) {
  VertexOutput output;
  EXPECT_TRUE(is_valid(output));
  output.stride = 11;
  EXPECT_FALSE(is_valid(output));
  output.format = VertexFormat::kUnorm16x4;
  EXPECT_TRUE(is_valid(output));
  output.format = static_cast<VertexFormat>(kVertexFormatCount);
  EXPECT_FALSE(is_valid(output));
  output.format = VertexFormat::kSnorm16x3;
  for (float wrong : {0.f, std::numeric_limits<float>::infinity(), std::nanf(""), 1e-38f}) {
    output.scale[1] = wrong;
    EXPECT_FALSE(is_valid(output)) << wrong;
  }
  output.scale[1] = -3;
  EXPECT_TRUE(is_valid(output));
  output.offset[2] = std::nanf("");
  EXPECT_FALSE(is_valid(output));
}

TEST(VertexOutput, KnowsTheSizeOfEveryFormat) {
  const uint32_t sizes[kVertexFormatCount] = {12, 16, 6, 8, 6, 8, 6, 8};
  for (uint32_t id = 0; id < kVertexFormatCount; ++id)
    EXPECT_EQ(vertex_format_size(static_cast<VertexFormat>(id)), sizes[id]);
}

}  // namespace
}  // namespace anicodec
