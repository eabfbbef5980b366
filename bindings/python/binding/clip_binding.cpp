// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Opened clips.
#include "bindings/python/binding/binding.h"
#include "bindings/python/binding/instance.h"
#include "bindings/python/binding/struct_dicts.h"

#include <algorithm>
#include <memory>
#include <mutex>

namespace anicodec::python {
namespace {

struct CloseAsset {
  void operator()(anic_asset* asset) const { anic_close_asset(asset); }
};

struct DestroyContext {
  void operator()(anic_context* context) const { anic_destroy_context(context); }
};

struct DestroyPlan {
  void operator()(anic_normal_plan* plan) const { anic_destroy_normal_plan(plan); }
};

/// How normals of a mesh are made.
class NormalPlan {
 public:
  NormalPlan(const anic_asset* asset, uint32_t mesh, double crease, uint32_t frame, bool per_corner,
             bool source_edges) {
    anic_normal_plan_options options = ANIC_INIT(anic_normal_plan_options);
    options.crease_angle = crease;
    options.reference_frame = frame;
    options.per_corner = per_corner;
    options.source_edges = source_edges;
    anic_normal_plan* plan = nullptr;
    check_status(anic_create_normal_plan(asset, mesh, &options, nullptr, &plan));
    plan_.reset(plan);
  }

  size_t count() const { return anic_get_normal_count(plan_.get()); }

  void write(const Array<float>& positions, Writable<float> normals) const {
    anic_output out = ANIC_INIT(anic_output);
    out.data = normals.data();
    out.size = normals.nbytes();
    const WithoutInterpreter unlocked;
    check_status(anic_write_normals(plan_.get(), positions.data(), 0, 0,
                                    static_cast<uint32_t>(count()), &out));
  }

 private:
  std::unique_ptr<anic_normal_plan, DestroyPlan> plan_;
};

/// An opened file, with a context for times between frames. Clips that were not opened are not there: numbers of clips
/// and frames count those that were.
class Asset {
 public:
  Asset(const nb::bytes& file, double quality, uint64_t max_bytes,
        const std::vector<std::string>& clips, bool in_place, bool inexact) {
    anic_options options = ANIC_INIT(anic_options);
    std::vector<const char*> names;
    for (const std::string& name : clips)
      names.push_back(name.c_str());
    options.clips = names.data();
    options.clip_count = static_cast<uint32_t>(names.size());
    options.quality = quality;
    options.max_bytes = max_bytes;
    options.flags = (in_place ? ANIC_OPEN_IN_PLACE : 0) | (inexact ? ANIC_OPEN_INEXACT : 0);
    anic_failure failure = ANIC_INIT(anic_failure);
    anic_asset* asset = nullptr;
    anic_context* context = nullptr;
    const void* bytes = file.data();
    const size_t size = file.size();
    anic_status status;
    {
      const WithoutInterpreter unlocked;
      status = anic_open_asset(bytes, size, &options, &asset, &failure);
    }
    if (status != ANIC_OK)
      raise(status, report_of(failure));
    asset_.reset(asset);
    check_status(anic_create_context(asset, nullptr, &context));
    context_.reset(context);
    anic_get_asset_info(asset, &info_);
    for (uint32_t i = 0; i < anic_get_clip_count(asset); ++i) {
      anic_clip clip = ANIC_INIT(anic_clip);
      check_status(anic_get_clip(asset, i, &clip));
      if (clip.open) {
        clip_numbers_.push_back(i);
        first_frames_.push_back(frame_count_);
        clips_.push_back(clip);
        frame_count_ += clip.frame_count;
      }
    }
  }

  /// Clock and errors are those of the first clip.
  nb::dict info() const {
    nb::dict d = dict_of(info_);
    d.update(dict_of(clips_.front()));
    nb::del(d["first_frame"]);
    nb::del(d["open"]);
    d["frame_count"] = frame_count_;
    return d;
  }

  nb::dict mesh(uint32_t number) const {
    anic_mesh mesh = ANIC_INIT(anic_mesh);
    check_status(anic_get_mesh(asset_.get(), number, &mesh));
    return dict_of(mesh);
  }

  nb::tuple polygons(uint32_t mesh) const {
    anic_polygons polygons = ANIC_INIT(anic_polygons);
    check_status(anic_get_polygons(asset_.get(), mesh, &polygons));
    const size_t count = polygons.polygon_count;
    return nb::make_tuple(copied(polygons.offsets, count + 1),
                          copied(polygons.corners, polygons.offsets[count]));
  }

  nb::ndarray<nb::numpy, uint32_t> triangles(uint32_t number) const {
    anic_mesh mesh = ANIC_INIT(anic_mesh);
    check_status(anic_get_mesh(asset_.get(), number, &mesh));
    auto result = new_array<uint32_t>({mesh.triangle_count, 3});
    check_status(anic_write_indices(asset_.get(), number, 4, result.data(), result.nbytes()));
    return result;
  }

  nb::dict attribute(uint32_t mesh, uint32_t number) const {
    anic_attribute a = ANIC_INIT(anic_attribute);
    check_status(anic_get_attribute(asset_.get(), mesh, number, &a));
    nb::dict d = dict_of(a);
    if (a.components > 0) {
      auto values = new_array<float>({a.count, a.components});
      if (values.nbytes() > 0)
        std::memcpy(values.data(), a.values, values.nbytes());
      d["values"] = values;
    } else {
      d["values"] = copied(a.labels, a.count);
      nb::list names;
      for (uint32_t i = 0; i < a.label_count; ++i)
        names.append(text_of(anic_get_label_name(asset_.get(), mesh, number, i)));
      d["labels"] = names;
      if (a.kind == ANIC_ATTRIBUTE_MATERIAL) {
        nb::list looks;
        for (uint32_t i = 0; i < a.label_count; ++i)
          looks.append(look(mesh, number, i));
        d["looks"] = looks;
      }
    }
    return d;
  }

  /// The values of a material; None where they are unknown.
  nb::object look(uint32_t mesh, uint32_t attribute, uint32_t label) const {
    anic_material m = ANIC_INIT(anic_material);
    const anic_status status = anic_get_material(asset_.get(), mesh, attribute, label, &m);
    if (status == ANIC_E_ABSENT)
      return nb::none();
    check_status(status);
    return dict_of(m);
  }

  double frame_time(uint32_t frame) const {
    return anic_get_frame_time(asset_.get(), frame_of(frame));
  }

  /// Fills frames x vertices x 3.
  void frames(uint32_t mesh, std::vector<uint32_t> numbers, Writable<float> out) {
    const size_t count = numbers.size();
    if (count == 0)
      return;
    for (uint32_t& number : numbers)
      number = frame_of(number);
    const WithoutInterpreter unlocked;
    const size_t bytes = out.nbytes() / count;
    auto* to = reinterpret_cast<unsigned char*>(out.data());
    const auto vertices = static_cast<uint32_t>(bytes / (3 * sizeof(float)));
    for (size_t first = 0; first < count; first += ANIC_MAX_FRAMES) {
      const auto n = static_cast<uint32_t>(std::min<size_t>(ANIC_MAX_FRAMES, count - first));
      anic_output outputs[ANIC_MAX_FRAMES];
      for (uint32_t i = 0; i < n; ++i) {
        outputs[i] = ANIC_INIT(anic_output);
        outputs[i].data = to + (first + i) * bytes;
        outputs[i].size = bytes;
      }
      const anic_status status =
          anic_write_frames(asset_.get(), mesh, &numbers[first], n, 0, vertices, outputs);
      if (status == ANIC_E_STATE)
        single_frames(mesh, &numbers[first], n, vertices, outputs);
      else
        check_status(status);
    }
  }

  /// Fills vertices x 3 with a moment.
  void at(uint32_t mesh, uint32_t clip, double seconds, int sampling, int wrap, uint32_t other,
          double other_seconds, int other_wrap, double weight, Writable<float> out) {
    anic_output output = ANIC_INIT(anic_output);
    output.data = out.data();
    output.size = out.nbytes();
    const auto vertices = static_cast<uint32_t>(out.nbytes() / (3 * sizeof(float)));
    const WithoutInterpreter unlocked;
    const std::lock_guard<std::mutex> lock(mutex_);
    seek(clip, seconds, sampling, wrap);
    blend(other, other_seconds, sampling, other_wrap, weight);
    check_status(
        anic_write_positions(context_.get(), mesh, ANIC_WHEN_CURRENT, 0, vertices, &output));
  }

  /// Fills elements x components with an attribute at a moment.
  void attribute_at(uint32_t mesh, uint32_t attribute, uint32_t clip, double seconds, int sampling,
                    int wrap, uint32_t other, double other_seconds, int other_wrap, double weight,
                    Writable<float> out, uint32_t elements) {
    anic_value_output output = ANIC_INIT(anic_value_output);
    output.data = out.data();
    output.size = out.nbytes();
    const WithoutInterpreter unlocked;
    const std::lock_guard<std::mutex> lock(mutex_);
    seek(clip, seconds, sampling, wrap);
    blend(other, other_seconds, sampling, other_wrap, weight);
    check_status(anic_write_attribute(context_.get(), mesh, attribute, ANIC_WHEN_CURRENT, 0,
                                      elements, &output));
  }

  /// Position, normal and tangent of a point of the surface at a moment.
  std::vector<float> surface_frame(uint32_t mesh, uint32_t clip, double seconds, int sampling,
                                   int wrap, uint32_t other, double other_seconds, int other_wrap,
                                   double weight, std::array<uint32_t, 3> vertices,
                                   std::array<float, 3> weights) {
    anic_surface_point point;
    std::copy_n(vertices.data(), 3, point.vertices);
    std::copy_n(weights.data(), 3, point.weights);
    anic_surface_frame frame;
    const WithoutInterpreter unlocked;
    const std::lock_guard<std::mutex> lock(mutex_);
    seek(clip, seconds, sampling, wrap);
    blend(other, other_seconds, sampling, other_wrap, weight);
    check_status(anic_get_surface_frame(context_.get(), mesh, ANIC_WHEN_CURRENT, &point, &frame));
    std::vector<float> result(frame.position, frame.position + 3);
    result.insert(result.end(), frame.normal, frame.normal + 3);
    result.insert(result.end(), frame.tangent, frame.tangent + 3);
    return result;
  }

  /// Triangle, distance, weights and side of the first point on a ray at a moment; none if it meets nothing.
  std::optional<std::tuple<uint32_t, float, std::array<float, 3>, int>> intersect_ray(
      uint32_t mesh, uint32_t clip, double seconds, int sampling, int wrap, uint32_t other,
      double other_seconds, int other_wrap, double weight, std::array<float, 3> origin,
      std::array<float, 3> direction, float farthest, int side, const Array<uint32_t>& triangles) {
    anic_ray ray = ANIC_INIT(anic_ray);
    std::copy_n(origin.data(), 3, ray.origin);
    std::copy_n(direction.data(), 3, ray.direction);
    ray.farthest = farthest;
    ray.side = static_cast<anic_side>(side);
    anic_mesh sizes = ANIC_INIT(anic_mesh);
    check_status(anic_get_mesh(asset_.get(), mesh, &sizes));
    const auto count = static_cast<uint32_t>(triangles.size() / 3);
    anic_hit hit;
    {
      const WithoutInterpreter unlocked;
      std::vector<float> work(size_t{3} * sizes.vertex_count);
      const std::lock_guard<std::mutex> lock(mutex_);
      seek(clip, seconds, sampling, wrap);
      blend(other, other_seconds, sampling, other_wrap, weight);
      check_status(anic_intersect_ray(context_.get(), mesh, ANIC_WHEN_CURRENT, &ray,
                                      triangles.data(), count, work.data(),
                                      work.size() * sizeof(float), &hit));
    }
    if (hit.triangle == UINT32_MAX)
      return std::nullopt;
    const float* w = hit.point.weights;
    return std::tuple(hit.triangle, hit.distance, std::array<float, 3>{w[0], w[1], w[2]},
                      int{hit.side});
  }

  NormalPlan* normal_plan(uint32_t mesh, double crease, uint32_t frame, bool per_corner,
                          bool source_edges) const {
    return new NormalPlan(asset_.get(), mesh, crease, frame_of(frame), per_corner, source_edges);
  }

  RenderPlan* render_plan(uint32_t mesh, double crease, uint32_t frame, bool source_edges) const {
    return new RenderPlan(asset_.get(), mesh, crease, frame_of(frame), source_edges);
  }

  Instance* instance() const { return new Instance(asset_.get(), clip_numbers_); }

  /// A dictionary for each clip.
  nb::list clips() const {
    nb::list all;
    for (size_t i = 0; i < clips_.size(); ++i) {
      const anic_clip& clip = clips_[i];
      nb::dict d = dict_of(clip);
      d["first_frame"] = first_frames_[i];
      nb::list events;
      for (uint32_t e = 0; e < anic_get_event_count(asset_.get(), clip_numbers_[i]); ++e) {
        anic_event event = ANIC_INIT(anic_event);
        check_status(anic_get_event(asset_.get(), clip_numbers_[i], e, &event));
        events.append(nb::make_tuple(text_of(event.name), event.seconds));
      }
      d["events"] = nb::tuple(events);
      all.append(d);
    }
    return all;
  }

  nb::dict root_motion(uint32_t clip, double seconds, int sampling, int wrap) const {
    anic_root_motion motion = ANIC_INIT(anic_root_motion);
    check_status(anic_get_root_motion(asset_.get(), clip_of(clip), seconds,
                                      static_cast<anic_sampling>(sampling),
                                      static_cast<anic_wrap>(wrap), &motion));
    return dict_of(motion);
  }

  /// The same from one time to another.
  nb::dict root_step(uint32_t clip, double from, double to, int sampling, int wrap) const {
    anic_root_motion motion = ANIC_INIT(anic_root_motion);
    check_status(anic_get_root_step(asset_.get(), clip_of(clip), from, to,
                                    static_cast<anic_sampling>(sampling),
                                    static_cast<anic_wrap>(wrap), &motion));
    return dict_of(motion);
  }

  bool shows(uint32_t mesh, uint32_t frame) {
    const std::lock_guard<std::mutex> lock(mutex_);
    check_status(anic_seek_frame(context_.get(), frame_of(frame)));
    anic_output nothing = ANIC_INIT(anic_output);
    float none = 0;
    nothing.data = &none;
    const anic_status status =
        anic_write_positions(context_.get(), mesh, ANIC_WHEN_CURRENT, 0, 0, &nothing);
    if (status != ANIC_E_ABSENT)
      check_status(status);
    return status == ANIC_OK;
  }

  void verify() const {
    const WithoutInterpreter unlocked;
    check_status(anic_verify_asset(asset_.get()));
  }

 private:
  /// The file's number of a clip.
  uint32_t clip_of(uint32_t clip) const { return at_number(clip_numbers_, clip); }

  /// The file's number of a frame.
  uint32_t frame_of(uint32_t frame) const {
    if (frame >= frame_count_)
      check_status(ANIC_E_FRAME_RANGE);
    const auto after = std::upper_bound(first_frames_.begin(), first_frames_.end(), frame);
    const size_t clip = static_cast<size_t>(after - first_frames_.begin()) - 1;
    return clips_[clip].first_frame + (frame - first_frames_[clip]);
  }

  static std::string report_of(const anic_failure& failure) {
    std::string text = anic_get_status_text(failure.status);
    if (*failure.detail)
      text += " (" + std::string(failure.detail) + ")";
    return "offset " + std::to_string(failure.offset) +
           (failure.chunk[0] ? ", chunk " + std::string(failure.chunk) : "") + ": " + text;
  }

  void seek(uint32_t clip, double seconds, int sampling, int wrap) {
    check_status(anic_set_clip(context_.get(), clip_of(clip)));
    check_status(anic_seek_time(context_.get(), seconds, static_cast<anic_sampling>(sampling),
                                static_cast<anic_wrap>(wrap)));
  }

  void blend(uint32_t clip, double seconds, int sampling, int wrap, double weight) {
    if (weight != 0)
      check_status(anic_blend(context_.get(), clip_of(clip), seconds,
                              static_cast<anic_sampling>(sampling), static_cast<anic_wrap>(wrap),
                              weight));
  }

  /// Frames of a segment that needs the memory of a context.
  void single_frames(uint32_t mesh, const uint32_t* numbers, uint32_t count, uint32_t vertices,
                     const anic_output* outputs) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (uint32_t i = 0; i < count; ++i) {
      check_status(anic_seek_frame(context_.get(), numbers[i]));
      check_status(
          anic_write_positions(context_.get(), mesh, ANIC_WHEN_CURRENT, 0, vertices, &outputs[i]));
    }
  }

  std::unique_ptr<anic_asset, CloseAsset> asset_;
  std::unique_ptr<anic_context, DestroyContext> context_;
  std::mutex mutex_;
  anic_asset_info info_ = ANIC_INIT(anic_asset_info);
  std::vector<anic_clip> clips_;        ///< those that were opened
  std::vector<uint32_t> clip_numbers_;  ///< of each, in the file
  std::vector<uint32_t> first_frames_;  ///< of each, among those that were opened
  uint32_t frame_count_ = 0;
};

}  // namespace

void bind_clip(nb::module_& module) {
  nb::class_<NormalPlan>(module, "NormalPlan")
      .def_prop_ro("count", &NormalPlan::count)
      .def("write", &NormalPlan::write);
  module.def("read_metadata", [](const nb::bytes& file) -> std::optional<std::string> {
    const char* text;
    size_t size;
    const anic_status status = anic_read_metadata(file.data(), file.size(), &text, &size);
    if (status == ANIC_E_ABSENT)
      return std::nullopt;
    check_status(status);
    return std::string(text, size);
  });
  module.def("read_bounds",
             [](const nb::bytes& file, uint32_t mesh, uint32_t first,
                uint32_t count) -> std::optional<nb::ndarray<nb::numpy, float>> {
               anic_box box;
               const anic_status status =
                   anic_read_bounds(file.data(), file.size(), mesh, first, count, &box);
               if (status == ANIC_E_ABSENT)
                 return std::nullopt;
               check_status(status);
               auto result = new_array<float>({2, 3});
               std::memcpy(result.data(), &box, sizeof box);
               return result;
             });
  nb::class_<Asset>(module, "Asset")
      .def(nb::init<const nb::bytes&, double, uint64_t, const std::vector<std::string>&, bool,
                    bool>())
      .def("root_motion", &Asset::root_motion)
      .def("root_step", &Asset::root_step)
      .def("info", &Asset::info)
      .def("mesh", &Asset::mesh)
      .def("polygons", &Asset::polygons)
      .def("triangles", &Asset::triangles)
      .def("attribute", &Asset::attribute)
      .def("frame_time", &Asset::frame_time)
      .def("frames", &Asset::frames)
      .def("at", &Asset::at)
      .def("attribute_at", &Asset::attribute_at)
      .def("surface_frame", &Asset::surface_frame)
      .def("intersect_ray", &Asset::intersect_ray)
      .def("normal_plan", &Asset::normal_plan, nb::rv_policy::take_ownership,
           nb::keep_alive<0, 1>())
      .def("render_plan", &Asset::render_plan, nb::rv_policy::take_ownership,
           nb::keep_alive<0, 1>())
      .def("instance", &Asset::instance, nb::rv_policy::take_ownership, nb::keep_alive<0, 1>())
      .def("clips", &Asset::clips)
      .def("shows", &Asset::shows)
      .def("verify", &Asset::verify);
}

}  // namespace anicodec::python
