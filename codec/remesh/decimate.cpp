// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/decimate.h"

#include "codec/remesh/open_mesh.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <cstddef>

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>

namespace anicodec {
namespace {

using OpenMesh::TriMesh;
using OpenMesh::Vec3d;
using Quadric = OpenMesh::Geometry::QuadricT<double>;

constexpr double kTurn = 60, kMostTurn = 85;  // degrees, of a triangle in a collapse
constexpr double kOutline = 1;                // weight of a boundary's planes, per length squared
// Weight of the distance from a vertex's own place, of that from its planes: it keeps flat parts
// from slivers, and is too little to matter on curved ones.
constexpr double kPlace = 1e-4;
// A hub is tested against all its neighbours, whenever one of them is removed: it stays.
constexpr unsigned kHub = 100;
constexpr size_t kReportEvery = 1000;  // collapses

/// OpenMesh's quadrics, and those that it has not: of boundaries and of places.
class SteadyQuadric : public OpenMesh::Decimater::ModQuadricT<TriMesh> {
 public:
  using Self = SteadyQuadric;
  using Base = OpenMesh::Decimater::ModQuadricT<TriMesh>;
  using Handle = OpenMesh::Decimater::ModHandleT<SteadyQuadric>;

  explicit SteadyQuadric(TriMesh& mesh) : Base(mesh) { mesh.add_property(extra_); }

  ~SteadyQuadric() override { mesh().remove_property(extra_); }

  void initialize() override {
    Base::initialize();
    for (auto v : mesh().vertices())
      mesh().property(extra_, v) = Quadric();
    for (auto f : mesh().faces())
      add_places(f);
    for (auto h : mesh().halfedges()) {
      if (mesh().is_boundary(h))
        add_outline(mesh().opposite_halfedge_handle(h));
    }
  }

  float collapse_priority(const CollapseInfo& collapse) override {
    Quadric extra = mesh().property(extra_, collapse.v0);
    extra += mesh().property(extra_, collapse.v1);
    // Rounding leaves either sum a little below 0 where it is 0, which would forbid the collapse.
    return std::max(0.0F, Base::collapse_priority(collapse)) +
           static_cast<float>(std::max(0.0, extra(collapse.p1)));
  }

  void postprocess_collapse(const CollapseInfo& collapse) override {
    Base::postprocess_collapse(collapse);
    mesh().property(extra_, collapse.v1) += mesh().property(extra_, collapse.v0);
  }

 private:
  void add_places(TriMesh::FaceHandle f) {
    const double weight = kPlace * mesh().calc_face_area(f);
    for (auto v : mesh().fv_range(f)) {
      const Vec3d p = mesh().point(v);
      Quadric place(1, 0, 0, -p[0], 1, 0, -p[1], 1, -p[2], p.sqrnorm());
      place *= weight;
      mesh().property(extra_, v) += place;
    }
  }

  /// `side`: of a boundary edge, the half that has a face.
  void add_outline(TriMesh::HalfedgeHandle side) {
    const TriMesh::VertexHandle from = mesh().from_vertex_handle(side),
                                to = mesh().to_vertex_handle(side);
    const Vec3d edge = mesh().point(to) - mesh().point(from);
    Vec3d across = edge % mesh().calc_face_normal(mesh().face_handle(side));
    const double length = across.norm();
    if (!(length > 0))
      return;
    across /= length;
    Quadric plane(across[0], across[1], across[2], -(mesh().point(from) | across));
    plane *= kOutline * edge.sqrnorm();
    mesh().property(extra_, from) += plane;
    mesh().property(extra_, to) += plane;
  }

  OpenMesh::VPropHandleT<Quadric> extra_;
};

class Report : public OpenMesh::Decimater::Observer {
 public:
  Report(const Progress& progress, size_t collapses)
      : Observer(kReportEvery), progress_(progress), collapses_(collapses) {}

  void notify(size_t step) override {
    if (progress_)
      progress_("decimating", static_cast<double>(step) / static_cast<double>(collapses_));
  }

 private:
  const Progress& progress_;
  size_t collapses_;
};

void lock_hubs(bool locked, TriMesh* mesh) {
  for (auto v : mesh->vertices())
    mesh->status(v).set_locked(locked && mesh->valence(v) > kHub);
}

/// Removes up to so many vertices.
void collapse(size_t collapses, double max_distance, const Progress& progress, TriMesh* mesh) {
  using OpenMesh::Decimater::ModHausdorffT;
  using OpenMesh::Decimater::ModNormalFlippingT;
  Report report(progress, collapses);
  mesh->request_face_normals();  // else the module asks for them, and tells the terminal
  mesh->update_face_normals();
  {
    OpenMesh::Decimater::DecimaterT<TriMesh> decimater(*mesh);
    decimater.set_observer(&report);
    SteadyQuadric::Handle quadric;
    ModNormalFlippingT<TriMesh>::Handle flipping;
    ModHausdorffT<TriMesh>::Handle hausdorff;
    decimater.add(quadric);
    decimater.add(flipping);
    decimater.module(flipping).set_max_normal_deviation(kTurn);
    if (max_distance > 0) {
      decimater.add(hausdorff);
      decimater.module(hausdorff).set_tolerance(max_distance);
    }
    if (!decimater.initialize())
      throw Error(ErrorKind::kInternal, "the decimater has no measure of errors");
    lock_hubs(true, mesh);
    const size_t done = decimater.decimate(collapses);
    if (done < collapses) {
      lock_hubs(false, mesh);
      decimater.module(flipping).set_max_normal_deviation(kMostTurn);
      decimater.decimate(collapses - done);
    }
  }
  mesh->release_face_normals();
}

}  // namespace

Decimation decimate(const SurfaceFrame& mesh, const DecimationOptions& options,
                    const Progress& progress) {
  if (options.vertices == 0 && !(options.max_distance > 0))
    throw Error(ErrorKind::kUsage, "decimating needs a number of vertices or a distance");
  const MeshSequence sequence = single_frame(mesh);
  const SoundMesh sound = sound_mesh(sequence);
  const Positions positions = sound.frame(mesh.positions);
  const UnitBox box(positions);
  TriMesh half_edges;
  half_edges
      .request_vertex_status();  // else the decimater takes the marks of what it deleted along
  half_edges.request_edge_status();
  half_edges.request_face_status();
  add_triangles(sound.triangles, box.to_box(positions), &half_edges);
  if (options.vertices < sound.source.size())
    collapse(sound.source.size() - options.vertices, options.max_distance / box.diagonal(),
             progress, &half_edges);

  const CompactMesh left = compact(half_edges);
  Decimation result;
  result.repairs = sound.repairs;
  for (const SurfaceTopology::Triangle& t : left.triangles)
    result.mesh.polygons.add(t);
  for (uint32_t v : left.vertices) {
    const uint32_t source = sound.source[v];
    result.vertices.push_back(source);
    for (size_t axis = 0; axis < 3; ++axis)
      result.mesh.positions.push_back(mesh.positions[size_t{3} * source + axis]);
  }
  return result;
}

}  // namespace anicodec
