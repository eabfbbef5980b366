/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * A crowd on the graphics card: many instances of some clips, each at a time and a blend of its own,
 * by SDL2 and OpenGL 3.3 or ES 3. The basis of a clip lies in textures that all its instances share;
 * an instance is a row of a second texture, which is uploaded each frame; a clip's mesh is one draw
 * call. Instances that are far away play fewer components, and those outside the picture are left
 * out by the boxes of their frames.
 *
 * Corrections of single vertices are left out: they lie within the bound that the clip was encoded
 * to, which a crowd does not show. Clips of geometry interpolation are refused.
 */
#include <anicodec/anicodec.h>

#include <GL/glcorearb.h>
#include <SDL2/SDL.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MAX_MODELS = 16, HEAD_TEXELS = 4, NO_DISPLAY = 3 };

#define FUNCTIONS(F)                                               \
  F(PFNGLGETSTRINGPROC, GetString)                                 \
  F(PFNGLGETERRORPROC, GetError)                                   \
  F(PFNGLGETINTEGERVPROC, GetIntegerv)                             \
  F(PFNGLENABLEPROC, Enable)                                       \
  F(PFNGLDISABLEPROC, Disable)                                     \
  F(PFNGLVIEWPORTPROC, Viewport)                                   \
  F(PFNGLCLEARCOLORPROC, ClearColor)                               \
  F(PFNGLCLEARPROC, Clear)                                         \
  F(PFNGLFINISHPROC, Finish)                                       \
  F(PFNGLREADPIXELSPROC, ReadPixels)                               \
  F(PFNGLPIXELSTOREIPROC, PixelStorei)                             \
  F(PFNGLGENTEXTURESPROC, GenTextures)                             \
  F(PFNGLBINDTEXTUREPROC, BindTexture)                             \
  F(PFNGLACTIVETEXTUREPROC, ActiveTexture)                         \
  F(PFNGLTEXIMAGE2DPROC, TexImage2D)                               \
  F(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)                         \
  F(PFNGLTEXPARAMETERIPROC, TexParameteri)                         \
  F(PFNGLGENBUFFERSPROC, GenBuffers)                               \
  F(PFNGLBINDBUFFERPROC, BindBuffer)                               \
  F(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                       \
  F(PFNGLBUFFERDATAPROC, BufferData)                               \
  F(PFNGLMAPBUFFERRANGEPROC, MapBufferRange)                       \
  F(PFNGLUNMAPBUFFERPROC, UnmapBuffer)                             \
  F(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                     \
  F(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                     \
  F(PFNGLCREATESHADERPROC, CreateShader)                           \
  F(PFNGLSHADERSOURCEPROC, ShaderSource)                           \
  F(PFNGLCOMPILESHADERPROC, CompileShader)                         \
  F(PFNGLGETSHADERIVPROC, GetShaderiv)                             \
  F(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                   \
  F(PFNGLCREATEPROGRAMPROC, CreateProgram)                         \
  F(PFNGLATTACHSHADERPROC, AttachShader)                           \
  F(PFNGLTRANSFORMFEEDBACKVARYINGSPROC, TransformFeedbackVaryings) \
  F(PFNGLLINKPROGRAMPROC, LinkProgram)                             \
  F(PFNGLGETPROGRAMIVPROC, GetProgramiv)                           \
  F(PFNGLUSEPROGRAMPROC, UseProgram)                               \
  F(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)               \
  F(PFNGLUNIFORM1IPROC, Uniform1i)                                 \
  F(PFNGLUNIFORM3FPROC, Uniform3f)                                 \
  F(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                   \
  F(PFNGLBEGINTRANSFORMFEEDBACKPROC, BeginTransformFeedback)       \
  F(PFNGLENDTRANSFORMFEEDBACKPROC, EndTransformFeedback)           \
  F(PFNGLDRAWARRAYSPROC, DrawArrays)                               \
  F(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced)

#define DECLARE(type, name) static type gl##name;
FUNCTIONS(DECLARE)

static const char VERTEX[] =
    "uniform highp isampler2D narrow, wide;\n"
    "uniform highp sampler2D pose, state;\n"
    "uniform int width, rows, instance;\n"
    "uniform mat4 view;\n"
    "out vec3 shown, place;\n"
    "flat out float level;\n"
    "int row;\n"
    "vec4 of(int i) { return texelFetch(state, ivec2(i, row), 0); }\n"
    "vec3 moved(int i, vec3 p) {\n"
    "  vec4 q = vec4(p, 1.0);\n"
    "  return vec3(dot(of(i), q), dot(of(i + 1), q), dot(of(i + 2), q));\n"
    "}\n"
    /* Twelve numbers of three texels: four vectors, or three weights of each of four numbers. */
    "vec3 vectors(vec4 a, vec4 b, vec4 c, vec4 w) {\n"
    "  return w.x * a.xyz + w.y * vec3(a.w, b.xy) + w.z * vec3(b.zw, c.x) + w.w * c.yzw;\n"
    "}\n"
    "#define SUM(basis, first, groups, w)                                             \\\n"
    "  for (int g = 0; g < groups; ++g) {                                             \\\n"
    "    if (is_vectors) {                                                            \\\n"
    "      ivec2 at = ivec2(v.x, first + 3 * g * rows + v.y);                         \\\n"
    "      x += vectors(vec4(texelFetch(basis, at, 0)),                               \\\n"
    "                   vec4(texelFetch(basis, at + ivec2(0, rows), 0)),              \\\n"
    "                   vec4(texelFetch(basis, at + ivec2(0, 2 * rows), 0)), of(w + g)); \\\n"
    "    } else {                                                                     \\\n"
    "      x += vectors(of(w + 3 * g), of(w + 3 * g + 1), of(w + 3 * g + 2),          \\\n"
    "                   vec4(texelFetch(basis, ivec2(v.x, first + g * rows + v.y), 0))); \\\n"
    "    }                                                                            \\\n"
    "  }\n"
    "void main() {\n"
    "  row = gl_InstanceID + instance;\n"
    "  int vertex = gl_VertexID;\n"
    "  ivec2 v = ivec2(vertex % width, vertex / width);\n"
    "  int at = 4, parts = int(of(3).x);\n"
    "  vec3 sum = vec3(0.0);\n"
    "  for (int p = 0; p < parts; ++p) {\n"
    "    vec4 head = of(at);\n"     /* first rows: narrow, wide, pose; length */
    "    vec4 kind = of(at + 1);\n" /* vectors?, texels of the wide weights, of a region's state */
    "    bool is_vectors = kind.x > 0.5;\n"
    "    vec4 still = vec4(0.0);\n" /* and the region */
    "    if (head.z >= 0.0) still = texelFetch(pose, ivec2(v.x, int(head.z) + v.y), 0);\n"
    "    int region = at + 2 + int(still.w) * int(kind.z);\n"
    "    vec4 counts = of(region + 6);\n"
    "    vec3 x = vec3(0.0);\n"
    "    int w = region + 7;\n"
    "    SUM(wide, int(head.y), int(counts.x), w)\n"
    "    w += int(kind.y);\n"
    "    SUM(narrow, int(head.x), int(counts.y), w)\n"
    "    sum += counts.z * moved(region + 3, x + moved(region, still.xyz));\n"
    "    at += int(head.w);\n"
    "  }\n"
    "  shown = sum;\n"
    "  place = moved(0, sum);\n"
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

/* A mesh of a file, with its basis in textures. */
typedef struct {
  anic_asset* asset;
  anic_asset_info info;
  uint32_t mesh, vertices, triangles;
  uint32_t width, rows;    /* of a layer of a texture */
  uint32_t (*first)[3];    /* by segment: row of narrow, wide and pose */
  unsigned char* has_pose; /* by segment */
  uint32_t state_texels;   /* of an instance */
  GLuint narrow, wide, pose, state, indices;
  uint64_t texture_bytes, vertex_animation_bytes;
  float* staged;         /* the texture of states */
  uint32_t staged_count; /* instances in it */
  anic_box box;
} Model;

typedef struct {
  anic_context* context;
  uint32_t model, clip, other; /* clips of the file; other: that is faded in */
  double start, other_start, weight, duration, other_duration;
  float map[12]; /* to the world */
} Instance;

static Model models[MAX_MODELS];
static uint32_t model_count;

static void fail(const char* what, const char* why) {
  fprintf(stderr, "crowd: %s: %s\n", what, why);
  exit(1);
}

static void check(anic_status status, const char* what) {
  if (status != ANIC_OK)
    fail(what, anic_get_status_text(status));
}

static void* room(size_t size) {
  void* memory = calloc(size > 0 ? size : 1, 1);
  if (memory == NULL)
    fail("memory", "there is none");
  return memory;
}

/* ---- OpenGL ---------------------------------------------------------------------------------- */

static GLuint compile(GLenum kind, int embedded, const char* text) {
  const char* head = embedded ? "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                              : "#version 330 core\n";
  const char* sources[2] = {head, text};
  const GLuint shader = glCreateShader(kind);
  GLint done = 0;
  glShaderSource(shader, 2, sources, NULL);
  glCompileShader(shader);
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (!done) {
    char log[2000] = "";
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    fail("shader", log);
  }
  return shader;
}

static GLuint make_program(int embedded) {
  static const char* shown[] = {"shown"};
  const GLuint program = glCreateProgram();
  GLint done = 0;
  glAttachShader(program, compile(GL_VERTEX_SHADER, embedded, VERTEX));
  glAttachShader(program, compile(GL_FRAGMENT_SHADER, embedded, FRAGMENT));
  glTransformFeedbackVaryings(program, 1, shown, GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(program);
  glGetProgramiv(program, GL_LINK_STATUS, &done);
  if (!done)
    fail("program", "does not link");
  return program;
}

static GLuint make_texture(GLint format, GLsizei width, GLsizei height, GLenum layout, GLenum type,
                           const void* data) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, layout, type, data);
  return texture;
}

/* ---- loading --------------------------------------------------------------------------------- */

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

static void load_model(anic_asset* asset, uint32_t mesh, uint32_t instances, uint32_t max_size) {
  if (model_count == MAX_MODELS)
    fail("clips", "there are too many meshes");
  Model* model = &models[model_count++];
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
  glGenBuffers(1, &model->indices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, model->indices);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, 12 * (GLsizeiptr)model->triangles, indices, GL_STATIC_DRAW);
  free(indices);
  /* A texel of four 16-bit numbers for each vertex and frame. */
  model->vertex_animation_bytes = (uint64_t)8 * model->vertices * model->info.frame_count;
}

static anic_asset* open_file(const char* path, double* seconds) {
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
  const Uint64 begin = SDL_GetPerformanceCounter();
  check(anic_open_asset(bytes, size, &options, &asset, NULL), path);
  *seconds += (double)(SDL_GetPerformanceCounter() - begin) / (double)SDL_GetPerformanceFrequency();
  free(bytes);
  return asset;
}

/* ---- instances ------------------------------------------------------------------------------- */

/* The same numbers in every run. */
static double next_random(uint32_t* seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (*seed >> 8) / 16777216.0;
}

/* Places an instance in a grid, one unit high, y up. */
static void place_instance(Instance* instance, uint32_t i, uint32_t count) {
  const Model* model = &models[instance->model];
  const uint32_t side = (uint32_t)ceil(sqrt((double)count));
  const int z_up = model->info.up == ANIC_UP_Z;
  const int up = z_up ? 2 : 1;
  float size = 0;
  for (int c = 0; c < 3; ++c)
    size = fmaxf(size, model->box.max[c] - model->box.min[c]);
  const float scale = size > 0 ? 1 / size : 1;
  memset(instance->map, 0, sizeof instance->map);
  instance->map[0] = scale;
  instance->map[4 + up] = scale;
  instance->map[8 + (z_up ? 1 : 2)] = z_up ? -scale : scale;
  instance->map[3] = 1.2f * ((float)(i % side) - (float)side / 2) -
                     scale * (model->box.min[0] + model->box.max[0]) / 2;
  instance->map[7] = -scale * model->box.min[up];
  const float depth = (model->box.min[3 - up] + model->box.max[3 - up]) / 2;
  instance->map[11] = -1.2f * (float)(i / side) - (z_up ? -scale : scale) * depth;
}

/* Box of the frames around a time of a clip; the whole clip where frames are not even. */
static void add_frames(const Model* model, uint32_t clip, double seconds, anic_box* box) {
  anic_clip info = ANIC_INIT(anic_clip);
  check(anic_get_clip(model->asset, clip, &info), "clip");
  if (info.uneven) {
    *box = model->box;
    return;
  }
  const double turn = info.loop_duration > 0 ? info.loop_duration : 1;
  const double t = seconds - turn * floor(seconds / turn);
  const uint32_t frame = (uint32_t)(t * info.rate_numerator / info.rate_denominator);
  for (uint32_t i = 0; i < 2; ++i) {
    anic_box now;
    if (anic_get_frame_bounds(model->asset, model->mesh,
                              info.first_frame + (frame + i) % info.frame_count, &now) != ANIC_OK)
      continue;
    for (int c = 0; c < 3; ++c) {
      box->min[c] = fminf(box->min[c], now.min[c]);
      box->max[c] = fmaxf(box->max[c], now.max[c]);
    }
  }
}

/* Whether all corners of a box are on the far side of one plane of the picture. */
static int is_outside(const anic_box* box, const float* map, const float* view) {
  int outside[5] = {1, 1, 1, 1, 1};
  for (int corner = 0; corner < 8; ++corner) {
    float p[3], q[3], clip[4];
    for (int c = 0; c < 3; ++c)
      p[c] = corner >> c & 1 ? box->max[c] : box->min[c];
    for (int r = 0; r < 3; ++r)
      q[r] = map[4 * r] * p[0] + map[4 * r + 1] * p[1] + map[4 * r + 2] * p[2] + map[4 * r + 3];
    for (int r = 0; r < 4; ++r)
      clip[r] = view[r] * q[0] + view[4 + r] * q[1] + view[8 + r] * q[2] + view[12 + r];
    for (int c = 0; c < 2; ++c) {
      outside[2 * c] &= clip[c] < -clip[3];
      outside[2 * c + 1] &= clip[c] > clip[3];
    }
    outside[4] &= clip[2] < -clip[3];
  }
  return outside[0] || outside[1] || outside[2] || outside[3] || outside[4];
}

typedef struct {
  uint32_t shown, culled, corrected, levels[3];
} Counts;

/* Seeks an instance and writes its row of the model's texture. */
static void stage(Instance* instance, double time, const float* view, const float* eye,
                  Counts* counts) {
  static const double qualities[] = {1, 0.5, 0.25};
  Model* model = &models[instance->model];
  anic_box box = {{1e30f, 1e30f, 1e30f}, {-1e30f, -1e30f, -1e30f}};
  add_frames(model, instance->clip, time + instance->start, &box);
  if (instance->weight > 0)
    add_frames(model, instance->other, time + instance->other_start, &box);
  if (box.min[0] > box.max[0] || is_outside(&box, instance->map, view)) {
    ++counts->culled;
    return;
  }
  const float away = hypotf(instance->map[3] - eye[0], instance->map[11] - eye[2]);
  const int level = away < 8 ? 0 : away < 20 ? 1 : 2;
  anic_set_quality(instance->context, qualities[level]);
  anic_seek_time(instance->context, time + instance->start, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP);
  if (instance->weight > 0)
    check(anic_blend(instance->context, instance->other, time + instance->other_start,
                     ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP, instance->weight),
          "blend");
  anic_parts shown = ANIC_INIT(anic_parts);
  if (anic_get_parts(instance->context, model->mesh, ANIC_WHEN_CURRENT, &shown) != ANIC_OK) {
    ++counts->culled;
    return;
  }
  float* const row = model->staged + 4 * (size_t)model->state_texels * model->staged_count++;
  memcpy(row, instance->map, sizeof instance->map);
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
    anic_write_state(instance->context, model->mesh, ANIC_WHEN_CURRENT, p, to + 8,
                     16 * (size_t)(texels - 2));
    to += 4 * texels;
    counts->corrected += part->correction_count > 0;
  }
  ++counts->shown;
  ++counts->levels[level];
}

/* ---- the picture ----------------------------------------------------------------------------- */

/* Column-major: a camera at `eye` that looks at `at`. */
static void look(const float* eye, const float* at, float aspect, float* out) {
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

static void bind(GLuint program, const Model* model) {
  const GLuint textures[4] = {model->narrow, model->wide, model->pose, model->state};
  static const char* names[4] = {"narrow", "wide", "pose", "state"};
  for (GLint i = 0; i < 4; ++i) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)i);
    glBindTexture(GL_TEXTURE_2D, textures[i]);
    glUniform1i(glGetUniformLocation(program, names[i]), i);
  }
  glUniform1i(glGetUniformLocation(program, "width"), (GLint)model->width);
  glUniform1i(glGetUniformLocation(program, "rows"), (GLint)model->rows);
}

static void upload(const Model* model) {
  glBindTexture(GL_TEXTURE_2D, model->state);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, (GLsizei)model->state_texels,
                  (GLsizei)model->staged_count, GL_RGBA, GL_FLOAT, model->staged);
}

static double size_of(const anic_box* box) {
  double largest = 1e-30;
  for (int c = 0; c < 3; ++c)
    largest = fmax(largest, fmax(fabs((double)box->min[c]), fabs((double)box->max[c])));
  return largest;
}

/* Positions of the shader against those of the library, relative to the largest coordinate. */
static double largest_difference(GLuint program, Instance* instances, uint32_t count, double time) {
  static const float all[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}; /* culls nothing */
  double worst = 0;
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glEnable(GL_RASTERIZER_DISCARD);
  for (uint32_t i = 0; i < count; ++i) {
    Model* model = &models[instances[i].model];
    const size_t size = 3 * sizeof(float) * model->vertices;
    Counts counts = {0};
    const float eye[3] = {instances[i].map[3] + (float)(i % 3) * 12, 0, instances[i].map[11]};
    model->staged_count = 0;
    stage(&instances[i], time, all, eye, &counts);
    if (counts.shown == 0)
      continue;
    glActiveTexture(GL_TEXTURE0);
    upload(model);
    bind(program, model);
    glUniform1i(glGetUniformLocation(program, "instance"), 0);
    glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, (GLsizeiptr)size, NULL, GL_STREAM_READ);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, (GLsizei)model->vertices);
    glEndTransformFeedback();
    const float* made =
        glMapBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, (GLsizeiptr)size, GL_MAP_READ_BIT);
    float* expected = room(size);
    anic_output out = ANIC_INIT(anic_output);
    anic_parts shown = ANIC_INIT(anic_parts);
    out.data = expected;
    out.size = size;
    check(anic_write_positions(instances[i].context, model->mesh, ANIC_WHEN_CURRENT, 0,
                               model->vertices, &out),
          "positions");
    anic_get_parts(instances[i].context, model->mesh, ANIC_WHEN_CURRENT, &shown);
    for (uint32_t p = 0; p < shown.count; ++p) {
      for (uint32_t k = 0; k < shown.parts[p].correction_count; ++k) {
        for (uint32_t c = 0; c < 3; ++c)
          expected[3 * shown.parts[p].corrections[k].vertex + c] -=
              shown.parts[p].share * shown.parts[p].corrections[k].delta[c];
      }
    }
    for (size_t k = 0; made != NULL && k < size / sizeof(float); ++k)
      worst = fmax(worst, fabs((double)made[k] - (double)expected[k]) / size_of(&model->box));
    if (made == NULL)
      fail("check", "nothing can be read back");
    free(expected);
    glUnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER);
  }
  glDisable(GL_RASTERIZER_DISCARD);
  return worst;
}

static void save_picture(const char* path, int width, int height) {
  unsigned char* pixels = room(4 * (size_t)width * (size_t)height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
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

/* Time that this program has had on the processor, whatever else runs. */
static double processor_milliseconds(clock_t* since) {
  const clock_t now = clock();
  const double passed = 1000.0 * (double)(now - *since) / CLOCKS_PER_SEC;
  *since = now;
  return passed;
}

/* The other way to play: positions and normals in vertex buffers, of instances of each clip. */
static void print_buffers(const Instance* instances, uint32_t count) {
  enum { MOST = 400 };

  for (uint32_t m = 0; m < model_count; ++m) {
    const Model* model = &models[m];
    anic_render_plan* plan = NULL;
    anic_render_info render = ANIC_INIT(anic_render_info);
    anic_basis basis = ANIC_INIT(anic_basis);
    check(anic_create_render_plan(model->asset, model->mesh, NULL, NULL, &plan), "plan");
    check(anic_get_render_info(plan, &render), "plan");
    check(anic_get_basis(model->asset, 0, &basis), "basis");
    anic_output positions = ANIC_INIT(anic_output), normals = ANIC_INIT(anic_output);
    positions.size = 12 * (size_t)render.vertex_count;
    positions.data = room(positions.size);
    normals.size = 8 * (size_t)render.vertex_count;
    normals.data = room(normals.size);
    normals.format = ANIC_FORMAT_SNORM16X4;
    double placing = 0, shading = 0;
    uint32_t made = 0;
    for (uint32_t i = 0; made < MOST; i = (i + 1) % count) {
      if (instances[i].model != m)
        continue;
      clock_t since = clock();
      anic_set_quality(instances[i].context, 1);
      anic_seek_time(instances[i].context, instances[i].start + made / 30.0, ANIC_SAMPLE_LINEAR,
                     ANIC_WRAP_LOOP);
      check(anic_write_render_positions(plan, instances[i].context, ANIC_WHEN_CURRENT, 0,
                                        render.vertex_count, &positions),
            "positions");
      placing += processor_milliseconds(&since);
      check(anic_write_render_normals(plan, positions.data, 0, 0, render.vertex_count, &normals),
            "normals");
      shading += processor_milliseconds(&since);
      ++made;
    }
    const double vertices = (double)MOST * render.vertex_count;
    printf(
        "buffers  %8.3f ms for ten of %u vertices by %u components: %.2f ns a vertex for "
        "positions, %.2f for normals\n",
        10 * (placing + shading) / MOST, render.vertex_count, basis.components,
        1e6 * placing / vertices, 1e6 * shading / vertices);
    free(positions.data);
    free(normals.data);
    anic_destroy_render_plan(plan);
  }
}

static double milliseconds(Uint64* since) {
  const Uint64 now = SDL_GetPerformanceCounter();
  const double passed = 1000 * (double)(now - *since) / (double)SDL_GetPerformanceFrequency();
  *since = now;
  return passed;
}

static SDL_Window* open_window(int embedded, int width, int height) {
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, embedded ? 0 : 3);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK,
                      embedded ? SDL_GL_CONTEXT_PROFILE_ES : SDL_GL_CONTEXT_PROFILE_CORE);
  SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 24);
  SDL_Window* window = SDL_CreateWindow("crowd", SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                        width, height, SDL_WINDOW_OPENGL);
  if (window != NULL && SDL_GL_CreateContext(window) == NULL) {
    SDL_DestroyWindow(window);
    window = NULL;
  }
  return window;
}

static int usage(void) {
  fprintf(stderr,
          "usage: crowd [options] CLIP.anic...\n"
          "  --instances N    [1000]\n"
          "  --frames N       pictures to draw; 0: until the window is closed [0]\n"
          "  --size N         width of the picture [960]\n"
          "  --picture FILE   saves the last picture as PPM\n"
          "  --no-drawing     CPU and upload alone\n"
          "  --buffers        measures vertex buffers filled by the CPU too\n"
          "  --check          compares positions of the shader with those of the library\n"
          "  --es             OpenGL ES 3 instead of OpenGL 3.3\n");
  return 1;
}

int main(int argc, char** argv) {
  uint32_t count = 1000, frames = 0;
  int width = 960, buffers = 0, checks = 0, embedded = 0, draws = 1, file_count = 0;
  const char* picture = NULL;
  char** files = argv;
  for (int i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--check") == 0)
      checks = 1;
    else if (strcmp(argv[i], "--buffers") == 0)
      buffers = 1;
    else if (strcmp(argv[i], "--es") == 0)
      embedded = 1;
    else if (strcmp(argv[i], "--no-drawing") == 0)
      draws = 0;
    else if (strcmp(argv[i], "--instances") == 0 && i + 1 < argc)
      count = (uint32_t)strtoul(argv[++i], NULL, 10);
    else if (strcmp(argv[i], "--frames") == 0 && i + 1 < argc)
      frames = (uint32_t)strtoul(argv[++i], NULL, 10);
    else if (strcmp(argv[i], "--size") == 0 && i + 1 < argc)
      width = (int)strtol(argv[++i], NULL, 10);
    else if (strcmp(argv[i], "--picture") == 0 && i + 1 < argc)
      picture = argv[++i];
    else if (argv[i][0] == '-')
      return usage();
    else
      files[file_count++] = argv[i];
  }
  const int height = width * 9 / 16;
  if (file_count == 0 || count == 0 || width < 16)
    return usage();

  SDL_Window* window = NULL;
  if (SDL_Init(SDL_INIT_VIDEO) == 0)
    window = open_window(embedded, width, height);
  if (window == NULL) {
    fprintf(stderr, "crowd: no OpenGL %s: %s\n", embedded ? "ES 3" : "3.3", SDL_GetError());
    return NO_DISPLAY;
  }
#define LOAD(type, name)                                  \
  *(void**)&gl##name = SDL_GL_GetProcAddress("gl" #name); \
  if (gl##name == NULL)                                   \
    fail("OpenGL has no function", "gl" #name);
  FUNCTIONS(LOAD)
  SDL_GL_SetSwapInterval(frames == 0);
  GLint max_size = 0;
  GLuint vertex_array = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_size);
  glGenVertexArrays(1, &vertex_array);
  glBindVertexArray(vertex_array);
  const GLuint program = make_program(embedded);
  glUseProgram(program);

  double opening = 0;
  uint64_t resident = 0, textures = 0, vertex_animation = 0;
  for (int f = 0; f < file_count; ++f) {
    anic_asset* asset = open_file(files[f], &opening);
    anic_asset_info info = ANIC_INIT(anic_asset_info);
    anic_get_asset_info(asset, &info);
    resident += info.resident_bytes;
    load_model(asset, 0, count, (uint32_t)max_size);
  }
  for (uint32_t m = 0; m < model_count; ++m) {
    textures += models[m].texture_bytes;
    vertex_animation += models[m].vertex_animation_bytes;
  }

  Instance* instances = room(sizeof *instances * count);
  uint32_t seed = 1;
  uint64_t contexts = 0;
  for (uint32_t i = 0; i < count; ++i) {
    Instance* instance = &instances[i];
    instance->model = (i + i / 7) % model_count;
    const Model* model = &models[instance->model];
    const uint32_t clips = anic_get_clip_count(model->asset);
    check(anic_create_context(model->asset, NULL, &instance->context), "context");
    instance->clip = i / model_count % clips;
    instance->other = (instance->clip + 1) % clips;
    check(anic_set_clip(instance->context, instance->clip), "clip");
    instance->start = 10 * next_random(&seed);
    instance->other_start = 10 * next_random(&seed);
    instance->weight = i % 3 == 0 ? next_random(&seed) : 0; /* a third of them blends */
    place_instance(instance, i, count);
    contexts += model->info.context_bytes;
  }

  if (checks) {
    double worst = 0;
    for (int t = 0; t < 3; ++t)
      worst =
          fmax(worst, largest_difference(program, instances, count < 60 ? count : 60, 0.31 * t));
    printf("largest difference from the CPU: %.2g of the coordinates\n", worst);
    if (!(worst <= 1e-4))
      return 1;
  }

  const float depth = 1.2f * sqrtf((float)count);
  const float eye[3] = {0.13f * depth, 2.5f, 3}, at[3] = {0, 0.5f, -0.5f * depth};
  float view[16];
  look(eye, at, (float)width / (float)height, view);
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glClearColor(0.85f, 0.9f, 0.95f, 1);
  double cpu = 0, uploads = 0, drawing = 0;
  uint32_t drawn = 0;
  Counts counts = {0};
  for (int open = 1; open && (frames == 0 || drawn < frames); ++drawn) {
    for (SDL_Event event; SDL_PollEvent(&event);)
      open &= event.type != SDL_QUIT;
    const double time = frames == 0 ? SDL_GetTicks() / 1000.0 : drawn / 30.0;
    clock_t processor = clock();
    memset(&counts, 0, sizeof counts);
    for (uint32_t m = 0; m < model_count; ++m)
      models[m].staged_count = 0;
    for (uint32_t i = 0; i < count; ++i)
      stage(&instances[i], time, view, eye, &counts);
    cpu += processor_milliseconds(&processor);
    Uint64 since = SDL_GetPerformanceCounter();
    glActiveTexture(GL_TEXTURE0);
    for (uint32_t m = 0; m < model_count; ++m)
      upload(&models[m]);
    glFinish();
    uploads += milliseconds(&since);
    if (!draws)
      continue;
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUniformMatrix4fv(glGetUniformLocation(program, "view"), 1, GL_FALSE, view);
    glUniform1i(glGetUniformLocation(program, "instance"), 0);
    for (uint32_t m = 0; m < model_count; ++m) {
      if (models[m].staged_count == 0)
        continue;
      bind(program, &models[m]);
      glUniform3f(glGetUniformLocation(program, "colour"), m % 2 ? 0.9f : 0.4f,
                  m / 2 % 2 ? 0.8f : 0.5f, m / 4 % 2 ? 0.9f : 0.4f);
      glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, models[m].indices);
      glDrawElementsInstanced(GL_TRIANGLES, (GLsizei)(3 * models[m].triangles), GL_UNSIGNED_INT,
                              NULL, (GLsizei)models[m].staged_count);
    }
    glFinish();
    drawing += milliseconds(&since);
    if (picture != NULL && drawn + 1 == frames)
      save_picture(picture, width, height);
    SDL_GL_SwapWindow(window);
  }
  if (glGetError() != GL_NO_ERROR)
    fail("OpenGL", "an error");

  const double each = 1.0 / drawn;
  uint64_t staged = 0;
  for (uint32_t m = 0; m < model_count; ++m)
    staged += 16 * (uint64_t)models[m].state_texels * models[m].staged_count;
  printf("%s, %s\n", (const char*)glGetString(GL_VERSION), (const char*)glGetString(GL_RENDERER));
  printf(
      "%u instances of %u clips: %u in the picture (%u near, %u further, %u far), %u culled, "
      "%u with corrections left out\n",
      count, model_count, counts.shown, counts.levels[0], counts.levels[1], counts.levels[2],
      counts.culled, counts.corrected);
  printf("CPU      %8.3f ms a frame, %.2f us for each instance in the picture\n", cpu * each,
         counts.shown > 0 ? 1000 * cpu * each / counts.shown : 0);
  printf("upload   %8.3f ms a frame, %.0f bytes for each instance in the picture\n", uploads * each,
         counts.shown > 0 ? (double)staged / counts.shown : 0);
  if (draws)
    printf("drawing  %8.3f ms a frame, %u calls\n", drawing * each, model_count);
  printf("opening  %8.3f ms\n", 1000 * opening);
  printf("memory   %8.2f MB of textures; %.2f MB resident, %.2f MB of contexts\n", textures / 1e6,
         resident / 1e6, contexts / 1e6);
  printf(
      "a vertex-animation texture of 16 bits takes %.2f MB, %.1f times as much as the textures\n",
      vertex_animation / 1e6, (double)vertex_animation / (double)textures);

  if (buffers)
    print_buffers(instances, count);
  for (uint32_t i = 0; i < count; ++i)
    anic_destroy_context(instances[i].context);
  for (uint32_t m = 0; m < model_count; ++m) {
    anic_close_asset(models[m].asset);
    free(models[m].first);
    free(models[m].has_pose);
    free(models[m].staged);
  }
  free(instances);
  SDL_Quit();
  return 0;
}
