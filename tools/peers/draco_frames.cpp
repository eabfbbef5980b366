// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/peers/draco_frames.h"

#include "codec/metrics/metrics.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <bit>

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/core/quantization_utils.h>
#include <draco/mesh/mesh.h>

namespace anicodec::peers {
namespace {

constexpr int kFewestGridBits = 4, kMostGridBits = 24;

/// The mesh that takes the positions of one frame after the other.
class FrameMesh {
 public:
  FrameMesh(uint32_t vertices, std::span<const uint32_t> triangles) {
    mesh_.set_num_points(vertices);
    mesh_.SetNumFaces(triangles.size() / 3);
    for (size_t t = 0; t < triangles.size() / 3; ++t) {
      draco::Mesh::Face face;
      for (size_t i = 0; i < 3; ++i)
        face[i] = draco::PointIndex(triangles[3 * t + i]);
      mesh_.SetFace(draco::FaceIndex(static_cast<uint32_t>(t)), face);
    }
    draco::GeometryAttribute position;
    position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
                  3 * sizeof(float), 0);
    position_ = mesh_.AddAttribute(position, true, vertices);
  }

  void set_positions(std::span<const float> frame) {
    for (uint32_t v = 0; v < mesh_.num_points(); ++v)
      mesh_.attribute(position_)->SetAttributeValue(draco::AttributeValueIndex(v),
                                                    &frame[size_t{3} * v]);
  }

  /// `configure` sets the quantisation of an attribute in an encoder.
  template <class Configure>
  std::vector<char> encode(Configure configure) const {
    draco::ExpertEncoder encoder(mesh_);
    encoder.SetSpeedOptions(0, 0);
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    configure(encoder, position_);
    draco::EncoderBuffer buffer;
    if (draco::Status status = encoder.EncodeToBuffer(&buffer); !status.ok())
      throw Error(ErrorKind::kInput, std::string("Draco: ") + status.error_msg());
    return {buffer.data(), buffer.data() + buffer.size()};
  }

 private:
  draco::Mesh mesh_;
  int position_ = 0;
};

/// A frame after Draco's quantisation and back.
void quantise(std::span<const float> frame, int bits, std::vector<float>& out) {
  float low[3], range = 0;
  for (size_t c = 0; c < 3; ++c) {
    low[c] = frame[c];
    float high = frame[c];
    for (size_t i = c; i < frame.size(); i += 3) {
      low[c] = std::min(low[c], frame[i]);
      high = std::max(high, frame[i]);
    }
    range = std::max(range, high - low[c]);
  }
  if (range == 0)
    range = 1;
  int32_t largest = (1 << bits) - 1;
  draco::Quantizer quantiser;
  quantiser.Init(range, largest);
  draco::Dequantizer dequantiser;
  dequantiser.Init(range, largest);
  out.resize(frame.size());
  for (size_t i = 0; i < frame.size(); ++i)
    out[i] = dequantiser(quantiser(frame[i] - low[i % 3])) + low[i % 3];
}

double kg_of_bits(const MeshSequence& sequence, int bits) {
  std::vector<float> decoded;
  CompareOptions options;
  options.sted = false;
  return compare(
             sequence.polygons, sequence.vertex_count, sequence.frame_count, frames_of(sequence),
             [&](uint32_t f) -> std::span<const float> {
               quantise(sequence.frame(f), bits, decoded);
               return decoded;
             },
             options)
      .kg;
}

std::vector<char> encode_bits(const FrameMesh& mesh, int bits) {
  return mesh.encode([&](draco::ExpertEncoder& encoder, int attribute) {
    encoder.SetAttributeQuantization(attribute, bits);
  });
}

}  // namespace

uint64_t DracoFrames::bytes() const {
  uint64_t sum = 0;
  for (const auto& frame : frames)
    sum += frame.size();
  return sum;
}

DracoFrames draco_at_kg(const MeshSequence& sequence, std::span<const uint32_t> triangles,
                        double kg) {
  DracoFrames result;
  result.bits = kFewestGridBits;
  while ((result.kg = kg_of_bits(sequence, result.bits)) > kg) {
    if (++result.bits > kMostGridBits)
      throw Error(ErrorKind::kUsage, "Draco does not reach the error asked for");
  }
  FrameMesh mesh(sequence.vertex_count, triangles);
  for (uint32_t f = 0; f < sequence.frame_count; ++f) {
    mesh.set_positions(sequence.frame(f));
    result.frames.push_back(encode_bits(mesh, result.bits));
  }
  return result;
}

std::vector<char> draco_frame(const MeshSequence& sequence, std::span<const uint32_t> triangles,
                              uint32_t frame, int bits) {
  FrameMesh mesh(sequence.vertex_count, triangles);
  mesh.set_positions(sequence.frame(frame));
  return encode_bits(mesh, bits);
}

DracoFrames draco_on_grid(const MeshSequence& sequence, std::span<const uint32_t> triangles,
                          const GriddedClip& grid) {
  DracoFrames result;
  result.bits = std::max(2, static_cast<int>(std::bit_width(grid.largest)));
  result.kg = grid.error.kg;
  // Draco's range is that of all integers of so many bits.
  auto range = static_cast<float>(grid.step * ((1 << result.bits) - 1));
  float origin[3];
  std::copy_n(grid.origin, 3, origin);
  FrameMesh mesh(sequence.vertex_count, triangles);
  for (uint32_t f = 0; f < sequence.frame_count; ++f) {
    mesh.set_positions(sequence.frame(f));
    result.frames.push_back(mesh.encode([&](draco::ExpertEncoder& encoder, int attribute) {
      encoder.SetAttributeExplicitQuantization(attribute, result.bits, 3, origin, range);
    }));
  }
  return result;
}

uint32_t decode_draco(std::span<const char> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok())
    throw Error(ErrorKind::kInternal, std::string("Draco: ") + result.status().error_msg());
  return result.value()->num_points();
}

}  // namespace anicodec::peers
