// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/linear_segment_encode.h"

#include "codec/connectivity/mesh_layout.h"
#include "codec/segment/encoded_segment.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/segment/surface_regions.h"
#include "sdk/play/play.h"
#include "sdk/segment/keep_frames.h"
#include "tests/sdk/position_tolerance.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr uint32_t kWaveWidth = 24, kWaveHeight = 20, kWaveFrames = 18;

/// A sheet of two halves that wave apart.
class Sheet {
 public:
  Sheet() {
    MeshSequence source;
    source.vertex_count = kWaveWidth * kWaveHeight;
    source.frame_count = 1;
    for (uint32_t y = 0; y + 1 < kWaveHeight; ++y)
      for (uint32_t x = 0; x + 1 < kWaveWidth; ++x)
        source.polygons.add(std::vector<uint32_t>{y * kWaveWidth + x, y * kWaveWidth + x + 1,
                                                  (y + 1) * kWaveWidth + x + 1,
                                                  (y + 1) * kWaveWidth + x});
    for (uint32_t v = 0; v < source.vertex_count; ++v)
      source.positions.insert(source.positions.end(), {float(v % kWaveWidth), float(v / kWaveWidth),
                                                       0.01F * float(v * v % 7)});
    layout = lay_out_mesh(source);
    copies.assign(layout.sizes.coded_vertices, 1);
    for (uint32_t f = 0; f < kWaveFrames; ++f) {
      for (uint32_t v : layout.coded_source) {
        const double x = v % kWaveWidth, y = v / kWaveWidth;
        const double z = x < kWaveWidth / 2. ? std::sin(0.8 * y + 0.7 * f) + std::sin(1.9 * y - f)
                                             : std::sin(0.9 * x + 0.4 * f) + std::cos(0.2 * x * f);
        positions.insert(positions.end(), {static_cast<float>(x + 0.1 * f), static_cast<float>(y),
                                           static_cast<float>(z)});
      }
    }
  }

  FrameView view() const { return {positions.data(), kWaveFrames, layout.sizes.coded_vertices}; }

  LinearBasis basis(uint32_t regions, bool scattered = false) const {
    const LinearAnalysis analysis(view());
    if (regions == 1)
      return analysis.basis(BasisKind::kEigentrajectories, ReferencePose::kRankThree, Base::kAffine,
                            1000, 0);
    Vector<uint8_t> of_vertex(layout.sizes.coded_vertices);
    for (uint32_t v = 0; v < of_vertex.size(); ++v)
      of_vertex[v] = static_cast<uint8_t>(
          (scattered ? v : layout.coded_source[v] % kWaveWidth * regions / kWaveWidth) % regions);
    return RegionAnalysis(
               std::make_shared<const RegionClips>(view(), of_vertex, regions),
               std::make_shared<const Eigen::MatrixXd>(analysis.space_of_trajectories(1000)))
        .basis(analysis, ReferencePose::kRankThree, 1000);
  }

  EncodedSegment encode(const LinearBasis& basis, const LinearSettings& settings,
                        const Vector<uint32_t>& runs = {}) const {
    std::optional<EncodedSegment> coded = encode_linear(
        view(), basis, settings, layout,
        encode_reference_pose(basis.pose, basis.origin, pose_step(settings, kWaveFrames), layout),
        runs);
    EXPECT_TRUE(coded.has_value());
    return std::move(*coded);
  }

  double rmse(const Segment& segment) const {
    return std::sqrt(measure(segment, view(), copies).squared / (kWaveFrames * copies.size()));
  }

  MeshLayout layout;
  std::vector<float> positions;
  std::vector<uint32_t> copies;
};

LinearSettings fine() {
  LinearSettings settings;
  settings.step = 0.01;
  settings.refit_weights = true;
  return settings;
}

TEST(LinearSegmentEncode, ComesAsNearWithRegionsAsWithout) {
  const Sheet sheet;
  for (uint32_t regions : {1U, 2U, 5U, 8U}) {
    for (bool scattered : {false, true}) {
      EncodedSegment coded = sheet.encode(sheet.basis(regions, scattered), fine());
      EXPECT_EQ(coded.sizes.regions, regions);
      EXPECT_EQ(coded.pose.empty(), regions == 1);
      const Segment opened = open_encoded(coded, sheet.layout);
      EXPECT_EQ(opened.regions, regions);
      EXPECT_EQ(opened.vertex_region.empty(), regions == 1);
      EXPECT_LT(sheet.rmse(opened), 0.02) << regions << scattered;
    }
  }
}

TEST(LinearSegmentEncode, TakesFewerComponentsInRegionsThatMoveApart) {
  const Sheet sheet;
  const EncodedSegment whole = sheet.encode(sheet.basis(1), fine()),
                       halves = sheet.encode(sheet.basis(2), fine());
  EXPECT_LT(halves.sizes.components, whole.sizes.components);
  EXPECT_LT(halves.bytes(), whole.bytes());
}

TEST(LinearSegmentEncode, RegionsGoWithEveryLayerAndRun) {
  const Sheet sheet;
  for (const bool anew : {false, true}) {
    LinearSettings settings = fine();
    settings.layers = 3;
    settings.layers_anew = anew;
    settings.passes_per_level = 3;
    settings.joint_lambda = 0.2;
    settings.components = {6, 0, 3};
    settings.run_steps = {0, 4};
    EncodedSegment coded = sheet.encode(sheet.basis(3, true), settings, {10, 8});
    EXPECT_EQ(coded.sizes.components, 6u);
    const Segment opened = open_encoded(coded, sheet.layout);
    for (uint32_t f : {0U, 9U, 10U, 17U}) {
      std::vector<float> x(size_t{3} * opened.vertices);
      play(frame_state(opened, f), 0, opened.vertices, x.data());
      EXPECT_LE(tolerance_used(opened, f, x), 1);
    }
  }
}

TEST(LinearSegmentEncode, KnowsWhatItsStreamsDecodeTo) {
  const Sheet sheet;
  for (uint32_t regions : {1U, 3U}) {
    LinearSettings settings = fine();
    settings.layers = 2;
    settings.refit_weights = regions == 1;
    settings.run_steps = {0, 4};
    EncodedSegment coded = sheet.encode(sheet.basis(regions), settings, {10, 8});
    EncodedSegment unknown = coded;
    unknown.decoded.reset();
    const Segment known = open_encoded(coded, sheet.layout),
                  decoded = open_encoded(unknown, sheet.layout);
    EXPECT_FALSE(coded.decoded.has_value());
    EXPECT_EQ(coded.hash, unknown.hash);
    EXPECT_EQ(known.wide, decoded.wide);
    EXPECT_EQ(known.narrow, decoded.narrow);
    EXPECT_EQ(known.weights, decoded.weights);
    EXPECT_EQ(known.vertex_region, decoded.vertex_region);
    ASSERT_EQ(known.pose_maps.size(), decoded.pose_maps.size());
    for (size_t i = 0; i < known.pose_maps.size(); ++i)
      EXPECT_TRUE(
          std::equal(known.pose_maps[i].m, known.pose_maps[i].m + 12, decoded.pose_maps[i].m));
  }
}

TEST(LinearSegmentEncode, RegionsPlayAsBeforeWithFewerFrames) {
  const Sheet sheet;
  EncodedSegment coded = sheet.encode(sheet.basis(4), fine());
  const Segment whole = open_encoded(coded, sheet.layout);
  Segment part = whole;
  keep_frames(5, 4, &part);
  for (uint32_t f = 0; f < 4; ++f) {
    std::vector<float> a(size_t{3} * part.vertices), b(a.size());
    play(frame_state(part, f), 0, part.vertices, a.data());
    play(frame_state(whole, 5 + f), 0, part.vertices, b.data());
    EXPECT_EQ(a, b) << f;
  }
}

}  // namespace
}  // namespace anicodec
