// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_compression.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <utility>

#include <draco/compression/decode.h>

namespace anicodec::tools {
namespace {

/// Reads the head of a bitstream; past its end everything is 0.
class HeadReader {
 public:
  explicit HeadReader(std::string_view bytes) : bytes_(bytes) {}

  uint8_t byte() {
    if (bytes_.empty())
      return 0;
    auto b = static_cast<uint8_t>(bytes_.front());
    bytes_.remove_prefix(1);
    return b;
  }

  uint64_t varint() {
    uint64_t x = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      uint8_t b = byte();
      x |= uint64_t{b & 0x7FU} << shift;
      if (b < 0x80)
        break;
    }
    return x;
  }

 private:
  std::string_view bytes_;
};

/// Whether the counts at the head are those that the document announces. Draco sizes its tables by
/// them before it reads any more.
bool is_plausible(std::string_view bytes, uint32_t points, uint32_t faces) {
  if (!bytes.starts_with("DRACO"))
    return false;
  HeadReader in(bytes.substr(5));
  const int version = in.byte() * 256 + in.byte();
  const uint8_t geometry = in.byte(), method = in.byte();
  in.byte(), in.byte();  // flags
  if (version != 0x202 || geometry != draco::TRIANGULAR_MESH)
    return false;
  if (method == draco::MESH_SEQUENTIAL_ENCODING)
    return in.varint() == faces && in.varint() == points;
  in.byte();  // kind of traversal
  const uint64_t vertices = in.varint(), coded_faces = in.varint();
  in.byte();  // attribute data
  const uint64_t symbols = in.varint(), split_symbols = in.varint();
  return vertices <= points && coded_faces == faces && symbols <= faces && split_symbols <= symbols;
}

/// Largest value of an integer type, 0 for others.
float largest_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return std::numeric_limits<int8_t>::max();
    case draco::DT_UINT8:
      return std::numeric_limits<uint8_t>::max();
    case draco::DT_INT16:
      return std::numeric_limits<int16_t>::max();
    case draco::DT_UINT16:
      return std::numeric_limits<uint16_t>::max();
    default:
      return 0;
  }
}

bool take_values(const draco::PointAttribute& attribute, uint32_t points,
                 DracoPrimitive::Values& out) {
  const int components = attribute.num_components();
  if (components < 1 || components > 16)
    return false;
  out.components = static_cast<uint32_t>(components);
  out.values.resize(size_t{points} * out.components);
  for (uint32_t p = 0; p < points; ++p) {
    draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(p));
    if (index.value() >= attribute.size() ||
        !attribute.ConvertValue<float>(index, static_cast<int8_t>(components),
                                       out.values.data() + size_t{p} * out.components))
      return false;
  }
  float largest = largest_of(attribute.data_type());
  if (largest > 0 && !attribute.normalized())
    out.normalizing_scale = 1 / largest;
  return true;
}

std::optional<DracoPrimitive> decode(const DracoSource& source) {
  const auto& [bytes, attributes, points, indices] = source;
  if (indices % 3 != 0 || !is_plausible(bytes, points, indices / 3))
    return std::nullopt;
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok())
    return std::nullopt;
  const std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
  if (mesh->num_points() != points || mesh->num_faces() != indices / 3)
    return std::nullopt;
  DracoPrimitive out;
  out.points = points;
  for (uint32_t f = 0; f < mesh->num_faces(); ++f) {
    for (draco::PointIndex p : mesh->face(draco::FaceIndex(f))) {
      if (p.value() >= points)
        return std::nullopt;
      out.indices.push_back(p.value());
    }
  }
  for (const auto& [name, id] : attributes) {
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id);
    if (!attribute || !take_values(*attribute, points, out.attributes[name]))
      return std::nullopt;
  }
  return out;
}

}  // namespace

std::optional<DracoPrimitive> decode_draco(const DracoSource& source) {
  try {
    return decode(source);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace anicodec::tools
