// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/remesh_fit.h"

#include "codec/sequence/error.h"
#include "tests/codec/massage_meshes.h"

#include <string>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

SurfaceFrame frame_of(const TestMesh& mesh, const Eigen::Vector3d& by = Eigen::Vector3d::Zero()) {
  SurfaceFrame frame;
  for (const SurfaceTopology::Triangle& t : mesh.topology.triangles)
    frame.polygons.add(t);
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i) {
    for (int k = 0; k < 3; ++k)
      frame.positions.push_back(static_cast<float>(mesh.positions(i, k) + by[k]));
  }
  return frame;
}

TEST(RemeshFit, BringsACoarseBallCloserToAFineOne) {
  const RemeshFit fit = fit_remesh(frame_of(sphere(5)), frame_of(sphere(20)));
  EXPECT_TRUE(fit.improved);
  EXPECT_LT(fit.after.mean(), 0.55 * fit.before.mean());
  EXPECT_LT(fit.after.max(), 0.6 * fit.before.max());
  EXPECT_EQ(fit.turned_after, 0U);
  EXPECT_EQ(fit.positions.size(), frame_of(sphere(5)).positions.size());
}

TEST(RemeshFit, TurnsTrianglesThatWereTurned) {
  TestMesh ball = sphere(6);
  // A vertex beyond the far side of its ring.
  const uint32_t end = ball.topology.ring[40][0];
  ball.positions.row(40) =
      (row(ball.positions, 40) + 1.6 * (row(ball.positions, end) - row(ball.positions, 40)))
          .normalized()
          .transpose();
  const RemeshFit fit = fit_remesh(frame_of(ball), frame_of(sphere(20)));
  EXPECT_GT(fit.turned_before, 0U);
  EXPECT_TRUE(fit.improved);
  EXPECT_EQ(fit.turned_after, 0U);
}

TEST(RemeshFit, LeavesAMeshThatIsTheSurface) {
  const SurfaceFrame ball = frame_of(sphere(6));
  const RemeshFit fit = fit_remesh(ball, ball);
  EXPECT_FALSE(fit.improved);
  EXPECT_EQ(fit.positions, ball.positions);
}

void expect_refused(const SurfaceFrame& mesh, const SurfaceFrame& surface, const char* text) {
  try {
    fit_remesh(mesh, surface);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(e.what()).find(text), std::string::npos) << e.what();
  }
}

TEST(RemeshFit, RefusesAnOpenMeshForAClosedSurface) {
  expect_refused(frame_of(flat_sheet(6)), frame_of(sphere(6)), "is open");
  expect_refused(frame_of(sphere(6)), frame_of(flat_sheet(6)), "is closed");
}

TEST(RemeshFit, RefusesAComponentWithoutCounterpart) {
  SurfaceFrame two = frame_of(sphere(6));
  const SurfaceFrame far = frame_of(sphere(6), {5, 0, 0});
  const auto shift = static_cast<uint32_t>(two.positions.size() / 3);
  for (size_t p = 0; p < far.polygons.size(); ++p) {
    const auto c = far.polygons[p];
    const uint32_t shifted[] = {c[0] + shift, c[1] + shift, c[2] + shift};
    two.polygons.add(shifted);
  }
  two.positions.insert(two.positions.end(), far.positions.begin(), far.positions.end());
  expect_refused(two, frame_of(sphere(8)), "component of the mesh");
  expect_refused(frame_of(sphere(8)), two, "component of the surface");
}

TEST(RemeshFit, RefusesPoints) {
  SurfaceFrame points = frame_of(sphere(6));
  points.polygons = {};
  expect_refused(points, frame_of(sphere(6)), "without triangles");
}

}  // namespace
}  // namespace anicodec
