// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/pose_partners.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

struct Shape {
  Topology topology;
  MatrixXd pose;

  void add(const Shape& other) {
    const uint32_t first = topology.coded_vertices;
    for (const uint32_t v : other.topology.triangles)
      topology.triangles.push_back(first + v);
    topology.coded_vertices += other.topology.coded_vertices;
    pose.conservativeResize(topology.coded_vertices, 3);
    pose.bottomRows(other.pose.rows()) = other.pose;
  }
};

/// A wavy crumpled_sheet of (2 n + 1)^2 vertices, symmetric about x = 0, with random diagonals.
Shape crumpled_sheet(int n, unsigned seed) {
  std::mt19937 random(seed);
  Shape s;
  const int side = 2 * n + 1;
  s.topology.coded_vertices = static_cast<uint32_t>(side * side);
  s.pose.resize(side * side, 3);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  for (int j = 0; j < side; ++j) {
    for (int i = n; i < side; ++i) {
      const double u = i - n;
      const Vector3d x(u == 0 ? 0 : u + jitter(random), j + jitter(random),
                       2 * std::sin(0.4 * u) * std::cos(0.3 * j) + jitter(random));
      s.pose.row(j * side + i) = x;
      s.pose.row(j * side + 2 * n - i) = Vector3d(-x[0], x[1], x[2]);
    }
  }
  for (int j = 0; j + 1 < side; ++j) {
    for (int i = 0; i + 1 < side; ++i) {
      const auto a = static_cast<uint32_t>(j * side + i), b = a + 1,
                 c = a + static_cast<uint32_t>(side), d = c + 1;
      Vector<uint32_t>& t = s.topology.triangles;
      if (random() % 2)
        t.insert(t.end(), {a, b, d, a, d, c});
      else
        t.insert(t.end(), {a, b, c, b, d, c});
    }
  }
  return s;
}

size_t with_partners(const PosePartners& partners) {
  size_t count = 0;
  for (const uint32_t u : partners.partner)
    count += u != PosePartners::kNone;
  return count;
}

TEST(PosePartners, AreTheMirrorImagesWhateverTheDiagonals) {
  const int n = 12, side = 2 * n + 1;
  const Shape s = crumpled_sheet(n, 1);
  const CornerTable table(s.topology);
  const PosePartners partners = find_partners(s.pose, table);
  ASSERT_EQ(partners.partner.size(), static_cast<size_t>(side * side));
  size_t right = 0;
  for (int v = 0; v < side * side; ++v)
    right += partners.partner[static_cast<size_t>(v)] ==
             static_cast<uint32_t>(v / side * side + 2 * n - v % side);
  EXPECT_GT(right, static_cast<size_t>(side * side) * 19 / 20);
  for (size_t v = 0; v < partners.partner.size(); ++v) {
    if (partners.partner[v] != PosePartners::kNone) {
      EXPECT_EQ(partners.flips[v], 1) << v;
    }
  }
}

TEST(PosePartners, OfACopyAreTheVerticesOfWhatItCopies) {
  const Shape original = crumpled_sheet(6, 2);
  Shape s = original;
  // Bend what was symmetric.
  for (Eigen::Index v = 0; v < s.pose.rows(); ++v)
    s.pose(v, 2) += 0.05 * std::pow(s.pose(v, 0) + 4, 2);
  Shape turned = s;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).matrix();
  turned.pose = (s.pose * turn.transpose()).rowwise() + Vector3d(50, 3, 1).transpose();
  s.add(turned);
  const uint32_t n = original.topology.coded_vertices;
  const PosePartners partners = find_partners(s.pose, CornerTable(s.topology));
  ASSERT_EQ(partners.partner.size(), 2 * n);
  // Either is the copy, by the order in which they are coded.
  size_t right = 0;
  for (uint32_t v = 0; v < 2 * n; ++v)
    right += partners.partner[v] == (v < n ? v + n : v - n);
  EXPECT_EQ(right, n);
}

TEST(PosePartners, AreNotSeenInNoise) {
  Shape s = crumpled_sheet(15, 3);
  s.pose += MatrixXd::Random(s.pose.rows(), 3);
  EXPECT_LT(with_partners(find_partners(s.pose, CornerTable(s.topology))),
            static_cast<size_t>(s.pose.rows()) / 10);
}

TEST(PosePartners, OfOddMeshesAreFoundWithoutHarm) {
  Shape s;
  EXPECT_TRUE(find_partners(MatrixXd(0, 3), CornerTable(s.topology)).partner.empty());
  s.topology.coded_vertices = 4;
  s.topology.triangles = {0, 0, 0, 1, 2, 1, 0, 1, 2, 2, 1, 0};
  s.pose = MatrixXd::Zero(4, 3);
  find_partners(s.pose, CornerTable(s.topology));
  s.pose.row(1) = Vector3d(1e30, 0, 0);
  find_partners(s.pose, CornerTable(s.topology));
  // All vertices at one point, and at one fan.
  s = crumpled_sheet(8, 4);
  s.pose.setZero();
  find_partners(s.pose, CornerTable(s.topology));
  for (uint32_t v = 0; v + 2 < s.topology.coded_vertices; ++v)
    s.topology.triangles.insert(s.topology.triangles.end(), {0, v + 1, v + 2});
  s.pose = MatrixXd::Random(s.pose.rows(), 3);
  find_partners(s.pose, CornerTable(s.topology));
}

}  // namespace
}  // namespace anicodec
