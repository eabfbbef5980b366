// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/sliding.h"

#include "codec/surface/surface.h"
#include "corpus/build.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace anicodec::corpus {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr int kSmoothings = 3;
constexpr int kHalvings = 4;
constexpr double kLeastCosine = 0.05, kLeastArea = 0.1;  // of a triangle against the one before

/// About normally distributed: the sum of twelve uniform numbers.
double normal_number(SplitMix64& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i)
    sum += random.uniform(0, 1);
  return sum;
}

/// Smooth tangential noise, root mean square 1 over the vertices that move.
Positions smooth_noise(const Surface& surface, SplitMix64& random) {
  const SurfaceTopology& topology = surface.topology();
  Positions noise(static_cast<Index>(topology.vertex_count), 3);
  for (Index i = 0; i < noise.size(); ++i)
    noise.data()[i] = normal_number(random);
  for (int pass = 0; pass < kSmoothings; ++pass) {
    const Positions before = noise;
    for (uint32_t i = 0; i < topology.vertex_count; ++i) {
      const auto ring = topology.ring[i];
      for (uint32_t j : ring)
        noise.row(i) += before.row(j);
      noise.row(i) /= static_cast<double>(ring.size() + 1);
    }
  }
  size_t moving = 0;
  for (uint32_t i = 0; i < topology.vertex_count; ++i) {
    const Vector3d n = row(surface.normals(), i);
    if (topology.kind[i] == VertexKind::kInner && n.squaredNorm() > 0) {
      noise.row(i) -= n.dot(row(noise, i)) * n.transpose();
      ++moving;
    } else {
      noise.row(i).setZero();
    }
  }
  const double size = noise.norm();
  if (size > 0)
    noise *= std::sqrt(static_cast<double>(moving)) / size;
  return noise;
}

Positions slid(const Surface& surface, double edges, SplitMix64& random) {
  const SurfaceTopology& topology = surface.topology();
  const Positions& before = surface.positions();
  const Eigen::VectorXd size = ring_sizes(topology, before);
  Positions step = (edges * size).asDiagonal() * smooth_noise(surface, random);
  for (uint32_t i = 0; i < topology.vertex_count; ++i) {
    double shortest = size[i];
    for (uint32_t j : topology.ring[i])
      shortest = std::min(shortest, (row(before, j) - row(before, i)).norm());
    const double most = 0.9 * std::min(size[i], 2 * shortest), length = step.row(i).norm();
    if (length > most)
      step.row(i) *= most / length;
  }
  Positions after = before;
  std::vector<uint32_t> pending(topology.vertex_count);
  std::iota(pending.begin(), pending.end(), 0U);
  for (int attempt = 0; attempt <= kHalvings && !pending.empty(); ++attempt) {
    for (uint32_t i : pending) {
      if (!topology.star[i].empty())
        after.row(i) =
            surface.walk(row(before, i) + row(step, i), topology.star[i][0]).position.transpose();
    }
    pending.clear();
    for (const SurfaceTopology::Triangle& t : topology.triangles) {
      const Vector3d a = area_normal(before, t), b = area_normal(after, t);
      if (a.dot(b) < kLeastCosine * a.norm() * b.norm() || b.norm() < kLeastArea * a.norm())
        pending.insert(pending.end(), t.begin(), t.end());
    }
    std::sort(pending.begin(), pending.end());
    pending.erase(std::unique(pending.begin(), pending.end()), pending.end());
    for (uint32_t i : pending)
      step.row(i) *= attempt + 1 < kHalvings ? 0.5 : 0.0;
  }
  return after;
}

}  // namespace

MeshSequence slide_vertices(const MeshSequence& sequence, double edges, double grid,
                            uint64_t seed) {
  MeshSequence result = sequence;
  const SurfaceTopology topology(fan_triangles(sequence.polygons), sequence.vertex_count);
  SplitMix64 seeds(seed);
  for (uint32_t f = 0; f < sequence.frame_count; ++f) {
    SplitMix64 random(seeds.next());
    const Surface surface(topology, positions_of(sequence.frame(f)));
    const Positions after = slid(surface, edges, random);
    std::span<float> out = result.frame(f);
    for (Index i = 0; i < after.size(); ++i) {
      const double x = after.data()[i];
      // Adding 0 turns -0 into 0: equal positions have equal bits.
      out[static_cast<size_t>(i)] =
          static_cast<float>(grid > 0 ? std::round(x / grid) * grid + 0.0 : x);
    }
  }
  return result;
}

}  // namespace anicodec::corpus
