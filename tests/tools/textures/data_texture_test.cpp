// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/data_texture.h"

#include "codec/sequence/error.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

DataTexture ramp() {
  DataTexture texture(5, 3);
  for (size_t i = 0; i < texture.texels.size(); ++i)
    texture.texels[i] = static_cast<float>(i) / 59;
  return texture;
}

TEST(DataTexture, PngHoldsNumbersWithinHalfAStep) {
  const DataTexture before = ramp();
  const std::string bytes = texture_bytes(before, TexelKind::kPng16);
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(bytes[24], 16) << "bits";
  EXPECT_EQ(bytes[25], 6) << "red, green, blue, alpha";
  const DataTexture after = read_texture(bytes, TexelKind::kPng16);
  ASSERT_EQ(after.texels.size(), before.texels.size());
  EXPECT_EQ(after.width, 5U);
  for (size_t i = 0; i < before.texels.size(); ++i)
    EXPECT_NEAR(after.texels[i], before.texels[i], 0.501 / 65535) << i;
}

TEST(DataTexture, ExrHoldsHalfFloats) {
  DataTexture before = ramp();
  before.texels[7] = -12345.678F;
  const DataTexture half =
      read_texture(texture_bytes(before, TexelKind::kExrHalf), TexelKind::kExrHalf);
  EXPECT_EQ(half.width, 5U);
  EXPECT_EQ(half.height, 3U);
  for (size_t i = 0; i < before.texels.size(); ++i)
    EXPECT_NEAR(half.texels[i], before.texels[i], std::abs(before.texels[i]) / 2048) << i;
}

TEST(DataTexture, RefusesNumbersThatAFileDoesNotHold) {
  DataTexture texture(1, 1);
  for (const auto& [kind, number] :
       {std::pair{TexelKind::kPng16, 1.001F},
        {TexelKind::kPng16, -0.001F},
        {TexelKind::kExrHalf, 70000.0F},
        {TexelKind::kExrHalf, std::numeric_limits<float>::quiet_NaN()}}) {
    texture.texels[2] = number;
    EXPECT_THROW(texture_bytes(texture, kind), Error) << number;
  }
}

TEST(DataTexture, RefusesOtherFiles) {
  for (TexelKind kind : {TexelKind::kPng16, TexelKind::kExrHalf}) {
    const std::string bytes = texture_bytes(ramp(), kind);
    EXPECT_THROW(read_texture("no picture at all, but some text", kind), Error);
    EXPECT_THROW(read_texture(bytes.substr(0, 40), kind), Error);
  }
}

}  // namespace
}  // namespace anicodec::tools
