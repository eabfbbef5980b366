// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/mesh_layout.h"

#include "codec/connectivity/face_source.h"
#include "codec/sequence/error.h"
#include "sdk/mesh/faces_coding.h"
#include "sdk/mesh/map_coding.h"
#include "sdk/mesh/vertex_walk.h"

#include <vector>

namespace anicodec {
namespace {

Limits::Mesh sizes_of(const MeshSequence& sequence, const Weld& weld, const FaceSource& source) {
  Limits::Mesh sizes;
  sizes.source_vertices = sequence.vertex_count;
  sizes.coded_vertices = static_cast<uint32_t>(weld.representative.size());
  sizes.triangles = source.triangles();
  sizes.polygons = static_cast<uint32_t>(sequence.polygons.size());
  sizes.corners = static_cast<uint32_t>(sequence.polygons.corners.size());
  return sizes;
}

Bytes faces_from(SeedOrder seeds, FaceSource* source, MeshLayout* layout) {
  source->begin(seeds);
  BinaryEncoder encoder;
  FacesCoding<BinaryEncoder, FaceSource> faces(encoder, *source, layout->sizes, &layout->topology);
  if (faces.run() != Status::kOk)
    throw Error(ErrorKind::kInternal, "the faces could not be coded");
  return encoder.finish();
}

/// Begins the walk at the seeds from which it takes the fewest bytes: up to an eighth less.
void code_faces(FaceSource* source, MeshLayout* layout) {
  SeedOrder best = SeedOrder::kSource;
  size_t fewest = SIZE_MAX;
  for (const SeedOrder seeds : {SeedOrder::kMiddle, SeedOrder::kFullest, SeedOrder::kSource}) {
    layout->faces = faces_from(seeds, source, layout);
    if (layout->faces.size() < fewest) {
      fewest = layout->faces.size();
      best = seeds;
    }
  }
  if (best != SeedOrder::kSource)
    layout->faces = faces_from(best, source, layout);
}

/// Codes where vertices come from.
void code_vertex_map(const std::vector<uint32_t>& canonical, MeshLayout* layout) {
  layout->vertex_source.resize(canonical.size());
  for (uint32_t v = 0; v < canonical.size(); ++v)
    layout->vertex_source[canonical[v]] = v;
  BinaryEncoder encoder;
  VertexWalk(layout->topology).code(encoder, &layout->vertex_source);
  layout->vertex_map = encoder.finish();
}

/// Codes where polygons come from, and which of their corners is the source's first.
void code_face_map(const FaceSource& source, MeshLayout* layout) {
  for (const auto& [polygon, first] : source.polygon_places()) {
    layout->polygon_source.push_back(polygon);
    layout->polygon_first.push_back(first);
  }
  BinaryEncoder encoder;
  code_permutation(encoder, layout->sizes.polygons, &layout->polygon_source);
  code_rotations(encoder, layout->topology.polygon_offsets, &layout->polygon_first);
  layout->face_map = encoder.finish();
}

}  // namespace

MeshLayout lay_out_mesh(const MeshSequence& sequence, const Weld& weld) {
  FaceSource source(sequence.polygons, weld);
  MeshLayout layout;
  layout.name = sequence.mesh_name;
  layout.sizes = sizes_of(sequence, weld, source);
  code_faces(&source, &layout);
  std::vector<uint32_t> coded_of(weld.representative.size());
  for (const uint32_t w : source.coded_welded()) {
    coded_of[w] = static_cast<uint32_t>(layout.coded_source.size());
    layout.coded_source.push_back(weld.representative[w]);
  }
  for (const uint32_t w : weld.welded)
    layout.source_coded.push_back(coded_of[w]);
  code_vertex_map(source.canonical(), &layout);
  code_face_map(source, &layout);
  return layout;
}

MeshLayout lay_out_mesh(const MeshSequence& sequence) {
  return lay_out_mesh(sequence, weld_trajectories(sequence));
}

}  // namespace anicodec
