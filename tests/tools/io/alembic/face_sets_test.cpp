// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/tools/io/alembic/alembic_testing.h"

#include <cstdint>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(AlembicFaceSets, ThatShareFacesAreNamed) {
  MeshSequence clip;
  clip.vertex_count = 4;
  clip.frame_count = 1;
  clip.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  clip.polygons.add(std::vector<uint32_t>{0, 1, 2});
  clip.polygons.add(std::vector<uint32_t>{1, 3, 2});
  clip.materials = {{"a", "b"}, {0, 1}};
  const std::string bytes =
      rewritten(archive_of_scene(scene_of(clip)), [](const AbcArchive& from, AbcArchiveOutput& to) {
        copy_object(from, 0, to.top(), [](const AbcProperty& property, std::string& sample) {
          const int32_t second = 1;
          if (property.name == ".faces" &&
              std::memcmp(sample.data() + sample.size() - 4, &second, 4) == 0)
            std::memset(sample.data() + sample.size() - 4, 0, 4);  // of the first set, too
        });
      });
  std::string notes;
  AlembicOptions options;
  options.note = [&](const std::string& text) { notes += text + "\n"; };
  const MeshSequence read = read_bytes_of_archive(bytes, options);
  EXPECT_EQ(read.materials.of_polygon, (std::vector<uint32_t>{0, kNoLabel}));
  EXPECT_NE(notes.find("1 faces of face set 'b' are in 'a', too, and stay there alone"),
            std::string::npos)
      << notes;
}

}  // namespace
}  // namespace anicodec::tools
