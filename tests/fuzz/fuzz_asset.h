// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_ASSET_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_ASSET_H_

#include "tests/fuzz/fuzz_file.h"
#include "tests/heap_count.h"

#include <anicodec/anicodec.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace anicodec {

inline void require(bool condition) {
  if (!condition)
    std::abort();
}

/// Memory of a host that has only so much of it.
struct CappedMemory {
  static constexpr size_t kHead = 16;

  size_t cap = size_t{64} << 20;
  size_t held = 0, peak = 0, calls = 0;

  anic_allocator allocator() {
    anic_allocator a = {};
    a.user = this;
    a.allocate = [](void* user, size_t size, size_t alignment) -> void* {
      auto* self = static_cast<CappedMemory*>(user);
      require(size > 0 && alignment <= 16);
      ++self->calls;
      if (size > self->cap - self->held)
        return nullptr;
      self->held += size;
      self->peak = std::max(self->peak, self->held);
      const HeapPause own;
      auto* head = static_cast<unsigned char*>(std::malloc(size + kHead));
      std::memcpy(head, &size, sizeof size);
      return head + kHead;
    };
    a.release = [](void* user, void* memory, size_t size) {
      auto* self = static_cast<CappedMemory*>(user);
      auto* head = static_cast<unsigned char*>(memory) - kHead;
      size_t asked;
      std::memcpy(&asked, head, sizeof asked);
      require(asked == size);
      self->held -= size;
      const HeapPause own;
      std::free(head);
    };
    return a;
  }

  anic_options options() {
    anic_options o = ANIC_INIT(anic_options);
    o.max_vertices = 20000;
    o.max_frames = 5000;
    o.max_components = 4096;
    o.max_bytes = cap / 2;
    o.allocator = allocator();
    return o;
  }
};

/// Global heap that opening a file may take: as much as Draco announces, else none.
inline size_t announced_heap(const Bytes& file, const anic_options& options) {
  anic_requirements needs = ANIC_INIT(anic_requirements);
  const HeapCount heap;
  const anic_status status = anic_get_requirements(file.data(), file.size(), &options, &needs);
  require(heap.peak() == 0);
  return status == ANIC_OK ? static_cast<size_t>(needs.draco_bytes) : 0;
}

/// Room for elements of any format, with bytes around it that must stay what they are.
class GuardedOutput {
 public:
  GuardedOutput(uint32_t count, Script* script) {
    constexpr size_t kSizes[] = {12, 16, 6, 8, 6, 8, 6, 8};
    const uint32_t format = script->byte() % 8;
    const size_t gap = script->byte() % 5;
    element_ = kSizes[format];
    out_.format = static_cast<anic_format>(format);
    out_.stride = gap == 0 ? 0 : element_ + gap;
    const size_t stride = element_ + gap;
    size_ = count == 0 ? 0 : stride * (count - 1) + element_;
    bytes_.assign(size_ + 2 * kGuard, 0xA5);
    out_.data = bytes_.data() + kGuard;
    out_.size = size_;
    for (int c = 0; c < 3; ++c) {
      out_.offset[c] = static_cast<float>(script->byte()) - 128;
      out_.scale[c] = static_cast<float>(script->byte());
    }
  }

  const anic_output* out() const { return &out_; }

  void check() const {
    for (size_t i = 0; i < kGuard; ++i)
      require(bytes_[i] == 0xA5 && bytes_[bytes_.size() - 1 - i] == 0xA5);
    if (out_.format > ANIC_FORMAT_FLOAT32X4 || size_ == 0)
      return;
    const size_t stride = out_.stride == 0 ? element_ : out_.stride;
    for (size_t at = 0; at < size_; at += stride) {
      float x[3];
      std::memcpy(x, bytes_.data() + kGuard + at, sizeof x);
      require(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]));
    }
  }

 private:
  static constexpr size_t kGuard = 32;
  std::vector<unsigned char> bytes_;
  anic_output out_ = ANIC_INIT(anic_output);
  size_t element_ = 0, size_ = 0;
};

/// Textures of a segment, to the byte.
inline void check_textures(const anic_asset* asset, uint32_t segment) {
  anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
  if (anic_get_texture_layout(asset, segment, 4096, &layout) != ANIC_OK)
    return;
  const uint32_t heights[3] = {layout.pose_height, layout.wide_height, layout.narrow_height};
  for (int32_t t = 0; t < 3; ++t) {
    std::vector<unsigned char> bytes((t == 2 ? size_t{8} : size_t{16}) * layout.width * heights[t]);
    require(anic_write_texture(asset, segment, static_cast<anic_texture>(t), &layout, 0,
                               bytes.data(), bytes.size()) == ANIC_OK);
  }
}

/// State of a part, to the byte.
inline void check_state(const anic_asset* asset, const anic_context* context, uint32_t mesh,
                        anic_when when, uint32_t part, uint32_t segment) {
  anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
  if (anic_get_texture_layout(asset, segment, UINT32_MAX, &layout) != ANIC_OK)
    return;
  std::vector<float> state(layout.state_floats);
  require(anic_write_state(context, mesh, when, part, state.data(), sizeof(float) * state.size()) ==
          ANIC_OK);
  for (float x : state)
    require(std::isfinite(x));
}

/// Calls of a host on an asset, some of them wrong; none of them allocates.
inline void sample(const anic_asset* asset, CappedMemory* memory, Script script) {
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_get_asset_info(asset, &info);
  require(info.mesh_count > 0 && info.frame_count > 0);
  anic_context* context = nullptr;
  if (anic_create_context(asset, nullptr, &context) != ANIC_OK)
    return;
  const size_t calls = memory->calls;
  for (int step = 0; step < 6; ++step) {
    const uint32_t mesh = script.below(info.mesh_count);
    anic_mesh sizes = ANIC_INIT(anic_mesh);
    require(anic_get_mesh(asset, mesh, &sizes) == ANIC_OK);
    require(anic_set_quality(context, (3 - step % 3) / 3.0) == ANIC_OK);
    if (script.byte() % 2) {
      const anic_status status = anic_seek_frame(context, script.below(info.frame_count + 1));
      require(status == ANIC_OK || status == ANIC_E_FRAME_RANGE);
    } else {
      const double span = info.duration + 1;
      const double time = span * (script.below(1000) / 300.0 - 1);
      const auto sampling = static_cast<anic_sampling>(static_cast<int32_t>(script.byte() % 5) - 1);
      const auto wrap = static_cast<anic_wrap>(static_cast<int32_t>(script.byte() % 5) - 1);
      anic_seek_time(context, time, sampling, wrap);
    }
    const auto when = static_cast<anic_when>(script.byte() % 2);
    const uint32_t first = script.below(sizes.vertex_count + 1);
    const uint32_t count = script.below(sizes.vertex_count - first + 1);
    const GuardedOutput points(count, &script);
    if (anic_write_positions(context, mesh, when, first, count, points.out()) == ANIC_OK)
      points.check();
    const uint32_t frames[2] = {script.below(info.frame_count), script.below(info.frame_count)};
    const GuardedOutput one(count, &script), two(count, &script);
    const anic_output outs[2] = {*one.out(), *two.out()};
    if (anic_write_frames(asset, mesh, frames, 2, first, count, outs) == ANIC_OK) {
      one.check();
      two.check();
    }
    const uint32_t attribute = script.below(sizes.attribute_count + 1);
    std::vector<unsigned char> values(size_t{16} * count * 2);
    anic_value_output value_out = ANIC_INIT(anic_value_output);
    value_out.data = values.data();
    value_out.size = values.size();
    value_out.format = static_cast<anic_value_format>(script.byte() % 5);
    value_out.components = script.below(18);
    anic_write_attribute(context, mesh, attribute, when, first, count, &value_out);
    anic_box box;
    if (anic_compute_bounds(context, mesh, when, &box) == ANIC_OK && sizes.vertex_count > 0)
      require(box.min[0] <= box.max[0] && std::isfinite(box.min[2]));
    anic_parts shown = ANIC_INIT(anic_parts);
    if (anic_get_parts(context, mesh, when, &shown) == ANIC_OK) {
      for (uint32_t p = 0; p < shown.count; ++p) {
        anic_basis basis = ANIC_INIT(anic_basis);
        require(anic_get_basis(asset, shown.parts[p].segment, &basis) == ANIC_OK);
        require(basis.vertex_count == sizes.vertex_count);
        for (uint32_t k = 0; k < shown.parts[p].correction_count; ++k)
          require(shown.parts[p].corrections[k].vertex < sizes.vertex_count);
        const uint32_t row = basis.components * basis.weight_channels;
        for (uint32_t j = 0; j < basis.regions * row; ++j)
          require(j % row >= shown.components[p] * basis.weight_channels ||
                  std::isfinite(shown.parts[p].weights[j]));
        for (uint32_t i = 0; shown.pose_maps[p] && i < 12 * basis.regions; ++i)
          require(std::isfinite(shown.pose_maps[p][i]));
        for (uint32_t v = 0; basis.vertex_region && v < basis.vertex_count; ++v)
          require(basis.vertex_region[v] < basis.regions);
        check_textures(asset, shown.parts[p].segment);
        check_state(asset, context, mesh, when, p, shown.parts[p].segment);
      }
    }
    if (anic_get_attribute_parts(context, mesh, attribute, 3 * script.below(6), when, &shown) ==
        ANIC_OK) {
      for (uint32_t p = 0; p < shown.count; ++p) {
        anic_basis basis = ANIC_INIT(anic_basis);
        require(anic_get_basis(asset, shown.parts[p].segment, &basis) == ANIC_OK);
        require(basis.target == ANIC_TARGET_ATTRIBUTE && basis.attribute == attribute &&
                basis.mesh == mesh);
      }
    }
    anic_forget_previous(context);
  }
  require(memory->calls == calls);
  anic_destroy_context(context);
}

/// The parts of an asset that do not move.
inline void look(const anic_asset* asset, Script script) {
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_get_asset_info(asset, &info);
  for (uint32_t c = 0; c < anic_get_clip_count(asset); ++c) {
    double before = 0;
    for (uint32_t e = 0; e < anic_get_event_count(asset, c); ++e) {
      anic_event event = ANIC_INIT(anic_event);
      require(anic_get_event(asset, c, e, &event) == ANIC_OK && event.name != nullptr);
      require(event.seconds >= before);
      before = event.seconds;
    }
    anic_root_motion motion = ANIC_INIT(anic_root_motion);
    const anic_status status = anic_get_root_motion(asset, c, script.byte() / 16.0,
                                                    ANIC_SAMPLE_CUBIC, ANIC_WRAP_LOOP, &motion);
    require(status == ANIC_OK || status == ANIC_E_ABSENT);
    for (const float x : motion.matrix)
      require(std::isfinite(x));
  }
  for (uint32_t m = 0; m < info.mesh_count; ++m) {
    anic_mesh sizes = ANIC_INIT(anic_mesh);
    anic_polygons polygons = ANIC_INIT(anic_polygons);
    const uint32_t* copies = nullptr;
    require(anic_get_mesh(asset, m, &sizes) == ANIC_OK);
    require(anic_get_polygons(asset, m, &polygons) == ANIC_OK);
    require(anic_get_coded_vertices(asset, m, &copies) == ANIC_OK);
    for (uint32_t v = 0; v < sizes.vertex_count; ++v)
      require(copies[v] < sizes.coded_vertex_count);
    for (uint32_t i = 0; i < sizes.attribute_count; ++i) {
      anic_attribute a = ANIC_INIT(anic_attribute);
      require(anic_get_attribute(asset, m, i, &a) == ANIC_OK);
      require(a.components > 0 ? a.values != nullptr : a.labels != nullptr || a.count == 0);
      for (uint32_t k = 0; k < a.label_count; ++k)
        require(anic_get_label_name(asset, m, i, k) != nullptr);
      for (uint64_t k = 0; k < uint64_t{a.count} * a.components; ++k)
        require(std::isfinite(a.values[k]));
      for (uint32_t k = 0; k < a.count && a.domain == ANIC_DOMAIN_POLYGONS && a.components == 0;
           ++k)
        require(a.labels[k] <= a.label_count);
    }
    for (uint32_t p = 0; p < polygons.polygon_count; ++p)
      require(polygons.offsets[p] <= polygons.offsets[p + 1]);
    require(polygons.offsets[polygons.polygon_count] == sizes.corner_count);
    for (uint32_t c = 0; c < sizes.corner_count; ++c)
      require(polygons.corners[c] < sizes.vertex_count);
    std::vector<uint32_t> indices(size_t{3} * sizes.triangle_count);
    require(anic_write_indices(asset, m, 4, indices.data(), 4 * indices.size()) == ANIC_OK);
    for (const uint32_t v : indices)
      require(v < sizes.vertex_count);

    anic_normal_plan_options wanted = ANIC_INIT(anic_normal_plan_options);
    wanted.crease_angle = script.byte() % 3 * 30;
    wanted.per_corner = script.byte() % 2;
    wanted.reference_frame = script.below(info.frame_count);
    anic_normal_plan* normals = nullptr;
    if (anic_create_normal_plan(asset, m, &wanted, nullptr, &normals) != ANIC_OK)
      continue;
    const std::vector<float> points(size_t{3} * sizes.vertex_count, 1.0F);
    const GuardedOutput out(anic_get_normal_count(normals), &script);
    require(anic_write_normals(normals, points.data(), 0, 0, anic_get_normal_count(normals),
                               out.out()) == ANIC_OK);
    out.check();
    anic_destroy_normal_plan(normals);
  }
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FUZZ_FUZZ_ASSET_H_
