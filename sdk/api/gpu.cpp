// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: what a GPU needs.
#include "sdk/api/objects.h"
#include "sdk/play/shader_data.h"

#include <algorithm>
#include <cstddef>

namespace anicodec {
namespace {

static_assert(sizeof(anic_correction) == sizeof(Segment::Correction) &&
              offsetof(anic_correction, vertex) == offsetof(Segment::Correction, vertex) &&
              offsetof(anic_correction, delta) == offsetof(Segment::Correction, delta));
static_assert(ANIC_MAX_PARTS == Sample::kMaxParts && ANIC_BLOCK_VERTICES == kBlock);

/// Tells the host what a sample consists of.
void give_parts(const Clip& clip, const Sample& sample, anic_parts* host) {
  anic_parts parts = ANIC_INIT(anic_parts);
  parts.count = sample.count;
  for (uint32_t p = 0; p < sample.count; ++p) {
    const FrameState& state = sample.parts[p];
    anic_part& part = parts.parts[p];
    part.segment = static_cast<uint32_t>(state.segment - clip.segments().data());
    part.share = sample.share[p];
    part.weights = state.weights;
    part.shape = state.shape;
    const Affine identity;
    std::copy_n(state.pose_maps ? state.pose_maps : identity.m, 12, part.pose_map);
    parts.pose_maps[p] = state.pose_maps;
    std::copy_n(state.motion.m, 12, part.motion);
    part.corrections = reinterpret_cast<const anic_correction*>(state.corrections);
    part.correction_count = state.correction_count;
    parts.components[p] = state.components;
  }
  give(parts, host);
}

/// The segment, if it is there and a shader can combine it.
anic_status find_basis(const anic_asset* asset, uint32_t segment, const Segment** out) {
  if (!asset || segment >= asset->clip.segments().size())
    return ANIC_E_ARGUMENT;
  *out = &asset->clip.segments()[segment];
  return (*out)->frames > 0 && (*out)->msgi.empty() ? ANIC_OK : ANIC_E_STATE;
}

}  // namespace
}  // namespace anicodec

using namespace anicodec;

anic_status anic_get_basis(const anic_asset* asset, uint32_t segment, anic_basis* out) {
  if (!asset || !is_sized(out) || segment >= asset->clip.segments().size())
    return ANIC_E_ARGUMENT;
  const Segment& s = asset->clip.segments()[segment];
  if (s.frames == 0)
    return ANIC_E_STATE;
  anic_basis filled = ANIC_INIT(anic_basis);
  filled.kind = static_cast<anic_basis_kind>(s.kind);
  filled.mesh = s.mesh;
  filled.first_frame = s.first_frame;
  filled.frame_count = s.frames;
  filled.vertex_count = s.vertices;
  filled.components = s.components;
  filled.wide_components = s.wide_components;
  filled.channels = s.channels();
  filled.weight_channels = s.weight_channels();
  filled.pose = s.pose.empty() ? nullptr : s.pose.data();
  filled.wide = s.wide.data();
  filled.narrow = s.narrow.data();
  filled.pose_count = s.pose.size();
  filled.wide_count = s.wide.size();
  filled.narrow_count = s.narrow.size();
  if (s.attribute != kPositions) {
    filled.target = ANIC_TARGET_ATTRIBUTE;
    filled.attribute = s.attribute;
    filled.first_component = s.first_component;
  }
  filled.regions = s.regions;
  filled.vertex_region = s.vertex_region.empty() ? nullptr : s.vertex_region.data();
  filled.vertex_shape = s.msgi.empty() || s.vertex_coded.empty() ? nullptr : s.vertex_coded.data();
  filled.reconstruction = s.msgi.empty() ? ANIC_RECONSTRUCTION_LINEAR : ANIC_RECONSTRUCTION_MSGI;
  for (size_t i = 0; i < 3; ++i)
    filled.origin[i] = static_cast<float>(s.origin[i]);
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_get_parts(const anic_context* context, uint32_t mesh, anic_when when,
                           anic_parts* out) {
  const Sample* sample = nullptr;
  if (!is_sized(out))
    return ANIC_E_ARGUMENT;
  if (anic_status status = find_sample(context, mesh, when, &sample); status != ANIC_OK)
    return status;
  give_parts(context->asset->clip, *sample, out);
  return ANIC_OK;
}

anic_status anic_get_attribute_parts(const anic_context* context, uint32_t mesh, uint32_t attribute,
                                     uint32_t first_component, anic_when when, anic_parts* out) {
  const MeshAttribute* found = nullptr;
  if (!is_sized(out) || first_component % 3 != 0)
    return ANIC_E_ARGUMENT;
  if (anic_status status = find_attribute(context, mesh, attribute, when, &found);
      status != ANIC_OK)
    return status;
  if (first_component >= found->header.components())
    return ANIC_E_ARGUMENT;
  const Clip& clip = context->asset->clip;
  const auto [first, last] = clip.attribute_tracks(mesh, attribute);
  const Sample none;
  const Sample* sample = &none;
  for (uint32_t t = first; t < last; ++t) {
    if (clip.tracks()[t].first_component == first_component)
      sample = &context->states[when].samples[t];
  }
  give_parts(clip, *sample, out);
  return ANIC_OK;
}

anic_status anic_get_texture_layout(const anic_asset* asset, uint32_t segment, uint32_t max_size,
                                    anic_texture_layout* out) {
  const Segment* found = nullptr;
  if (!is_sized(out) || max_size == 0)
    return ANIC_E_ARGUMENT;
  if (anic_status status = find_basis(asset, segment, &found); status != ANIC_OK)
    return status;
  TextureLayout layout;
  if (!TextureLayout::find(*found, max_size, &layout))
    return ANIC_E_LIMIT;
  anic_texture_layout filled = ANIC_INIT(anic_texture_layout);
  filled.width = layout.width;
  filled.rows = layout.rows;
  filled.pose_height = layout.height(*found, BasisTexture::kPose);
  filled.wide_height = layout.height(*found, BasisTexture::kWide);
  filled.narrow_height = layout.height(*found, BasisTexture::kNarrow);
  filled.state_floats = static_cast<uint32_t>(state_floats(*found));
  filled.regions = found->regions;
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_write_texture(const anic_asset* asset, uint32_t segment, anic_texture texture,
                               const anic_texture_layout* layout, size_t row_bytes, void* out,
                               size_t size) {
  const Segment* found = nullptr;
  anic_texture_layout host;
  if (!layout || !take(layout, &host) || texture < ANIC_TEXTURE_POSE ||
      texture > ANIC_TEXTURE_NARROW)
    return ANIC_E_ARGUMENT;
  if (anic_status status = find_basis(asset, segment, &found); status != ANIC_OK)
    return status;
  const TextureLayout ours = {host.width, host.rows};
  if (!ours.holds(*found))
    return ANIC_E_ARGUMENT;
  const auto which = static_cast<BasisTexture>(texture);
  const uint32_t height = ours.height(*found, which);
  const size_t row = texel_bytes(which) * ours.width;
  const size_t stride = row_bytes == 0 ? row : row_bytes;
  if (height == 0)
    return ANIC_OK;
  if (!out || stride < row)
    return ANIC_E_ARGUMENT;
  if (size < row || (size - row) / stride < size_t{height} - 1)
    return ANIC_E_BUFFER_SIZE;
  // A single row takes no step: a huge one would lead past every address.
  write_texture(*found, which, ours, height == 1 ? row : stride, out);
  return ANIC_OK;
}

anic_status anic_write_state(const anic_context* context, uint32_t mesh, anic_when when,
                             uint32_t part, float* out, size_t size) {
  const Sample* sample = nullptr;
  if (anic_status status = find_sample(context, mesh, when, &sample); status != ANIC_OK)
    return status;
  if (part >= sample->count || !out)
    return ANIC_E_ARGUMENT;
  const FrameState& state = sample->parts[part];
  if (state.shape)
    return ANIC_E_STATE;
  if (size / sizeof(float) < state_floats(*state.segment))
    return ANIC_E_BUFFER_SIZE;
  write_state(state, sample->share[part], out);
  return ANIC_OK;
}
