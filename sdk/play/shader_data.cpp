// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/shader_data.h"

#include <algorithm>
#include <cstring>

namespace anicodec {
namespace {

/// Components of a group, and numbers of a texel.
constexpr uint32_t kGroup = 4;

/// Floats of a state before its weights.
constexpr size_t kHead = 28;

uint32_t group_count(uint32_t components) {
  return (components + kGroup - 1) / kGroup;
}

uint32_t components_in(const Segment& segment, BasisTexture texture) {
  return texture == BasisTexture::kWide ? segment.wide_components
                                        : segment.components - segment.wide_components;
}

uint32_t layer_count(const Segment& segment, BasisTexture texture) {
  if (texture == BasisTexture::kPose)
    return segment.pose.empty() ? 0 : 1;
  return group_count(components_in(segment, texture)) * segment.channels();
}

/// Writes layers whose number k of vertex v is from[(block * numbers + k) * kBlock + i], and whose last
/// number is fourth[v] unless that is null.
template <class T>
void write_layers(const T* from, uint32_t numbers, uint32_t vertices, uint32_t layers,
                  const TextureLayout& layout, size_t stride, unsigned char* to,
                  const uint8_t* fourth = nullptr) {
  for (uint32_t layer = 0; layer < layers; ++layer) {
    for (uint32_t row = 0; row < layout.rows; ++row, to += stride) {
      unsigned char* place = to;
      for (uint32_t x = 0; x < layout.width; ++x, place += kGroup * sizeof(T)) {
        const uint32_t v = row * layout.width + x;
        T texel[kGroup] = {};
        for (uint32_t i = 0; v < vertices && i < kGroup && kGroup * layer + i < numbers; ++i)
          texel[i] = from[(size_t{v / kBlock} * numbers + size_t{kGroup} * layer + i) * kBlock +
                          v % kBlock];
        if (fourth && v < vertices)
          texel[kGroup - 1] = static_cast<T>(fourth[v]);
        std::memcpy(place, texel, sizeof texel);
      }
    }
  }
}

/// Floats of a state for one region.
size_t region_floats(const Segment& segment) {
  const size_t groups = size_t{group_count(segment.wide_components)} +
                        group_count(segment.components - segment.wide_components);
  return kHead + groups * kGroup * segment.weight_channels();
}

void write_region_state(const FrameState& state, float share, uint32_t region, float* out) {
  const Segment& segment = *state.segment;
  const Affine identity;
  std::copy_n(state.pose_maps ? state.pose_maps + size_t{12} * region : identity.m, 12, out);
  std::copy_n(state.motion.m, 12, out + 12);
  for (size_t c = 0; c < 3; ++c)
    out[4 * c + 3] += static_cast<float>(segment.origin[c]);
  const uint32_t wide = std::min(state.components, segment.wide_components);
  const uint32_t narrow = state.components - wide;
  out[24] = static_cast<float>(group_count(wide));
  out[25] = static_cast<float>(group_count(narrow));
  out[26] = share;
  out[27] = static_cast<float>(state.correction_count);
  const size_t channels = segment.weight_channels();
  const size_t narrow_at = kHead + kGroup * channels * group_count(segment.wide_components);
  std::fill(out + kHead, out + region_floats(segment), 0.0F);
  const float* weights = state.weights + region * region_weights(segment);
  std::copy_n(weights, channels * wide, out + kHead);
  std::copy_n(weights + channels * segment.wide_components, channels * narrow, out + narrow_at);
}

}  // namespace

size_t texel_bytes(BasisTexture texture) {
  return kGroup * (texture == BasisTexture::kNarrow ? sizeof(int16_t) : sizeof(int32_t));
}

bool TextureLayout::find(const Segment& segment, uint32_t max_size, TextureLayout* out) {
  const uint32_t vertices = std::max(segment.vertices, 1U);
  out->rows = (vertices - 1) / max_size + 1;
  out->width = (vertices - 1) / out->rows + 1;
  for (BasisTexture texture : {BasisTexture::kPose, BasisTexture::kWide, BasisTexture::kNarrow}) {
    if (uint64_t{out->rows} * layer_count(segment, texture) > max_size)
      return false;
  }
  return true;
}

bool TextureLayout::holds(const Segment& segment) const {
  return width > 0 && rows == (std::max(segment.vertices, 1U) - 1) / width + 1 &&
         uint64_t{rows} * (segment.components + kGroup) * 3 <= UINT32_MAX;
}

uint32_t TextureLayout::height(const Segment& segment, BasisTexture texture) const {
  return rows * layer_count(segment, texture);
}

void write_texture(const Segment& segment, BasisTexture texture, const TextureLayout& layout,
                   size_t stride, void* out) {
  auto* to = static_cast<unsigned char*>(out);
  const uint32_t layers = layer_count(segment, texture);
  if (texture == BasisTexture::kPose) {
    write_layers(segment.pose.data(), 3, segment.vertices, layers, layout, stride, to,
                 segment.vertex_region.empty() ? nullptr : segment.vertex_region.data());
    return;
  }
  const uint32_t numbers = components_in(segment, texture) * segment.channels();
  if (texture == BasisTexture::kWide)
    write_layers(segment.wide.data(), numbers, segment.vertices, layers, layout, stride, to);
  else
    write_layers(segment.narrow.data(), numbers, segment.vertices, layers, layout, stride, to);
}

size_t state_floats(const Segment& segment) {
  return segment.regions * region_floats(segment);
}

void write_state(const FrameState& state, float share, float* out) {
  for (uint32_t r = 0; r < state.segment->regions; ++r)
    write_region_state(state, share, r, out + r * region_floats(*state.segment));
}

}  // namespace anicodec
