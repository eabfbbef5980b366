// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes as decisions about clips, odd ones among them, and options to encode them by, through the C interface: what
// cannot be encoded is refused with a text; what can, opens with all that it was made of, and took no more memory than it
// might.
#include "tests/fuzz/fuzz_file.h"
#include "tests/heap_count.h"

#include <anicodec/anicodec.h>
#include <anicodec/encode.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

using namespace anicodec;

namespace {

void require(bool condition) {
  if (!condition)
    std::abort();
}

using Float = std::numeric_limits<float>;
constexpr float kOdd[] = {0.0F,
                          -0.0F,
                          1.0F,
                          -1.0F,
                          1e-3F,
                          16777216.0F,
                          1e10F,
                          1e20F,
                          -1e30F,
                          1e-20F,
                          1e-40F,
                          Float::max(),
                          Float::lowest(),
                          Float::min(),
                          Float::denorm_min(),
                          Float::infinity(),
                          Float::quiet_NaN()};

/// A clip, and ways to encode it. Holds what the encoder does not copy.
class Encoding {
 public:
  explicit Encoding(Script script) : script_(script) {
    require(anic_create_encoder(&encoder_) == ANIC_OK);
  }

  Encoding(const Encoding&) = delete;
  Encoding& operator=(const Encoding&) = delete;

  ~Encoding() { anic_destroy_encoder(encoder_); }

  void run() {
    if (!taken(set_clips()) || !taken(add_meshes()))
      return;
    anic_encode_options options = ANIC_INIT(anic_encode_options);
    choose(&options);
    anic_encoding result = ANIC_INIT(anic_encoding);
    const HeapCount heap;  // of this thread
    const anic_status status = anic_encode(encoder_, &options, &result);
    require(options.max_bytes == 0 || options.threads > 1 || heap.peak() <= options.max_bytes);
    if (taken(status) && result.file)
      open(result, options);
  }

 private:
  uint32_t below(uint32_t limit) { return script_.byte() % limit; }

  bool one_in(uint32_t count) { return below(count) == count - 1; }

  /// Whether a call did what it was asked to; else it says what was wrong.
  bool taken(anic_status status) const {
    const char* const text = anic_get_encoder_text(encoder_);
    const bool fair = status == ANIC_OK || status == ANIC_E_ARGUMENT || status == ANIC_E_STATE ||
                      status == ANIC_E_NON_FINITE || status == ANIC_E_LIMIT ||
                      status == ANIC_E_INDEX_RANGE || status == ANIC_E_READ ||
                      status == ANIC_E_CANCELLED;
    if (!fair || (status != ANIC_OK && *text == '\0'))
      std::fprintf(stderr, "status %d: %s\n", static_cast<int>(status), text);
    require(fair && (status == ANIC_OK || *text != '\0'));
    return status == ANIC_OK;
  }

  float odd() { return kOdd[below(std::size(kOdd))]; }

  const char* text() {
    constexpr const char* kTexts[] = {"a", "b", "", "\xC3\xA4", "\xFF\xFE", "a\nb\x1B", "../c"};
    return one_in(3) ? nullptr : kTexts[below(std::size(kTexts))];
  }

  anic_status set_clips() {
    const uint32_t clips = one_in(4) ? 2 : 1;
    anic_source_clip clip = ANIC_INIT(anic_source_clip);
    clip.up = static_cast<anic_up_axis>(below(3));
    clip.metres_per_unit = one_in(16) ? static_cast<double>(odd()) : 0;
    for (double& x : clip.origin)
      x = one_in(32) ? static_cast<double>(odd()) : 0;
    clip.find_origin = one_in(8);
    plain_ =
        clip.find_origin == 0 && clip.origin[0] == 0 && clip.origin[1] == 0 && clip.origin[2] == 0;
    for (uint32_t c = 0; c < clips; ++c) {
      clip.name = c == 0 ? text() : "second";
      clip.frame_count = 1 + below(one_in(4) ? 40 : 8);
      clip.rate_numerator = below(4) * below(256);
      clip.rate_denominator = below(3);
      clip.loop = one_in(2);
      clip.start_time = one_in(16) ? static_cast<double>(odd()) : 0;
      std::vector<double>& times = doubles_.emplace_back();
      for (uint32_t f = 0, uneven = one_in(8); uneven && f < clip.frame_count; ++f)
        times.push_back((times.empty() ? 0 : times.back()) +
                        (one_in(16) ? static_cast<double>(odd()) : 0.1 * below(4)));
      clip.times = times.size() == clip.frame_count ? times.data() : nullptr;
      const char* const name = "step";
      const double second = one_in(16) ? static_cast<double>(odd()) : 0;
      clip.event_count = one_in(8);
      clip.event_names = &name;
      clip.event_seconds = &second;
      frames_ += clip.frame_count;
      const anic_status status =
          c == 0 ? anic_set_source_clip(encoder_, &clip) : anic_add_source_clip(encoder_, &clip);
      if (status != ANIC_OK)
        return status;
    }
    return ANIC_OK;
  }

  anic_status add_meshes() {
    for (uint32_t more = one_in(6) ? 2 : 1; more > 0; --more) {
      anic_source_mesh mesh = ANIC_INIT(anic_source_mesh);
      mesh.name = text();
      mesh.vertex_count = 1 + below(one_in(4) ? 60 : 12);
      anic_frame_run run = {0, frames_};
      if (one_in(8)) {
        run = {below(frames_), 1 + below(frames_)};
        mesh.runs = &run;
        mesh.run_count = 1;
        plain_ = false;
      }
      const std::vector<uint32_t> offsets = polygons(mesh.vertex_count);
      mesh.polygon_count = static_cast<uint32_t>(offsets.size() - 1);
      mesh.offsets = offsets.data();
      mesh.corners = corners_.data();
      set_positions(&mesh, run.count);
      const anic_status status = anic_add_source_mesh(encoder_, &mesh, nullptr);
      if (status != ANIC_OK)
        return status;
      vertices_.push_back(mesh.vertex_count);
      for (uint32_t count = one_in(2) ? below(4) : 0; count > 0; --count)
        (void)taken(add_attribute(mesh, run.count));
    }
    return ANIC_OK;
  }

  /// Offsets of polygons over `vertices`, corners in corners_.
  std::vector<uint32_t> polygons(uint32_t vertices) {
    std::vector<uint32_t> offsets = {0};
    corners_.clear();
    const uint32_t kind = below(4), count = below(kind == 0 ? 2 : 40);
    for (uint32_t p = 0; p < count; ++p) {
      const uint32_t sides = one_in(16) ? below(9) : 3 + (kind == 1 && one_in(2));
      for (uint32_t k = 0; k < sides; ++k)
        corners_.push_back(kind == 3 ? below(vertices) : (p + k * (1 + p % 2)) % vertices);
      offsets.push_back(static_cast<uint32_t>(corners_.size()));
    }
    if (!corners_.empty() && one_in(32))
      corners_.back() = vertices;
    return offsets;
  }

  void set_positions(anic_source_mesh* mesh, uint32_t frames) {
    const bool wide = one_in(8);
    mesh->scalar = wide ? ANIC_SCALAR_FLOAT64 : ANIC_SCALAR_FLOAT32;
    std::vector<float>& floats = floats_.emplace_back();
    const uint32_t kind = below(8);
    const float size = kind == 7 ? odd() : 1, far = kind == 6 ? odd() : 0;
    const uint32_t seed = below(256);
    for (uint32_t f = 0; f < frames; ++f) {
      for (uint32_t i = 0; i < 3 * mesh->vertex_count; ++i) {
        const auto at = static_cast<float>((i * 7 + seed) % 19),
                   time = static_cast<float>((f * (1 + seed % 5) + i % 3) % 11);
        float x = kind == 0 ? at : kind == 1 ? time : at + 0.1F * time;
        if (kind >= 4 && kind < 6 && one_in(kind == 4 ? 2 : 12))
          x = static_cast<float>(script_.byte());
        floats.push_back(size * x + far);
      }
    }
    while (one_in(8))
      floats[script_.below(static_cast<uint32_t>(floats.size()))] = odd();
    mesh->positions = floats.data();
    if (wide) {
      std::vector<double>& doubles = doubles_.emplace_back(floats.begin(), floats.end());
      mesh->positions = doubles.data();
    } else if (one_in(8)) {
      mesh->positions = nullptr;
      mesh->user = &floats;
      static thread_local uint32_t count;
      count = 3 * mesh->vertex_count;
      mesh->read = [](void* user, uint32_t frame, float* positions) {
        const auto& all = *static_cast<const std::vector<float>*>(user);
        const size_t from = size_t{count} * frame;
        if (from + count > all.size())
          return 1;
        std::copy_n(all.data() + from, count, positions);
        return 0;
      };
    }
  }

  anic_status add_attribute(const anic_source_mesh& mesh, uint32_t frames) {
    anic_source_attribute a = ANIC_INIT(anic_source_attribute);
    a.name = text();
    a.kind = static_cast<anic_attribute_kind>(below(7));
    a.domain = static_cast<anic_domain>(below(3));
    a.components = a.kind >= ANIC_ATTRIBUTE_MATERIAL ? 0 : below(5) + 12 * one_in(8);
    a.frames = one_in(2) ? frames : 1;
    const size_t elements = a.domain == ANIC_DOMAIN_VERTICES  ? mesh.vertex_count
                            : a.domain == ANIC_DOMAIN_CORNERS ? corners_.size()
                                                              : mesh.polygon_count;
    std::vector<float> values(elements * a.components * a.frames + 1);
    for (float& x : values)
      x = one_in(64) ? odd() : 0.1F * static_cast<float>(below(11));
    a.values = values.data();
    std::vector<uint32_t> labels(elements + 1);
    for (uint32_t& label : labels)
      label = below(one_in(64) ? 5 : 3);
    a.labels = labels.data();
    const char* const names[] = {"one", "two"};
    a.label_names = names;
    a.label_count = 2;
    anic_material look = ANIC_INIT(anic_material);
    look.metallic = one_in(4) ? odd() : 0;
    look.base_colour_texture = text();
    const anic_material* const looks[] = {&look, nullptr};
    a.materials = one_in(2) ? looks : nullptr;
    a.unit = text();
    a.bound = static_cast<anic_bound>(below(4));
    a.error = one_in(4) ? static_cast<double>(odd()) : 0.01 * below(100);
    return anic_add_source_attribute(encoder_, static_cast<uint32_t>(vertices_.size() - 1), &a);
  }

  void choose(anic_encode_options* options) {
    constexpr double kValues[] = {1e-6, 1e-3, 0.01, 0.1, 1, 5, 1000, 0};
    options->goal = static_cast<anic_goal>(below(8));
    if (options->goal != ANIC_GOAL_DEFAULT)
      options->goal_value = one_in(16) ? static_cast<double>(odd()) : kValues[below(7 + one_in(8))];
    if (options->goal == ANIC_GOAL_MAX_ERROR && one_in(2))
      options->flags = ANIC_ENCODE_PERCENT;
    options->max_error = one_in(8) ? kValues[below(8)] : 0;
    for (const uint64_t flag :
         {ANIC_ENCODE_CAP_PERCENT, ANIC_ENCODE_ERROR_PERCENT, ANIC_ENCODE_NO_ATTRIBUTES,
          ANIC_ENCODE_ROOT_MOTION, ANIC_ENCODE_SMALLEST})
      options->flags |= one_in(8) ? flag : 0;
    if (one_in(8)) {
      options->flags = ANIC_ENCODE_LOSSLESS;
      options->goal = ANIC_GOAL_DEFAULT;
      options->goal_value = options->max_error = 0;
    }
    options->order = static_cast<anic_order>(below(3));
    options->max_bytes = one_in(4) ? 65536 * (1 + below(256)) : 0;
    options->threads = one_in(4) ? 2 : 1;
    options->basis = static_cast<anic_basis_choice>(below(4));
    const bool by_keyframes = options->basis == ANIC_CHOOSE_KEYFRAMES || one_in(16);
    options->keyframes = by_keyframes && one_in(4) ? below(12) : 0;
    options->selection = static_cast<anic_selection>(below(3));
    options->interpolation = static_cast<anic_interpolation>(by_keyframes ? below(4) : 0);
    options->keyframe_coder = static_cast<anic_keyframe_coder>(below(3));
    options->massage = one_in(8) ? static_cast<anic_massage>(below(3)) : ANIC_MASSAGE_OFF;
    options->uv_bits = one_in(8) ? below(20) : 0;
    options->colour_bits = one_in(8) ? below(20) : 0;
    options->massage_strength = one_in(8) ? static_cast<double>(odd()) : 0;
    options->massage_tolerance = one_in(8) ? static_cast<double>(odd()) : 0;
    options->attribute_error = one_in(8) ? static_cast<double>(odd()) : 0;
    options->normal_error = one_in(8) ? below(200) : 0;
    options->metadata = one_in(8) ? (one_in(2) ? "{\"a\": [1]}" : text()) : nullptr;
    if (one_in(16)) {
      left_ = below(256);
      options->progress.user = &left_;
      options->progress.report = [](void* user, const char*, double) {
        return (*static_cast<uint32_t*>(user))-- == 0 ? 1 : 0;
      };
    }
    if (one_in(16)) {
      options->writer.user = &left_;
      options->writer.write = [](void* user, const void*, size_t) {
        return *static_cast<uint32_t*>(user) % 2 == 0 ? 0 : 1;
      };
    }
  }

  void open(const anic_encoding& result, const anic_encode_options& options) const {
    anic_asset* asset = nullptr;
    require(anic_open_asset(result.file, result.size, nullptr, &asset, nullptr) == ANIC_OK);
    require(anic_verify_asset(asset) == ANIC_OK);
    anic_asset_info info = ANIC_INIT(anic_asset_info);
    anic_get_asset_info(asset, &info);
    require(info.frame_count == frames_ && info.mesh_count == vertices_.size());
    for (uint32_t m = 0; m < info.mesh_count; ++m) {
      anic_mesh mesh = ANIC_INIT(anic_mesh);
      require(anic_get_mesh(asset, m, &mesh) == ANIC_OK && mesh.vertex_count == vertices_[m]);
    }
    if (plain_ && (options.flags & ANIC_ENCODE_LOSSLESS) && options.order == ANIC_ORDER_VERTICES &&
        info.mesh_count == 1)
      compare(asset);
    anic_close_asset(asset);
  }

  /// A lossless file has the bits of all frames.
  void compare(const anic_asset* asset) const {
    std::vector<float> shown(size_t{3} * vertices_[0]);
    for (uint32_t f = 0; f < frames_; ++f) {
      anic_output out = ANIC_INIT(anic_output);
      out.data = shown.data();
      out.size = sizeof(float) * shown.size();
      const float* source = floats_[0].data() + f * shown.size();
      if ((f + 1) * shown.size() <= floats_[0].size() &&
          anic_write_frames(asset, 0, &f, 1, 0, vertices_[0], &out) == ANIC_OK)
        require(std::memcmp(shown.data(), source, out.size) == 0);
    }
  }

  Script script_;
  anic_encoder* encoder_ = nullptr;
  bool plain_ = true;  // positions come back as they were given
  uint32_t frames_ = 0, left_ = 0;
  std::vector<uint32_t> vertices_;  // of each mesh
  std::vector<uint32_t> corners_;   // of the last one
  std::deque<std::vector<float>> floats_;
  std::deque<std::vector<double>> doubles_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Encoding({data, size}).run();
  return 0;
}
