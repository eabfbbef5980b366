// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Outline {
  std::vector<std::array<float, 3>> corners;

  std::vector<float> positions() const {
    std::vector<float> out;
    for (const auto& c : corners)
      out.insert(out.end(), c.begin(), c.end());
    return out;
  }

  Polygons polygon() const {
    Polygons out;
    std::vector<uint32_t> all;
    for (uint32_t v = 0; v < corners.size(); ++v)
      all.push_back(v);
    out.add(all);
    return out;
  }

  /// Twice the signed area of some corners, seen from above.
  double area(const std::vector<uint32_t>& ring) const {
    double sum = 0;
    for (size_t i = 0; i < ring.size(); ++i) {
      const auto &a = corners[ring[i]], &b = corners[ring[(i + 1) % ring.size()]];
      sum += static_cast<double>(a[0]) * static_cast<double>(b[1]) -
             static_cast<double>(a[1]) * static_cast<double>(b[0]);
    }
    return sum;
  }
};

/// Every triangle faces as the polygon does, and together they are its area: it is covered once. Every corner is used.
void expect_covered(const Outline& outline) {
  const Polygons polygon = outline.polygon();
  const std::vector<uint32_t> cut = corner_triangles(polygon, outline.positions());
  const double whole = outline.area({polygon.corners.begin(), polygon.corners.end()});
  double sum = 0;
  ASSERT_EQ(cut.size(), 3 * (outline.corners.size() - 2));
  for (size_t i = 0; i < cut.size(); i += 3) {
    const double area = outline.area({cut[i], cut[i + 1], cut[i + 2]});
    EXPECT_GE(area * whole, -1e-6);
    sum += area;
  }
  EXPECT_NEAR(sum, whole, 1e-5 * std::abs(whole));
  EXPECT_EQ(std::set<uint32_t>(cut.begin(), cut.end()).size(), outline.corners.size());
}

const Outline kL{{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}};
const Outline kDart{{{0, 0, 0}, {1, 0.25F, 0}, {2, 0, 0}, {1, 2, 0}}};

TEST(Triangulate, CoversConcavePolygonsOnceFromWhateverCornerTheyBegin) {
  // A comb, whose teeth no fan reaches, and a square ring whose hole a bridge joins to the outline.
  Outline comb{{{0, 0, 0}, {9, 0, 0}}};
  for (int i = 9; i > 0; --i)
    comb.corners.push_back({static_cast<float>(i) - 0.5F, i % 2 == 0 ? 1.0F : 4.0F, 0});
  const Outline ring{{{0, 0, 0},
                      {4, 0, 0},
                      {4, 4, 0},
                      {0, 4, 0},
                      {0, 0, 0},
                      {1, 1, 0},
                      {1, 3, 0},
                      {3, 3, 0},
                      {3, 1, 0},
                      {1, 1, 0}}};
  for (Outline outline : {kL, kDart, comb, ring}) {
    for (size_t start = 0; start < outline.corners.size(); ++start) {
      expect_covered(outline);
      std::ranges::reverse(outline.corners);
      expect_covered(outline);
      std::ranges::reverse(outline.corners);
      std::ranges::rotate(outline.corners, outline.corners.begin() + 1);
    }
  }
}

TEST(Triangulate, KeepsCornersInTheMiddleOfStraightSides) {
  expect_covered({{{0, 0, 0},
                   {1, 0, 0},
                   {2, 0, 0},
                   {3, 0, 0},
                   {3, 1, 0},
                   {2, 1, 0},
                   {1, 1, 0},
                   {1, 2, 0},
                   {1, 3, 0},
                   {0, 3, 0},
                   {0, 2, 0},
                   {0, 1, 0}}});
}

TEST(Triangulate, CutsPolygonsThatAreNotFlatInAnyDirection) {
  Outline bent = kL;
  for (size_t c = 0; c < bent.corners.size(); ++c)
    bent.corners[c][2] = 0.2F * std::sin(static_cast<float>(3 * c));
  expect_covered(bent);
  Outline upright = bent;  // x -> y, y -> z, z -> x
  for (size_t c = 0; c < bent.corners.size(); ++c)
    upright.corners[c] = {bent.corners[c][2], bent.corners[c][0], bent.corners[c][1]};
  const std::vector<uint32_t> a = corner_triangles(bent.polygon(), bent.positions());
  const std::vector<uint32_t> b = corner_triangles(upright.polygon(), upright.positions());
  double sum = 0;
  for (size_t i = 0; i < b.size(); i += 3)
    sum += bent.area({b[i], b[i + 1], b[i + 2]});
  EXPECT_NEAR(sum, 10, 1e-5);
  EXPECT_EQ(a.size(), b.size());
}

TEST(Triangulate, LeavesAFanWhereAPolygonCrossesItself) {
  const Outline bow{{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 3, 0}}};
  EXPECT_EQ(corner_triangles(bow.polygon(), bow.positions()).size(), 6U);
}

TEST(Triangulate, LeavesFansAsTheyAre) {
  Polygons polygons;
  for (const std::vector<uint32_t>& p :
       {std::vector<uint32_t>{0, 1, 2, 3}, {0, 1}, {3, 2, 1}, {}, {0, 0, 0, 0}})
    polygons.add(p);
  const std::vector<float> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  EXPECT_THAT(corner_triangles(polygons, positions),
              testing::ElementsAre(0, 1, 2, 0, 2, 3, 6, 7, 8, 9, 10, 11, 9, 11, 12));
  EXPECT_THAT(triangulated(polygons, positions).corners,
              testing::ElementsAre(0, 1, 2, 0, 2, 3, 3, 2, 1, 0, 0, 0, 0, 0, 0));
}

}  // namespace
}  // namespace anicodec
