// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/subdivide.h"

#include "codec/remesh/open_mesh.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

namespace anicodec {
namespace {

using OpenMesh::TriMesh;

constexpr double kMostPositions = 1 << 30;  // vertices x frames

/// The mesh of one frame, subdivided.
TriMesh subdivided(const SoundMesh& sound, const Positions& positions, uint32_t levels) {
  TriMesh mesh;
  add_triangles(sound.triangles, positions, &mesh);
  size_t valence = 6;  // of the vertices that are made
  for (auto v : mesh.vertices())
    valence = std::max<size_t>(valence, mesh.valence(v));
  OpenMesh::Subdivider::Uniform::LoopT<TriMesh, double> loop;
  loop.init_weights(valence + 1);  // it does not look how far its table goes
  loop.attach(mesh);
  loop(levels);
  loop.detach();
  return mesh;
}

void check_size(const SoundMesh& sound, uint32_t frames, uint32_t levels) {
  // A level adds a vertex for each edge, of which there are at most three a triangle.
  const double triangles = static_cast<double>(sound.triangles.size()) * std::pow(4.0, levels);
  if (triangles * 3 * frames > kMostPositions)
    throw Error(ErrorKind::kInput, "the subdivided mesh would be too large");
}

}  // namespace

MeshSequence subdivide(const MeshSequence& sequence, uint32_t levels) {
  const SoundMesh sound = sound_mesh(sequence);
  check_size(sound, sequence.frame_count, levels);
  MeshSequence result;
  result.name = sequence.name;
  result.mesh_name = sequence.mesh_name;
  result.frame_count = sequence.frame_count;
  result.rate = sequence.rate;
  result.start_time = sequence.start_time;
  result.times = sequence.times;
  result.up = sequence.up;
  result.metres_per_unit = sequence.metres_per_unit;
  result.origin = sequence.origin;
  result.loop = sequence.loop;
  for (uint32_t f = 0; f < sequence.frame_count; ++f) {
    const TriMesh mesh = subdivided(sound, sound.frame(sequence.frame(f)), levels);
    if (f == 0) {
      result.vertex_count = static_cast<uint32_t>(mesh.n_vertices());
      for (const SurfaceTopology::Triangle& t : compact(mesh).triangles)
        result.polygons.add(t);
      result.positions.reserve(size_t{3} * result.vertex_count * result.frame_count);
    }
    for (auto v : mesh.vertices()) {
      const OpenMesh::Vec3d p = mesh.point(v);
      for (size_t axis = 0; axis < 3; ++axis)
        result.positions.push_back(static_cast<float>(p[axis]));
    }
  }
  return result;
}

SurfaceFrame subdivide(const SurfaceFrame& mesh, uint32_t levels, MeshRepairs* repairs) {
  const MeshSequence sequence = single_frame(mesh);
  if (repairs != nullptr)
    *repairs = sound_mesh(sequence).repairs;
  MeshSequence result = subdivide(sequence, levels);
  return {std::move(result.polygons), std::move(result.positions)};
}

}  // namespace anicodec
