// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/isotropic.h"

#include "codec/remesh/open_mesh.h"
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "codec/surface/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>

namespace anicodec {
namespace {

using OpenMesh::TriMesh;
using OpenMesh::Vec3d;
using VertexHandle = TriMesh::VertexHandle;
using EdgeHandle = TriMesh::EdgeHandle;
using HalfedgeHandle = TriMesh::HalfedgeHandle;

constexpr double kLong = 4.0 / 3, kShort = 4.0 / 5;  // of the edge length asked for
// Cosine between a triangle's normals before and after a change.
constexpr double kLeastCosine = 0.5;
constexpr double kMostStray = 0.2;  // of a vertex from the triangles in its place, in lengths
constexpr double kCorner = 0.77;    // cosine of the angle up to which a crease runs on: 40 degrees
constexpr int kSplitPasses = 24;    // each halves the edges
constexpr size_t kMostGrowth = 4;   // vertices at any time, in those asked for or given
constexpr double kMostCorrection = 1.3;  // of the edge length, in a round

Vec3d vector_of(const Eigen::Vector3d& p) {
  return {p[0], p[1], p[2]};
}

Eigen::Vector3d point_of(const Vec3d& p) {
  return {p[0], p[1], p[2]};
}

/// The mesh on its way, in a box of diagonal 1.
class Remesher {
 public:
  Remesher(const SoundMesh& sound, const Positions& positions, const Surface& surface,
           const IsotropicOptions& options)
      : surface_(surface), goal_(options.vertices) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    mesh_.add_property(below_);
    add_triangles(sound.triangles, positions, &mesh_);
    for (auto v : mesh_.vertices())
      mesh_.property(below_, v) = surface.topology().star[static_cast<size_t>(v.idx())].front();
    for (auto e : mesh_.edges())
      mesh_.status(e).set_feature(mesh_.is_boundary(e) ||
                                  std::abs(mesh_.calc_dihedral_angle(e)) >
                                      options.crease * std::numbers::pi / 180);
    double area = 0;
    for (auto f : mesh_.faces())
      area += mesh_.calc_face_area(f);
    if (!(area > 0))
      throw Error(ErrorKind::kInput, "a surface without area cannot be remeshed");
    // Vertices have two triangles each, of sqrt(3)/4 of the square length.
    length_ =
        std::sqrt(2 * area / (std::numbers::sqrt3 * std::max(4.0, static_cast<double>(goal_))));
    most_ = kMostGrowth * std::max<size_t>(goal_, mesh_.n_vertices());
  }

  void run_round() {
    collapse_short();
    split_long();
    collapse_short();
    flip();
    relax();
  }

  /// Brings the edge length to where the number of vertices will be met.
  void correct_length() {
    const double share = static_cast<double>(left()) / goal_;
    length_ *= std::clamp(std::sqrt(share), 1 / kMostCorrection, kMostCorrection);
  }

  size_t left() const {
    size_t count = 0;
    for (auto v : mesh_.vertices())
      count += !mesh_.is_isolated(v);
    return count;
  }

  const TriMesh& mesh() const { return mesh_; }

 private:
  void split_long() {
    const double limit = kLong * length_;
    for (int pass = 0; pass < kSplitPasses; ++pass) {
      bool any = false;
      const size_t edges = mesh_.n_edges();
      for (size_t i = 0; i < edges && mesh_.n_vertices() < most_; ++i) {
        const EdgeHandle e(static_cast<int>(i));
        if (mesh_.status(e).deleted() || mesh_.calc_edge_length(e) <= limit)
          continue;
        split(e);
        any = true;
      }
      if (!any)
        break;
    }
    mesh_.garbage_collection();
  }

  void split(EdgeHandle e) {
    const HalfedgeHandle h = mesh_.halfedge_handle(e, 0);
    const VertexHandle a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
    const bool feature = mesh_.status(e).feature();
    const Vec3d middle = (mesh_.point(a) + mesh_.point(b)) * 0.5;
    const VertexHandle v = mesh_.add_vertex(middle);
    mesh_.split(e, v);
    for (auto spoke : mesh_.ve_range(v))
      mesh_.status(spoke).set_feature(false);
    for (auto end : {a, b})
      mesh_.status(mesh_.edge_handle(mesh_.find_halfedge(v, end))).set_feature(feature);
    const SurfacePoint from_a = surface_.walk(point_of(middle), mesh_.property(below_, a)),
                       from_b = surface_.walk(point_of(middle), mesh_.property(below_, b));
    const SurfacePoint& nearer = from_b.square_distance < from_a.square_distance ? from_b : from_a;
    mesh_.property(below_, v) = nearer.triangle;
    if (!feature)
      mesh_.set_point(v, vector_of(nearer.position));
  }

  void collapse_short() {
    const double limit = kShort * length_;
    const size_t edges = mesh_.n_edges();
    for (size_t i = 0; i < edges; ++i) {
      const EdgeHandle e(static_cast<int>(i));
      if (mesh_.status(e).deleted() || mesh_.calc_edge_length(e) >= limit)
        continue;
      for (unsigned side : {0U, 1U}) {
        const HalfedgeHandle h = mesh_.halfedge_handle(e, side);
        if (may_collapse(h)) {
          collapse(h);
          break;
        }
      }
    }
    mesh_.garbage_collection();
  }

  /// The vertex that would go may be missed: it lies within a crease that runs straight on along
  /// the edge, or on none; no edge becomes too long and no triangle turns.
  bool may_collapse(HalfedgeHandle h) {
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    if (!keeps_creases(h) || !mesh_.is_collapse_ok(h) || closes_tetrahedron(h))
      return false;
    for (auto w : mesh_.vv_range(from)) {
      if ((mesh_.point(w) - mesh_.point(to)).norm() > kLong * length_)
        return false;
    }
    return keeps_surface(h);
  }

  /// No triangle turns, and the place of the vertex stays close to the new ones: a thin part is not
  /// cut off.
  bool keeps_surface(HalfedgeHandle h) const {
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    const TriMesh::FaceHandle left = mesh_.face_handle(h), right = mesh_.opposite_face_handle(h);
    const Eigen::Vector3d place = point_of(mesh_.point(from));
    double nearest = std::numeric_limits<double>::infinity();
    for (auto f : mesh_.vf_range(from)) {
      if (f == left || f == right)
        continue;
      const std::array<Vec3d, 3> before = corners_of(f),
                                 after = corners_of(f, from, mesh_.point(to));
      if (turned(before, after))
        return false;
      nearest = std::min(nearest, closest_on_triangle(point_of(after[0]), point_of(after[1]),
                                                      point_of(after[2]), place)
                                      .square_distance);
    }
    return nearest <= kMostStray * kMostStray * length_ * length_;
  }

  /// Two triangles would be left, back to back.
  bool closes_tetrahedron(HalfedgeHandle h) const {
    const VertexHandle l = mesh_.opposite_vh(h), r = mesh_.opposite_he_opposite_vh(h);
    return l.is_valid() && r.is_valid() && mesh_.valence(l) == 3 && mesh_.valence(r) == 3 &&
           mesh_.find_halfedge(l, r).is_valid();
  }

  bool keeps_creases(HalfedgeHandle h) const {
    const VertexHandle from = mesh_.from_vertex_handle(h);
    std::array<Vec3d, 2> along;
    size_t creases = 0;
    for (auto spoke : mesh_.voh_range(from)) {
      if (!mesh_.status(mesh_.edge_handle(spoke)).feature())
        continue;
      if (creases < 2)
        along[creases] = mesh_.calc_edge_vector(spoke).normalized();
      ++creases;
    }
    if (creases == 0)
      return true;
    return creases == 2 && mesh_.status(mesh_.edge_handle(h)).feature() &&
           (along[0] | along[1]) < -kCorner;
  }

  /// The corners of a triangle, one of which may be moved.
  std::array<Vec3d, 3> corners_of(TriMesh::FaceHandle f, VertexHandle moved = VertexHandle(),
                                  const Vec3d& to = Vec3d(0, 0, 0)) const {
    std::array<Vec3d, 3> corners;
    size_t k = 0;
    for (auto v : mesh_.fv_range(f))
      corners[k++] = v == moved ? to : mesh_.point(v);
    return corners;
  }

  static bool turned(const std::array<Vec3d, 3>& before, const std::array<Vec3d, 3>& after) {
    const Vec3d a = (before[1] - before[0]) % (before[2] - before[0]);
    const Vec3d b = (after[1] - after[0]) % (after[2] - after[0]);
    return !((a | b) > kLeastCosine * a.norm() * b.norm()) && a.norm() > 0;
  }

  void collapse(HalfedgeHandle h) {
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    // Two edges become one at either side; the crease may be the one that goes.
    std::array<VertexHandle, 2> merged{mesh_.opposite_vh(h), mesh_.opposite_he_opposite_vh(h)};
    std::array<bool, 2> feature{};
    for (size_t k = 0; k < 2; ++k) {
      if (merged[k].is_valid())
        feature[k] = is_crease(from, merged[k]) || is_crease(to, merged[k]);
    }
    mesh_.collapse(h);
    for (size_t k = 0; k < 2; ++k) {
      if (merged[k].is_valid())
        mesh_.status(mesh_.edge_handle(mesh_.find_halfedge(to, merged[k]))).set_feature(feature[k]);
    }
  }

  bool is_crease(VertexHandle a, VertexHandle b) const {
    return mesh_.status(mesh_.edge_handle(mesh_.find_halfedge(a, b))).feature();
  }

  void flip() {
    for (auto e : mesh_.edges()) {
      if (mesh_.status(e).feature() || !mesh_.is_flip_ok(e))
        continue;
      const HalfedgeHandle h = mesh_.halfedge_handle(e, 0);
      const VertexHandle a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h),
                         c = mesh_.opposite_vh(h), d = mesh_.opposite_he_opposite_vh(h);
      const int gain = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0) - excess(a, -1) -
                       excess(b, -1) - excess(c, 1) - excess(d, 1);
      if (gain <= 0)
        continue;
      // a b c and b a d become c d b and d c a.
      const Vec3d &pa = mesh_.point(a), &pb = mesh_.point(b), &pc = mesh_.point(c),
                  &pd = mesh_.point(d);
      if (turned({pa, pb, pc}, {pd, pb, pc}) || turned({pa, pb, pc}, {pa, pd, pc}) ||
          turned({pb, pa, pd}, {pd, pb, pc}) || turned({pb, pa, pd}, {pa, pd, pc}))
        continue;
      mesh_.flip(e);
    }
  }

  /// Square distance of a valence from the one that even triangles have.
  int excess(VertexHandle v, int change) const {
    const int best = mesh_.is_boundary(v) ? 4 : 6;
    const int off = static_cast<int>(mesh_.valence(v)) + change - best;
    return off * off;
  }

  void relax() {
    std::vector<std::pair<VertexHandle, SurfacePoint>> moves;
    for (auto v : mesh_.vertices()) {
      if (on_crease(v))
        continue;
      Vec3d middle(0, 0, 0);
      size_t count = 0;
      for (auto w : mesh_.vv_range(v)) {
        middle += mesh_.point(w);
        ++count;
      }
      if (count == 0)
        continue;
      middle /= static_cast<double>(count);
      moves.emplace_back(v, surface_.walk(point_of(middle), mesh_.property(below_, v)));
    }
    for (const auto& [v, target] : moves) {
      const Vec3d to = vector_of(target.position);
      bool any = false;
      for (auto f : mesh_.vf_range(v))
        any |= turned(corners_of(f), corners_of(f, v, to));
      if (any)
        continue;
      mesh_.set_point(v, to);
      mesh_.property(below_, v) = target.triangle;
    }
  }

  bool on_crease(VertexHandle v) const {
    for (auto e : mesh_.ve_range(v)) {
      if (mesh_.status(e).feature())
        return true;
    }
    return false;
  }

  TriMesh mesh_;
  const Surface& surface_;
  OpenMesh::VPropHandleT<uint32_t> below_;  ///< triangle of the surface
  uint32_t goal_;
  double length_ = 0;
  size_t most_ = 0;
};

}  // namespace

SurfaceFrame remesh_isotropic(const SurfaceFrame& mesh, const IsotropicOptions& options,
                              const Progress& progress, MeshRepairs* repairs) {
  if (options.vertices == 0)
    throw Error(ErrorKind::kUsage, "remeshing needs a number of vertices");
  const SoundMesh sound = sound_mesh(single_frame(mesh));
  if (repairs != nullptr)
    *repairs = sound.repairs;
  const Positions given = sound.frame(mesh.positions);
  const UnitBox box(given);
  const Positions positions = box.to_box(given);
  std::vector<uint32_t> corners;
  for (const SurfaceTopology::Triangle& t : sound.triangles)
    corners.insert(corners.end(), t.begin(), t.end());
  const SurfaceTopology topology(corners, static_cast<uint32_t>(sound.source.size()));
  const Surface surface(topology, positions);
  Remesher remesher(sound, positions, surface, options);
  for (int round = 0; round < options.rounds; ++round) {
    if (progress)
      progress("remeshing", static_cast<double>(round) / options.rounds);
    if (round > 1)
      remesher.correct_length();
    remesher.run_round();
  }

  const CompactMesh left = compact(remesher.mesh());
  const Positions moved = box.from_box(positions_of(remesher.mesh(), left.vertices));
  SurfaceFrame result;
  for (const SurfaceTopology::Triangle& t : left.triangles)
    result.polygons.add(t);
  for (Eigen::Index v = 0; v < moved.rows(); ++v) {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      result.positions.push_back(static_cast<float>(moved(v, axis)));
  }
  return result;
}

}  // namespace anicodec
