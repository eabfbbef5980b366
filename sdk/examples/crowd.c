/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * A crowd on the graphics card: many instances of some clips, each at a time and a blend of its own.
 * Instances that are far away play fewer components, and instances outside the picture are left
 * out by the boxes of their frames. card_clip.c draws them.
 */
#include "card_clip.h"
#include "gl_window.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_MODELS = 16 };

typedef struct {
  anic_context* context;
  uint32_t model, clip, other; /* clips of the file; other: that is faded in */
  double start, other_start, weight, duration, other_duration;
  float map[12]; /* to the world */
} Instance;

static Model models[MAX_MODELS];
static uint32_t model_count;

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
  if (!stage_instance(model, instance->context, instance->map, level, &counts->corrected)) {
    ++counts->culled;
    return;
  }
  ++counts->shown;
  ++counts->levels[level];
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
  gl.GenBuffers(1, &buffer);
  gl.Enable(GL_RASTERIZER_DISCARD);
  for (uint32_t i = 0; i < count; ++i) {
    Model* model = &models[instances[i].model];
    const size_t size = 3 * sizeof(float) * model->vertices;
    Counts counts = {0};
    const float eye[3] = {instances[i].map[3] + (float)(i % 3) * 12, 0, instances[i].map[11]};
    model->staged_count = 0;
    stage(&instances[i], time, all, eye, &counts);
    if (counts.shown == 0)
      continue;
    upload_states(model);
    bind_model(program, model);
    gl.Uniform1i(gl.GetUniformLocation(program, "instance"), 0);
    gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
    gl.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, (GLsizeiptr)size, NULL, GL_STREAM_READ);
    gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    gl.BeginTransformFeedback(GL_POINTS);
    gl.DrawArrays(GL_POINTS, 0, (GLsizei)model->vertices);
    gl.EndTransformFeedback();
    const float* made =
        gl.MapBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, (GLsizeiptr)size, GL_MAP_READ_BIT);
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
    gl.UnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER);
  }
  gl.Disable(GL_RASTERIZER_DISCARD);
  return worst;
}

static int usage(void) {
  fprintf(stderr,
          "usage: crowd [options] CLIP.anic...\n"
          "  --instances N    [1000]\n"
          "  --frames N       pictures to draw; 0: until the window is closed [0]\n"
          "  --size N         width of the picture [960]\n"
          "  --picture FILE   saves the last picture as PPM\n"
          "  --no-drawing     CPU and upload alone\n"
          "  --check          compares positions of the shader with those of the library\n"
          "  --es             OpenGL ES 3 instead of OpenGL 3.3\n");
  return 1;
}

int main(int argc, char** argv) {
  uint32_t count = 1000, frames = 0;
  int width = 960, checks = 0, embedded = 0, draws = 1, file_count = 0;
  const char* picture = NULL;
  char** files = argv;
  for (int i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--check") == 0)
      checks = 1;
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

  SDL_Window* window = open_window("crowd", embedded, width, height);
  if (window == NULL)
    return NO_DISPLAY;
  SDL_GL_SetSwapInterval(frames == 0);
  const GLuint program = make_clip_program(embedded);
  gl.UseProgram(program);

  double opening = 0;
  uint64_t resident = 0, textures = 0, vertex_animation = 0;
  for (int f = 0; f < file_count; ++f) {
    anic_asset* asset = open_file(files[f], &opening);
    anic_asset_info info = ANIC_INIT(anic_asset_info);
    anic_get_asset_info(asset, &info);
    resident += info.resident_bytes;
    if (model_count == MAX_MODELS)
      fail("clips", "there are too many meshes");
    load_model(&models[model_count++], asset, 0, count);
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
    for (uint32_t m = 0; m < model_count; ++m)
      upload_states(&models[m]);
    gl.Finish();
    uploads += milliseconds(&since);
    if (!draws)
      continue;
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.UniformMatrix4fv(gl.GetUniformLocation(program, "view"), 1, GL_FALSE, view);
    for (uint32_t m = 0; m < model_count; ++m) {
      const float colour[3] = {m % 2 ? 0.9f : 0.4f, m / 2 % 2 ? 0.8f : 0.5f,
                               m / 4 % 2 ? 0.9f : 0.4f};
      draw_model(program, &models[m], colour);
    }
    gl.Finish();
    drawing += milliseconds(&since);
    if (picture != NULL && drawn + 1 == frames)
      save_picture(picture, width, height);
    SDL_GL_SwapWindow(window);
  }
  if (gl.GetError() != GL_NO_ERROR)
    fail("OpenGL", "an error");

  const double each = 1.0 / drawn;
  uint64_t staged = 0;
  for (uint32_t m = 0; m < model_count; ++m)
    staged += 16 * (uint64_t)models[m].state_texels * models[m].staged_count;
  printf("%s, %s\n", (const char*)gl.GetString(GL_VERSION), (const char*)gl.GetString(GL_RENDERER));
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
  printf("memory   %8.2f MB of textures; %.2f MB resident, %.2f MB of contexts\n",
         (double)textures / 1e6, (double)resident / 1e6, (double)contexts / 1e6);
  printf(
      "a vertex-animation texture of 16 bits takes %.2f MB, %.1f times as much as the textures\n",
      (double)vertex_animation / 1e6, (double)vertex_animation / (double)textures);

  for (uint32_t i = 0; i < count; ++i)
    anic_destroy_context(instances[i].context);
  for (uint32_t m = 0; m < model_count; ++m)
    close_model(&models[m]);
  free(instances);
  SDL_Quit();
  return 0;
}
