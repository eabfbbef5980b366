// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A shape by its edge lengths and dihedral angles (thesis sections 4.2 and 5.3).
#ifndef ANICODEC_CODEC_SURFACE_EDGE_NETWORK_H_
#define ANICODEC_CODEC_SURFACE_EDGE_NETWORK_H_

#include "sdk/msgi/face_graph.h"

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Two faces that share the edge (a, b): (a, b, c) and (a, b, d), in whatever orientation.
struct Hinge {
  uint32_t a, b, c, d;
  uint32_t face_c, face_d;
  uint32_t edge;
};

/// The edges and hinges of any triangle list. An edge of k faces has up to k - 1 hinges.
struct EdgeNetwork {
  EdgeNetwork(std::span<const uint32_t> triangles, uint32_t vertex_count);

  uint32_t vertex_count;
  Vector<uint32_t> triangles;  ///< those of FaceGraph
  Vector<FaceGraph::Edge> edges;
  Vector<uint32_t> triangle_edges;  ///< three per triangle, kNoIndex when of no length
  std::vector<Hinge> hinges;
};

struct EdgeShape {
  Eigen::VectorXd lengths;  ///< per edge
  Eigen::VectorXd angles;   ///< per hinge, signed, 0 when flat, in radians
};

/// Radians of a full turn, that angles are known up to.
inline constexpr double kFullTurn = 2 * std::numbers::pi;

/// Positions as a matrix: a column per vertex.
using Points = Eigen::Matrix3Xd;

inline Eigen::Index column(uint32_t vertex) {
  return static_cast<Eigen::Index>(vertex);
}

Points to_points(std::span<const float> positions);

/// In (-pi, pi]; 0 where a face is degenerate.
double dihedral_angle(const Points& x, const Hinge& hinge);

EdgeShape measure_edges(const EdgeNetwork& network, const Points& x);

/// The shapes of all inputs, angles by the multiple of a turn that is nearest to the first input's.
std::vector<EdgeShape> measure_edges(const EdgeNetwork& network, std::span<const Points> inputs);

/// Linear combination; a length stays above a tenth of its shortest when weights extrapolate.
EdgeShape blend_edges(std::span<const EdgeShape> shapes, std::span<const double> weights);

/// Signed volume under all faces, seen from the centroid.
double enclosed_volume(const EdgeNetwork& network, const Points& x);

/// How far a mesh is from the shape it should have (thesis figures 4.24 and 4.25).
struct EdgeError {
  double length = 0;          ///< mean of |l - l*| / l*
  double largest_length = 0;  ///< largest of them
  double angle = 0;           ///< mean of |theta - theta*|, radians
  double volume = 0;          ///< |V - V*| / |V*|
  uint32_t folded = 0;        ///< hinges that are off by more than a right angle
  uint32_t collapsed = 0;  ///< triangles of less than a tenth of the area their edges should give
};

EdgeError edge_error(const EdgeNetwork& network, const Points& x, const EdgeShape& target,
                     double target_volume);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_EDGE_NETWORK_H_
