// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The files of tests/conformance/, and the example that the specification takes apart.
#include "build_paths.h"
#include "corpus/clips.h"
#include "sdk/clip/sample.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

const std::string kSource = ANICODEC_SOURCE_DIR;

struct ConformanceVector {
  const char* file;
  const char* clip;
  uint32_t vertices = 0, frames = 0;  ///< when it is scaled
};

Bytes read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Conformance : public testing::TestWithParam<ConformanceVector> {};

TEST_P(Conformance, DecodesAsTheFileSays) {
  Clip clip;
  Failure failure = clip.open(read(kSource + "/tests/conformance/" + GetParam().file));
  ASSERT_TRUE(failure.ok()) << status_string(failure.status) << ": " << failure.detail;
  EXPECT_TRUE(clip.check_hashes().ok());
  const MeshSequence source =
      GetParam().frames == 0
          ? corpus::make_clip(GetParam().clip)
          : corpus::make_scaled(GetParam().clip, GetParam().vertices, GetParam().frames);
  ASSERT_EQ(clip.vertex_count(), source.vertex_count);
  ASSERT_EQ(clip.frame_count(), source.frame_count);
  std::vector<float> played(size_t{3} * source.vertex_count);
  double largest = 0;
  for (uint32_t f = 0; f < clip.frame_count(); ++f) {
    ASSERT_EQ(show_positions(clip, 0, f, played.data()), Status::kOk);
    for (size_t v = 0; v < source.vertex_count; ++v) {
      double squared = 0;
      for (size_t c = 0; c < 3; ++c)
        squared += std::pow(double{played[3 * v + c]} - double{source.frame(f)[3 * v + c]}, 2);
      largest = std::max(largest, std::sqrt(squared));
    }
  }
  EXPECT_NEAR(largest, clip.clips()[0].max_error, 1e-4 * clip.clips()[0].max_error);
  for (const AttributeError& error : clip.clips()[0].attribute_errors) {
    const MeshAttribute& stored = clip.meshes()[0].attributes[error.attribute];
    const auto of = std::ranges::find(source.attributes, stored.header.kind, &Attribute::kind);
    ASSERT_NE(of, source.attributes.end());
    std::vector<float> values(stored.values.size());
    double furthest = 0;
    for (uint32_t f = 0; f < clip.frame_count(); ++f) {
      ASSERT_EQ(show_attribute(clip, 0, error.attribute, f, values.data()), Status::kOk);
      for (size_t i = 0; i < values.size(); ++i)
        furthest = std::max(
            furthest, std::abs(double{values[i]} - double{of->values[f * values.size() + i]}));
    }
    EXPECT_NEAR(furthest, error.max_error, 1e-3 * error.max_error);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, Conformance,
    testing::Values(ConformanceVector{"triangle.anic", "one_triangle"},
                    ConformanceVector{"nonmanifold_keyframes.anic", "nonmanifold"},
                    ConformanceVector{"polygons_all.anic", "polygons"},
                    ConformanceVector{"quad_box_corrected.anic", "quad_box"},
                    ConformanceVector{"soup.anic", "soup"},
                    ConformanceVector{"limb_effort9.anic", "limb"},
                    ConformanceVector{"limb_small.anic", "limb", 100, 8},
                    ConformanceVector{"far_rigid.anic", "far"},
                    ConformanceVector{"uneven_times.anic", "uneven"},
                    ConformanceVector{"leftovers.anic", "leftovers"},
                    ConformanceVector{"one_frame.anic", "one_frame"},
                    ConformanceVector{"one_vertex.anic", "one_vertex"},
                    ConformanceVector{"nonmanifold_interpolated.anic", "nonmanifold"},
                    ConformanceVector{"limb_default.anic", "limb", 200, 12},
                    ConformanceVector{"limb_native.anic", "limb", 200, 12},
                    ConformanceVector{"painted_box.anic", "painted_box"},
                    ConformanceVector{"heated.anic", "heated"}),
    [](const auto& vector) {
      return std::string(vector.param.file, std::string(vector.param.file).find('.'));
    });

TEST(ConformanceExample, IsTheFileThatTheSpecificationShows) {
  std::ifstream page(kSource + "/spec/A-examples.md");
  const std::regex bytes_of_line(R"(^([0-9a-f]{4}) +((?:[0-9a-f]{2} )+) .*)");
  Bytes shown;
  std::string line;
  while (std::getline(page, line)) {
    std::smatch match;
    if (!std::regex_match(line, match, bytes_of_line))
      continue;
    EXPECT_EQ(std::stoul(match[1], nullptr, 16), shown.size()) << line;
    for (size_t i = 0; i + 3 <= match[2].str().size(); i += 3)
      shown.push_back(static_cast<uint8_t>(std::stoul(match[2].str().substr(i, 2), nullptr, 16)));
  }
  EXPECT_EQ(shown, read(kSource + "/tests/conformance/triangle.anic"));
}

}  // namespace
}  // namespace anicodec
