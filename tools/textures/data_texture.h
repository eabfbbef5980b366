// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_TEXTURES_DATA_TEXTURE_H_
#define ANICODEC_TOOLS_TEXTURES_DATA_TEXTURE_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// Texels of four numbers, rows from the top.
struct DataTexture {
  uint32_t width = 0, height = 0;
  std::vector<float> texels;

  DataTexture() = default;

  /// All numbers are 0.
  DataTexture(uint32_t w, uint32_t h) : width(w), height(h), texels(size_t{4} * w * h) {}

  float* at(uint32_t x, uint32_t y) { return texels.data() + 4 * (size_t{y} * width + x); }

  const float* at(uint32_t x, uint32_t y) const {
    return texels.data() + 4 * (size_t{y} * width + x);
  }
};

/// The numbers of a file.
enum class TexelKind : uint8_t {
  kPng16,    ///< 0 to 1 in steps of 1/65535, rounded
  kExrHalf,  ///< 16-bit floats
};

/// The bytes of a PNG or EXR (scanlines by zip) with red, green, blue, alpha. Throws Error(kInput) for a number that
/// the kind does not hold, Error(kUnsupported) for EXR where the build lacks it.
std::string texture_bytes(const DataTexture& texture, TexelKind kind);

/// Reads such a file. Throws Error(kInput) for any other.
DataTexture read_texture(std::string_view bytes, TexelKind kind);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_TEXTURES_DATA_TEXTURE_H_
