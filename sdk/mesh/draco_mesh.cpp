// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/draco_mesh.h"

#include "sdk/mesh/draco_profile.h"

#include <memory>
#include <new>

#include <draco/compression/bit_coders/rans_bit_decoder.h>
#include <draco/compression/bit_coders/rans_bit_encoder.h>
#include <draco/compression/decode.h>
#include <draco/compression/entropy/symbol_decoding.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/core/varint_decoding.h>

namespace anicodec {
namespace {

ByteView rest_of(const draco::DecoderBuffer& buffer) {
  return {reinterpret_cast<const uint8_t*>(buffer.data_head()),
          static_cast<size_t>(buffer.remaining_size())};
}

/// Streams that say of so many edges that none is a seam, one after the other.
Bytes streams_without_seams(uint32_t streams, uint64_t edges) {
  draco::RAnsBitEncoder encoder;
  encoder.StartEncoding();
  for (uint64_t e = 0; e < edges; ++e)
    encoder.EncodeBit(false);
  draco::EncoderBuffer buffer;
  encoder.EndEncoding(&buffer);
  Bytes result;
  for (uint32_t i = 0; i < streams; ++i)
    result.insert(result.end(), buffer.data(), buffer.data() + buffer.size());
  return result;
}

/// Whether streams say of each of so many edges that it is no seam.
bool is_without_seams(ByteView streams, uint32_t count, uint64_t edges) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(streams.data), streams.size,
              DRACO_BITSTREAM_VERSION(2, 2));
  for (uint32_t i = 0; i < count; ++i) {
    draco::RAnsBitDecoder decoder;
    if (!decoder.StartDecoding(&buffer))
      return false;
    for (uint64_t e = 0; e < edges; ++e) {
      if (decoder.DecodeNextBit())
        return false;
    }
  }
  return true;
}

/// Whether the lists of symbols by valence hold no more than there are; each is read to find the
/// next one.
bool is_bounded(ByteView lists, uint32_t symbols) {
  constexpr int kLists = 6;
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(lists.data), lists.size, DRACO_BITSTREAM_VERSION(2, 2));
  Vector<uint32_t> values;
  for (int i = 0; i < kLists; ++i) {
    uint32_t count = 0;
    if (!draco::DecodeVarint(&count, &buffer) || count > symbols)
      return false;
    symbols -= count;
    values.resize(count);
    if (count > 0 && (!check_draco_symbols(rest_of(buffer), count) ||
                      !draco::DecodeSymbols(count, 1, &buffer, values.data())))
      return false;
  }
  return true;
}

/// Draco's decoder, which looks at what attributes announce before it makes room for them.
class BoundedDecoder : public draco::MeshEdgebreakerDecoder {
 public:
  /// seams: the bitstream's own, in place of which there are others.
  BoundedDecoder(const DracoCounts& counts, ByteView seams, uint32_t streams)
      : counts_(counts), seams_(seams), streams_(streams) {}

 protected:
  bool DecodePointAttributes() override {
    return mesh()->num_points() == counts_.points && mesh()->num_faces() == counts_.triangles &&
           is_without_seams(seams_, streams_, inner_edges()) &&
           check_draco_attributes(rest_of(*buffer()), counts_, streams_ + 1) &&
           draco::MeshEdgebreakerDecoder::DecodePointAttributes();
  }

  bool DecodeAllAttributes() override {
    for (int i = 0; i < num_attributes_decoders(); ++i) {
      // Draco's own loop goes on to the next attribute without a word.
      auto* decoder = const_cast<draco::AttributesDecoderInterface*>(attributes_decoder(i));
      const auto width = static_cast<uint64_t>(mesh()->attribute(i)->num_components());
      if (!check_draco_values(rest_of(*buffer()), width * counts_.points) ||
          !decoder->DecodeAttributes(buffer()))
        return false;
    }
    return true;
  }

 private:
  uint64_t inner_edges() const {
    const draco::CornerTable& table = *GetCornerTable();
    uint64_t sides = 0;
    for (int c = 0; c < table.num_corners(); ++c)
      sides += table.Opposite(draco::CornerIndex(static_cast<uint32_t>(c))) !=
               draco::kInvalidCornerIndex;
    return sides / 2;
  }

  DracoCounts counts_;
  ByteView seams_;
  uint32_t streams_;
};

Status decode(ByteView bytes, uint32_t points, uint32_t triangles, uint32_t components,
              DracoMesh* out) {
  const DracoCounts counts{points, triangles, components};
  DracoSeams seams;
  if (!read_draco_head(bytes, counts, &seams))
    return Status::kDraco;
  if (seams.symbols > 0 &&
      !is_bounded({bytes.data + seams.end, bytes.size - seams.end}, seams.symbols))
    return Status::kDraco;
  // Seams would grow Draco's tables, and are refused; but only its tables tell how many edges there
  // are. So it decodes without seams, and those of the bitstream are looked at then.
  Bytes plain = streams_without_seams(seams.streams, uint64_t{3} * triangles / 2);
  plain.insert(plain.begin(), bytes.data, bytes.data + seams.begin);
  plain.insert(plain.end(), bytes.data + seams.end, bytes.data + bytes.size);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(plain.data()), plain.size());
  BoundedDecoder decoder(counts, {bytes.data + seams.begin, seams.end - seams.begin},
                         seams.streams);
  auto mesh = std::make_unique<draco::Mesh>();
  const draco::DecoderOptions options;
  if (!decoder.Decode(options, &buffer, mesh.get()).ok() || buffer.remaining_size() != 0)
    return Status::kDraco;
  out->points = points;
  out->components = components;
  out->triangles.resize(size_t{triangles} * 3);
  for (uint32_t t = 0; t < triangles; ++t) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(t));
    for (size_t i = 0; i < 3; ++i) {
      uint32_t p = face[i].value();
      if (p >= points)
        return Status::kDraco;
      out->triangles[size_t{3} * t + i] = p;
    }
  }
  out->values.resize(size_t{points} * components);
  size_t column = 0;
  for (int a = 0; a < mesh->num_attributes(); ++a) {
    const draco::PointAttribute* attribute = mesh->attribute(a);
    auto width = static_cast<size_t>(attribute->num_components());
    for (uint32_t p = 0; p < points; ++p) {
      draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(p));
      if (index.value() >= attribute->size())
        return Status::kDraco;
      attribute->GetValue(index, out->values.data() + size_t{p} * components + column);
    }
    column += width;
  }
  return Status::kOk;
}

}  // namespace

Status decode_draco_mesh(ByteView bytes, uint32_t points, uint32_t triangles, uint32_t components,
                         DracoMesh* out) {
  try {
    return decode(bytes, points, triangles, components, out);
  } catch (const std::bad_alloc&) {
    return Status::kMemory;
  } catch (...) {
    return Status::kDraco;
  }
}

}  // namespace anicodec
