// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PLAY_VERTEX_OUTPUT_H_
#define ANICODEC_SDK_PLAY_VERTEX_OUTPUT_H_

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// How a position is stored, in the machine's byte order. Formats of four have a last one that is
/// 1, so that the position is a point in homogeneous coordinates.
///
/// The 16-bit formats store (x - offset) / scale: as an IEEE binary16, rounded to nearest even,
/// infinite beyond 65504; as round(65535 t) for t clamped to 0 .. 1; as round(32767 t) for t
/// clamped to -1 .. 1. The same position gives the same bytes on every machine.
enum class VertexFormat : uint8_t {
  kFloat32x3 = 0,
  kFloat32x4 = 1,
  kFloat16x3 = 2,
  kFloat16x4 = 3,
  kUnorm16x3 = 4,
  kUnorm16x4 = 5,
  kSnorm16x3 = 6,
  kSnorm16x4 = 7,
};

inline constexpr uint32_t kVertexFormatCount = 8;

/// Bytes of one position.
inline uint32_t vertex_format_size(VertexFormat format) {
  auto id = static_cast<uint32_t>(format);
  return (id < 2 ? 4u : 2u) * (3u + id % 2);
}

/// The destination of positions: vertex i at data + i * stride. Exactly the bytes of the format are written,
/// each once, at ascending addresses, and nothing is read there: the memory may be write-combined,
/// and other attributes may lie between the positions. Any alignment will do.
struct VertexOutput {
  void* data = nullptr;
  size_t stride = 3 * sizeof(float);  ///< bytes
  VertexFormat format = VertexFormat::kFloat32x3;
  float offset[3] = {0, 0, 0};  ///< of the 16-bit formats
  float scale[3] = {1, 1, 1};   ///< of the 16-bit formats
};

/// Whether the format is known, the stride holds it, and offset and scale are finite and the scale
/// and its inverse are not 0.
bool is_valid(const VertexOutput& output);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_VERTEX_OUTPUT_H_
