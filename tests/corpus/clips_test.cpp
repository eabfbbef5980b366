// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/clips.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::corpus {
namespace {

/// How many faces use each undirected edge; repeated corners make none.
std::map<std::pair<uint32_t, uint32_t>, int> edges(const Polygons& polygons) {
  std::map<std::pair<uint32_t, uint32_t>, int> result;
  for (size_t p = 0; p < polygons.size(); ++p) {
    auto polygon = polygons[p];
    for (size_t c = 0; c < polygon.size(); ++c) {
      uint32_t a = polygon[c], b = polygon[(c + 1) % polygon.size()];
      if (a != b)
        ++result[std::minmax(a, b)];
    }
  }
  return result;
}

int edges_of(const MeshSequence& s, int faces) {
  auto all = edges(s.polygons);
  return static_cast<int>(
      std::count_if(all.begin(), all.end(), [faces](auto& e) { return e.second == faces; }));
}

/// Connected components over shared vertices, unused vertices left out.
size_t components(const MeshSequence& s) {
  std::vector<uint32_t> parent(s.vertex_count);
  std::iota(parent.begin(), parent.end(), 0U);
  auto root = [&](uint32_t v) {
    while (parent[v] != v)
      v = parent[v];
    return v;
  };
  for (size_t p = 0; p < s.polygons.size(); ++p) {
    for (uint32_t v : s.polygons[p])
      parent[root(v)] = root(s.polygons[p][0]);
  }
  std::set<uint32_t> roots;
  for (uint32_t v : s.polygons.corners)
    roots.insert(root(v));
  return roots.size();
}

size_t unused(const MeshSequence& s) {
  std::set<uint32_t> used(s.polygons.corners.begin(), s.polygons.corners.end());
  return s.vertex_count - used.size();
}

bool same_frame(const MeshSequence& s, size_t f, size_t g) {
  return std::memcmp(s.frame(f).data(), s.frame(g).data(), s.frame(f).size_bytes()) == 0;
}

bool is_static(const MeshSequence& s, uint32_t v) {
  for (size_t f = 1; f < s.frame_count; ++f) {
    if (std::memcmp(&s.frame(f)[3 * v], &s.frame(0)[3 * v], 12) != 0)
      return false;
  }
  return true;
}

size_t static_vertices(const MeshSequence& s) {
  size_t count = 0;
  for (uint32_t v = 0; v < s.vertex_count; ++v)
    count += is_static(s, v);
  return count;
}

size_t distinct_trajectories(const MeshSequence& s) {
  std::set<std::vector<float>> seen;
  for (uint32_t v = 0; v < s.vertex_count; ++v) {
    std::vector<float> trajectory;
    for (size_t f = 0; f < s.frame_count; ++f) {
      auto p = s.frame(f).subspan(3 * v, 3);
      trajectory.insert(trajectory.end(), p.begin(), p.end());
    }
    seen.insert(trajectory);
  }
  return seen.size();
}

double distance(std::span<const float> p, std::span<const float> q) {
  double square = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    square += std::pow(double{p[axis]} - double{q[axis]}, 2);
  return std::sqrt(square);
}

double distance(const MeshSequence& s, size_t f, uint32_t a, uint32_t b) {
  return distance(s.frame(f).subspan(3 * a, 3), s.frame(f).subspan(3 * b, 3));
}

/// Largest move of any vertex from a frame to the next.
double step(const MeshSequence& s, size_t f) {
  double most = 0;
  for (uint32_t v = 0; v < s.vertex_count; ++v)
    most = std::max(most, distance(s.frame(f).subspan(3 * v, 3), s.frame(f + 1).subspan(3 * v, 3)));
  return most;
}

TEST(Clips, AllPassTheCheckAndCarryTheirNames) {
  EXPECT_GE(clips().size(), 20U);
  for (const ClipInfo& clip : clips()) {
    SCOPED_TRACE(clip.name);
    MeshSequence s = make_clip(clip.name);
    EXPECT_NO_THROW(check(s));
    EXPECT_EQ(s.name, clip.name);
    EXPECT_EQ(clip.description.find_first_of("\"\\\n"), std::string::npos);
    EXPECT_FALSE(s.rate.assumed);
    EXPECT_LT(s.positions.size(), 1'000'000U);
    EXPECT_EQ(s.positions, make_clip(clip.name).positions);
  }
}

TEST(Clips, RefusesUnknownNamesListingTheKnownOnes) {
  try {
    make_clip("nothing");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    EXPECT_THAT(e.what(), testing::HasSubstr("\"nothing\""));
    for (const std::string& name : clip_names())
      EXPECT_THAT(e.what(), testing::HasSubstr(name));
  }
}

TEST(Clips, HoldNoNegativeZero) {
  for (const std::string& name : clip_names()) {
    SCOPED_TRACE(name);
    for (float x : make_clip(name).positions)
      ASSERT_FALSE(x == 0 && std::signbit(x));
  }
}

TEST(Clips, ClosedSurfacesAreManifold) {
  for (const char* name :
       {"limb", "rigid", "helix", "cuts", "static", "one_frame", "far", "quad_box"}) {
    SCOPED_TRACE(name);
    MeshSequence s = make_clip(name);
    EXPECT_EQ(edges_of(s, 2), static_cast<int>(edges(s.polygons).size()));
    // Orientable: every directed edge once.
    std::set<std::pair<uint32_t, uint32_t>> directed;
    for (size_t p = 0; p < s.polygons.size(); ++p) {
      auto polygon = s.polygons[p];
      for (size_t c = 0; c < polygon.size(); ++c)
        EXPECT_TRUE(directed.insert({polygon[c], polygon[(c + 1) % polygon.size()]}).second);
    }
  }
}

TEST(Clips, ClothIsPinnedAlongOneEdge) {
  MeshSequence s = make_clip("cloth");
  for (uint32_t v = 0; v < s.vertex_count; ++v)
    EXPECT_EQ(is_static(s, v), v % 32 == 0) << v;
}

TEST(Clips, FaceIsPartlyStatic) {
  MeshSequence s = make_clip("face");
  EXPECT_GT(static_vertices(s), s.vertex_count / 10);
  EXPECT_LT(static_vertices(s), s.vertex_count / 2);
  EXPECT_EQ(edges_of(s, 1), 4 * 35);
}

TEST(Clips, RigidBodiesAreSevenComponentsThatKeepTheirEdgeLengths) {
  MeshSequence s = make_clip("rigid");
  EXPECT_EQ(components(s), 7U);
  for (auto& [e, faces] : edges(s.polygons)) {
    for (size_t f = 0; f < s.frame_count; f += 13)
      EXPECT_NEAR(distance(s, f, e.first, e.second), distance(s, 0, e.first, e.second), 1e-3);
  }
}

TEST(Clips, FarBoxIsRigidAndFarFromTheOrigin) {
  MeshSequence s = make_clip("far");
  EXPECT_LT(diagonal(s), 100);
  EXPECT_GT(s.positions[0], 2900);
  for (auto& [e, faces] : edges(s.polygons))
    EXPECT_NEAR(distance(s, 40, e.first, e.second), distance(s, 0, e.first, e.second), 2e-3);
}

TEST(Clips, HelixTurnsItsEndByMoreThanTwoTurnsAndKeepsItsLength) {
  MeshSequence s = make_clip("helix");
  // Darboux rate |(2.2, 0, 1.1)| times length 12.
  EXPECT_GT(std::hypot(2.2, 1.1) * 12, 4 * M_PI);
  auto cap = [&](size_t f, uint32_t back) {
    return s.frame(f).subspan(3 * (s.vertex_count - back), 3);
  };
  EXPECT_FLOAT_EQ(cap(0, 1)[2], 12);
  EXPECT_FLOAT_EQ(cap(0, 2)[2], 0);
  size_t last = s.frame_count - 1;
  EXPECT_FLOAT_EQ(cap(last, 2)[2], 0);
  // Pitch over the axis: the component of the tangent along the Darboux vector, 1.1 / |.|,
  // times 12.
  auto end = cap(last, 1);
  EXPECT_NEAR((double{end[0]} * 2.2 + double{end[2]} * 1.1) / std::hypot(2.2, 1.1),
              12 * 1.1 / std::hypot(2.2, 1.1), 1e-3);
}

TEST(Clips, CutsJumpAndOtherFramesDoNot) {
  MeshSequence s = make_clip("cuts");
  std::vector<double> steps;
  for (size_t f = 0; f + 1 < s.frame_count; ++f)
    steps.push_back(step(s, f));
  std::vector<double> smooth = steps;
  std::erase(smooth, steps[19]);
  std::erase(smooth, steps[39]);
  double most = *std::max_element(smooth.begin(), smooth.end());
  EXPECT_GT(steps[19], 3 * most);
  EXPECT_GT(steps[39], 3 * most);
}

TEST(Clips, RepeatsHoldEqualFrames) {
  MeshSequence s = make_clip("repeats");
  for (size_t f = 0; f < 30; f += 2)
    EXPECT_TRUE(same_frame(s, f, f + 1));
  for (size_t f = 31; f < 38; ++f)
    EXPECT_TRUE(same_frame(s, 30, f));
  EXPECT_TRUE(same_frame(s, 0, s.frame_count - 1));
  EXPECT_FALSE(same_frame(s, 0, 2));
}

TEST(Clips, StaticClipDoesNotMove) {
  MeshSequence s = make_clip("static");
  EXPECT_EQ(s.frame_count, 10U);
  EXPECT_EQ(static_vertices(s), s.vertex_count);
}

TEST(Clips, SmallestClipsHaveTheirCounts) {
  MeshSequence frame = make_clip("one_frame");
  EXPECT_EQ(frame.frame_count, 1U);
  MeshSequence triangle = make_clip("one_triangle");
  EXPECT_EQ(triangle.vertex_count, 3U);
  EXPECT_EQ(triangle.polygons.size(), 1U);
  EXPECT_FALSE(same_frame(triangle, 0, 1));
  MeshSequence vertex = make_clip("one_vertex");
  EXPECT_EQ(vertex.vertex_count, 1U);
  EXPECT_EQ(vertex.polygons.size(), 0U);
  EXPECT_FALSE(same_frame(vertex, 0, 1));
  MeshSequence points = make_clip("points");
  EXPECT_EQ(points.vertex_count, 500U);
  EXPECT_EQ(points.polygons.size(), 0U);
}

TEST(Clips, UnevenClipHasGrowingTimes) {
  MeshSequence s = make_clip("uneven");
  ASSERT_EQ(s.times.size(), s.frame_count);
  std::set<long> gaps;
  for (size_t f = 1; f < s.frame_count; ++f)
    gaps.insert(std::lround((s.times[f] - s.times[f - 1]) * 24));
  EXPECT_THAT(gaps, testing::ElementsAre(1, 2, 3, 4));
}

TEST(Clips, NonmanifoldHasEightEdgesOfThreeFacesAndABowTie) {
  MeshSequence s = make_clip("nonmanifold");
  EXPECT_EQ(edges_of(s, 3), 8);
  EXPECT_EQ(components(s), 1U);
  // Two groups of faces meet at vertex 8 without a common edge through it.
  std::map<uint32_t, std::set<uint32_t>> joined;
  for (size_t p = 0; p < s.polygons.size(); ++p) {
    auto t = s.polygons[p];
    if (std::find(t.begin(), t.end(), 8U) == t.end())
      continue;
    for (uint32_t a : t) {
      for (uint32_t b : t) {
        if (a != 8 && b != 8)
          joined[a].insert(b);
      }
    }
  }
  std::set<uint32_t> reached{joined.begin()->first};
  for (size_t before = 0; before != reached.size();) {
    before = reached.size();
    for (uint32_t a : std::set<uint32_t>(reached))
      reached.insert(joined[a].begin(), joined[a].end());
  }
  EXPECT_LT(reached.size(), joined.size());
  EXPECT_GT(reached.size(), 1U);
}

TEST(Clips, MoebiusStripHasOneBoundaryLoopAndNoOrientation) {
  MeshSequence s = make_clip("moebius");
  EXPECT_EQ(edges_of(s, 1), 2 * 40);
  EXPECT_EQ(edges_of(s, 3), 0);
  // Euler characteristic 0 with one boundary loop of all 80 edges: not a cylinder, which has two.
  EXPECT_EQ(static_cast<int>(s.vertex_count - edges(s.polygons).size() + s.polygons.size()), 0);
  std::map<uint32_t, std::vector<uint32_t>> next;
  for (auto& [e, faces] : edges(s.polygons)) {
    if (faces == 1) {
      next[e.first].push_back(e.second);
      next[e.second].push_back(e.first);
    }
  }
  uint32_t start = next.begin()->first, from = start, at = next[start][0];
  int length = 1;
  for (; at != start; ++length) {
    uint32_t to = next[at][0] == from ? next[at][1] : next[at][0];
    from = at;
    at = to;
  }
  EXPECT_EQ(length, 80);
}

TEST(Clips, OpenPairHasTwoComponentsWithBoundaries) {
  MeshSequence s = make_clip("open_pair");
  EXPECT_EQ(components(s), 2U);
  EXPECT_EQ(edges_of(s, 1), 2 * (13 + 8) + 2 * (6 + 16));
}

TEST(Clips, PolygonsMixTrianglesQuadsAndPentagons) {
  MeshSequence s = make_clip("polygons");
  std::map<size_t, int> sizes;
  for (size_t p = 0; p < s.polygons.size(); ++p)
    ++sizes[s.polygons[p].size()];
  EXPECT_EQ(sizes.size(), 3U);
  EXPECT_EQ(sizes[3], 36 * 2 + 36);
  EXPECT_EQ(sizes[4], 36);
  EXPECT_EQ(sizes[5], 36);
  EXPECT_EQ(edges_of(s, 3), 0);
  EXPECT_EQ(edges_of(s, 1), 2 * (12 + 9));
  MeshSequence box = make_clip("quad_box");
  EXPECT_EQ(box.polygons.size(), 6U * 25);
  EXPECT_EQ(box.polygons.corners.size(), 6U * 25 * 4);
  EXPECT_EQ(box.vertex_count, 152U);
}

TEST(Clips, ThePaintedBoxHasAttributesOfEveryDomain) {
  MeshSequence s = make_clip("painted_box");
  ASSERT_EQ(s.attributes.size(), 2U);
  EXPECT_EQ(s.attributes[0].values.size(), 2 * s.polygons.corners.size());
  EXPECT_EQ(s.attributes[1].values.size(), 3 * size_t{s.vertex_count});
  EXPECT_EQ(s.shared_normals.size(), s.polygons.corners.size());
  // Every side has its vertices for itself.
  EXPECT_EQ(std::set<uint32_t>(s.shared_normals.begin(), s.shared_normals.end()).size(), 6U * 25);
  EXPECT_EQ(s.materials.of_polygon.size(), s.polygons.size());
  EXPECT_EQ(s.parts.of_polygon.size(), s.polygons.size());
}

TEST(Clips, HeatedHasValuesInEveryFrameThatMoveAlikeAtTheSeam) {
  const MeshSequence s = make_clip("heated");
  EXPECT_EQ(distinct_trajectories(s), 225U);
  ASSERT_EQ(s.attributes.size(), 3U);
  for (const Attribute& a : s.attributes) {
    EXPECT_EQ(a.frames, s.frame_count);
    ASSERT_EQ(a.values.size(), size_t{a.components} * s.vertex_count * s.frame_count);
    const size_t row = size_t{a.components} * s.vertex_count;
    EXPECT_FALSE(std::equal(a.values.begin(), a.values.begin() + static_cast<ptrdiff_t>(row),
                            a.values.begin() + static_cast<ptrdiff_t>(row)))
        << a.name;
  }
}

TEST(Clips, SoupWeldsToASixthOfItsVertices) {
  MeshSequence s = make_clip("soup");
  EXPECT_EQ(s.vertex_count, 3 * s.polygons.size());
  EXPECT_EQ(components(s), s.polygons.size());
  // A closed triangle mesh has 2 n - 4 faces.
  EXPECT_EQ(distinct_trajectories(s) * 2 - 4, s.polygons.size());
}

TEST(Clips, LeftoversAreUnusedDegenerateAndDuplicate) {
  MeshSequence s = make_clip("leftovers");
  EXPECT_EQ(unused(s), 4U);
  EXPECT_EQ(distinct_trajectories(s), s.vertex_count - 1);
  int degenerate = 0, duplicates = 0;
  std::set<std::set<uint32_t>> seen;
  for (size_t p = 0; p < s.polygons.size(); ++p) {
    std::set<uint32_t> corners(s.polygons[p].begin(), s.polygons[p].end());
    if (corners.size() < s.polygons[p].size())
      ++degenerate;
    else if (!seen.insert(corners).second)
      ++duplicates;
  }
  EXPECT_EQ(degenerate, 3);
  EXPECT_EQ(duplicates, 3);
}

TEST(Clips, LargeAndTinyAreTheSameMotion) {
  MeshSequence large = make_clip("large"), tiny = make_clip("tiny");
  ASSERT_EQ(large.positions.size(), tiny.positions.size());
  for (size_t i = 0; i < large.positions.size(); ++i)
    ASSERT_EQ(large.positions[i], std::ldexp(tiny.positions[i], 80));
  EXPECT_GT(diagonal(large), 1e12);
  EXPECT_LT(diagonal(tiny), 1e-11);
}

TEST(Clips, ScaledClipsHaveAboutTheVerticesAndExactlyTheFrames) {
  for (const ClipInfo& clip : clips()) {
    if (!clip.scalable) {
      EXPECT_THROW(make_scaled(clip.name, 1000, 10), Error);
      continue;
    }
    SCOPED_TRACE(clip.name);
    MeshSequence s = make_scaled(clip.name, 20000, 7);
    EXPECT_NO_THROW(check(s));
    EXPECT_EQ(s.frame_count, 7U);
    EXPECT_NEAR(s.vertex_count, 20000, 1000);
    MeshSequence small = make_scaled(clip.name, 100, 2);
    EXPECT_NO_THROW(check(small));
    EXPECT_EQ(make_scaled(clip.name, 0, 0).positions, make_clip(clip.name).positions);
  }
}

/// Dimensions that the frames span about the first, by elimination on exact integers modulo a
/// prime.
size_t rank(const MeshSequence& s) {
  constexpr int64_t kPrime = 2147483647;
  std::vector<std::vector<int64_t>> rows;
  for (size_t f = 1; f < s.frame_count; ++f) {
    std::vector<int64_t> row;
    for (size_t i = 0; i < s.frame(f).size(); ++i) {
      double difference = double{s.frame(f)[i]} - double{s.frame(0)[i]};
      auto integer = static_cast<int64_t>(std::ldexp(difference, 22));
      EXPECT_EQ(static_cast<double>(integer), std::ldexp(difference, 22));
      row.push_back((integer % kPrime + kPrime) % kPrime);
    }
    rows.push_back(row);
  }
  auto inverse = [](int64_t x) {
    int64_t result = 1;
    for (int64_t e = kPrime - 2; e > 0; e >>= 1, x = x * x % kPrime)
      result = e & 1 ? result * x % kPrime : result;
    return result;
  };
  size_t found = 0;
  for (size_t column = 0; column < s.frame(0).size() && found < rows.size(); ++column) {
    size_t pivot = found;
    while (pivot < rows.size() && rows[pivot][column] == 0)
      ++pivot;
    if (pivot == rows.size())
      continue;
    std::swap(rows[pivot], rows[found]);
    int64_t scale = inverse(rows[found][column]);
    for (size_t r = found + 1; r < rows.size(); ++r) {
      int64_t factor = rows[r][column] * scale % kPrime;
      if (factor == 0)
        continue;
      for (size_t i = column; i < rows[r].size(); ++i)
        rows[r][i] = (rows[r][i] + (kPrime - factor) * rows[found][i]) % kPrime;
    }
    ++found;
  }
  return found;
}

TEST(WaveGrid, SpansExactlyItsShapes) {
  EXPECT_EQ(rank(make_wave_grid(300, 50, 30)), 30U);
  EXPECT_EQ(rank(make_wave_grid(300, 50, 7)), 7U);
  EXPECT_EQ(rank(make_wave_grid(300, 20, 30)), 19U);
  EXPECT_EQ(rank(make_wave_grid(50, 5, 0)), 0U);
}

TEST(WaveGrid, HasExactlyTheVertices) {
  for (uint32_t n : {4U, 5U, 17U, 1000U, 1023U, 1024U, 1025U}) {
    MeshSequence s = make_wave_grid(n, 2, 3);
    EXPECT_EQ(s.vertex_count, n);
    EXPECT_NO_THROW(check(s));
    EXPECT_LE(unused(s), 1U) << n;
    EXPECT_EQ(components(s), 1U);
  }
  EXPECT_THROW(make_wave_grid(3, 2, 3), Error);
  EXPECT_THROW(make_wave_grid(10, 0, 3), Error);
}

TEST(WaveGrid, StaysWhereFloatIsExact) {
  MeshSequence s = make_wave_grid(500, 30, 1000);
  for (float x : s.positions)
    ASSERT_LT(std::abs(x), 4);
}

}  // namespace
}  // namespace anicodec::corpus
