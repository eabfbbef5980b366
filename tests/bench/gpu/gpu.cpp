// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A crowd of one clip on the graphics card, from the textures of its basis and from a vertex-animation texture of float16, in
// turns. Both draw the same instances at the same times by one call.
#include "../stopwatch.h"
#include "frames_texture.h"
#include "headless_gl.h"
#include "sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace anicodec::bench {
namespace {

constexpr int kSkipped = 77;

struct Options {
  uint32_t instances = 1000;
  double seconds = 10;
  int width = 960;
  bool vulkan = false;
  std::string picture;
  std::vector<const char*> files;
};

/// One of the two ways: what a frame costs in it.
struct Way {
  Way(const char* its_name, uint64_t bytes) : name(its_name), texture_bytes(bytes) {}

  const char* name;
  uint64_t texture_bytes;
  std::function<void(double seconds)> stage;  ///< all instances
  std::function<uint64_t()> upload;           ///< bytes
  std::function<void()> draw;
  std::function<uint64_t()>
      read;  ///< bytes that the vertex shader reads for one pass over all vertices
  std::function<void(uint32_t instance, double seconds)> feed_back;
  std::vector<double> staging, processor,
      whole;  ///< seconds of each frame: of this thread, of all threads, of the clock
  uint64_t uploaded = 0;
  double deviation = 0;  ///< in diagonals of the box
};

/// A clip, its instances, and their places in a grid, each one unit high.
class Crowd {
 public:
  Crowd(const char* file, const Options& options)
      : options_(options), program_(make_clip_program(0)) {
    double opening = 0;
    load_model(&model_, open_file(file, &opening), 0, options.instances);
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(options.instances)));
    float size = 0;
    for (int c = 0; c < 3; ++c) {
      const float edge = model_.box.max[c] - model_.box.min[c];
      size = std::max(size, edge);
      diagonal_ = std::hypot(diagonal_, double{edge});
    }
    const float scale = size > 0 ? 1 / size : 1;
    const bool z_up = model_.info.up == ANIC_UP_Z;
    for (uint32_t i = 0; i < options.instances; ++i) {
      Instance instance{};
      const float place[3] = {1.2F * (static_cast<float>(i % side) - static_cast<float>(side) / 2),
                              0, -1.2F * static_cast<float>(i / side)};
      const int from[3] = {0, z_up ? 2 : 1, z_up ? 1 : 2};
      for (int r = 0; r < 3; ++r) {
        const float to = r == 2 && z_up ? -scale : scale;
        const auto c = from[r];
        instance.map[4 * r + c] = to;
        instance.map[4 * r + 3] = place[r] - to * (model_.box.min[c] + model_.box.max[c]) / 2;
      }
      instance.start = 0.037 * i;
      check(anic_create_context(model_.asset, nullptr, &instance.context), "context");
      instances_.push_back(instance);
    }
    const float depth = 1.2F * static_cast<float>(side);
    const float eye[3] = {0.13F * depth, 2.5F, 3}, at[3] = {0, 0.5F, -0.5F * depth};
    look(eye, at, 16.0F / 9, view_);
  }

  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  ~Crowd() {
    for (const Instance& instance : instances_)
      anic_destroy_context(instance.context);
    close_model(&model_);
  }

  /// Times both ways in turns, for `seconds` at least, and three frames of each.
  void measure() {
    FramesTexture frames(model_, options_.instances);
    Way ways[] = {by_basis(), by_frames(&frames)};
    for (Way& way : ways)
      compare(&way);
    Stopwatch since(CLOCK_MONOTONIC);
    for (int f = -1; f < 3 || since.seconds() < options_.seconds;
         ++f) {  // the first compiles, and does not count
      for (Way& way : ways)
        draw_frame(&way, f);
    }
    for (const Way& way : ways)
      print(way);
  }

 private:
  struct Instance {
    anic_context* context;
    double start;
    float map[12];
  };

  Way by_basis() {
    Way way("basis", model_.texture_bytes);
    way.stage = [this](double seconds) {
      model_.staged_count = 0;
      for (const Instance& instance : instances_)
        stage(instance, seconds);
    };
    way.upload = [this] {
      upload_states(&model_);
      return uint64_t{16} * model_.state_texels * model_.staged_count;
    };
    way.draw = [this] {
      gl.UseProgram(program_);
      gl.UniformMatrix4fv(gl.GetUniformLocation(program_, "view"), 1, GL_FALSE, view_);
      draw_model(program_, &model_, kColour);
    };
    way.read = [this] { return bytes_read(); };
    way.feed_back = [this](uint32_t i, double seconds) {
      model_.staged_count = 0;
      stage(instances_[i], seconds);
      upload_states(&model_);
      gl.UseProgram(program_);
      bind_model(program_, &model_);
      gl.Uniform1i(gl.GetUniformLocation(program_, "instance"), 0);
      gl.BeginTransformFeedback(GL_POINTS);
      gl.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(model_.vertices));
      gl.EndTransformFeedback();
    };
    return way;
  }

  Way by_frames(FramesTexture* frames) {
    Way way("float16 frames", frames->texture_bytes());
    way.stage = [this, frames](double seconds) {
      frames->clear();
      for (const Instance& instance : instances_)
        frames->stage(seconds + instance.start, instance.map);
    };
    way.upload = [frames] {
      frames->upload();
      return frames->staged_bytes();
    };
    way.draw = [this, frames] { frames->draw(view_, kColour); };
    way.read = [this] {
      return uint64_t{16} * model_.vertices * options_.instances;
    };  // two texels
    way.feed_back = [this, frames](uint32_t i, double seconds) {
      frames->clear();
      frames->stage(seconds + instances_[i].start, instances_[i].map);
      frames->upload();
      frames->draw_points();
    };
    return way;
  }

  void stage(const Instance& instance, double seconds) {
    uint32_t corrected = 0;
    check(anic_seek_time(instance.context, seconds + instance.start, ANIC_SAMPLE_LINEAR,
                         ANIC_WRAP_LOOP),
          "time");
    if (!stage_instance(&model_, instance.context, instance.map, 0, &corrected))
      fail("clip", "the mesh is not there at all times");
  }

  /// Texels of the basis for the parts that all instances show.
  uint64_t bytes_read() const {
    uint64_t bytes = 0;
    for (const Instance& instance : instances_) {
      anic_parts shown = ANIC_INIT(anic_parts);
      check(anic_get_parts(instance.context, model_.mesh, ANIC_WHEN_CURRENT, &shown), "parts");
      for (uint32_t p = 0; p < shown.count; ++p) {
        anic_basis basis = ANIC_INIT(anic_basis);
        const uint32_t segment = shown.parts[p].segment;
        check(anic_get_basis(model_.asset, segment, &basis), "basis");
        const uint32_t layers = basis.channels == 3 ? 3 : 1;
        const uint32_t wide = (basis.wide_components + 3) / 4;
        const uint32_t narrow = (basis.components - basis.wide_components + 3) / 4;
        bytes += uint64_t{model_.vertices} *
                 (16 * model_.has_pose[segment] + layers * (16 * wide + 8 * narrow));
      }
    }
    return bytes;
  }

  /// Positions of a few instances at a few times against those of the CPU.
  void compare(Way* way) {
    const size_t size = 3 * sizeof(float) * model_.vertices;
    GLuint buffer = 0;
    gl.GenBuffers(1, &buffer);
    gl.Enable(GL_RASTERIZER_DISCARD);
    std::vector<float> expected(size_t{3} * model_.vertices);
    const uint32_t count = std::min(options_.instances, 8U);
    for (uint32_t i = 0; i < 3 * count; ++i) {
      const Instance& instance = instances_[i % count * (options_.instances / count)];
      const double seconds = 0.31 * (i / count);
      gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
      gl.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, static_cast<GLsizeiptr>(size), nullptr,
                    GL_STREAM_READ);
      gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
      way->feed_back(static_cast<uint32_t>(&instance - instances_.data()), seconds);
      anic_output out = ANIC_INIT(anic_output);
      out.data = expected.data();
      out.size = size;
      check(anic_seek_time(instance.context, seconds + instance.start, ANIC_SAMPLE_LINEAR,
                           ANIC_WRAP_LOOP),
            "time");
      check(anic_write_positions(instance.context, model_.mesh, ANIC_WHEN_CURRENT, 0,
                                 model_.vertices, &out),
            "positions");
      const auto* made = static_cast<const float*>(gl.MapBufferRange(
          GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLsizeiptr>(size), GL_MAP_READ_BIT));
      if (made == nullptr)
        fail("OpenGL", "positions cannot be read back");
      for (size_t v = 0; v < model_.vertices; ++v) {
        double square = 0;
        for (size_t c = 0; c < 3; ++c)
          square += std::pow(double{made[3 * v + c]} - double{expected[3 * v + c]}, 2);
        way->deviation = std::max(way->deviation, std::sqrt(square) / diagonal_);
      }
      gl.UnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER);
    }
    gl.Disable(GL_RASTERIZER_DISCARD);
  }

  /// Counts unless f is below 0.
  void draw_frame(Way* way, int f) {
    const Stopwatch whole(CLOCK_MONOTONIC), processor(CLOCK_PROCESS_CPUTIME_ID),
        staging(CLOCK_THREAD_CPUTIME_ID);
    way->stage(std::max(f, 0) / 30.0);
    const double staged = staging.seconds();
    way->uploaded = way->upload();
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    way->draw();
    gl.Finish();
    if (f >= 0) {
      way->staging.push_back(staged);
      way->processor.push_back(processor.seconds());
      way->whole.push_back(whole.seconds());
    }
    if (f == 0 && !options_.picture.empty())
      save_picture(
          (options_.picture + "." + (way->name[0] == 'b' ? "basis" : "frames") + ".ppm").c_str(),
          options_.width, options_.width * 9 / 16);
  }

  void print(const Way& way) const {
    const double frame = median(way.whole);
    std::printf("| %u | %s | %llu | %llu | %.3g | %.3f | %.1f | %.1f | %.3g | %.2g |\n",
                model_.vertices, way.name, static_cast<unsigned long long>(way.texture_bytes),
                static_cast<unsigned long long>(way.uploaded),
                static_cast<double>(way.read()) / 1e6, 1000 * median(way.staging),
                1000 * median(way.processor), 1000 * frame, 1 / frame, 100 * way.deviation);
  }

  static constexpr float kColour[3] = {0.9F, 0.6F, 0.4F};
  const Options& options_;
  Model model_{};
  GLuint program_;
  std::vector<Instance> instances_;
  double diagonal_ = 0;
  float view_[16] = {};
};

int print_usage() {
  std::fputs(
      "usage: anicodec_gpu_bench [options] CLIP.anic...\n"
      "  --instances N   [1000]\n"
      "  --seconds S     for the frames of a clip, both ways [10]\n"
      "  --size N        width of the picture [960]\n"
      "  --picture NAME  saves the first picture of each way as NAME.basis.ppm, NAME.frames.ppm\n"
      "  --vulkan        OpenGL over Vulkan, by Mesa's zink\n",
      stderr);
  return 1;
}

int run(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--vulkan")
      options.vulkan = true;
    else if (name == "--instances" && i + 1 < argc)
      options.instances = static_cast<uint32_t>(std::strtoul(argv[++i], nullptr, 10));
    else if (name == "--seconds" && i + 1 < argc)
      options.seconds = std::strtod(argv[++i], nullptr);
    else if (name == "--size" && i + 1 < argc)
      options.width = static_cast<int>(std::strtol(argv[++i], nullptr, 10));
    else if (name == "--picture" && i + 1 < argc)
      options.picture = argv[++i];
    else if (name[0] == '-')
      return print_usage();
    else
      options.files.push_back(argv[i]);
  }
  if (options.files.empty() || options.instances == 0 || options.width < 16)
    return print_usage();
  sample = "anicodec_gpu_bench";
  const std::string why = start_headless_gl(options.vulkan, options.width, options.width * 9 / 16);
  if (!why.empty()) {
    std::printf("skipped: %s\n", why.c_str());
    return kSkipped;
  }
  std::printf("%s%s\n%u instances, a picture of %d x %d, one draw call\n\n", describe_gl().c_str(),
              is_software_gl() ? ": software, no graphics card" : "", options.instances,
              options.width, options.width * 9 / 16);
  std::puts(
      "| vertices | way | uploaded once, bytes | a frame, bytes | read by the shader, MB a frame | "
      "seeking, CPU ms a frame | all threads, CPU ms "
      "a frame | ms a frame | frames/s | largest deviation, % of the diagonal |\n"
      "|---|---|---|---|---|---|---|---|---|---|");
  for (const char* file : options.files)
    Crowd(file, options).measure();
  if (gl.GetError() != GL_NO_ERROR)
    fail("OpenGL", "an error");
  return 0;
}

}  // namespace
}  // namespace anicodec::bench

int main(int argc, char** argv) {
  return anicodec::bench::run(argc, argv);
}
