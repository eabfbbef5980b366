/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 */
#include "card_clip.h"

#include <stdlib.h>
#include <string.h>

enum { HEAD_TEXELS = 4 };

static const char VERTEX[] =
    "uniform highp isampler2D narrow, wide;\n"
    "uniform highp sampler2D pose, state;\n"
    "uniform int width, rows, instance;\n"
    "uniform mat4 view;\n"
    "out vec3 shown, place;\n"
    "flat out float level;\n"
    "int row;\n"
    "vec4 of(int i) { return texelFetch(state, ivec2(i, row), 0); }\n"
    "#define ANIC_STATE(i) of(i)\n"
#include "anicodec_play.inc" /* sdk/shaders/anicodec_play.glsl */
    "void main() {\n"
    "  row = gl_InstanceID + instance;\n"
    "  int at = 4, parts = int(of(3).x);\n"
    "  vec3 sum = vec3(0.0);\n"
    "  for (int p = 0; p < parts; ++p) {\n"
    "    vec4 head = of(at);\n"     /* first rows: narrow, wide, pose; length */
    "    vec4 kind = of(at + 1);\n" /* vectors?, texels of the wide weights, of a region's state */
    "    AnicSegment s = AnicSegment(int(head.x), int(head.y), int(head.z), width, rows,\n"
    "                                kind.x > 0.5, int(kind.y), int(kind.z));\n"
    "    sum += anic_part(narrow, wide, pose, s, gl_VertexID, at + 2);\n"
    "    at += int(head.w);\n"
    "  }\n"
    "  shown = sum;\n"
    "  place = anic_moved(0, sum);\n"
    "  level = of(3).y;\n"
    "  gl_Position = view * vec4(place, 1.0);\n"
    "}\n";

static const char FRAGMENT[] =
    "in vec3 shown, place;\n"
    "flat in float level;\n"
    "uniform vec3 colour;\n"
    "out vec4 result;\n"
    "void main() {\n"
    "  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));\n"
    "  float light = 0.3 + 0.7 * max(dot(normal, normalize(vec3(0.4, 0.8, 0.5))), 0.0);\n"
    "  result = vec4(light * mix(colour, vec3(0.6), 0.3 * level), 1.0);\n"
    "}\n";

GLuint make_lit_program(int embedded, const char* vertex) {
  return make_program(embedded, vertex, FRAGMENT, "shown");
}

GLuint make_clip_program(int embedded) {
  return make_lit_program(embedded, VERTEX);
}

/* Writes one texture of all segments of a mesh, below one another. Returns its bytes. */
static uint64_t load_texture(Model* model, anic_texture kind, uint32_t max_size, GLuint* texture) {
  static const GLint formats[] = {GL_RGBA32F, GL_RGBA32I, GL_RGBA16I};
  static const GLenum layouts[] = {GL_RGBA, GL_RGBA_INTEGER, GL_RGBA_INTEGER};
  static const GLenum types[] = {GL_FLOAT, GL_INT, GL_SHORT};
  const size_t row = (kind == ANIC_TEXTURE_NARROW ? 8 : 16) * (size_t)model->width;
  uint32_t height = 0;
  unsigned char* data = NULL;
  for (int pass = 0; pass < 2; ++pass) { /* how high it is, then what is in it */
    if (pass == 1)
      data = room(row * (height > 0 ? height : 1));
    height = 0;
    for (uint32_t s = 0; s < model->info.segment_count; ++s) {
      anic_basis basis = ANIC_INIT(anic_basis);
      anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
      check(anic_get_basis(model->asset, s, &basis), "basis");
      if (basis.mesh != model->mesh || basis.target != ANIC_TARGET_POSITIONS)
        continue;
      check(anic_get_texture_layout(model->asset, s, max_size, &layout), "textures");
      const uint32_t heights[] = {layout.pose_height, layout.wide_height, layout.narrow_height};
      model->first[s][kind] = height;
      model->has_pose[s] = layout.pose_height > 0;
      if (pass == 1)
        check(anic_write_texture(model->asset, s, kind, &layout, 0, data + row * height,
                                 row * heights[kind]),
              "textures");
      height += heights[kind];
    }
  }
  if (height > max_size)
    fail("textures", "the segments of a clip are too many for one");
  *texture = make_texture(formats[kind], (GLsizei)model->width, (GLsizei)(height > 0 ? height : 1),
                          layouts[kind], types[kind], data);
  free(data);
  return row * height;
}

void load_model(Model* model, anic_asset* asset, uint32_t mesh, uint32_t instances) {
  GLint size = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &size);
  const uint32_t max_size = (uint32_t)size;
  anic_mesh shape = ANIC_INIT(anic_mesh);
  model->asset = asset;
  model->mesh = mesh;
  model->info = ANIC_INIT(anic_asset_info);
  check(anic_get_asset_info(asset, &model->info), "asset");
  check(anic_get_mesh(asset, mesh, &shape), "mesh");
  check(anic_get_clip_bounds(asset, mesh, &model->box), "bounds");
  model->vertices = shape.vertex_count;
  model->triangles = shape.triangle_count;
  model->first = room(sizeof *model->first * model->info.segment_count);
  model->has_pose = room(model->info.segment_count);
  uint32_t parts = 0, largest = 0;
  for (uint32_t s = 0; s < model->info.segment_count; ++s) {
    anic_basis basis = ANIC_INIT(anic_basis);
    anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
    check(anic_get_basis(asset, s, &basis), "basis");
    if (basis.mesh != mesh || basis.target != ANIC_TARGET_POSITIONS)
      continue;
    if (basis.reconstruction != ANIC_RECONSTRUCTION_LINEAR)
      fail("clip", "a graphics card does not make geometry interpolation");
    check(anic_get_texture_layout(asset, s, max_size, &layout), "textures");
    model->width = layout.width;
    model->rows = layout.rows;
    if (layout.state_floats / 4 > largest)
      largest = layout.state_floats / 4;
    parts += parts < ANIC_MAX_PARTS;
  }
  model->state_texels = HEAD_TEXELS + parts * (2 + largest);
  for (int kind = ANIC_TEXTURE_POSE; kind <= ANIC_TEXTURE_NARROW; ++kind) {
    GLuint* textures[] = {&model->pose, &model->wide, &model->narrow};
    model->texture_bytes += load_texture(model, (anic_texture)kind, max_size, textures[kind]);
  }
  model->staged = room(16 * (size_t)model->state_texels * instances);
  model->state = make_texture(GL_RGBA32F, (GLsizei)model->state_texels, (GLsizei)instances, GL_RGBA,
                              GL_FLOAT, model->staged);
  uint32_t* indices = room(12 * (size_t)model->triangles);
  check(anic_write_indices(asset, mesh, 4, indices, 12 * (size_t)model->triangles), "indices");
  gl.GenBuffers(1, &model->indices);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, model->indices);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, 12 * (GLsizeiptr)model->triangles, indices,
                GL_STATIC_DRAW);
  free(indices);
  /* A texel of four 16-bit numbers for each vertex and frame. */
  model->vertex_animation_bytes = (uint64_t)8 * model->vertices * model->info.frame_count;
}

int stage_instance(Model* model, const anic_context* context, const float map[12], int level,
                   uint32_t* corrected) {
  anic_parts shown = ANIC_INIT(anic_parts);
  if (anic_get_parts(context, model->mesh, ANIC_WHEN_CURRENT, &shown) != ANIC_OK)
    return 0;
  float* const row = model->staged + 4 * (size_t)model->state_texels * model->staged_count++;
  memcpy(row, map, 12 * sizeof(float));
  row[12] = (float)shown.count;
  row[13] = (float)level;
  float* to = row + 4 * HEAD_TEXELS;
  for (uint32_t p = 0; p < shown.count; ++p) {
    const anic_part* part = &shown.parts[p];
    anic_basis basis = ANIC_INIT(anic_basis);
    anic_get_basis(model->asset, part->segment, &basis);
    const int vectors = basis.channels == 3;
    const uint32_t wide = (basis.wide_components + 3) / 4;
    const uint32_t narrow = (basis.components - basis.wide_components + 3) / 4;
    const uint32_t region = ANIC_STATE_FLOATS / 4 + (wide + narrow) * (vectors ? 1 : 3);
    const uint32_t texels = 2 + basis.regions * region;
    const uint32_t* first = model->first[part->segment];
    to[0] = (float)first[ANIC_TEXTURE_NARROW];
    to[1] = (float)first[ANIC_TEXTURE_WIDE];
    to[2] = model->has_pose[part->segment] ? (float)first[ANIC_TEXTURE_POSE] : -1;
    to[3] = (float)texels;
    to[4] = (float)vectors;
    to[5] = (float)(wide * (vectors ? 1 : 3));
    to[6] = (float)region;
    anic_write_state(context, model->mesh, ANIC_WHEN_CURRENT, p, to + 8, 16 * (size_t)(texels - 2));
    to += 4 * texels;
    *corrected += part->correction_count > 0;
  }
  return 1;
}

void bind_model(GLuint program, const Model* model) {
  const GLuint textures[4] = {model->narrow, model->wide, model->pose, model->state};
  static const char* names[4] = {"narrow", "wide", "pose", "state"};
  for (GLint i = 0; i < 4; ++i) {
    gl.ActiveTexture(GL_TEXTURE0 + (GLenum)i);
    gl.BindTexture(GL_TEXTURE_2D, textures[i]);
    gl.Uniform1i(gl.GetUniformLocation(program, names[i]), i);
  }
  gl.Uniform1i(gl.GetUniformLocation(program, "width"), (GLint)model->width);
  gl.Uniform1i(gl.GetUniformLocation(program, "rows"), (GLint)model->rows);
}

void upload_states(const Model* model) {
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, model->state);
  gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, (GLsizei)model->state_texels,
                   (GLsizei)model->staged_count, GL_RGBA, GL_FLOAT, model->staged);
}

void draw_model(GLuint program, const Model* model, const float colour[3]) {
  if (model->staged_count == 0)
    return;
  bind_model(program, model);
  gl.Uniform1i(gl.GetUniformLocation(program, "instance"), 0);
  gl.Uniform3f(gl.GetUniformLocation(program, "colour"), colour[0], colour[1], colour[2]);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, model->indices);
  gl.DrawElementsInstanced(GL_TRIANGLES, (GLsizei)(3 * model->triangles), GL_UNSIGNED_INT, NULL,
                           (GLsizei)model->staged_count);
}

void close_model(Model* model) {
  anic_close_asset(model->asset);
  free(model->first);
  free(model->has_pose);
  free(model->staged);
}
