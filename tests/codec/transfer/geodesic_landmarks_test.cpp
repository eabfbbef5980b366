// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/geodesic_landmarks.h"

#include "tests/codec/massage_meshes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(GeodesicGraph, MeasuresASheetAlongEdgesAndDiagonals) {
  const TestMesh sheet = flat_sheet(9);
  const std::vector<double> distances = GeodesicGraph(sheet.topology, sheet.positions).distances(0);
  EXPECT_DOUBLE_EQ(distances[8], 8);
  EXPECT_NEAR(distances[80], 8 * std::sqrt(2.0), 1e-9);  // along the diagonals of the quads
  for (uint32_t i = 0; i < 81; ++i) {
    const double straight = row(sheet.positions, i).norm();
    EXPECT_GE(distances[i], straight - 1e-9);
    EXPECT_LE(distances[i], 1.09 * straight + 1e-9);
  }
}

TEST(GeodesicGraph, TakesTheOtherDiagonalOfAQuad) {
  const TestMesh sheet = flat_sheet(5);
  // From corner to corner against the diagonals that are edges.
  EXPECT_NEAR(GeodesicGraph(sheet.topology, sheet.positions).distances(4)[20], 4 * std::sqrt(2.0),
              1e-9);
}

TEST(GeodesicGraph, KnowsNoWayToAnotherPiece) {
  const std::vector<uint32_t> corners = {0, 1, 2, 3, 4, 5};
  Positions positions = Positions::Random(6, 3);
  const SurfaceTopology topology(corners, 6);
  EXPECT_EQ(GeodesicGraph(topology, positions).distances(0)[4],
            std::numeric_limits<double>::infinity());
}

/// A strip, bent by an angle in its middle.
TestMesh strip(uint32_t n, double scale, double angle) {
  TestMesh mesh = height_field(n, [](double, double) { return 0.0; });
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i) {
    Eigen::Vector3d p = row(mesh.positions, i) * scale;
    p[0] *= 8;
    const double beyond = p[0] - 40;
    if (beyond > 0)
      p = Eigen::Vector3d(40 + beyond * std::cos(angle), p[1], beyond * std::sin(angle));
    mesh.positions.row(i) = p.transpose();
  }
  return mesh;
}

TEST(GeodesicLandmarks, FindAFoldedPartAgain) {
  // The far half of the strip has swung by more than a right angle; the near half is known.
  const TestMesh flat = strip(21, 0.5, 0), bent = strip(17, 0.625, 1.8);
  Surface surface(bent.topology, bent.positions);
  surface.build_index();
  std::vector<Anchor> anchors;
  for (uint32_t i = 0; i < flat.topology.vertex_count; ++i) {
    const SurfacePoint point = surface.closest(row(flat.positions, i));
    if (row(flat.positions, i)[0] > 35)
      continue;
    Eigen::Index corner = 0;
    point.weights.maxCoeff(&corner);
    anchors.push_back({i, bent.topology.triangles[point.triangle][static_cast<size_t>(corner)]});
  }
  const std::vector<Landmark> landmarks =
      geodesic_landmarks(GeodesicGraph(flat.topology, flat.positions), anchors,
                         GeodesicGraph(bent.topology, bent.positions), surface, 3);
  const TestMesh truth = strip(21, 0.5, 1.8);
  size_t swung = 0;
  for (const Landmark& l : landmarks) {
    EXPECT_LT((l.position - row(truth.positions, l.vertex)).norm(), 8) << l.vertex;
    swung += row(flat.positions, l.vertex)[0] > 40;
  }
  EXPECT_GT(swung, 5U);
}

TEST(GeodesicLandmarks, LeaveOutAnchorsThatDisagree) {
  const TestMesh mesh = strip(21, 0.5, 0);
  Surface surface(mesh.topology, mesh.positions);
  surface.build_index();
  const GeodesicGraph graph(mesh.topology, mesh.positions);
  std::vector<Anchor> anchors;
  for (uint32_t i = 0; i < mesh.topology.vertex_count; i += 3)
    anchors.push_back(
        {i, i % 30 == 0 ? mesh.topology.vertex_count - 1 - i : i});  // a tenth: at the other end
  const std::vector<Landmark> landmarks = geodesic_landmarks(graph, anchors, graph, surface, 1);
  EXPECT_GT(landmarks.size(), 60U);
  for (const Landmark& l : landmarks)
    EXPECT_LT((l.position - row(mesh.positions, l.vertex)).norm(), 1) << l.vertex;
}

TEST(GeodesicLandmarks, NeedAnchors) {
  const TestMesh sheet = flat_sheet(5);
  const Surface surface(sheet.topology, sheet.positions);
  const GeodesicGraph graph(sheet.topology, sheet.positions);
  EXPECT_TRUE(geodesic_landmarks(graph, {{0, 0}, {1, 1}}, graph, surface, 1).empty());
}

}  // namespace
}  // namespace anicodec
