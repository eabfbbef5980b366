// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The encoder, over its C interface.
#include "bindings/python/binding/binding.h"
#include "bindings/python/binding/live_binding.h"
#include "bindings/python/binding/struct_dicts.h"

#include <anicodec/encode.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace anicodec::python {
namespace {

struct DestroyEncoder {
  void operator()(anic_encoder* encoder) const { anic_destroy_encoder(encoder); }
};

/// A callback of Python that a C interface calls: the first exception is kept for later.
struct Callback {
  nb::object function;
  size_t floats = 0;  ///< that a frame has
  std::optional<nb::python_error>* thrown = nullptr;

  template <class Work>
  int guarded(const Work& work) const {
    const WithInterpreter locked;
    try {
      if (PyErr_CheckSignals() != 0)
        throw nb::python_error();
      return work();
    } catch (nb::python_error& e) {
      thrown->emplace(std::move(e));
    } catch (const std::exception& e) {
      PyErr_SetString(PyExc_TypeError, e.what());
      thrown->emplace();
    }
    return 1;
  }
};

int report(void* user, const char* stage, double done) {
  const auto* callback = static_cast<const Callback*>(user);
  return callback->guarded([&] {
    if (callback->function.is_none())
      return 0;
    const nb::object answer = callback->function(stage, done);
    return answer.ptr() == Py_False ? 1 : 0;
  });
}

int read_frame(void* user, uint32_t frame, float* positions) {
  const auto* callback = static_cast<const Callback*>(user);
  return callback->guarded([&] {
    const nb::object answer = callback->function(frame);
    const auto array = nb::cast<Array<float>>(answer);
    if (array.size() != callback->floats)
      throw nb::value_error("a frame does not have the positions of all vertices");
    std::memcpy(positions, array.data(), array.nbytes());
    return 0;
  });
}

/// Numbers and textures of a material in the order of anic_material, the kind of alpha and double_sided
/// behind the other numbers.
using Look = std::pair<std::vector<float>, std::vector<std::string>>;

anic_material material_of(const Look& look) {
  const auto& [numbers, textures] = look;
  if (numbers.size() != 12 || textures.size() != 5)
    throw nb::value_error("a material has 12 numbers and 5 textures");
  anic_material m = ANIC_INIT(anic_material);
  std::copy_n(numbers.begin(), 4, m.base_colour);
  m.metallic = numbers[4];
  m.roughness = numbers[5];
  std::copy_n(numbers.begin() + 6, 3, m.emissive);
  m.alpha_cutoff = numbers[9];
  m.alpha = static_cast<anic_alpha>(numbers[10]);
  m.double_sided = numbers[11] != 0;
  m.base_colour_texture = textures[0].c_str();
  m.metallic_roughness_texture = textures[1].c_str();
  m.normal_texture = textures[2].c_str();
  m.occlusion_texture = textures[3].c_str();
  m.emissive_texture = textures[4].c_str();
  return m;
}

class Encoder {
 public:
  Encoder() {
    anic_encoder* encoder = nullptr;
    check_status(anic_create_encoder(&encoder));
    encoder_.reset(encoder);
  }

  /// The first, or one more. `origin`: none for one that is found.
  void add_clip(const std::string& name, uint32_t frames, uint32_t numerator, uint32_t denominator,
                int up, bool loop, double start, double unit,
                const std::optional<Array<double>>& times,
                const std::vector<std::pair<std::string, double>>& events,
                const std::optional<std::array<double, 3>>& origin) {
    anic_source_clip clip = ANIC_INIT(anic_source_clip);
    clip.name = name.c_str();
    clip.frame_count = frames;
    clip.rate_numerator = numerator;
    clip.rate_denominator = denominator;
    clip.up = static_cast<anic_up_axis>(up);
    clip.loop = loop;
    clip.start_time = start;
    clip.metres_per_unit = unit;
    clip.find_origin = !origin;
    if (origin)
      std::copy_n(origin->begin(), 3, clip.origin);
    clip.times = times ? times->data() : nullptr;
    std::vector<const char*> names;
    std::vector<double> seconds;
    for (const auto& [event, time] : events) {
      names.push_back(event.c_str());
      seconds.push_back(time);
    }
    clip.event_names = names.data();
    clip.event_seconds = seconds.data();
    clip.event_count = static_cast<uint32_t>(events.size());
    check(has_clip_ ? anic_add_source_clip(encoder_.get(), &clip)
                    : anic_set_source_clip(encoder_.get(), &clip));
    has_clip_ = true;
  }

  /// Positions: an array frames x vertices x 3 whose last axis is packed, or a function of a frame; None in a live clip.
  void add_mesh(const std::string& name, uint32_t vertices, const Array<uint32_t>& offsets,
                const Array<uint32_t>& corners, const nb::object& positions,
                const std::vector<std::pair<uint32_t, uint32_t>>& runs);

  void add_attribute(uint32_t mesh, const std::string& name, int kind, int domain,
                     uint32_t components, uint32_t frames,
                     const std::optional<Array<float>>& values,
                     const std::optional<Array<uint32_t>>& labels,
                     const std::vector<std::string>& names,
                     const std::vector<std::optional<Look>>& looks, int bound, double error,
                     const std::string& unit) {
    anic_source_attribute attribute = ANIC_INIT(anic_source_attribute);
    attribute.name = name.c_str();
    attribute.kind = static_cast<anic_attribute_kind>(kind);
    attribute.domain = static_cast<anic_domain>(domain);
    attribute.components = components;
    attribute.frames = frames;
    attribute.bound = static_cast<anic_bound>(bound);
    attribute.error = error;
    attribute.unit = unit.c_str();
    attribute.values = values ? values->data() : nullptr;
    attribute.labels = labels ? labels->data() : nullptr;
    std::vector<const char*> texts;
    for (const std::string& text : names)
      texts.push_back(text.c_str());
    attribute.label_names = texts.data();
    attribute.label_count = static_cast<uint32_t>(texts.size());
    std::vector<anic_material> materials;
    for (const std::optional<Look>& look : looks)
      materials.push_back(look ? material_of(*look) : anic_material{});
    std::vector<const anic_material*> known;
    for (size_t i = 0; i < looks.size(); ++i)
      known.push_back(looks[i] ? &materials[i] : nullptr);
    attribute.materials = known.empty() ? nullptr : known.data();
    check(anic_add_source_attribute(encoder_.get(), mesh, &attribute));
  }

  nb::tuple encode(const nb::dict& choices, const nb::object& progress);

  /// A live stream of a clip without frames; 0 means what it does in anic_live_options.
  Live begin_live(const nb::dict& choices, double piece, double key_every, double box,
                  uint64_t most_waiting);

 private:
  void check(anic_status status) const {
    if (status != ANIC_OK)
      raise(status, anic_get_encoder_text(encoder_.get()));
  }

  std::unique_ptr<anic_encoder, DestroyEncoder> encoder_;
  bool has_clip_ = false;
  std::vector<nb::ndarray<nb::ro, nb::device::cpu>> arrays_;  ///< kept until they are read
  std::vector<std::unique_ptr<Callback>> readers_;
  std::optional<nb::python_error> thrown_;
};

void Encoder::add_mesh(const std::string& name, uint32_t vertices, const Array<uint32_t>& offsets,
                       const Array<uint32_t>& corners, const nb::object& positions,
                       const std::vector<std::pair<uint32_t, uint32_t>>& runs) {
  anic_source_mesh mesh = ANIC_INIT(anic_source_mesh);
  mesh.name = name.c_str();
  mesh.vertex_count = vertices;
  mesh.polygon_count = static_cast<uint32_t>(offsets.size() - 1);
  mesh.offsets = offsets.data();
  mesh.corners = corners.data();
  if (PyCallable_Check(positions.ptr())) {
    readers_.push_back(
        std::make_unique<Callback>(Callback{positions, size_t{vertices} * 3, &thrown_}));
    mesh.user = readers_.back().get();
    mesh.read = read_frame;
  } else if (!positions.is_none()) {
    auto array = nb::cast<nb::ndarray<nb::ro, nb::device::cpu>>(positions);
    const bool wide = array.dtype() == nb::dtype<double>();
    if (array.ndim() != 3 || array.shape(2) != 3 || array.shape(1) != vertices ||
        array.stride(2) != 1 || (!wide && array.dtype() != nb::dtype<float>()))
      throw nb::value_error("positions must be frames x vertices x 3 of float32 or float64");
    const auto scalar = static_cast<int64_t>(array.itemsize());
    mesh.positions = array.data();
    mesh.scalar = wide ? ANIC_SCALAR_FLOAT64 : ANIC_SCALAR_FLOAT32;
    mesh.vertex_stride = static_cast<ptrdiff_t>(array.stride(1) * scalar);
    mesh.frame_stride = static_cast<ptrdiff_t>(array.stride(0) * scalar);
    arrays_.push_back(std::move(array));
  }
  std::vector<anic_frame_run> host_runs;
  for (const auto& [first, count] : runs)
    host_runs.push_back({first, count});
  mesh.runs = host_runs.empty() ? nullptr : host_runs.data();
  mesh.run_count = static_cast<uint32_t>(host_runs.size());
  check(anic_add_source_mesh(encoder_.get(), &mesh, nullptr));
}

/// The options of Python as the encoder takes them.
struct Options {
  anic_encode_options options = ANIC_INIT(anic_encode_options);
  std::string metadata;

  explicit Options(const nb::dict& choices);
};

Options::Options(const nb::dict& choices) {
  auto set = [&]<class Field>(const char* key, Field& field) {
    if (!choices.contains(key))
      return;
    std::conditional_t<std::is_enum_v<Field>, int32_t, Field> value;
    if (!nb::try_cast(choices[key], value))
      throw nb::type_error((std::string(key) + " is not a number that fits").c_str());
    field = static_cast<Field>(value);
  };
  each_number(options, set);
  if (choices.contains("metadata")) {
    metadata = nb::cast<std::string>(choices["metadata"]);
    options.metadata = metadata.c_str();
  }
}

nb::tuple Encoder::encode(const nb::dict& choices, const nb::object& progress) {
  Options given(choices);
  anic_encode_options& options = given.options;
  Callback follower{progress, 0, &thrown_};
  options.progress = {&follower, report};
  anic_encoding result = ANIC_INIT(anic_encoding);
  anic_status status;
  {
    const WithoutInterpreter unlocked;
    status = anic_encode(encoder_.get(), &options, &result);
  }
  if (thrown_) {
    nb::python_error error = std::move(*thrown_);
    thrown_.reset();
    throw error;
  }
  check(status);
  return nb::make_tuple(nb::bytes(result.file, result.size), dict_of(result));
}

Live Encoder::begin_live(const nb::dict& choices, double piece, double key_every, double box,
                         uint64_t most_waiting) {
  const Options given(choices);
  anic_live_options live = ANIC_INIT(anic_live_options);
  live.piece_seconds = piece;
  live.key_seconds = key_every;
  live.box = box;
  live.most_waiting_frames = most_waiting;
  anic_live* made = nullptr;
  check(anic_begin_live(encoder_.get(), &given.options, &live, &made));
  return Live(made);
}

}  // namespace

void bind_encoder(nb::module_& module) {
  nb::class_<Encoder>(module, "Encoder")
      .def(nb::init<>())
      .def("add_clip", &Encoder::add_clip, nb::arg("name"), nb::arg("frames"), nb::arg("numerator"),
           nb::arg("denominator"), nb::arg("up"), nb::arg("loop"), nb::arg("start"),
           nb::arg("unit"), nb::arg("times").none(), nb::arg("events"), nb::arg("origin").none())
      .def("add_mesh", &Encoder::add_mesh, nb::arg("name"), nb::arg("vertices"), nb::arg("offsets"),
           nb::arg("corners"), nb::arg("positions").none(), nb::arg("runs"))
      .def("add_attribute", &Encoder::add_attribute, nb::arg("mesh"), nb::arg("name"),
           nb::arg("kind"), nb::arg("domain"), nb::arg("components"), nb::arg("frames"),
           nb::arg("values").none(), nb::arg("labels").none(), nb::arg("names"), nb::arg("looks"),
           nb::arg("bound"), nb::arg("error"), nb::arg("unit"))
      .def("encode", &Encoder::encode, nb::arg("choices"), nb::arg("progress").none())
      .def("begin_live", &Encoder::begin_live, nb::arg("choices"), nb::arg("piece"),
           nb::arg("key_every"), nb::arg("box"), nb::arg("most_waiting"));
}

}  // namespace anicodec::python
