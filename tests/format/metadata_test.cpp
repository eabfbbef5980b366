// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/metadata.h"

#include <string>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

bool accepts(const std::string& text) {
  return is_metadata({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

TEST(Metadata, IsUtf8InItsShortestForm) {
  EXPECT_TRUE(accepts("{}"));
  EXPECT_TRUE(accepts("{\"author\":\"J\xC3\xBCrg \xE2\x82\xAC \xF0\x9F\x8E\x88\"}"));
  EXPECT_FALSE(accepts(""));
  for (const char* bad :
       {"\x80", "\xC3", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80", "\xF0\x80\x80\x80",
        "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xC3(", "\xE2\x82("})
    EXPECT_FALSE(accepts(std::string("{\"a\":\"") + bad + "\"}"));
}

TEST(Metadata, HasAGreatestSizeAndDepth) {
  EXPECT_TRUE(accepts(std::string(kMaxMetadataBytes, ' ')));
  EXPECT_FALSE(accepts(std::string(kMaxMetadataBytes + 1, ' ')));
  EXPECT_TRUE(
      accepts(std::string(kMaxMetadataNesting, '[') + std::string(kMaxMetadataNesting, ']')));
  EXPECT_FALSE(accepts(std::string(kMaxMetadataNesting + 1, '[')));
  EXPECT_TRUE(
      accepts("{\"text\":\"" + std::string(100, '[') + "\\\"" + std::string(100, '{') + "\"}"));
}

}  // namespace
}  // namespace anicodec
