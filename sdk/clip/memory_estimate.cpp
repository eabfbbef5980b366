// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/memory_estimate.h"

#include "format/attribute_record.h"
#include "sdk/clip/mesh_work.h"
#include "sdk/mesh/draco_profile.h"
#include "sdk/msgi/msgi_memory.h"
#include "sdk/prediction/prediction_job.h"
#include "sdk/segment/learnt_segment.h"
#include "sdk/segment/segment.h"

#include <algorithm>

namespace anicodec {
namespace {

constexpr uint64_t kModels = uint64_t{1} << 18;  // of the entropy coders
constexpr uint64_t kPoseModels = uint64_t{3} << 17;
constexpr uint64_t kFaceModels = uint64_t{3} << 18;   // of the coder of faces
constexpr uint64_t kOrderModels = uint64_t{1} << 18;  // and of the order of the vertices
constexpr uint64_t kNeighbours = 24;                  // at most, of a vertex
constexpr uint64_t kClip = 256, kRootOfClip = 128, kRootOfFrame = 12;
constexpr uint64_t kStructure = 512;  // of a mesh or segment
constexpr uint64_t kMatrix = 48;      // bytes of a pose map or motion
constexpr uint64_t kExactModels = uint64_t{1} << 18;
constexpr uint64_t kSymbol = 12;               // bytes that Draco keeps per possible symbol
constexpr uint64_t kZstd = uint64_t{1} << 17;  // what zstd decodes in

/// A sum that stays at its end instead of wrapping.
class CheckedSum {
 public:
  void add(uint64_t x) { total_ += std::min(x, UINT64_MAX - total_); }

  uint64_t total() const { return total_; }

 private:
  uint64_t total_ = 0;
};

uint64_t resident(const Limits::Mesh& m) {
  return kStructure + 4 * (uint64_t{m.source_vertices} + m.polygons + 1 + uint64_t{m.corners}) +
         attribute_bytes(m);
}

/// Bytes for a mesh until its segments are open: its triangles, and a pose.
uint64_t held(const Limits::Mesh& m) {
  return uint64_t{12} * m.triangles + uint64_t{12} * m.coded_vertices;
}

/// An order of the vertices, and their regions.
uint64_t order(const Limits::Mesh& m) {
  return (4 * kNeighbours + 5) * m.coded_vertices;
}

/// Bytes that several segments share until they are open: the corners that poses are predicted over, the
/// edges that their orders are made from, and the last order.
uint64_t shared(const Limits::Mesh& m) {
  return uint64_t{36} * m.triangles + uint64_t{80} * m.coded_vertices + order(m);
}

/// Bytes of what segments of a mesh learn, three times: of the file before, of the segment before, of the one at hand.
uint64_t learning(const Limits::Mesh& m) {
  constexpr uint64_t kOfVertex = 4 * learnt_floats(kMostLearningNeighbours) + 62;
  return 3 * (kOfVertex * m.coded_vertices + kModels);
}

/// Exact positions: 24 and 31 bits, and a factor of 12.
uint64_t exact_bytes(const Limits::Segment& s, const Limits::Mesh& mesh) {
  return uint64_t{12} * s.frames * mesh.coded_vertices;
}

/// Scratch memory of decoding exact positions: four neighbours of each vertex and their state,
/// errors of lattice points, a reference of each frame.
uint64_t exact_opening(const Limits::Segment& s, const Limits::Mesh& mesh) {
  return s.exact ? uint64_t{42} * mesh.coded_vertices + exact_bytes(s, mesh) +
                       uint64_t{12} * s.frames + kExactModels
                 : 0;
}

/// A segment whose components are those wanted, and its exact positions if they are.
Limits::Segment coarser(Limits::Segment s, double quality, bool exact) {
  s.exact = s.exact && exact;
  if (s.kind != BasisKind::kKeyframes && !s.learns)
    s.components = wanted_components(quality, s.components);
  s.wide_components = std::min(s.wide_components, s.components);
  return s;
}

// The factors of a product have at most 31 + 21 bits, its constant 6: each term fits 64 bits.
uint64_t resident(const Limits::Segment& s, const Limits::Mesh& mesh) {
  const uint64_t n = (uint64_t{mesh.source_vertices} + 15) / 16 * 16;
  const uint64_t components = s.components;
  const uint64_t frames = uint64_t{s.frames} * s.regions;
  const uint64_t integers = components + s.wide_components;  // in units of 16 bits
  uint64_t bytes = kStructure;
  switch (s.kind) {
    case BasisKind::kKeyframes:
      bytes += kMatrix * frames + 6 * n * integers + 4 * frames * components;
      break;
    case BasisKind::kEigenshapes:
      bytes += kMatrix * frames + 12 * n + 6 * n * integers + 4 * frames * components;
      break;
    case BasisKind::kEigentrajectories:
      bytes += kMatrix * frames + 12 * n + 2 * n * integers + 12 * frames * components;
      break;
  }
  if (s.reconstruction == Reconstruction::kMsgi)
    bytes += msgi_bytes(s, mesh) + uint64_t{4} * mesh.source_vertices;
  if (s.exact) {
    const bool maps = s.reconstruction != Reconstruction::kMsgi;  // which has the map already
    bytes += exact_bytes(s, mesh) + (maps ? uint64_t{4} * mesh.source_vertices : 0);
  }
  if (s.regions > 1)
    bytes += n;
  if (s.corrections > 0)
    bytes += uint64_t{16} * s.corrections + 4 * (uint64_t{s.frames} + 1);
  return bytes;
}

/// Draco's decoder keeps values three times, a mesh and its corners, the order of the values, and
/// tables for the symbols that it decodes.
uint64_t draco(const Limits::Segment& s, const Limits::Mesh& m) {
  if (s.draco_bytes == 0)
    return 0;
  const uint64_t components = uint64_t{3} * s.components, points = s.draco_points;
  const uint64_t tables =
      (uint64_t{4} << draco_table_bits(points * std::min<uint64_t>(components, 255))) +
      kSymbol * std::min<uint64_t>(uint64_t{64} * s.draco_bytes, kMaxDracoSymbols);
  return kStructure * (kMaxDracoAttributes + 8) + tables + uint64_t{64} * s.draco_bytes +
         12 * points * components + uint64_t{160} * m.triangles + 80 * points;
}

/// The corners that a pose is predicted over, what is known of its vertices, and their partners.
uint64_t predicting(const Limits::Mesh& m) {
  return uint64_t{48} * m.coded_vertices + uint64_t{52} * m.triangles + kPoseModels;
}

uint64_t opening(const Limits::Mesh& m) {
  const uint64_t faces = uint64_t{44} * m.corners + uint64_t{8} * m.polygons +
                         uint64_t{28} * m.coded_vertices + kFaceModels;
  const uint64_t maps = uint64_t{40} * m.source_vertices + uint64_t{36} * m.polygons +
                        uint64_t{16} * m.corners + kOrderModels;
  // Edges, entries and their numbers; or a permutation and a copy.
  const uint64_t attributes = m.attributes == 0
                                  ? 0
                                  : uint64_t{64} * m.corners + uint64_t{16} * m.source_vertices +
                                        2 * attribute_bytes(m) + 65536;
  return std::max({faces, maps + attributes, predicting(m)}) + kZstd;
}

uint64_t opening(const Limits::Segment& s, const Limits::Mesh& mesh) {
  // Kinds with a prediction: residuals and coefficients, weights, the order of the vertices.
  const uint64_t n = mesh.coded_vertices, components = s.components;
  const uint64_t frames = uint64_t{s.frames} * s.regions;
  // Key-frames as floats, faces and patches, and the fronts of the factorisation.
  uint64_t msgi = 0;
  if (s.reconstruction == Reconstruction::kMsgi)
    msgi = 12 * n * components + uint64_t{1000} * mesh.triangles + msgi_bytes(s, mesh);
  if (s.kind == BasisKind::kKeyframes)
    return 36 * n * components + 4 * frames * components + 28 * frames + kModels + msgi +
           (s.draco_bytes > 0 ? draco(s, mesh) : predicting(mesh));
  // Residuals lie in the resident arrays. Making the order of the vertices takes most for each of
  // them, predicting for each coefficient.
  const uint64_t channels = traits_of(s.kind).channels;
  const uint64_t ordering = (4 * kNeighbours + 272) * n + uint64_t{48} * mesh.triangles;
  const uint64_t predicting =
      4 * channels * (n + 1) * (components + 8) + (4 * kNeighbours + 24) * n;
  return std::max(ordering, predicting) + 12 * frames * components + 80 * frames + kModels;
}

}  // namespace

MemoryEstimate estimate_memory(const Limits& limits, double quality, bool exact) {
  MemoryEstimate estimate;
  CheckedSum open, until_open, kept;
  uint64_t largest = 0;
  const Vector<uint32_t> predicted = predicted_segments(limits);
  open.add(kClip * limits.clip_frames.size());
  if (limits.root_frames > 0)
    open.add(kRootOfClip * limits.clip_frames.size() + kRootOfFrame * limits.root_frames);
  for (size_t i = 0; i < limits.meshes.size(); ++i) {
    const Limits::Mesh& m = limits.meshes[i];
    open.add(resident(m));
    until_open.add(held(m));
    kept.add(resident(m) + held(m) + 2 * order(m));  // one in use
    until_open.add(predicted[i] > 1 ? shared(m) : 0);
    largest = std::max(largest, opening(m));
  }
  for (const Limits::Segment& s : limits.segments) {
    const Limits::Mesh mesh = s.coded_over(limits.meshes[s.mesh]);
    const Limits::Segment wanted = coarser(s, quality, exact);
    open.add(resident(wanted, mesh));
    largest = std::max({largest, opening(wanted, mesh), exact_opening(wanted, mesh)});
    estimate.draco = std::max(estimate.draco, draco(s, mesh));
  }
  Vector<uint8_t> learns(limits.meshes.size(), 0);
  for (const Limits::Segment& s : limits.segments)
    learns[s.mesh] |= static_cast<uint8_t>(s.learns);
  for (size_t i = 0; i < limits.meshes.size(); ++i)
    until_open.add(learns[i] ? learning(limits.meshes[i]) : 0);
  const Vector<uint32_t> order_of_segments = limits.segments_by_frame();
  for (size_t i = 0; i < order_of_segments.size(); ++i) {  // each attribute that moves, once
    const Limits::Segment& s = limits.segments[order_of_segments[i]];
    const Limits::Segment* before = i > 0 ? &limits.segments[order_of_segments[i - 1]] : nullptr;
    if (s.attribute == kPositions ||
        (before && before->mesh == s.mesh && before->attribute == s.attribute))
      continue;
    const Limits::Mesh surface = s.coded_over(limits.meshes[s.mesh]);
    open.add(uint64_t{4} * surface.source_vertices);
    until_open.add(held(surface) + shared(surface));
    kept.add(uint64_t{4} * surface.source_vertices + uint64_t{12} * surface.triangles);
  }
  estimate.resident = open.total();
  open.add(until_open.total());
  open.add(largest);
  estimate.opening = open.total();
  estimate.kept = kept.total();
  return estimate;
}

}  // namespace anicodec
