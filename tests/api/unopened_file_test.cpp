// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Metadata and boxes are read from a file that is not opened.
#include "tests/api/opened.h"

#include <algorithm>
#include <string>

namespace anicodec {
namespace {

Bytes clip_with(const std::string& metadata) {
  MeshSequence clip = corpus::make_scaled("limb", 200, 80);
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.2, true};
  options.effort = Effort::kFast;
  options.metadata = metadata;
  return encode(clip, options).file;
}

std::string metadata_of(const Bytes& file, size_t size) {
  const char* text = nullptr;
  size_t bytes = 0;
  const anic_status status = anic_read_metadata(file.data(), size, &text, &bytes);
  return status == ANIC_OK ? std::string(text, bytes) : anic_get_status_text(status);
}

TEST(UnopenedFile, TellsItsMetadata) {
  const Bytes file = clip_with(R"({ "author": "Ada", "licence": "CC0-1.0" })");
  EXPECT_EQ(metadata_of(file, file.size()), R"({"author":"Ada","licence":"CC0-1.0"})");
  EXPECT_EQ(metadata_of(file, 60), anic_get_status_text(ANIC_E_TRUNCATED));
  size_t least = 0;
  while (metadata_of(file, least)[0] != '{')
    ++least;
  EXPECT_LT(least, 600U) << "metadata comes before what is large";
  const Bytes without = clip_with("");
  EXPECT_EQ(metadata_of(without, without.size()), anic_get_status_text(ANIC_E_ABSENT));
  EXPECT_EQ(anic_read_metadata(file.data(), file.size(), nullptr, nullptr), ANIC_E_ARGUMENT);
}

TEST(UnopenedFile, TakesJsonObjectsAlone) {
  for (const char* bad : {"[1]", "author", "{\"a\":", "{\"a\":\"\xC3\"}", "1"})
    EXPECT_ANY_THROW(clip_with(bad)) << bad;
  EXPECT_ANY_THROW(clip_with("{\"a\":" + std::string(40, '[') + std::string(40, ']') + "}"));
}

TEST(UnopenedFile, HasBoxesThatHoldItsFrames) {
  const Bytes file = clip_with("");
  const Asset asset = open(file);
  anic_box all = {{0}, {0}};
  ASSERT_EQ(anic_read_bounds(file.data(), file.size(), 0, 0, 0, &all), ANIC_OK);
  for (uint32_t f = 0; f < 80; ++f) {
    anic_box box = {{0}, {0}};
    ASSERT_EQ(anic_read_bounds(file.data(), 600, 0, f, 1, &box), ANIC_OK);
    const std::vector<float> positions = frame(asset, f);
    for (size_t i = 0; i < positions.size(); ++i) {
      EXPECT_GE(positions[i], box.min[i % 3]);
      EXPECT_LE(positions[i], box.max[i % 3]);
    }
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_LE(all.min[c], box.min[c]);
      EXPECT_GE(all.max[c], box.max[c]);
    }
  }
  anic_box early = {{0}, {0}}, late = {{0}, {0}};
  ASSERT_EQ(anic_read_bounds(file.data(), file.size(), 0, 0, 64, &early), ANIC_OK);
  ASSERT_EQ(anic_read_bounds(file.data(), file.size(), 0, 64, 0, &late), ANIC_OK);
  EXPECT_FALSE(std::equal(early.min, early.min + 3, late.min) &&
               std::equal(early.max, early.max + 3, late.max));
}

TEST(UnopenedFile, SaysWhereThereAreNoBoxes) {
  const Bytes file = clip_with("");
  anic_box box = {{0}, {0}};
  EXPECT_EQ(anic_read_bounds(file.data(), file.size(), 1, 0, 0, &box), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_read_bounds(file.data(), file.size(), 0, 80, 0, &box), ANIC_E_FRAME_RANGE);
  EXPECT_EQ(anic_read_bounds(file.data(), file.size(), 0, 79, 2, &box), ANIC_E_FRAME_RANGE);
  EXPECT_EQ(anic_read_bounds(file.data(), 50, 0, 0, 0, &box), ANIC_E_TRUNCATED);
  EXPECT_EQ(anic_read_bounds(file.data(), file.size(), 0, 0, 0, nullptr), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_read_bounds("none", 4, 0, 0, 0, &box), ANIC_E_MAGIC);
}

}  // namespace
}  // namespace anicodec
