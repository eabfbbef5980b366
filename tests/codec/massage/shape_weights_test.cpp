// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/shape_weights.h"

#include "tests/codec/massage_meshes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;

constexpr ShapeWeights kAll[] = {ShapeWeights::kUniform, ShapeWeights::kMeanValue,
                                 ShapeWeights::kHarmonic};

TestMesh uneven_hill() {
  TestMesh mesh = height_field(9, [](double x, double y) { return std::sin(x) * std::cos(y / 2); });
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i) {
    if (mesh.topology.kind[i] == VertexKind::kInner)
      mesh.positions.row(i) +=
          Eigen::RowVector3d(0.2 * std::sin(7.0 * i), 0.2 * std::cos(5.0 * i), 0);
  }
  return mesh;
}

TEST(ShapeWeights, AreConvexCombinations) {
  const TestMesh mesh = uneven_hill();
  for (ShapeWeights kind : kAll) {
    const RowMatrix a = shape_matrix(mesh.topology, mesh.positions, kind);
    for (int i = 0; i < a.rows(); ++i) {
      double sum = 0;
      for (RowMatrix::InnerIterator it(a, i); it; ++it) {
        sum += it.value();
        if (it.col() == i) {
          EXPECT_EQ(it.value(), 1);
        } else {
          EXPECT_LE(it.value(), 0);
        }
      }
      EXPECT_NEAR(sum, 0, 1e-12);
    }
  }
}

TEST(ShapeWeights, KeepEveryFlatMesh) {
  TestMesh mesh = uneven_hill();
  mesh.positions.col(2).setZero();
  const RowMatrix a = shape_matrix(mesh.topology, mesh.positions, ShapeWeights::kMeanValue);
  EXPECT_LT((a * mesh.positions).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ShapeWeights, AskNothingTangentialOfTheirReference) {
  const TestMesh mesh = uneven_hill();
  const RowMatrix a = shape_matrix(mesh.topology, mesh.positions, ShapeWeights::kMeanValue);
  const Positions normals = vertex_normals(mesh.topology, mesh.positions);
  const Positions off = a * mesh.positions;
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i) {
    if (mesh.topology.kind[i] != VertexKind::kInner)
      continue;
    const Vector3d n = row(normals, i), x = row(off, i);
    EXPECT_LT((x - n * n.dot(x)).norm(), 1e-12);
  }
}

TEST(ShapeWeights, UniformOnesAreTheMean) {
  const TestMesh mesh = uneven_hill();
  const RowMatrix a = shape_matrix(mesh.topology, mesh.positions, ShapeWeights::kUniform);
  EXPECT_NEAR(a.coeff(40, 41), -1.0 / 6, 1e-12);
}

TEST(ShapeWeights, BoundarySlidesAlongItselfAndCornersAreEmpty) {
  const TestMesh mesh = flat_sheet(5);
  const RowMatrix a = shape_matrix(mesh.topology, mesh.positions, ShapeWeights::kHarmonic);
  EXPECT_EQ(a.row(0).nonZeros(), 0);
  EXPECT_EQ(a.row(2).nonZeros(), 3);
  EXPECT_NEAR(a.coeff(2, 1), -0.5, 1e-12);
  EXPECT_NEAR(a.coeff(2, 3), -0.5, 1e-12);
}

TEST(ShapeWeights, AreFiniteOnDegenerateTriangles) {
  TestMesh mesh = flat_sheet(5);
  mesh.positions.row(12) = mesh.positions.row(13);  // an edge of no length
  mesh.positions.row(7) = mesh.positions.row(6);
  for (ShapeWeights kind : kAll) {
    const RowMatrix a = shape_matrix(mesh.topology, mesh.positions, kind);
    EXPECT_TRUE(Eigen::MatrixXd(a).allFinite());
  }
}

TEST(ShapeWeights, FoldedRingsFallBackToAnglesInSpace) {
  TestMesh mesh = flat_sheet(5);
  mesh.positions.row(12) << 3.5, 3.5, 0.1;  // outside its ring
  const RowMatrix a = shape_matrix(mesh.topology, mesh.positions, ShapeWeights::kMeanValue);
  for (RowMatrix::InnerIterator it(a, 12); it; ++it)
    EXPECT_TRUE(it.col() == 12 || (it.value() <= 0 && it.value() >= -1));
}

}  // namespace
}  // namespace anicodec
