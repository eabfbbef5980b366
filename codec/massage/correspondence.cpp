// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/correspondence.h"

#include "codec/parallel/parallel.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kLeastImportance = 1e-2, kMostImportance = 1e3;
constexpr double kTrustedQuantile = 0.9, kTrustedReach = 3;

double distance(const Correspondence& c, const Positions& v) {
  return (c.point(v) - c.target).norm();
}

}  // namespace

Correspondences::Correspondences(const SurfaceTopology& mesh, const Surface& surface, bool centres)
    : mesh_(&mesh),
      surface_(&surface),
      surface_has_boundary_(surface.topology().has_boundary()),
      from_mesh_(mesh.vertex_count + (centres ? mesh.triangles.size() : 0)),
      from_surface_(surface.topology().vertex_count),
      start_on_surface_(from_mesh_.size(), SurfaceTopology::kNone),
      start_on_mesh_(from_surface_.size(), SurfaceTopology::kNone) {}

void Correspondences::update(const Positions& v, bool by_index) {
  Surface moving(*mesh_, v);
  if (by_index)
    moving.build_index();
  // Isolated: a caller that works on several frames at once must not be entered again meanwhile.
  isolated([&] {
    parallel_for(size_t{0}, from_mesh_.size(), [&](size_t r) {
      if (r < mesh_->vertex_count)
        draw_vertex(static_cast<uint32_t>(r), v, moving.normals(), by_index);
      else
        draw_centre(static_cast<uint32_t>(r - mesh_->vertex_count), v, by_index);
    });
    parallel_for(size_t{0}, from_surface_.size(), [&](size_t j) {
      if (!surface_->topology().star[j].empty())
        draw_to_vertex(static_cast<uint32_t>(j), moving, by_index);
    });
  });
}

SurfacePoint Correspondences::find(const Surface& surface, const Vector3d& q, bool by_index,
                                   uint32_t* start) const {
  const SurfacePoint point =
      by_index || *start == SurfaceTopology::kNone ? surface.closest(q) : surface.walk(q, *start);
  *start = point.triangle;
  return point;
}

void Correspondences::draw_vertex(uint32_t i, const Positions& v, const Positions& normals,
                                  bool by_index) {
  Correspondence& c = from_mesh_[i];
  c.corners = {i, i, i};
  c.used = false;
  if (mesh_->star[i].empty())
    return;
  const Vector3d here = row(v, i);
  const SurfacePoint point = find(*surface_, here, by_index, &start_on_surface_[i]);
  c.normal = surface_->normal(point);
  c.target = surface_->curved(point);
  c.along = Vector3d::Zero();
  if (mesh_->kind[i] == VertexKind::kBoundary && surface_has_boundary_) {
    c.target = surface_->closest_on_boundary(here, &c.along);
    c.used = true;
    return;
  }
  c.used = row(normals, i).dot(c.normal) >= kLeastAgreement &&
           !(mesh_->kind[i] == VertexKind::kInner && surface_->on_boundary(point));
}

void Correspondences::draw_centre(uint32_t t, const Positions& v, bool by_index) {
  const size_t r = size_t{mesh_->vertex_count} + t;
  Correspondence& c = from_mesh_[r];
  c.corners = mesh_->triangles[t];
  c.weights = Vector3d::Constant(1.0 / 3);
  const SurfacePoint point = find(*surface_, c.point(v), by_index, &start_on_surface_[r]);
  c.target = point.position;
  c.normal = surface_->normal(point);
  c.used = area_normal(v, c.corners).normalized().dot(c.normal) >= kLeastAgreement &&
           !surface_->on_boundary(point);
}

void Correspondences::draw_to_vertex(uint32_t j, const Surface& moving, bool by_index) {
  Correspondence& c = from_surface_[j];
  c.target = row(surface_->positions(), j);
  c.normal = row(surface_->normals(), j);
  const SurfacePoint point = find(moving, c.target, by_index, &start_on_mesh_[j]);
  c.corners = mesh_->triangles[point.triangle];
  c.weights = point.weights;
  c.used = moving.normal(point).dot(c.normal) >= kLeastAgreement &&
           (surface_->topology().kind[j] != VertexKind::kInner || !moving.on_boundary(point));
}

template <class Visit>
void Correspondences::for_used(const Visit& visit) {
  for (std::vector<Correspondence>* list : {&from_mesh_, &from_surface_}) {
    for (Correspondence& c : *list) {
      if (c.used)
        visit(c);
    }
  }
}

Residuals Correspondences::residuals(const Positions& v) const {
  Residuals result;
  double squares = 0;
  size_t used = 0;
  for (const std::vector<Correspondence>* list : {&from_mesh_, &from_surface_}) {
    for (const Correspondence& c : *list) {
      if (!c.used)
        continue;
      const double d = distance(c, v);
      squares += d * d;
      result.max = std::max(result.max, d);
      ++used;
    }
  }
  const size_t all = from_mesh_.size() + from_surface_.size();
  if (used > 0)
    result.rms = std::sqrt(squares / static_cast<double>(used));
  if (all > 0)
    result.dropped_share = 1 - static_cast<double>(used) / static_cast<double>(all);
  return result;
}

void Correspondences::reweight(const Positions& v, double exponent) {
  const double rms = residuals(v).rms;
  if (!(rms > 0))
    return;
  double sum = 0;
  size_t used = 0;
  for_used([&](Correspondence& c) {
    c.importance *= std::pow(distance(c, v) / rms + 1e-3, exponent);
    sum += c.importance;
    ++used;
  });
  for_used([&](Correspondence& c) {
    c.importance = std::clamp(c.importance * static_cast<double>(used) / sum, kLeastImportance,
                              kMostImportance);
  });
}

void Correspondences::trust_near(const Positions& v) {
  std::vector<double> distances;
  for_used([&](Correspondence& c) { distances.push_back(distance(c, v)); });
  if (distances.empty())
    return;
  const auto quantile =
      distances.begin() +
      static_cast<ptrdiff_t>(kTrustedQuantile * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), quantile, distances.end());
  const double reach = kTrustedReach * *quantile;
  for_used([&](Correspondence& c) {
    const double d = reach > 0 ? distance(c, v) / reach : 0;
    c.importance = std::exp(-d * d);
  });
}

Vector3d Correspondences::facing(uint32_t triangle) const {
  const SurfaceTopology::Triangle& t = mesh_->triangles[triangle];
  return from_mesh_[t[0]].normal + from_mesh_[t[1]].normal + from_mesh_[t[2]].normal;
}

}  // namespace anicodec
