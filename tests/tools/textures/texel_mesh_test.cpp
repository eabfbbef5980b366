// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/texel_mesh.h"

#include "tests/tools/textures/shown_textures.h"

namespace anicodec::tools {
namespace {

std::vector<TexelPlace> diagonal_places(uint32_t count) {
  std::vector<TexelPlace> places;
  for (uint32_t v = 0; v < count; ++v)
    places.emplace_back((v + 0.5) / count, (v + 0.5) / count);
  return places;
}

TEST(TexelMesh, HardEdgesHaveTexelsOfTheirOwn) {
  const MeshSequence smooth = limb(), hard = limb(true);
  EXPECT_EQ(TexelMesh(smooth).vertex_count(), smooth.vertex_count);
  const TexelMesh mesh(hard);
  EXPECT_EQ(mesh.vertex_count(), hard.polygons.corners.size());
  const std::vector<float> normals = mesh.normals(hard.frame(3));
  EXPECT_EQ(normals.size(), 3 * hard.polygons.corners.size());
  const GlbSurface surface(mesh.glb(hard.frame(0), diagonal_places(mesh.vertex_count())));
  EXPECT_EQ(surface.size(), mesh.vertex_count());
}

TEST(TexelMesh, TexturePlacesAreTheSecondCoordinates) {
  for (const MeshSequence& clip : {limb(), limb(true)}) {
    const TexelMesh mesh(clip);
    const uint32_t count = mesh.vertex_count();
    const GlbSurface surface(mesh.glb(clip.frame(0), diagonal_places(count)));
    const std::vector<float> positions = mesh.positions(clip.frame(0));
    for (uint32_t v = 0; v < count; ++v) {
      EXPECT_NEAR(surface.u(v), surface.v(v), 1e-6);
      const V3 at = GlbSurface::at(positions, static_cast<uint32_t>(surface.u(v) * count));
      for (size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(surface.rest(v)[c], at[c], 1e-6);
    }
  }
}

TEST(TexelMesh, PointsHavePlacesAndNoNormals) {
  MeshSequence clip = limb();
  clip.polygons = {};
  const TexelMesh mesh(clip);
  EXPECT_FALSE(mesh.has_normals());
  EXPECT_EQ(mesh.vertex_count(), clip.vertex_count);
  EXPECT_FALSE(mesh.glb(clip.frame(0), diagonal_places(clip.vertex_count)).empty());
}

}  // namespace
}  // namespace anicodec::tools
