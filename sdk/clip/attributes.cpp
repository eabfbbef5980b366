// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/attributes.h"

#include "sdk/clip/attribute_coding.h"
#include "sdk/clip/attribute_surface.h"

#include <cmath>
#include <utility>

namespace anicodec {
namespace {

Status decode_values(BinaryDecoder& decoder, const CornerGraph& graph, bool moves,
                     MeshAttribute* out) {
  const AttributeHeader& header = out->header;
  if (header.has_labels()) {
    out->labels.assign(graph.polygon_count(), 0);
    return code_labels(decoder, graph, static_cast<uint32_t>(header.labels.size()) + 1,
                       &out->labels);
  }
  AttributeEntries entries;
  const uint32_t components = header.components();
  {
    AttributeCoding<BinaryDecoder> coding(decoder, graph, header.domain, components, nullptr,
                                          &entries);
    if (Status s = coding.run(); s != Status::kOk)
      return s;
  }
  if (components == 0) {
    out->labels = std::move(entries.of_element);
    return Status::kOk;
  }
  out->values.resize(entries.of_element.size() * components);
  float* to = out->values.data();
  for (uint32_t entry : entries.of_element) {
    for (uint32_t i = 0; i < components; ++i, ++to) {
      const AttributeHeader::Grid& grid = header.grids[i];
      *to = static_cast<float>(grid.origin +
                               entries.numbers[size_t{entry} * components + i] / grid.scale);
      if (!std::isfinite(*to))
        return Status::kNonFinite;
    }
  }
  if (moves)
    out->surface = attribute_surface(graph, header.domain, std::move(entries));
  return Status::kOk;
}

/// Row i of the result is row from[i].
template <class T>
void permute(const Vector<uint32_t>& from, size_t columns, Vector<T>* values) {
  if (values->empty())
    return;
  Vector<T> result;
  result.reserve(values->size());
  for (uint32_t i : from) {
    const auto row = values->begin() + static_cast<ptrdiff_t>(columns * i);
    result.insert(result.end(), row, row + static_cast<ptrdiff_t>(columns));
  }
  values->swap(result);
}

void permute(const Vector<uint32_t>& from, AttributeDomain domain,
             Vector<MeshAttribute>* attributes) {
  for (MeshAttribute& a : *attributes) {
    if (a.header.domain != domain)
      continue;
    permute(from, a.header.components(), &a.values);
    permute(from, 1, &a.labels);
    permute(from, 1, &a.surface.vertex_coded);
  }
}

Vector<uint32_t> inverse(const Vector<uint32_t>& permutation) {
  Vector<uint32_t> result(permutation.size());
  for (uint32_t i = 0; i < permutation.size(); ++i)
    result[permutation[i]] = i;
  return result;
}

}  // namespace

Status decode_attributes(const AttributeRecord& record, const Limits::Mesh& sizes,
                         const Topology& topology, const Vector<uint8_t>& moving,
                         Vector<MeshAttribute>* out) {
  // Each attribute looks at all corners, also where few elements share them.
  if (uint64_t{sizes.corners} * record.attributes.size() > uint64_t{16} * sizes.corners +
                                                               256 * sizes.attribute_numbers +
                                                               4096 * record.attributes.size())
    return Status::kLimit;
  const CornerGraph graph(topology);
  BinaryDecoder decoder(record.stream.data, record.stream.size);
  *out = Vector<MeshAttribute>(record.attributes.size());
  for (size_t i = 0; i < out->size(); ++i) {
    MeshAttribute& attribute = (*out)[i];
    attribute.header = record.attributes[i];
    const bool moves = moving[i] == 1 + static_cast<uint8_t>(attribute.header.domain);
    if (Status s = decode_values(decoder, graph, moves, &attribute); s != Status::kOk)
      return s;
  }
  return decoder.finish() ? Status::kOk : Status::kEntropy;
}

void apply_vertex_map(const Vector<uint32_t>& source, Vector<MeshAttribute>* attributes) {
  if (!attributes->empty())
    permute(inverse(source), AttributeDomain::kVertex, attributes);
}

void apply_face_map(const Vector<uint32_t>& place, const Vector<uint32_t>& first,
                    const Topology& topology, Vector<MeshAttribute>* attributes) {
  if (attributes->empty())
    return;
  const Vector<uint32_t> canonical = inverse(place);
  permute(canonical, AttributeDomain::kPolygon, attributes);
  permute(corner_order(canonical, first, topology.polygon_offsets), AttributeDomain::kCorner,
          attributes);
}

}  // namespace anicodec
