// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// C++17 over anicodec.h: handles that clean up behind themselves, ranges instead of pointers and
// sizes. Header only; throws nothing and allocates nothing. anicodec.h describes the functions.
#ifndef ANICODEC_ANICODEC_HPP_
#define ANICODEC_ANICODEC_HPP_

#include <anicodec/anicodec.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

namespace anic {

/// A status that may not be overlooked. True when all went well.
class [[nodiscard]] Status {
 public:
  constexpr Status(anic_status code = ANIC_OK) : code_(code) {}  // NOLINT: implicit by design

  constexpr explicit operator bool() const { return code_ == ANIC_OK; }

  constexpr anic_status code() const { return code_; }

  const char* text() const { return anic_get_status_text(code_); }

  friend constexpr bool operator==(Status a, Status b) { return a.code_ == b.code_; }

  friend constexpr bool operator!=(Status a, Status b) { return a.code_ != b.code_; }

 private:
  anic_status code_;
};

/// A range of elements that belong to someone else; made of anything that has data() and size().
template <class T>
class Span {
 public:
  constexpr Span() = default;

  constexpr Span(T* data, size_t size) : data_(data), size_(size) {}

  template <class Container,
            class Element = std::remove_pointer_t<decltype(std::declval<Container&>().data())>,
            class = std::enable_if_t<std::is_convertible_v<Element (*)[], T (*)[]>>>
  constexpr Span(Container&& container)  // NOLINT: implicit by design
      : data_(container.data()), size_(container.size()) {}

  constexpr T* data() const { return data_; }

  constexpr size_t size() const { return size_; }

  constexpr size_t size_bytes() const { return size_ * sizeof(T); }

  constexpr T& operator[](size_t i) const { return data_[i]; }

  constexpr T* begin() const { return data_; }

  constexpr T* end() const { return data_ + size_; }

 private:
  T* data_ = nullptr;
  size_t size_ = 0;
};

/// An output of packed float32 points.
inline anic_output output(Span<float> points) {
  anic_output out = ANIC_INIT(anic_output);
  out.data = points.data();
  out.size = points.size_bytes();
  return out;
}

/// An output of any format, from `data` on.
inline anic_output output(void* data, size_t size, anic_format format, size_t stride = 0) {
  anic_output out = ANIC_INIT(anic_output);
  out.data = data;
  out.size = size;
  out.format = format;
  out.stride = stride;
  return out;
}

/// An output of packed float32 values of an attribute.
inline anic_value_output value_output(Span<float> values) {
  anic_value_output out = ANIC_INIT(anic_value_output);
  out.data = values.data();
  out.size = values.size_bytes();
  return out;
}

/// Offset and scale of a 16-bit output for positions in a box.
inline anic_output within(anic_output out, const anic_box& box) {
  for (int c = 0; c < 3; ++c) {
    const bool centred = out.format == ANIC_FORMAT_SNORM16X3 || out.format == ANIC_FORMAT_SNORM16X4;
    const float size = box.max[c] - box.min[c];
    out.offset[c] = centred ? box.min[c] + size / 2 : box.min[c];
    out.scale[c] = centred ? size / 2 : size;
  }
  return out;
}

namespace detail {

template <class T, void (*Release)(T*)>
struct Releaser {
  void operator()(T* handle) const { Release(handle); }
};

template <class T, void (*Release)(T*)>
using Handle = std::unique_ptr<T, Releaser<T, Release>>;

/// Passes the place of a raw handle to `make`, and keeps what it put there.
template <class T, class H, class Make>
Status receive(H* handle, Make make) {
  T* raw = nullptr;
  const Status status = make(&raw);
  handle->reset(raw);
  return status;
}

}  // namespace detail

inline Status get_requirements(Span<const uint8_t> head, anic_requirements* out,
                               const anic_options* options = nullptr) {
  return anic_get_requirements(head.data(), head.size(), options, out);
}

/// A file that arrives piece by piece.
class Stream {
 public:
  Status create(const anic_options* options = nullptr) {
    return detail::receive<anic_stream>(
        &handle_, [&](anic_stream** out) { return anic_create_stream(options, out); });
  }

  explicit operator bool() const { return handle_ != nullptr; }

  anic_stream* get() const { return handle_.get(); }

  Status push(Span<const uint8_t> bytes) {
    return anic_push_bytes(get(), bytes.data(), bytes.size());
  }

  /// Turns to the next file of a live stream: see anic_advance_stream().
  Status advance() { return anic_advance_stream(get()); }

  anic_stream_info info() const {
    anic_stream_info info = ANIC_INIT(anic_stream_info);
    (void)anic_get_stream_info(get(), &info);
    return info;
  }

  anic_failure failure() const {
    anic_failure failure = ANIC_INIT(anic_failure);
    failure.detail = "";
    (void)anic_get_stream_failure(get(), &failure);
    return failure;
  }

 private:
  detail::Handle<anic_stream, anic_destroy_stream> handle_;
};

/// An opened file. Empty until open() succeeds.
class Asset {
 public:
  Status open(Span<const uint8_t> file, const anic_options* options = nullptr,
              anic_failure* failure = nullptr) {
    return detail::receive<anic_asset>(&handle_, [&](anic_asset** out) {
      return anic_open_asset(file.data(), file.size(), options, out, failure);
    });
  }

  /// Read is called as bool(uint64_t offset, void* to, size_t size).
  template <class Read>
  Status open(uint64_t file_size, Read&& read, const anic_options* options = nullptr,
              anic_failure* failure = nullptr) {
    using Function = std::remove_reference_t<Read>;
    Function* function = &read;
    const anic_reader reader = {&function, [](void* user, uint64_t offset, void* to, size_t size) {
                                  return (**static_cast<Function**>(user))(offset, to, size) ? 0
                                                                                             : 1;
                                }};
    return detail::receive<anic_asset>(&handle_, [&](anic_asset** out) {
      return anic_open_asset_from_reader(&reader, file_size, options, out, failure);
    });
  }

  /// The part of a stream that has arrived.
  Status open(const Stream& stream, anic_failure* failure = nullptr) {
    return detail::receive<anic_asset>(&handle_, [&](anic_asset** out) {
      return anic_open_asset_from_stream(stream.get(), out, failure);
    });
  }

  /// Another asset of the same file, which shares its memory: see anic_share_asset().
  Status share(const Asset& of, const anic_options* options = nullptr) {
    return detail::receive<anic_asset>(
        &handle_, [&](anic_asset** out) { return anic_share_asset(of.get(), options, out); });
  }

  void close() { handle_.reset(); }

  explicit operator bool() const { return handle_ != nullptr; }

  anic_asset* get() const { return handle_.get(); }

  anic_asset_info info() const {
    anic_asset_info info = ANIC_INIT(anic_asset_info);
    (void)anic_get_asset_info(get(), &info);
    return info;
  }

  anic_mesh mesh(uint32_t mesh = 0) const {
    anic_mesh info = ANIC_INIT(anic_mesh);
    (void)anic_get_mesh(get(), mesh, &info);
    return info;
  }

  anic_polygons polygons(uint32_t mesh = 0) const {
    anic_polygons polygons = ANIC_INIT(anic_polygons);
    (void)anic_get_polygons(get(), mesh, &polygons);
    return polygons;
  }

  /// Texture coordinates, colours, materials and the like; mesh().attribute_count of them.
  anic_attribute attribute(uint32_t number, uint32_t mesh = 0) const {
    anic_attribute attribute = ANIC_INIT(anic_attribute);
    (void)anic_get_attribute(get(), mesh, number, &attribute);
    return attribute;
  }

  /// Null if there is no such label.
  const char* label_name(uint32_t attribute, uint32_t label, uint32_t mesh = 0) const {
    return anic_get_label_name(get(), mesh, attribute, label);
  }

  /// Status kAbsent where the file has the material's name and nothing else.
  Status material(uint32_t attribute, uint32_t label, anic_material* out, uint32_t mesh = 0) const {
    return anic_get_material(get(), mesh, attribute, label, out);
  }

  /// Which vertices move together.
  Span<const uint32_t> coded_vertices(uint32_t mesh = 0) const {
    const uint32_t* first = nullptr;
    return anic_get_coded_vertices(get(), mesh, &first) == ANIC_OK
               ? Span<const uint32_t>(first, this->mesh(mesh).vertex_count)
               : Span<const uint32_t>();
  }

  /// Index is uint16_t or uint32_t.
  template <class Index>
  Status write_indices(Span<Index> out, uint32_t mesh = 0) const {
    static_assert(sizeof(Index) == 2 || sizeof(Index) == 4);
    return anic_write_indices(get(), mesh, sizeof(Index), out.data(), out.size_bytes());
  }

  double frame_time(uint32_t frame) const { return anic_get_frame_time(get(), frame); }

  /// The step of a character from one time of a clip to another: see anic_get_root_step().
  Status root_step(uint32_t clip, double from, double to, anic_root_motion* out,
                   anic_sampling sampling = ANIC_SAMPLE_LINEAR,
                   anic_wrap wrap = ANIC_WRAP_LOOP) const {
    return anic_get_root_step(get(), clip, from, to, sampling, wrap, out);
  }

  Status verify() const { return anic_verify_asset(get()); }

  /// Whole frames, without a context; as many outputs as frames.
  Status write_frames(Span<const uint32_t> frames, Span<const anic_output> outputs, uint32_t first,
                      uint32_t count, uint32_t mesh = 0) const {
    if (frames.size() != outputs.size() || frames.size() > ANIC_MAX_FRAMES)
      return ANIC_E_ARGUMENT;
    return anic_write_frames(get(), mesh, frames.data(), static_cast<uint32_t>(frames.size()),
                             first, count, outputs.data());
  }

  Status bounds(anic_box* out, uint32_t mesh = 0) const {
    return anic_get_clip_bounds(get(), mesh, out);
  }

  Status frame_bounds(uint32_t frame, anic_box* out, uint32_t mesh = 0) const {
    return anic_get_frame_bounds(get(), mesh, frame, out);
  }

  Status basis(uint32_t segment, anic_basis* out) const {
    return anic_get_basis(get(), segment, out);
  }

  Status texture_layout(uint32_t segment, uint32_t max_size, anic_texture_layout* out) const {
    return anic_get_texture_layout(get(), segment, max_size, out);
  }

  Status write_texture(uint32_t segment, anic_texture texture, const anic_texture_layout& layout,
                       Span<unsigned char> out, size_t row_bytes = 0) const {
    return anic_write_texture(get(), segment, texture, &layout, row_bytes, out.data(), out.size());
  }

 private:
  detail::Handle<anic_asset, anic_close_asset> handle_;
};

/// An instance of an asset, which must outlive it.
class Context {
 public:
  Status create(const Asset& asset, const anic_allocator* allocator = nullptr) {
    return detail::receive<anic_context>(&handle_, [&](anic_context** out) {
      return anic_create_context(asset.get(), allocator, out);
    });
  }

  explicit operator bool() const { return handle_ != nullptr; }

  anic_context* get() const { return handle_.get(); }

  Status seek_frame(uint32_t frame) { return anic_seek_frame(get(), frame); }

  Status seek(double seconds, anic_sampling sampling = ANIC_SAMPLE_LINEAR,
              anic_wrap wrap = ANIC_WRAP_CLAMP) {
    return anic_seek_time(get(), seconds, sampling, wrap);
  }

  Status set_clip(uint32_t clip) { return anic_set_clip(get(), clip); }

  Status blend(uint32_t clip, double seconds, double weight,
               anic_sampling sampling = ANIC_SAMPLE_LINEAR, anic_wrap wrap = ANIC_WRAP_CLAMP) {
    return anic_blend(get(), clip, seconds, sampling, wrap, weight);
  }

  Status set_quality(double quality) { return anic_set_quality(get(), quality); }

  Status forget_previous() { return anic_forget_previous(get()); }

  Status write_positions(const anic_output& out, uint32_t first, uint32_t count,
                         anic_when when = ANIC_WHEN_CURRENT, uint32_t mesh = 0) const {
    return anic_write_positions(get(), mesh, when, first, count, &out);
  }

  Status write_attribute(uint32_t attribute, const anic_value_output& out, uint32_t first,
                         uint32_t count, anic_when when = ANIC_WHEN_CURRENT,
                         uint32_t mesh = 0) const {
    return anic_write_attribute(get(), mesh, attribute, when, first, count, &out);
  }

  Status compute_bounds(anic_box* out, anic_when when = ANIC_WHEN_CURRENT,
                        uint32_t mesh = 0) const {
    return anic_compute_bounds(get(), mesh, when, out);
  }

  Status surface_frame(const anic_surface_point& point, anic_surface_frame* out,
                       anic_when when = ANIC_WHEN_CURRENT, uint32_t mesh = 0) const {
    return anic_get_surface_frame(get(), mesh, when, &point, out);
  }

  /// `triangles`: three vertices each; `work`: three floats for each vertex of the mesh.
  Status intersect_ray(const anic_ray& ray, Span<const uint32_t> triangles, Span<float> work,
                       anic_hit* out, anic_when when = ANIC_WHEN_CURRENT, uint32_t mesh = 0) const {
    return anic_intersect_ray(get(), mesh, when, &ray, triangles.data(),
                              static_cast<uint32_t>(triangles.size() / 3), work.data(),
                              work.size_bytes(), out);
  }

  Status parts(anic_parts* out, anic_when when = ANIC_WHEN_CURRENT, uint32_t mesh = 0) const {
    return anic_get_parts(get(), mesh, when, out);
  }

  /// One part, ready for a shader.
  Status write_state(uint32_t part, Span<float> out, anic_when when = ANIC_WHEN_CURRENT,
                     uint32_t mesh = 0) const {
    return anic_write_state(get(), mesh, when, part, out.data(), out.size_bytes());
  }

  /// For three components of an attribute.
  Status attribute_parts(uint32_t attribute, uint32_t first_component, anic_parts* out,
                         anic_when when = ANIC_WHEN_CURRENT, uint32_t mesh = 0) const {
    return anic_get_attribute_parts(get(), mesh, attribute, first_component, when, out);
  }

 private:
  detail::Handle<anic_context, anic_destroy_context> handle_;
};

/// How to make normals of a mesh; independent of the asset once made.
class NormalPlan {
 public:
  Status create(const Asset& asset, const anic_normal_plan_options* options = nullptr,
                uint32_t mesh = 0, const anic_allocator* allocator = nullptr) {
    return detail::receive<anic_normal_plan>(&handle_, [&](anic_normal_plan** out) {
      return anic_create_normal_plan(asset.get(), mesh, options, allocator, out);
    });
  }

  explicit operator bool() const { return handle_ != nullptr; }

  anic_normal_plan* get() const { return handle_.get(); }

  uint32_t size() const { return anic_get_normal_count(get()); }

  Status write_normals(const float* positions, const anic_output& out, uint32_t first,
                       uint32_t count, size_t stride = 0) const {
    return anic_write_normals(get(), positions, stride, first, count, &out);
  }

 private:
  detail::Handle<anic_normal_plan, anic_destroy_normal_plan> handle_;
};

/// The vertices that a graphics card needs; independent of the asset once made.
class RenderPlan {
 public:
  Status create(const Asset& asset, const anic_render_plan_options* options = nullptr,
                uint32_t mesh = 0, const anic_allocator* allocator = nullptr) {
    return detail::receive<anic_render_plan>(&handle_, [&](anic_render_plan** out) {
      return anic_create_render_plan(asset.get(), mesh, options, allocator, out);
    });
  }

  explicit operator bool() const { return handle_ != nullptr; }

  anic_render_plan* get() const { return handle_.get(); }

  /// The plan's counts; all 0 without a plan.
  anic_render_info info() const {
    anic_render_info info = ANIC_INIT(anic_render_info);
    anic_get_render_info(get(), &info);
    return info;
  }

  Status write_positions(const Context& context, const anic_output& out, uint32_t first,
                         uint32_t count, anic_when when = ANIC_WHEN_CURRENT) const {
    return anic_write_render_positions(get(), context.get(), when, first, count, &out);
  }

  Status write_normals(const float* positions, const anic_output& out, uint32_t first,
                       uint32_t count, size_t stride = 0) const {
    return anic_write_render_normals(get(), positions, stride, first, count, &out);
  }

  Status write_attribute(const Context& context, uint32_t attribute, const anic_value_output& out,
                         uint32_t first, uint32_t count, anic_when when = ANIC_WHEN_CURRENT) const {
    return anic_write_render_attribute(get(), context.get(), attribute, when, first, count, &out);
  }

 private:
  detail::Handle<anic_render_plan, anic_destroy_render_plan> handle_;
};

}  // namespace anic

#endif  // ANICODEC_ANICODEC_HPP_
