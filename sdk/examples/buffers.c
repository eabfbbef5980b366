/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Plays into vertex buffers: positions and normals of render vertices, filled by the CPU, as an engine
 * uploads them. Prints the cost of both.
 */
#include <anicodec/anicodec.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { FRAMES = 400 };

static void check(anic_status status, const char* what) {
  if (status == ANIC_OK)
    return;
  fprintf(stderr, "buffers: %s: %s\n", what, anic_get_status_text(status));
  exit(1);
}

static int read_file(void* user, uint64_t offset, void* to, size_t size) {
  return fseek(user, (long)offset, SEEK_SET) != 0 || fread(to, 1, size, user) != size;
}

static anic_asset* open_file(const char* path) {
  FILE* file = fopen(path, "rb");
  if (file == NULL || fseek(file, 0, SEEK_END) != 0)
    check(ANIC_E_READ, path);
  const anic_reader reader = {file, read_file};
  anic_asset* asset = NULL;
  check(anic_open_asset_from_reader(&reader, (uint64_t)ftell(file), NULL, &asset, NULL), path);
  fclose(file);
  return asset;
}

/* A packed buffer for all vertices. */
static anic_output buffer_of(uint32_t vertices, size_t bytes, anic_format format) {
  anic_output out = ANIC_INIT(anic_output);
  out.size = bytes * vertices;
  out.data = malloc(out.size + 1);
  out.format = format;
  check(out.data == NULL ? ANIC_E_MEMORY : ANIC_OK, "buffers");
  return out;
}

/* Processor time that passed, in nanoseconds. */
static double nanoseconds(clock_t* since) {
  const clock_t now = clock();
  const double passed = 1e9 * (double)(now - *since) / CLOCKS_PER_SEC;
  *since = now;
  return passed;
}

static void play(const anic_asset* asset) {
  anic_context* context = NULL;
  anic_render_plan* plan = NULL;
  anic_render_info render = ANIC_INIT(anic_render_info);
  check(anic_create_context(asset, NULL, &context), "context");
  check(anic_create_render_plan(asset, 0, NULL, NULL, &plan), "plan");
  check(anic_get_render_info(plan, &render), "plan");
  const uint32_t vertices = render.vertex_count;
  anic_output positions = buffer_of(vertices, 12, ANIC_FORMAT_FLOAT32X3);
  anic_output normals = buffer_of(vertices, 8, ANIC_FORMAT_SNORM16X4);
  double placing = 0, shading = 0;
  clock_t since = clock();
  for (uint32_t frame = 0; frame < FRAMES; ++frame) {
    check(anic_seek_time(context, frame / 30.0, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP), "time");
    const anic_status status =
        anic_write_render_positions(plan, context, ANIC_WHEN_CURRENT, 0, vertices, &positions);
    if (status == ANIC_E_ABSENT) /* no mesh at this time: nothing to draw */
      continue;
    check(status, "positions");
    placing += nanoseconds(&since);
    check(anic_write_render_normals(plan, positions.data, 0, 0, vertices, &normals), "normals");
    shading += nanoseconds(&since);
  }
  const double each = 1 / ((double)FRAMES * vertices);
  printf("%u render vertices: %.2f ns a vertex for positions, %.2f for normals\n", vertices,
         placing * each, shading * each);
  free(positions.data);
  free(normals.data);
  anic_destroy_render_plan(plan);
  anic_destroy_context(context);
}

int main(int argc, char** argv) {
  if (argc < 2)
    return fprintf(stderr, "usage: buffers CLIP.anic...\n"), 1;
  for (int i = 1; i < argc; ++i) {
    anic_asset* asset = open_file(argv[i]);
    play(asset);
    anic_close_asset(asset);
  }
  return 0;
}
