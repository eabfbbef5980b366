// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/metrics/hausdorff.h"

#include "codec/sequence/error.h"
#include "corpus/clips.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

struct Shape {
  Polygons polygons;
  std::vector<float> positions;
};

HausdorffDistance between(const Shape& a, const Shape& b) {
  return hausdorff(a.polygons, a.positions, b.polygons, b.positions);
}

/// A square of side `side` at height z, as one quad, cornered at the origin.
Shape square_at(float side, float z) {
  Shape s;
  s.polygons.add(std::vector<uint32_t>{0, 1, 2, 3});
  s.positions = {0, 0, z, side, 0, z, side, side, z, 0, side, z};
  return s;
}

Shape frame_of(const MeshSequence& s, size_t f) {
  return {s.polygons, {s.frame(f).begin(), s.frame(f).end()}};
}

TEST(Hausdorff, ParallelSquaresAreTheirDistanceApart) {
  HausdorffDistance d = between(square_at(1, 0), square_at(1, 0.75F));
  for (const SurfaceDistance& way : {d.forward, d.backward}) {
    EXPECT_DOUBLE_EQ(way.mean, 0.75);
    EXPECT_DOUBLE_EQ(way.rms, 0.75);
    EXPECT_DOUBLE_EQ(way.max, 0.75);
  }
}

TEST(Hausdorff, IsNotTheSameBothWays) {
  // From the small square every point is 0.5 below the large one; from the large one the far corner
  // is (1, 1, 0.5) from the corner of the small.
  HausdorffDistance d = between(square_at(1, 0), square_at(2, 0.5F));
  EXPECT_DOUBLE_EQ(d.forward.max, 0.5);
  EXPECT_DOUBLE_EQ(d.forward.mean, 0.5);
  EXPECT_DOUBLE_EQ(d.backward.max, 1.5);
  EXPECT_DOUBLE_EQ(d.max(), 1.5);
  EXPECT_GT(d.backward.mean, 0.5);
  EXPECT_EQ(d.mean(), d.backward.mean);
  EXPECT_EQ(d.rms(), d.backward.rms);
}

TEST(Hausdorff, ShiftedCubeIsItsShiftApart) {
  MeshSequence box = corpus::make_clip("quad_box");
  Shape a = frame_of(box, 0), b = a;
  for (size_t i = 0; i < b.positions.size(); i += 3)
    b.positions[i] += 0.25F;
  HausdorffDistance d = between(a, b);
  EXPECT_NEAR(d.max(), 0.25, 1e-7);
  // Two of six sides are 0.25 away, the others slide in themselves but for what sticks out.
  EXPECT_GT(d.mean(), 0.25 / 3);
  EXPECT_LT(d.mean(), 0.25 / 2);
}

TEST(Hausdorff, WeighsByAreaNotByTheNumberOfSamples) {
  // A tilted square: the distance to the plane grows linearly from 0 to 1, whatever the
  // tessellation. The second is cut very unevenly.
  Shape plane = square_at(100, 0);
  for (size_t i = 0; i < plane.positions.size(); i += 3) {
    plane.positions[i] -= 50;
    plane.positions[i + 1] -= 50;
  }
  Shape even;
  even.polygons.add(std::vector<uint32_t>{0, 1, 2, 3});
  even.positions = {0, 0, 0, 1, 0, 1, 1, 1, 1, 0, 1, 0};
  Shape uneven;
  for (uint32_t i = 0; i <= 20; ++i) {
    float x = i == 20 ? 1 : 0.01F * static_cast<float>(i);
    for (float y : {0.F, 1.F})
      uneven.positions.insert(uneven.positions.end(), {x, y, x});
    if (i > 0)
      uneven.polygons.add(std::vector<uint32_t>{2 * i - 2, 2 * i, 2 * i + 1, 2 * i - 1});
  }
  for (const Shape& tilted : {even, uneven}) {
    SurfaceDistance d = between(tilted, plane).forward;
    EXPECT_NEAR(d.mean, 0.5, 1e-12);
    EXPECT_NEAR(d.rms, std::sqrt(1.0 / 3), 1e-12);
    EXPECT_DOUBLE_EQ(d.max, 1);
  }
}

TEST(Hausdorff, OtherTessellationOfTheSameSurfaceIsZero) {
  MeshSequence s = corpus::make_clip("polygons");
  Shape a = frame_of(s, 7), b = a;
  b.polygons = {};
  for (size_t p = 0; p < a.polygons.size(); ++p) {
    auto polygon = a.polygons[p];
    for (size_t c = 2; c < polygon.size(); ++c)
      b.polygons.add(std::vector<uint32_t>{polygon[c], polygon[0], polygon[c - 1]});
  }
  EXPECT_LT(between(a, b).max(), 1e-15);
}

TEST(Hausdorff, DegenerateTrianglesCountAsSegmentsAndPoints) {
  Shape segment;
  segment.polygons.add(std::vector<uint32_t>{0, 1, 1});
  segment.positions = {0, 0, 1, 1, 0, 1};
  HausdorffDistance d = between(segment, square_at(1, 0));
  EXPECT_DOUBLE_EQ(d.forward.mean, 1);
  EXPECT_DOUBLE_EQ(d.forward.max, 1);
  EXPECT_DOUBLE_EQ(d.backward.max, std::sqrt(2));
  EXPECT_EQ(between(segment, segment).max(), 0);
}

TEST(Hausdorff, UnusedVerticesAreNotPartOfASurface) {
  Shape a = square_at(1, 0), b = a;
  b.positions.insert(b.positions.end(), {50, 50, 50});
  EXPECT_LT(between(a, b).max(), 1e-15);
}

TEST(Hausdorff, PointCloudsUseTheNearestVertex) {
  Shape a, b;
  a.positions = {0, 0, 0, 1, 0, 0, 0, 3, 0};
  b.positions = {0, 0, 0, 1, 0, 2};
  HausdorffDistance d = between(a, b);
  EXPECT_DOUBLE_EQ(d.forward.max, 3);
  EXPECT_DOUBLE_EQ(d.forward.mean, (0 + 1 + 3) / 3.0);
  EXPECT_DOUBLE_EQ(d.forward.rms, std::sqrt((0 + 1 + 9) / 3.0));
  EXPECT_DOUBLE_EQ(d.backward.max, 2);
  // A cloud against a surface: its points to the surface, the surface to its points.
  HausdorffDistance mixed = between(b, square_at(1, 0));
  EXPECT_DOUBLE_EQ(mixed.forward.max, 2);
  EXPECT_DOUBLE_EQ(mixed.backward.max, std::sqrt(2));
}

TEST(Hausdorff, SmallAndFarSurfacesKeepTheirDigits) {
  MeshSequence s = corpus::make_clip("far");
  Shape a = frame_of(s, 30), b = a;
  for (size_t i = 2; i < b.positions.size(); i += 3)
    b.positions[i] += 1.F / 4096;
  EXPECT_GT(between(a, b).max(), 0);
  EXPECT_LE(between(a, b).max(), 1.0 / 4096);
  MeshSequence tiny = corpus::make_clip("tiny");
  HausdorffDistance d = between(frame_of(tiny, 0), frame_of(tiny, 5));
  HausdorffDistance same =
      between(frame_of(corpus::make_clip("large"), 0), frame_of(corpus::make_clip("large"), 5));
  EXPECT_DOUBLE_EQ(std::ldexp(d.max(), 80), same.max());
  EXPECT_DOUBLE_EQ(std::ldexp(d.mean(), 80), same.mean());
}

TEST(Hausdorff, ComparesClipsFrameByFrame) {
  MeshSequence a = corpus::make_clip("open_pair"), b = a;
  // Other connectivity: a vertex more, used by none.
  b.vertex_count += 1;
  b.positions.clear();
  for (uint32_t f = 0; f < a.frame_count; ++f) {
    for (size_t i = 0; i < a.frame(f).size(); ++i)
      b.positions.push_back(a.frame(f)[i] + (f == 7 && i % 3 == 2 ? 0.125F : 0));
    b.positions.insert(b.positions.end(), {9, 9, 9});
  }
  SurfaceComparison c = compare_surfaces(a, b);
  ASSERT_EQ(c.frames.size(), a.frame_count);
  EXPECT_EQ(c.max_frame, 7U);
  EXPECT_LT(c.frames[6].max(), 1e-15);
  EXPECT_EQ(c.total.max(), c.frames[7].max());
  EXPECT_LE(c.total.max(), 0.125);
  EXPECT_GT(c.total.max(), 0.05);
  EXPECT_NEAR(c.total.forward.mean, c.frames[7].forward.mean / a.frame_count, 1e-15);
  EXPECT_DOUBLE_EQ(c.total.backward.rms,
                   c.frames[7].backward.rms / std::sqrt(double(a.frame_count)));
  EXPECT_DOUBLE_EQ(c.diagonal, diagonal(a));
  SurfaceComparison again = compare_surfaces(a, b);
  EXPECT_EQ(c.total.mean(), again.total.mean());
  EXPECT_EQ(c.total.rms(), again.total.rms());
}

TEST(Hausdorff, DoesNotDependOnTheNumberOfThreads) {
  MeshSequence s = corpus::make_clip("limb");
  Shape a = frame_of(s, 0), b = frame_of(s, 9);
  auto with_threads = [&](size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return between(a, b);
  };
  HausdorffDistance one = with_threads(1), many = with_threads(4);
  EXPECT_EQ(one.forward.mean, many.forward.mean);
  EXPECT_EQ(one.backward.rms, many.backward.rms);
  EXPECT_EQ(one.max(), many.max());
}

TEST(Hausdorff, RefusesWhatHasNoDistance) {
  Shape empty;
  EXPECT_THROW(between(empty, square_at(1, 0)), Error);
  EXPECT_THROW(between(square_at(1, 0), empty), Error);
  Shape bad = square_at(1, 0);
  bad.positions[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(between(square_at(1, 0), bad), Error);
  EXPECT_THROW(between(bad, square_at(1, 0)), Error);
  Shape cut_short = square_at(1, 0);
  cut_short.positions.resize(9);
  EXPECT_THROW(between(cut_short, square_at(1, 0)), Error);
  EXPECT_THROW(compare_surfaces(corpus::make_clip("cuts"), corpus::make_clip("static")), Error);
}

}  // namespace
}  // namespace anicodec
