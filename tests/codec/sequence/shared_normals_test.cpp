// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/shared_normals.h"

#include "codec/sequence/error.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Two triangles at an edge whose vertices are there twice.
MeshSequence two_triangles(const std::array<float, 3>& first, const std::array<float, 3>& second) {
  MeshSequence sequence;
  sequence.polygons.add(std::vector<uint32_t>{0, 1, 2});
  sequence.polygons.add(std::vector<uint32_t>{4, 3, 5});
  sequence.vertex_count = 6;
  sequence.frame_count = 1;
  sequence.positions = {0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0};
  Attribute normals;
  normals.kind = AttributeKind::kNormal;
  normals.components = 3;
  for (uint32_t v = 0; v < 6; ++v) {
    const auto& normal = v < 3 ? first : second;
    normals.values.insert(normals.values.end(), normal.begin(), normal.end());
  }
  sequence.attributes.push_back(normals);
  return sequence;
}

TEST(KnownSharedNormals, JoinCopiesWithOneNormal) {
  const std::vector<uint32_t> shared = known_shared_normals(two_triangles({0, 0, 1}, {0, 0, 2}));
  ASSERT_EQ(shared.size(), 6U);
  EXPECT_EQ(shared[0], shared[4]);  // at (0, 0, 0)
  EXPECT_EQ(shared[1], shared[3]);
  EXPECT_NE(shared[2], shared[5]);
}

TEST(KnownSharedNormals, KeepNormalsApartThatDiffer) {
  const std::vector<uint32_t> shared = known_shared_normals(two_triangles({0, 0, 1}, {0, 0.1F, 1}));
  EXPECT_NE(shared[0], shared[4]);
  EXPECT_NE(shared[1], shared[3]);
}

TEST(KnownSharedNormals, OfPolygonsAreThoseOfTheirCorners) {
  for (const float lean : {0.0F, 0.1F}) {
    MeshSequence sequence = two_triangles({0, 0, 1}, {0, lean, 1});
    const std::vector<uint32_t> of_vertices = known_shared_normals(sequence);
    sequence.attributes[0].domain = AttributeDomain::kPolygon;
    sequence.attributes[0].values = {0, 0, 1, 0, lean, 1};
    EXPECT_EQ(known_shared_normals(sequence), of_vertices);
  }
}

TEST(KnownSharedNormals, AreThoseOfTheClipWhereItHasSome) {
  MeshSequence sequence = two_triangles({0, 0, 1}, {0, 0, 1});
  sequence.shared_normals = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(known_shared_normals(sequence), sequence.shared_normals);
  sequence.shared_normals.clear();
  sequence.attributes.clear();
  EXPECT_TRUE(known_shared_normals(sequence).empty());
}

TEST(ShareNormals, WantThreeComponents) {
  Attribute flat;
  flat.kind = AttributeKind::kNormal;
  flat.components = 2;
  EXPECT_THROW(share_normals(flat, {}, {}, 0), Error);
}

}  // namespace
}  // namespace anicodec
