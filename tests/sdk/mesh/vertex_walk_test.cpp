// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/vertex_walk.h"

#include <algorithm>
#include <initializer_list>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Vertices without copies, and polygons of them.
Topology mesh(uint32_t vertices) {
  Topology topology;
  topology.vertex_coded.resize(vertices);
  std::iota(topology.vertex_coded.begin(), topology.vertex_coded.end(), 0U);
  topology.polygon_offsets = {0};
  return topology;
}

void add_polygon(std::initializer_list<uint32_t> corners, Topology* topology) {
  topology->polygon_corners.insert(topology->polygon_corners.end(), corners);
  topology->polygon_offsets.push_back(static_cast<uint32_t>(topology->polygon_corners.size()));
}

/// A grid of quads whose canonical numbers are shuffled; (*source)[v] is row by row.
Topology shuffled_grid(uint32_t rows, uint32_t columns, Vector<uint32_t>* source) {
  Topology topology = mesh(rows * columns);
  *source = topology.vertex_coded;
  std::shuffle(source->begin(), source->end(), std::mt19937(1));
  Vector<uint32_t> canonical(source->size());
  for (uint32_t v = 0; v < canonical.size(); ++v)
    canonical[(*source)[v]] = v;
  for (uint32_t r = 0; r + 1 < rows; ++r) {
    for (uint32_t c = 0; c + 1 < columns; ++c) {
      const uint32_t v = r * columns + c;
      add_polygon(
          {canonical[v], canonical[v + 1], canonical[v + columns + 1], canonical[v + columns]},
          &topology);
    }
  }
  return topology;
}

Vector<uint8_t> coded(const Topology& topology, Vector<uint32_t> source) {
  BinaryEncoder encoder;
  EXPECT_TRUE(VertexWalk(topology).code(encoder, &source));
  return encoder.finish();
}

void expect_round_trip(const Topology& topology, const Vector<uint32_t>& source) {
  const Vector<uint8_t> bytes = coded(topology, source);
  BinaryDecoder decoder(bytes.data(), bytes.size());
  Vector<uint32_t> decoded;
  EXPECT_TRUE(VertexWalk(topology).code(decoder, &decoded));
  EXPECT_TRUE(decoder.finish());
  EXPECT_EQ(decoded, source);
}

TEST(VertexWalk, RowsOfAGridCostNextToNothing) {
  Vector<uint32_t> source;
  const Topology topology = shuffled_grid(60, 50, &source);
  expect_round_trip(topology, source);
  EXPECT_LT(coded(topology, source).size(), 3000 / 8 / 5);  // a fifth of a bit for each vertex
}

TEST(VertexWalk, PolygonByPolygonIsCheapWhereAllVerticesAreCopies) {
  constexpr uint32_t kQuads = 400;  // a strip, each with four vertices of its own
  Topology topology = mesh(4 * kQuads);
  // Canonical order: the copies of a coded vertex follow one another. Columns have up to two.
  Vector<uint32_t> source(4 * kQuads), number(4 * kQuads);
  uint32_t next = 0, coded_vertex = 0;
  for (uint32_t column = 0; column <= kQuads; ++column) {
    for (uint32_t side = 0; side < 2; ++side, ++coded_vertex) {
      for (uint32_t quad : {column - 1, column}) {  // the right end of one, the left of the other
        if (quad >= kQuads)
          continue;
        const uint32_t corner = quad == column ? 3 * side : 1 + side;
        topology.vertex_coded[next] = coded_vertex;
        number[4 * quad + corner] = next;
        source[next++] = 4 * quad + corner;
      }
    }
  }
  for (uint32_t q = 0; q < kQuads; ++q)
    add_polygon({number[4 * q], number[4 * q + 1], number[4 * q + 2], number[4 * q + 3]},
                &topology);
  expect_round_trip(topology, source);
  EXPECT_LT(coded(topology, source).size(), 4 * kQuads / 8 / 4);
}

TEST(VertexWalk, TakesAnyOrderOfAnyMesh) {
  std::mt19937 random(7);
  for (uint32_t vertices : {0U, 1U, 2U, 3U, 40U, 700U}) {
    Topology topology = mesh(vertices);
    for (uint32_t p = 0; p < vertices; ++p)  // repeats, loops, and a hub
      add_polygon({static_cast<uint32_t>(random() % vertices), 0,
                   static_cast<uint32_t>(random() % vertices)},
                  &topology);
    for (uint32_t v = 0; v + 1 < vertices; ++v)
      topology.vertex_coded[v + 1] = topology.vertex_coded[v] + (random() % 3 == 0 ? 1 : 0);
    Vector<uint32_t> source(vertices);
    std::iota(source.begin(), source.end(), 0U);
    std::shuffle(source.begin(), source.end(), random);
    expect_round_trip(topology, source);
  }
}

TEST(VertexWalk, AnyBytesGiveAPermutationOrNothing) {
  Vector<uint32_t> source;
  const Topology topology = shuffled_grid(9, 8, &source);
  const Vector<uint8_t> bytes = coded(topology, source);
  std::mt19937 random(3);
  int permutations = 0;
  for (int i = 0; i < 500; ++i) {
    Vector<uint8_t> damaged = bytes;
    for (uint8_t& b : damaged)
      b = static_cast<uint8_t>(random());
    BinaryDecoder decoder(damaged.data(), damaged.size());
    Vector<uint32_t> decoded;
    if (!VertexWalk(topology).code(decoder, &decoded))
      continue;
    ++permutations;
    std::sort(decoded.begin(), decoded.end());
    for (uint32_t v = 0; v < decoded.size(); ++v)
      ASSERT_EQ(decoded[v], v);
  }
  SUCCEED() << permutations << " streams decoded";
}

}  // namespace
}  // namespace anicodec
