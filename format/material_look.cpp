// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/material_look.h"

#include <cmath>

namespace anicodec {
namespace {

constexpr uint8_t kKnown = 1, kDoubleSided = 2, kAlphaShift = 2, kFlags = 0xF;

/// Calls visit(number) for all numbers that a known look has.
template <class Look, class Visit>
void visit_numbers(Look& look, const Visit& visit) {
  for (auto& x : look.base_colour)
    visit(x);
  visit(look.metallic);
  visit(look.roughness);
  for (auto& x : look.emissive)
    visit(x);
  if (look.alpha == AlphaMode::kMask)
    visit(look.alpha_cutoff);
}

}  // namespace

bool MaterialLook::in_range() const {
  bool all = true;
  visit_numbers(*this, [&](float x) { all &= std::isfinite(x) && x >= 0; });
  return all;
}

void MaterialLook::write(ByteWriter& w) const {
  if (!known)
    return w.u8(0);
  w.u8(static_cast<uint8_t>(kKnown | (double_sided ? kDoubleSided : 0) |
                            static_cast<uint8_t>(alpha) << kAlphaShift));
  visit_numbers(*this, [&](float x) { w.f32(x); });
  unsigned slots = 0;
  for (size_t i = 0; i < kTextureSlots; ++i)
    slots |= textures[i].empty() ? 0U : 1U << i;
  w.u8(static_cast<uint8_t>(slots));
  for (const String& texture : textures) {
    if (!texture.empty())
      w.text(texture);
  }
}

bool MaterialLook::read(ByteReader& r) {
  *this = {};
  const uint8_t flags = r.u8(), mode = (flags & kFlags) >> kAlphaShift;
  known = flags & kKnown;
  if (!known)
    return r.ok() && flags == 0;
  if ((flags & ~kFlags) || mode > static_cast<uint8_t>(AlphaMode::kBlend))
    return false;
  double_sided = flags & kDoubleSided;
  alpha = static_cast<AlphaMode>(mode);
  visit_numbers(*this, [&](float& x) { x = r.f32(); });
  bool named = true;
  const uint8_t slots = r.u8();
  for (size_t i = 0; i < kTextureSlots; ++i) {
    if (!(slots >> i & 1))
      continue;
    textures[i] = r.text();
    named &= !textures[i].empty();
  }
  return r.ok() && in_range() && named && slots >> kTextureSlots == 0;
}

}  // namespace anicodec
