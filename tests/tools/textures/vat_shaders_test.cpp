// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/vat_shaders.h"

#include "codec/sequence/error.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(VatShaders, AreTextOfTheirEngines) {
  const auto chosen = shaders_for("three,godot");
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_THAT(std::string(chosen[0].text), testing::HasSubstr("from 'three'"));
  EXPECT_THAT(std::string(chosen[1].text), testing::HasSubstr("shader_type spatial"));
  EXPECT_TRUE(shaders_for("").empty());
  EXPECT_THROW(shaders_for("godot,quake"), Error);
}

}  // namespace
}  // namespace anicodec::tools
