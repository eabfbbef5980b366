// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/tools/io/alembic/alembic_testing.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

/// Six times the volume of some faces of a frame: above 0 where they face outwards.
double volume(const MeshSequence& clip, size_t frame, size_t first, size_t count) {
  double sum = 0;
  for (size_t p = first; p < first + count; ++p) {
    std::array<std::array<double, 3>, 3> at{};
    for (size_t c = 0; c < 3; ++c) {
      for (size_t k = 0; k < 3; ++k)
        at[c][k] = static_cast<double>(clip.frame(frame)[3 * clip.polygons[p][c] + k]);
    }
    const auto& [a, b, c] = at;
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

TEST(AlembicMirror, AtSomeTimesIsASecondMesh) {
  MeshSequence clip;
  clip.name = "tetrahedron";
  clip.vertex_count = 4;
  clip.frame_count = 1;
  clip.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const std::vector<uint32_t>& face :
       {std::vector<uint32_t>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
    clip.polygons.add(face);
  const std::string bytes =
      rewritten(archive_of_scene(scene_of(clip)), [](const AbcArchive& from, AbcArchiveOutput& to) {
        const uint32_t frames = to.shared().sampling({1.0 / 24, {0}});
        AbcObjectOutput& flip = to.top().child(
            "flip", "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform");
        AbcCompoundOutput& xform = flip.properties().compound(".xform", "schema=AbcGeom_Xform_v3");
        xform.scalar(".inherits", "", AbcType::kBool, 1, 0).add_one(uint8_t{1});
        xform.scalar(".ops", "", AbcType::kUint8, 1, 0).add_one(uint8_t{0});  // scale
        AbcPropertyOutput& values = xform.scalar(".vals", "", AbcType::kFloat64, 3, frames);
        for (const double x : {-2.0, 0.0, 2.0, 0.0, -2.0})
          values.add(std::span<const double>(std::array{x, 1.0, 1.0}));
        copy_object(from, 0, flip, [](const AbcProperty&, std::string&) {});
      });
  const MeshSequence read = read_bytes_of_archive(bytes);
  ASSERT_EQ(read.frame_count, 5U);
  ASSERT_EQ(read.polygons.size(), 8U);
  ASSERT_EQ(read.parts.names.size(), 2U);
  EXPECT_EQ(read.parts.names[1], read.parts.names[0] + " mirrored");
  const double of_plain[] = {0, 0, 2, 0, 0}, of_mirrored[] = {2, 0, 0, 0, 2};
  for (size_t f = 0; f < 5; ++f) {
    EXPECT_NEAR(volume(read, f, 0, 4), of_plain[f], 1e-6) << f;
    EXPECT_NEAR(volume(read, f, 4, 4), of_mirrored[f], 1e-6) << f;
  }
}

}  // namespace
}  // namespace anicodec::tools
