// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/turned_axes.h"

#include "codec/sequence/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;

TEST(TurnedAxes, AreThoseThatTheFormatIsReadIn) {
  constexpr UpAxis kY = UpAxis::kY, kZ = UpAxis::kZ, kUnknown = UpAxis::kUnknown;
  EXPECT_EQ(up_of_output("f_%d.obj", kZ, kUnknown), kY);
  EXPECT_EQ(up_of_output("f_%d.obj", kZ, kZ), kZ);
  EXPECT_EQ(up_of_output("f_%d.obj", kUnknown, kUnknown), kUnknown);
  EXPECT_EQ(up_of_output("f_%d.ply", kZ, kUnknown), kZ);
  EXPECT_EQ(up_of_output("a.pc2", kZ, kUnknown), kZ) << "fits the mesh that it came from";
  EXPECT_EQ(up_of_output("a.pc2", kZ, kY), kY);
  EXPECT_EQ(up_of_output("a.glb", kZ, kY), kZ) << "is turned where it is written";
  EXPECT_THROW(up_of_output("a.glb", kY, kZ), Error);
  EXPECT_THROW(up_of_output("a.pc2", kUnknown, kZ), Error);
}

TEST(TurnedAxes, TurnFramesNormalsAndTangents) {
  const AxisTurn turn(UpAxis::kZ, UpAxis::kY), back(UpAxis::kY, UpAxis::kZ);
  const std::vector<float> frame{1, 2, 3, 4, 5, 6};
  const FrameSource frames = turn.turned([&](uint32_t) { return std::span(frame); });
  const std::span<const float> turned = frames(0);
  EXPECT_THAT(std::vector<float>(turned.begin(), turned.end()), ElementsAre(1, 3, -2, 4, 6, -5));
  std::vector<Attribute> attributes(2);
  attributes[0] = {
      .kind = AttributeKind::kTangent, .name = {}, .components = 4, .values = {1, 2, 3, -1}};
  attributes[1] = {.kind = AttributeKind::kUv, .name = {}, .values = {1, 2, 3, 4}};
  turn.turn(attributes);
  EXPECT_THAT(attributes[0].values, ElementsAre(1, 3, -2, -1));
  EXPECT_THAT(attributes[1].values, ElementsAre(1, 2, 3, 4));
  const AttributeSource source = back.turned([&](uint32_t) { return attributes; });
  EXPECT_THAT(source(0)[0].values, ElementsAre(1, 2, 3, -1));
  EXPECT_FALSE(AxisTurn(UpAxis::kZ, UpAxis::kZ).turns());
}

}  // namespace
}  // namespace anicodec::tools
