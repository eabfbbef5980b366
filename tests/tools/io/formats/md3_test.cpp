// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/md3.h"

#include "tests/tools/clip_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/base/byte_order.h"

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void put(uint32_t number, std::string& out) {
  append(number, std::endian::little, out);
}

std::string padded(std::string name) {
  name.resize(64);
  return name;
}

/// A triangle whose first corner rises by a half, of as many frames.
std::string model(uint32_t frames) {
  std::string surface = "IDP3" + padded("body");
  for (const uint32_t x : {0U, frames, 1U, 3U, 1U, 108U, 120U, 188U, 212U, 212U + 24U * frames})
    put(x, surface);
  for (const uint32_t v : {0U, 1U, 2U})
    put(v, surface);
  surface += padded("skin.tga");
  put(0, surface);
  for (const float x : {0.F, 0.F, 1.F, 0.F, 0.F, 0.75F})
    append(x, std::endian::little, surface);
  for (uint32_t f = 0; f < frames; ++f) {
    const auto rise = static_cast<int16_t>(32 * f);
    for (const int16_t x :
         {int16_t{-64}, int16_t{0}, rise, int16_t{0}, int16_t{64}, int16_t{0}, int16_t{0},
          int16_t{0}, int16_t{0}, int16_t{128}, int16_t{0}, int16_t{0}})
      append(static_cast<uint16_t>(x), std::endian::little, surface);
  }
  std::string bytes = "IDP3";
  put(15, bytes);
  bytes += padded("model");
  const uint32_t tags = 108 + 56 * frames, surfaces = tags + 112 * frames;
  for (const uint32_t x : {0U, frames, 1U, 1U, 0U, 108U, tags, surfaces})
    put(x, bytes);
  put(surfaces + static_cast<uint32_t>(surface.size()), bytes);
  return bytes + std::string(168 * frames, '\0') + surface;
}

TEST(Md3, HasAllItsFrames) {
  TemporaryFolder folder;
  folder.write("a.md3", model(3));
  std::string notes;
  LoadOptions options;
  options.note = [&](const std::string& text) { notes += text; };
  const MeshSequence clip = load_sequence(std::vector<std::string>{folder / "a.md3"}, options);
  EXPECT_THAT(notes, HasSubstr("left out: 1 tag,"));
  ASSERT_EQ(clip.frame_count, 3U);
  EXPECT_EQ(clip.rate.numerator, 10U);
  EXPECT_TRUE(clip.rate.assumed);
  EXPECT_EQ(clip.up, UpAxis::kZ);
  EXPECT_THAT(clip.polygons[0], ElementsAre(0, 2, 1));
  EXPECT_THAT(clip.frame(0), ElementsAre(-1, 0, 0, 1, 0, 0, 0, 2, 0));
  EXPECT_THAT(clip.frame(2), ElementsAre(-1, 0, 1, 1, 0, 0, 0, 2, 0));
  EXPECT_THAT(clip.parts.names, ElementsAre("body"));
  EXPECT_THAT(clip.materials.names, ElementsAre("skin.tga"));
  EXPECT_THAT(find_attribute(clip, AttributeKind::kUv)->values, ElementsAre(0, 1, 1, 1, 0, 0.25F));
  EXPECT_THAT(find_attribute(clip, AttributeKind::kNormal)->values,
              ElementsAre(0, 0, 1, 0, 0, 1, 0, 0, 1));
}

TEST(Md3, NamesItsFaults) {
  const std::string whole = model(2);
  for (size_t size = 0; size < whole.size(); ++size)
    EXPECT_THAT(fault([&] { parse_md3(whole.substr(0, size), "a.md3"); }), HasSubstr("a.md3: "))
        << size;
  std::string bad = whole;
  bad[4] = 14;
  EXPECT_EQ(fault([&] { parse_md3(bad, "a.md3"); }), "a.md3: version 14 of MD3 is not known");
  bad = whole;
  bad[bad.size() - 212 - 48 + 108] = 3;
  EXPECT_EQ(fault([&] { parse_md3(bad, "a.md3"); }),
            "a.md3: surface 0: triangle 0 uses vertex 3 of 3");
  EXPECT_THAT(fault([&] { parse_md3(model(0), "a.md3"); }), HasSubstr("has 0 frames"));
}

}  // namespace
}  // namespace anicodec::tools
