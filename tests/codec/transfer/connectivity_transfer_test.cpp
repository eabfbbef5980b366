// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/connectivity_transfer.h"

#include "codec/sequence/error.h"
#include "tests/codec/massage_meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

SurfaceFrame transfer_frame(const TestMesh& mesh) {
  SurfaceFrame frame;
  for (const SurfaceTopology::Triangle& t : mesh.topology.triangles)
    frame.polygons.add(t);
  for (Index i = 0; i < mesh.positions.size(); ++i)
    frame.positions.push_back(static_cast<float>(mesh.positions.data()[i]));
  return frame;
}

SurfaceFrame moved(TestMesh mesh, const std::function<Vector3d(const Vector3d&)>& to) {
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i)
    mesh.positions.row(i) = to(row(mesh.positions, i)).transpose();
  return transfer_frame(mesh);
}

/// A ball with its inside out: every triangle of another faces against it.
SurfaceFrame inside_out(uint32_t n) {
  SurfaceFrame ball = transfer_frame(sphere(n));
  for (size_t p = 0; p < ball.polygons.size(); ++p)
    std::swap(ball.polygons.corners[3 * p + 1], ball.polygons.corners[3 * p + 2]);
  return ball;
}

Vector3d same(const Vector3d& p) {
  return p;
}

/// The first frame, then one more.
TransferResult transfer(const SurfaceFrame& a, const SurfaceFrame& b,
                        const TransferOptions& options = {}) {
  return transfer_connectivity([&](uint32_t f) { return f == 0 ? a : b; }, 2, options);
}

TEST(ConnectivityTransfer, FollowsSlowMotionThroughMeshesOfOtherFaces) {
  auto source = [](uint32_t f) {
    const double t = 0.04 * f;
    return moved(sphere(f == 0 ? 10 : 11 + f % 3), [t](const Vector3d& p) {
      return Vector3d(p[0] * (1 + t), p[1], p[2] * (1 - t) + 0.3 * t * p[0]);
    });
  };
  const TransferResult result = transfer_connectivity(source, 6, {});
  ASSERT_EQ(result.segments.size(), 1U);
  EXPECT_EQ(result.segments[0].sequence.frame_count, 6U);
  check(result.segments[0].sequence);
  for (uint32_t f = 1; f < 6; ++f) {
    EXPECT_EQ(result.frames[f].alarms, 0) << f << ": " << alarm_names(result.frames[f].alarms);
    EXPECT_LT(result.frames[f].mean, 0.005 * result.diagonal) << f;
    EXPECT_EQ(result.frames[f].turned, 0) << f;
  }
}

/// A post on the middle of a sheet, tall and thin; its upper part swings by an angle.
TestMesh post(uint32_t n, double angle) {
  TestMesh mesh = height_field(n, [](double, double) { return 0.0; });
  const double middle = (n - 1) / 2.0;
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i) {
    const Vector3d at = (row(mesh.positions, i) - Vector3d(middle, middle, 0)) / middle;
    const double out = std::max(std::abs(at[0]), std::abs(at[1]));
    const double r = at.norm();
    // Out to 0.3 the tip, to 0.7 the side, beyond the ground.
    const double height = 4 * std::clamp((0.7 - out) / 0.4, 0.0, 1.0);
    const double radius = out < 0.3   ? out
                          : out < 0.7 ? 0.3 + 0.2 * (out - 0.3)
                                      : 0.38 + 6 * (out - 0.7);
    Vector3d p =
        r > 0 ? Vector3d(at[0] / r * radius, at[1] / r * radius, height) : Vector3d(0, 0, 4);
    const double bend = angle * std::clamp((p[2] - 0.5) / 1.0, 0.0, 1.0);
    const double over = p[2] - 0.5;
    if (over > 0)
      p = Vector3d(p[0] * std::cos(bend) + over * std::sin(bend), p[1],
                   0.5 + over * std::cos(bend) - p[0] * std::sin(bend));
    mesh.positions.row(i) = p.transpose();
  }
  return mesh;
}

TEST(ConnectivityTransfer, TriesAgainWhereAPartSwingsFar) {
  const TransferResult result =
      transfer(transfer_frame(post(31, -0.7)), transfer_frame(post(33, 0.7)));
  EXPECT_EQ(result.segments.size(), 1U) << alarm_names(result.frames[1].alarms);
  EXPECT_GT(result.frames[1].attempts, 1);
}

TEST(ConnectivityTransfer, AlarmsWhereTheSurfaceIsNotCovered) {
  // A second ball appears.
  TestMesh two = sphere(8);
  SurfaceFrame both = transfer_frame(two);
  const SurfaceFrame far =
      moved(two, [](const Vector3d& p) { return Vector3d(p + Vector3d(4, 0, 0)); });
  const auto shift = static_cast<uint32_t>(both.positions.size() / 3);
  for (size_t p = 0; p < far.polygons.size(); ++p) {
    const auto corners = far.polygons[p];
    const uint32_t shifted[] = {corners[0] + shift, corners[1] + shift, corners[2] + shift};
    both.polygons.add(shifted);
  }
  both.positions.insert(both.positions.end(), far.positions.begin(), far.positions.end());
  const TransferResult result = transfer(transfer_frame(sphere(9)), both);
  ASSERT_EQ(result.segments.size(), 2U);
  EXPECT_TRUE(result.frames[1].first);
  EXPECT_TRUE(result.frames[1].alarms & static_cast<uint8_t>(TransferAlarm::kDistance));
  EXPECT_EQ(result.segments[1].first_frame, 1U);
  EXPECT_EQ(result.segments[1].sequence.vertex_count, 2 * shift);
}

TEST(ConnectivityTransfer, AllowsForWhatCoarseMeshesCannotShow) {
  // Balls of 8 and 18 quads: further apart than half a per cent of the diagonal, being so coarse.
  TransferOptions strict;
  strict.edges = 0;
  strict.distance = 0.1;
  const SurfaceFrame a = transfer_frame(sphere(2)), b = transfer_frame(sphere(3));
  EXPECT_TRUE(transfer(a, b, strict).frames[1].alarms &
              static_cast<uint8_t>(TransferAlarm::kDistance));
  TransferOptions scaled;
  scaled.distance = 0.1;
  EXPECT_FALSE(transfer(a, b, scaled).frames[1].alarms &
               static_cast<uint8_t>(TransferAlarm::kDistance));
}

TEST(ConnectivityTransfer, AlarmsWhereTrianglesTurn) {
  const TransferResult result = transfer(transfer_frame(sphere(9)), inside_out(8));
  ASSERT_EQ(result.segments.size(), 2U);
  EXPECT_TRUE(result.frames[1].alarms & static_cast<uint8_t>(TransferAlarm::kTurned));
}

TEST(ConnectivityTransfer, AlarmsWhereCorrespondencesDisagree) {
  const TransferResult result = transfer(transfer_frame(sphere(9)), inside_out(8));
  EXPECT_GT(result.frames[1].dropped, 50);
  EXPECT_TRUE(result.frames[1].alarms & static_cast<uint8_t>(TransferAlarm::kDropped));
}

TEST(ConnectivityTransfer, AlarmsWhereTrianglesLoseTheirShapes) {
  // The ball becomes a cigar: covered all over, but of other triangles.
  const SurfaceFrame cigar = moved(
      sphere(12), [](const Vector3d& p) { return Vector3d(3.0 * p[0], 0.6 * p[1], 0.6 * p[2]); });
  const TransferResult result = transfer(transfer_frame(sphere(10)), cigar);
  ASSERT_EQ(result.segments.size(), 2U);
  EXPECT_TRUE(result.frames[1].alarms & static_cast<uint8_t>(TransferAlarm::kDistortion))
      << alarm_names(result.frames[1].alarms) << " " << result.frames[1].conformal;
}

TEST(ConnectivityTransfer, GoesOnFromTheFrameThatBeganASegment) {
  auto source = [](uint32_t f) {
    return f < 2 ? transfer_frame(sphere(9 + f)) : inside_out(10 + f);
  };
  const TransferResult result = transfer_connectivity(source, 4, {});
  ASSERT_EQ(result.segments.size(), 2U)
      << alarm_names(result.frames[1].alarms) << "; " << alarm_names(result.frames[3].alarms)
      << "; distortion " << result.frames[3].conformal << ", dropped " << result.frames[3].dropped;
  EXPECT_EQ(result.segments[0].sequence.frame_count, 2U);
  EXPECT_EQ(result.segments[1].first_frame, 2U);
  EXPECT_EQ(result.segments[1].sequence.frame_count, 2U);
  EXPECT_EQ(result.frames[3].alarms, 0) << alarm_names(result.frames[3].alarms);
}

TEST(ConnectivityTransfer, RefusesOpenAndClosedMeshesInOneSequence) {
  try {
    transfer(transfer_frame(sphere(6)), transfer_frame(flat_sheet(6)));
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(e.what()).find("frame 1: the mesh is closed, but the surface is open"),
              std::string::npos)
        << e.what();
  }
}

TEST(ConnectivityTransfer, RefusesAFrameWithoutTriangles) {
  SurfaceFrame points = moved(sphere(6), same);
  points.polygons = {};
  EXPECT_THROW(transfer(transfer_frame(sphere(6)), points), Error);
}

TEST(ConnectivityTransfer, NamesItsAlarms) {
  EXPECT_EQ(alarm_names(0), "");
  EXPECT_EQ(alarm_names(15), "distance, turned, distortion, dropped");
}

}  // namespace
}  // namespace anicodec
