// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/peers/gltfpack.h"

#include "codec/metrics/metrics.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tools/io/files/private_folder.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace anicodec::peers {
namespace {

class Gltfpack : public testing::Test {
 protected:
  void SetUp() override {
    if (gltfpack_version().empty())
      GTEST_SKIP() << "gltfpack is not installed, or meshoptimizer was not when this was built";
  }
};

TEST_F(Gltfpack, ReachesTheErrorAskedWithTheFewestBits) {
  const MeshSequence clip = corpus::make_clip("limb");
  const GltfpackClip fine = gltfpack_at_kg(clip, 0.1), coarse = gltfpack_at_kg(clip, 1);
  EXPECT_LE(fine.kg, 0.1);
  EXPECT_GT(fine.kg, 0.02);
  EXPECT_NEAR(compare(clip, fine.decoded).kg, fine.kg, 1e-12);
  EXPECT_LT(coarse.bits, fine.bits);
  EXPECT_LT(coarse.bytes, fine.bytes);
  EXPECT_LT(fine.bytes, fine.source_bytes);
}

TEST_F(Gltfpack, FindsTheVerticesThatItMerges) {
  for (const char* name : {"soup", "polygons", "repeats"}) {
    const MeshSequence clip = corpus::make_clip(name);
    const GltfpackClip packed = gltfpack_at_kg(clip, 0.1);
    EXPECT_LE(packed.kg, 0.1) << name;
    EXPECT_EQ(packed.decoded.vertex_count, clip.vertex_count) << name;
  }
}

TEST_F(Gltfpack, LeavesVerticesWithoutFacesAsTheyAre) {
  MeshSequence clip = corpus::make_clip("limb");
  MeshSequence more = clip;
  more.vertex_count += 1;
  more.positions.clear();
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    more.positions.insert(more.positions.end(), clip.frame(f).begin(), clip.frame(f).end());
    more.positions.insert(more.positions.end(), {100, 200, 300});
  }
  const GltfpackClip packed = gltfpack_at_kg(more, 1);
  EXPECT_EQ(packed.vertices, gltfpack_at_kg(clip, 1).vertices);
  for (uint32_t f = 0; f < clip.frame_count; ++f)
    EXPECT_EQ(packed.decoded.frame(f).back(), 300);
}

TEST_F(Gltfpack, RefusesWhatIsNoClip) {
  for (const char* name : {"one_frame", "points"}) {
    try {
      gltfpack_at_kg(corpus::make_clip(name), 1);
      FAIL() << name;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUsage) << name;
    }
  }
}

TEST_F(Gltfpack, IsMissedWhereItIsNot) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nonexistent", 1);
  EXPECT_EQ(gltfpack_version(), "");
  EXPECT_THROW(gltfpack_at_kg(corpus::make_clip("limb"), 1), Error);
  ::setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace anicodec::peers
