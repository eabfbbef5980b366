// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/topology.h"

#include "sdk/mesh/faces_coding.h"
#include "sdk/mesh/map_coding.h"
#include "sdk/mesh/vertex_walk.h"

#include <numeric>

namespace anicodec {

Status decode_faces(ByteView stream, const Limits::Mesh& sizes, Topology* out) {
  BinaryDecoder decoder(stream.data, stream.size);
  NoMesh none;
  if (Status s = FacesCoding<BinaryDecoder, NoMesh>(decoder, none, sizes, out).run();
      s != Status::kOk)
    return s;
  return decoder.finish() ? Status::kOk : Status::kEntropy;
}

Status decode_vertex_map(ByteView bytes, const Topology& topology, Vector<uint32_t>* source) {
  BinaryDecoder decoder(bytes.data, bytes.size);
  if (!VertexWalk(topology).code(decoder, source))
    return decoder.ok() ? Status::kIndexRange : Status::kEntropy;
  return decoder.finish() ? Status::kOk : Status::kEntropy;
}

Status decode_face_map(ByteView bytes, const Topology& topology, Vector<uint32_t>* place,
                       Vector<uint32_t>* first) {
  BinaryDecoder decoder(bytes.data, bytes.size);
  auto count = static_cast<uint32_t>(topology.polygon_offsets.size() - 1);
  if (!code_permutation(decoder, count, place))
    return decoder.ok() ? Status::kIndexRange : Status::kEntropy;
  first->resize(count);
  if (!code_rotations(decoder, topology.polygon_offsets, first))
    return decoder.ok() ? Status::kIndexRange : Status::kEntropy;
  return decoder.finish() ? Status::kOk : Status::kEntropy;
}

bool has_larger_polygons(const Topology& topology) {
  for (size_t p = 0; p + 1 < topology.polygon_offsets.size(); ++p) {
    if (topology.polygon_offsets[p + 1] - topology.polygon_offsets[p] > 3)
      return true;
  }
  return false;
}

void apply_vertex_map(const Vector<uint32_t>& source, Topology* topology) {
  Vector<uint32_t> coded(topology->vertex_coded.size());
  for (size_t i = 0; i < source.size(); ++i)
    coded[source[i]] = topology->vertex_coded[i];
  topology->vertex_coded.swap(coded);
  for (uint32_t& v : topology->polygon_corners)
    v = source[v];
}

Vector<uint32_t> corner_order(const Vector<uint32_t>& canonical, const Vector<uint32_t>& first,
                              const Vector<uint32_t>& offsets) {
  Vector<uint32_t> order;
  order.reserve(offsets.back());
  for (uint32_t i : canonical) {
    const uint32_t begin = offsets[i], n = offsets[i + 1] - begin;
    for (uint32_t k = 0; k < n; ++k)
      order.push_back(begin + (first[i] + k) % n);
  }
  return order;
}

void apply_face_map(const Vector<uint32_t>& place, const Vector<uint32_t>& first,
                    Topology* topology) {
  Vector<uint32_t> canonical(place.size());  // of each source polygon
  for (uint32_t i = 0; i < place.size(); ++i)
    canonical[place[i]] = i;
  Vector<uint32_t> corners = corner_order(canonical, first, topology->polygon_offsets);
  for (uint32_t& c : corners)
    c = topology->polygon_corners[c];
  Vector<uint32_t> offsets{0};
  offsets.reserve(topology->polygon_offsets.size());
  for (uint32_t i : canonical)
    offsets.push_back(offsets.back() + topology->polygon_offsets[i + 1] -
                      topology->polygon_offsets[i]);
  topology->polygon_offsets.swap(offsets);
  topology->polygon_corners.swap(corners);
}

}  // namespace anicodec
