// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/clip_library.h"

#include "codec/sequence/error.h"
#include "corpus/clips.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::HasSubstr;

MeshSequence named(const std::string& name, uint32_t frames) {
  MeshSequence clip = corpus::make_scaled("limb", 100, frames);
  clip.name = name;
  return clip;
}

std::string fault(std::vector<MeshSequence> clips) {
  try {
    check(clip_library(std::move(clips)));
  } catch (const Error& e) {
    return e.what();
  }
  return "none";
}

TEST(ClipLibrary, HasTheFramesOfAllClips) {
  const MeshSequence walk = named("walk", 7);
  MeshSequence run = named("run", 5);
  run.rate = {60, 1, false};
  run.loop = true;
  run.times = {0, 1, 3, 4, 9};
  const MeshSequence library = clip_library({walk, run});
  check(library);
  EXPECT_EQ(library.frame_count, 12U);
  EXPECT_EQ(library.polygons, walk.polygons);
  ASSERT_EQ(library.clips.size(), 2U);
  EXPECT_EQ(library.clips[0].name, "walk");
  EXPECT_EQ(library.clips[0].frame_count, 7U);
  EXPECT_EQ(library.clips[1].times, run.times);
  EXPECT_TRUE(library.clips[1].loop);
  for (uint32_t f = 0; f < 5; ++f)
    EXPECT_TRUE(std::ranges::equal(library.frame(7 + f), run.frame(f)));
}

TEST(ClipLibrary, AttributesThatMoveInOneClipHaveAllFrames) {
  MeshSequence walk = named("walk", 2), run = named("run", 3);
  Attribute heat;
  heat.kind = AttributeKind::kCustom;
  heat.name = "heat";
  heat.components = 1;
  heat.values.assign(walk.vertex_count, 1.F);
  walk.attributes = {heat};
  heat.frames = 3;
  heat.values.assign(size_t{3} * run.vertex_count, 2.F);
  run.attributes = {heat};
  const Attribute& joined = clip_library({walk, run}).attributes[0];
  EXPECT_EQ(joined.frames, 5U);
  ASSERT_EQ(joined.values.size(), size_t{5} * walk.vertex_count);
  EXPECT_EQ(joined.values[2 * walk.vertex_count - 1], 1.F);
  EXPECT_EQ(joined.values[2 * walk.vertex_count], 2.F);
}

TEST(ClipLibrary, RefusesWhatDoesNotFit) {
  MeshSequence other = corpus::make_scaled("limb", 200, 3);
  other.name = "other";
  EXPECT_THAT(fault({named("walk", 3), other}), HasSubstr("'other': has"));
  MeshSequence turned = named("turned", 3);
  turned.polygons.corners[0] = turned.polygons.corners[1];
  EXPECT_THAT(fault({named("walk", 3), turned}), HasSubstr("other faces"));
  MeshSequence upright = named("upright", 3);
  upright.up = UpAxis::kUnknown;
  EXPECT_THAT(fault({named("walk", 3), upright}), HasSubstr("up axis"));
  EXPECT_THAT(fault({named("walk", 3), named("walk", 2)}), HasSubstr("two clips have the name"));
  EXPECT_THAT(fault({}), HasSubstr("no clip"));
}

}  // namespace
}  // namespace anicodec
