/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 */
#include "gl_sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct gl_functions gl;

const char* sample = "";

void fail(const char* what, const char* why) {
  fprintf(stderr, "%s: %s: %s\n", sample, what, why);
  exit(1);
}

void check(anic_status status, const char* what) {
  if (status != ANIC_OK)
    fail(what, anic_get_status_text(status));
}

void* room(size_t size) {
  void* memory = calloc(size > 0 ? size : 1, 1);
  if (memory == NULL)
    fail("memory", "there is none");
  return memory;
}

anic_asset* open_file(const char* path, double* seconds) {
  FILE* file = fopen(path, "rb");
  if (file == NULL)
    fail(path, "cannot be read");
  fseek(file, 0, SEEK_END);
  const size_t size = (size_t)ftell(file);
  void* bytes = room(size);
  rewind(file);
  if (fread(bytes, 1, size, file) != size)
    fail(path, "cannot be read");
  fclose(file);
  anic_options options = ANIC_INIT(anic_options);
  options.flags = ANIC_OPEN_BOUNDS;
  anic_asset* asset = NULL;
  clock_t begin = clock();
  check(anic_open_asset(bytes, size, &options, &asset, NULL), path);
  *seconds += processor_milliseconds(&begin) / 1000;
  free(bytes);
  return asset;
}

void start_gl(void* (*find)(const char* name), int width, int height) {
#define FIND(type, name)                \
  *(void**)&gl.name = find("gl" #name); \
  if (gl.name == NULL)                  \
    fail("OpenGL has no function", "gl" #name);
  GL_FUNCTIONS(FIND)
  GLuint vertex_array = 0;
  gl.GenVertexArrays(1, &vertex_array);
  gl.BindVertexArray(vertex_array);
  gl.Viewport(0, 0, width, height);
  gl.Enable(GL_DEPTH_TEST);
  gl.ClearColor(0.85f, 0.9f, 0.95f, 1);
}

static GLuint compile(GLenum kind, int embedded, const char* text) {
  const char* head = embedded ? "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                              : "#version 330 core\n";
  const char* sources[2] = {head, text};
  const GLuint shader = gl.CreateShader(kind);
  GLint done = 0;
  gl.ShaderSource(shader, 2, sources, NULL);
  gl.CompileShader(shader);
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (!done) {
    char log[2000] = "";
    gl.GetShaderInfoLog(shader, sizeof log, NULL, log);
    fail("shader", log);
  }
  return shader;
}

GLuint make_program(int embedded, const char* vertex, const char* fragment, const char* captured) {
  const GLuint program = gl.CreateProgram();
  GLint done = 0;
  gl.AttachShader(program, compile(GL_VERTEX_SHADER, embedded, vertex));
  gl.AttachShader(program, compile(GL_FRAGMENT_SHADER, embedded, fragment));
  gl.TransformFeedbackVaryings(program, 1, &captured, GL_INTERLEAVED_ATTRIBS);
  gl.LinkProgram(program);
  gl.GetProgramiv(program, GL_LINK_STATUS, &done);
  if (!done)
    fail("program", "does not link");
  return program;
}

GLuint make_texture(GLint format, GLsizei width, GLsizei height, GLenum layout, GLenum type,
                    const void* data) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, layout, type, data);
  return texture;
}

void look(const float* eye, const float* at, float aspect, float* out) {
  float f[3], s[3], u[3], length = 0;
  for (int c = 0; c < 3; ++c)
    f[c] = at[c] - eye[c];
  length = sqrtf(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  for (int c = 0; c < 3; ++c)
    f[c] /= length;
  length = sqrtf(f[0] * f[0] + f[2] * f[2]);
  s[0] = -f[2] / length;
  s[1] = 0;
  s[2] = f[0] / length;
  u[0] = s[1] * f[2] - s[2] * f[1];
  u[1] = s[2] * f[0] - s[0] * f[2];
  u[2] = s[0] * f[1] - s[1] * f[0];
  const float focal = 1.8f, near = 0.1f, far = 200;
  const float* axes[3] = {s, u, f};
  const float scale[3] = {focal / aspect, focal, (far + near) / (far - near)};
  for (int r = 0; r < 3; ++r) {
    float at_eye = 0;
    for (int c = 0; c < 3; ++c) {
      out[4 * c + r] = scale[r] * axes[r][c];
      at_eye += axes[r][c] * eye[c];
    }
    out[12 + r] = -scale[r] * at_eye;
  }
  out[14] -= 2 * far * near / (far - near);
  out[15] = 0;
  for (int c = 0; c < 3; ++c) {
    out[4 * c + 3] = f[c];
    out[15] -= f[c] * eye[c];
  }
}

void save_picture(const char* path, int width, int height) {
  unsigned char* pixels = room(4 * (size_t)width * (size_t)height);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  FILE* file = fopen(path, "wb");
  if (file == NULL)
    fail(path, "cannot be written");
  fprintf(file, "P6\n%d %d\n255\n", width, height);
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x)
      fwrite(pixels + 4 * ((size_t)y * (size_t)width + (size_t)x), 1, 3, file);
  }
  fclose(file);
  free(pixels);
}

double processor_milliseconds(clock_t* since) {
  const clock_t now = clock();
  const double passed = 1000.0 * (double)(now - *since) / CLOCKS_PER_SEC;
  *since = now;
  return passed;
}
