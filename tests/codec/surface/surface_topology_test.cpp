// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface_topology.h"

#include "codec/sequence/error.h"
#include "codec/surface/surface.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <algorithm>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

TEST(SurfaceTopology, TellsInnerFromBoundary) {
  const TestMesh sheet = flat_sheet(4);
  EXPECT_EQ(sheet.topology.kind[5], VertexKind::kInner);
  EXPECT_EQ(sheet.topology.kind[0], VertexKind::kBoundary);
  EXPECT_TRUE(sheet.topology.has_boundary());
  EXPECT_FALSE(sphere(3).topology.has_boundary());
}

TEST(SurfaceTopology, ListsNeighbours) {
  const TestMesh sheet = flat_sheet(3);
  const auto ring = sheet.topology.ring[4];
  EXPECT_THAT(std::vector<uint32_t>(ring.begin(), ring.end()), ElementsAre(0, 1, 3, 5, 7, 8));
  EXPECT_EQ(sheet.topology.star[4].size(), 6U);
}

TEST(SurfaceTopology, PinsWhatIsNotManifold) {
  const MeshSequence clip = corpus::make_clip("nonmanifold");
  const SurfaceTopology topology(fan_triangles(clip.polygons), clip.vertex_count);
  EXPECT_GE(std::count(topology.kind.begin(), topology.kind.end(), VertexKind::kPinned), 9);
  EXPECT_GT(std::count(topology.kind.begin(), topology.kind.end(), VertexKind::kInner), 50);
}

TEST(SurfaceTopology, LeavesOutTrianglesWithARepeatedVertex) {
  const std::vector<uint32_t> corners{0, 1, 2, 1, 1, 2};
  const SurfaceTopology topology(corners, 4);
  EXPECT_EQ(topology.triangles.size(), 1U);
  EXPECT_EQ(topology.kind[3], VertexKind::kPinned);
}

TEST(SurfaceTopology, RefusesACornerOutOfRange) {
  const std::vector<uint32_t> corners{0, 1, 7};
  EXPECT_THROW(SurfaceTopology(corners, 3), Error);
}

TEST(SurfaceTopology, CountsComponents) {
  const MeshSequence clip = corpus::make_clip("rigid");
  const SurfaceTopology topology(fan_triangles(clip.polygons), clip.vertex_count);
  const std::vector<uint32_t> component = components(topology);
  EXPECT_EQ(*std::max_element(component.begin(), component.end()), 6U);
}

}  // namespace
}  // namespace anicodec
