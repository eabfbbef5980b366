// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes as the faces of a mesh. The first six are its counts.
#include "sdk/mesh/faces_coding.h"

#include <algorithm>
#include <cstdlib>

using namespace anicodec;

namespace {

void require(bool condition) {
  if (!condition)
    std::abort();
}

/// The number of triangles that decode_faces() will look for; 0 where it gets no further.
uint32_t triangles_of(ByteView bytes, const Limits::Mesh& sizes) {
  BinaryDecoder decoder(bytes.data, bytes.size);
  UnsignedModel corners;
  AdaptiveBit repeated;
  NoMesh none;
  const auto apart = static_cast<uint32_t>(corners.code(decoder));
  if (apart > sizes.polygons)
    return 0;
  const bool repeats = decoder.bit(repeated);
  WalkedFaces faces;
  GateWalk<BinaryDecoder, NoMesh> walk(decoder, none, sizes.coded_vertices, sizes.corners);
  if (walk.run(sizes.polygons - apart, sizes.corners, repeats, &faces) != Status::kOk)
    return 0;
  uint32_t count = 0;
  for (size_t f = 0; f < faces.repeats.size(); ++f)
    count += faces.repeats[f] ? 0 : faces.offsets[f + 1] - faces.offsets[f] - 2;
  return count;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 6)
    return 0;
  Limits::Mesh sizes;
  sizes.coded_vertices = 1U + data[0] + 8U * data[1];
  sizes.source_vertices = sizes.coded_vertices + data[2];
  sizes.polygons = data[3] * (data[4] % 9U + 1);
  sizes.corners = 3 * sizes.polygons + data[5] % 64U;
  const ByteView bytes{data + 6, size - 6};
  sizes.triangles = triangles_of(bytes, sizes);
  Topology t;
  if (decode_faces(bytes, sizes, &t) != Status::kOk)
    return 0;
  require(t.vertex_coded.size() == sizes.source_vertices);
  require(std::is_sorted(t.vertex_coded.begin(), t.vertex_coded.end()));
  require(t.vertex_coded.back() == sizes.coded_vertices - 1);
  require(t.polygon_offsets.size() == size_t{sizes.polygons} + 1);
  require(std::is_sorted(t.polygon_offsets.begin(), t.polygon_offsets.end()));
  require(t.polygon_offsets.back() == sizes.corners && t.polygon_corners.size() == sizes.corners);
  for (const uint32_t v : t.polygon_corners)
    require(v < sizes.source_vertices);
  require(t.triangles.size() == size_t{3} * sizes.triangles);
  for (const uint32_t v : t.triangles)
    require(v < t.vertices_in_triangles);
  Vector<uint32_t> map;
  decode_vertex_map(bytes, t, &map);
  return 0;
}
