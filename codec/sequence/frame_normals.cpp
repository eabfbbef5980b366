// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/frame_normals.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace anicodec {

FrameNormals::FrameNormals(const MeshSequence& clip) {
  const Polygons& polygons = clip.polygons;
  Topology topology;
  topology.coded_vertices = clip.vertex_count;
  topology.vertex_coded.resize(clip.vertex_count);
  std::iota(topology.vertex_coded.begin(), topology.vertex_coded.end(), 0U);
  topology.polygon_offsets.assign(polygons.offsets.begin(), polygons.offsets.end());
  topology.polygon_corners.assign(polygons.corners.begin(), polygons.corners.end());
  std::map<uint32_t, uint32_t> numbers;  // those of the clip may be any
  Vector<uint32_t> shared;
  shared.reserve(polygons.corners.size());
  for (uint32_t x : clip.shared_normals.empty() ? polygons.corners : clip.shared_normals)
    shared.push_back(numbers.try_emplace(x, static_cast<uint32_t>(numbers.size())).first->second);
  plan_ = plan_normals(topology, shared, true);
  first_corner_.resize(plan_.centre.size() - 1);
  for (uint32_t c = plan_.size(); c-- > 0;)
    first_corner_[plan_.group[c]] = c;
}

std::vector<float> FrameNormals::compute(std::span<const float> positions) const {
  std::vector<float> of_corners(size_t{3} * plan_.size());
  VertexOutput output;
  output.data = of_corners.data();
  compute_normals(plan_, positions.data(), 3 * sizeof(float), 0, plan_.size(), output);
  std::vector<float> normals;
  normals.reserve(3 * first_corner_.size());
  for (const uint32_t c : first_corner_)
    normals.insert(normals.end(), &of_corners[size_t{3} * c], &of_corners[size_t{3} * c] + 3);
  return normals;
}

namespace {

/// In degrees.
double angle(const float* a, const float* b) {
  double dot = 0, cross = 0;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const auto x = [](float value) { return static_cast<double>(value); };
    dot += x(a[i]) * x(b[i]);
    cross += std::pow(x(a[j]) * x(b[k]) - x(a[k]) * x(b[j]), 2);
  }
  return std::atan2(std::sqrt(cross), dot) * 180 / std::numbers::pi;
}

}  // namespace

NormalError normal_error(const MeshSequence& clip, const FrameSource& a, const FrameSource& b) {
  const FrameNormals normals(clip);
  NormalError error;
  double sum = 0, count = 0;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    const std::vector<float> p = normals.compute(a(f)), q = normals.compute(b(f));
    for (size_t i = 0; i < p.size(); i += 3) {
      const double degrees = angle(p.data() + i, q.data() + i);
      error.max = std::max(error.max, degrees);
      sum += degrees;
      ++count;
    }
  }
  error.mean = count > 0 ? sum / count : 0;
  return error;
}

}  // namespace anicodec
