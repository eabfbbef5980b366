// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "frames_texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace anicodec::bench {
namespace {

constexpr uint32_t kStateFloats = 16;

const char* const kVertex = R"(
uniform highp sampler2D frames, state;
uniform int width, rows, instance;
uniform mat4 view;
out vec3 shown, place;
flat out float level;
void main() {
  int row = gl_InstanceID + instance;
  vec4 time = texelFetch(state, ivec2(3, row), 0);
  ivec2 at = ivec2(gl_VertexID % width, gl_VertexID / width);
  vec3 a = texelFetch(frames, at + ivec2(0, int(time.x) * rows), 0).xyz;
  vec3 b = texelFetch(frames, at + ivec2(0, int(time.y) * rows), 0).xyz;
  shown = mix(a, b, time.z);
  vec4 p = vec4(shown, 1.0);
  place = vec3(dot(texelFetch(state, ivec2(0, row), 0), p), dot(texelFetch(state, ivec2(1, row), 0), p),
               dot(texelFetch(state, ivec2(2, row), 0), p));
  level = 0.0;
  gl_Position = view * vec4(place, 1.0);
}
)";

/// Positions of all frames of clip 0 as float16, in rows of `width` texels, `rows` of them a frame.
std::vector<uint16_t> make_frames(const Model& model, const anic_clip& clip, uint32_t width,
                                  uint32_t rows) {
  const size_t frame_texels = size_t{width} * rows;
  std::vector<uint16_t> texels(4 * frame_texels * clip.frame_count);
  anic_context* context = nullptr;
  check(anic_create_context(model.asset, nullptr, &context), "context");
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    anic_output out = ANIC_INIT(anic_output);
    out.data = texels.data() + 4 * frame_texels * f;
    out.size = 8 * size_t{model.vertices};
    out.stride = 8;
    out.format = ANIC_FORMAT_FLOAT16X4;
    check(anic_seek_frame(context, clip.first_frame + f), "frame");
    check(anic_write_positions(context, model.mesh, ANIC_WHEN_CURRENT, 0, model.vertices, &out),
          "positions");
  }
  anic_destroy_context(context);
  return texels;
}

}  // namespace

FramesTexture::FramesTexture(const Model& model, uint32_t instances) : model_(&model) {
  anic_clip clip = ANIC_INIT(anic_clip);
  check(anic_get_clip(model.asset, 0, &clip), "clip");
  if (clip.uneven)
    fail("vertex-animation texture", "the frames of the clip are not even");
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  frames_ = clip.frame_count;
  rate_ = static_cast<double>(clip.rate_numerator) / clip.rate_denominator;
  loop_ = clip.loop_duration;
  const auto size = static_cast<uint32_t>(largest);
  rows_ = (model.vertices + size - 1) / size;
  width_ = (model.vertices + rows_ - 1) / rows_;
  if (uint64_t{rows_} * frames_ > size)
    fail("vertex-animation texture", "the frames of the clip are too many for one");
  const std::vector<uint16_t> texels = make_frames(model, clip, width_, rows_);
  texture_bytes_ = sizeof(uint16_t) * texels.size();
  texture_ =
      make_texture(GL_RGBA16F, static_cast<GLsizei>(width_), static_cast<GLsizei>(rows_ * frames_),
                   GL_RGBA, GL_HALF_FLOAT, texels.data());
  staged_.reserve(size_t{kStateFloats} * instances);
  state_ = make_texture(GL_RGBA32F, kStateFloats / 4, static_cast<GLsizei>(instances), GL_RGBA,
                        GL_FLOAT, nullptr);
  program_ = make_lit_program(0, kVertex);
}

void FramesTexture::stage(double seconds, const float map[12]) {
  const double t = loop_ > 0 ? seconds - loop_ * std::floor(seconds / loop_) : 0;
  const double at = t * rate_, first = std::floor(at);
  const auto frame = static_cast<uint32_t>(first) % frames_;
  staged_.insert(staged_.end(), map, map + 12);
  staged_.push_back(static_cast<float>(frame));
  staged_.push_back(static_cast<float>((frame + 1) % frames_));
  staged_.push_back(static_cast<float>(at - first));
  staged_.push_back(0);
}

void FramesTexture::upload() const {
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, state_);
  gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kStateFloats / 4,
                   static_cast<GLsizei>(staged_.size() / kStateFloats), GL_RGBA, GL_FLOAT,
                   staged_.data());
}

void FramesTexture::bind() const {
  gl.UseProgram(program_);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.Uniform1i(gl.GetUniformLocation(program_, "frames"), 0);
  gl.ActiveTexture(GL_TEXTURE0 + 1);
  gl.BindTexture(GL_TEXTURE_2D, state_);
  gl.Uniform1i(gl.GetUniformLocation(program_, "state"), 1);
  gl.Uniform1i(gl.GetUniformLocation(program_, "width"), static_cast<GLint>(width_));
  gl.Uniform1i(gl.GetUniformLocation(program_, "rows"), static_cast<GLint>(rows_));
  gl.Uniform1i(gl.GetUniformLocation(program_, "instance"), 0);
}

void FramesTexture::draw(const float view[16], const float colour[3]) const {
  bind();
  gl.UniformMatrix4fv(gl.GetUniformLocation(program_, "view"), 1, GL_FALSE, view);
  gl.Uniform3f(gl.GetUniformLocation(program_, "colour"), colour[0], colour[1], colour[2]);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, model_->indices);
  gl.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(3 * model_->triangles),
                           GL_UNSIGNED_INT, nullptr,
                           static_cast<GLsizei>(staged_.size() / kStateFloats));
}

void FramesTexture::draw_points() const {
  bind();
  gl.BeginTransformFeedback(GL_POINTS);
  gl.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(model_->vertices));
  gl.EndTransformFeedback();
}

}  // namespace anicodec::bench
