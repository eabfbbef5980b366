// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_MATERIAL_LOOK_H_
#define ANICODEC_FORMAT_MATERIAL_LOOK_H_

#include "format/bytes.h"
#include "format/memory.h"

#include <array>
#include <cstdint>

namespace anicodec {

enum class AlphaMode : uint8_t { kOpaque = 0, kMask = 1, kBlend = 2 };

/// The property of a surface that an image holds.
enum class TextureSlot : uint8_t {
  kBaseColour = 0,
  kMetallicRoughness = 1,
  kNormal = 2,
  kOcclusion = 3,
  kEmissive = 4
};
inline constexpr size_t kTextureSlots = 5;

/// The look of a material, in the terms of glTF 2.0 (metallic and roughness): values, and the images
/// that it names but does not hold. Spec: 06, section 10.
struct MaterialLook {
  bool known = false;  ///< false: of the material there is a name and nothing else
  std::array<float, 4> base_colour{1, 1, 1, 1};  ///< linear RGBA
  float metallic = 0;
  float roughness = 1;
  std::array<float, 3> emissive{0, 0, 0};
  AlphaMode alpha = AlphaMode::kOpaque;
  float alpha_cutoff = 0.5F;  ///< of kMask
  bool double_sided = false;
  std::array<String, kTextureSlots> textures;  ///< as in the source, a path or a name; empty: none

  bool operator==(const MaterialLook& b) const {
    return known == b.known && base_colour == b.base_colour && metallic == b.metallic &&
           roughness == b.roughness && emissive == b.emissive && alpha == b.alpha &&
           alpha_cutoff == b.alpha_cutoff && double_sided == b.double_sided &&
           textures == b.textures;
  }

  bool operator!=(const MaterialLook& b) const { return !(*this == b); }

  const String& texture(TextureSlot slot) const { return textures[static_cast<size_t>(slot)]; }

  String& texture(TextureSlot slot) { return textures[static_cast<size_t>(slot)]; }

  /// Whether all numbers are finite and not below 0.
  bool in_range() const;

  void write(ByteWriter& w) const;
  /// False: a field is out of its range, or the bytes end.
  bool read(ByteReader& r);
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_MATERIAL_LOOK_H_
