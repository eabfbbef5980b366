// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/mutual_distance.h"

#include "codec/parallel/parallel.h"

#include <cmath>

namespace anicodec {
namespace {

using Eigen::Vector3d;

SurfacePoint find(const Surface& surface, const Vector3d& q, bool by_index, uint32_t* start) {
  const SurfacePoint point = by_index ? surface.closest(q) : surface.walk(q, *start);
  *start = point.triangle;
  return point;
}

}  // namespace

SampledSide::SampledSide(const SurfaceTopology& topology)
    : samples(surface_samples(topology)),
      starts(samples.size(), SurfaceTopology::kNone),
      pairs(samples.size()) {}

double SampledSide::mean() const {
  double sum = 0;
  for (size_t s = 0; s < samples.size(); ++s)
    sum += shares[s] * pairs[s].distance;
  return sum;
}

double SampledSide::max() const {
  double result = 0;
  for (const SamplePair& pair : pairs)
    result = std::max(result, pair.distance);
  return result;
}

MutualDistance::MutualDistance(const SurfaceTopology& mesh, const Surface& surface)
    : from_mesh(mesh), from_surface(surface.topology()), mesh_(mesh), surface_(surface) {
  from_surface.shares =
      sample_shares(surface.topology(), from_surface.samples, surface.positions());
}

void MutualDistance::update(const Positions& v, bool by_index) {
  Surface moving(mesh_, v);
  if (by_index)
    moving.build_index();
  from_mesh.shares = sample_shares(mesh_, from_mesh.samples, v);
  // Isolated: a caller that works on several frames at once must not be entered again meanwhile.
  isolated([&] {
    parallel_for(size_t{0}, from_mesh.samples.size(), [&](size_t s) {
      const SurfaceSample& sample = from_mesh.samples[s];
      SamplePair& pair = from_mesh.pairs[s];
      pair.on_mesh = {sample.triangle, sample.weights, sample_point(mesh_, sample, v), 0};
      const SurfacePoint found =
          find(surface_, pair.on_mesh.position, by_index, &from_mesh.starts[s]);
      pair.target = found.position;
      set_direction(found.triangle, &pair);
    });
    parallel_for(size_t{0}, from_surface.samples.size(), [&](size_t s) {
      const SurfaceSample& sample = from_surface.samples[s];
      SamplePair& pair = from_surface.pairs[s];
      pair.target = sample_point(surface_.topology(), sample, surface_.positions());
      pair.on_mesh = find(moving, pair.target, by_index, &from_surface.starts[s]);
      set_direction(sample.triangle, &pair);
    });
  });
}

/// The normal of the surface serves if there is no distance to speak of.
void MutualDistance::set_direction(uint32_t triangle, SamplePair* pair) const {
  const Vector3d offset = pair->target - pair->on_mesh.position;
  pair->distance = offset.norm();
  const Vector3d normal =
      area_normal(surface_.positions(), surface_.topology().triangles[triangle]);
  pair->direction = pair->distance > 1e-6 * std::sqrt(normal.norm())
                        ? Vector3d(offset / pair->distance)
                        : Vector3d(normal.normalized());
}

}  // namespace anicodec
