// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/material_look.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

MaterialLook glass() {
  MaterialLook look;
  look.known = true;
  look.base_colour = {0.1F, 0.2F, 0.3F, 0.4F};
  look.metallic = 0.5F;
  look.roughness = 0;
  look.emissive = {0, 4, 0};
  look.alpha = AlphaMode::kBlend;
  look.double_sided = true;
  look.texture(TextureSlot::kOcclusion) = "ao.png";
  look.texture(TextureSlot::kEmissive) = "#glow";
  return look;
}

Bytes bytes_of(const MaterialLook& look) {
  ByteWriter w;
  look.write(w);
  return std::move(w.bytes());
}

bool is_read(const Bytes& bytes, MaterialLook* out) {
  ByteReader r(bytes);
  return out->read(r) && r.remaining() == 0;
}

TEST(MaterialLook, ComesBack) {
  MaterialLook cut = glass();
  cut.alpha = AlphaMode::kMask;
  cut.alpha_cutoff = 0.75F;
  for (const MaterialLook& look : {MaterialLook(), glass(), cut}) {
    MaterialLook read = glass();
    ASSERT_TRUE(is_read(bytes_of(look), &read));
    EXPECT_EQ(read, look);
  }
  EXPECT_EQ(bytes_of(MaterialLook()).size(), 1U);
}

TEST(MaterialLook, RefusesWhatIsOutOfRange) {
  MaterialLook read;
  const Bytes good = bytes_of(glass());
  for (size_t size = 0; size < good.size(); ++size) {
    const Bytes cut(good.begin(), good.begin() + static_cast<ptrdiff_t>(size));
    EXPECT_FALSE(is_read(cut, &read)) << size;
  }
  for (const uint8_t flags : {2, 4, 13, 17, 255}) {
    Bytes bytes = good;
    bytes[0] = flags;
    EXPECT_FALSE(is_read(bytes, &read)) << int{flags};
  }
  for (const float x : {-1.0F, NAN, std::numeric_limits<float>::infinity()}) {
    MaterialLook look = glass();
    look.emissive[2] = x;
    EXPECT_FALSE(look.in_range());
    EXPECT_FALSE(is_read(bytes_of(look), &read)) << x;
  }
}

}  // namespace
}  // namespace anicodec
