/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * The work that speed.mjs gives to WebAssembly, in native code: opens a file without boxes, by the fastest kernels of the
 * machine and in one thread, and makes the positions of its first mesh frame by frame.
 *
 * usage: native_speed FILE.anic [RUNS]     prints the least processor time of an opening, ms, and of a frame, us
 */
#include <anicodec/anicodec.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static void stop(const char* what) {
  fprintf(stderr, "%s\n", what);
  exit(1);
}

static void check(anic_status status) {
  if (status != ANIC_OK)
    stop(anic_get_status_text(status));
}

static double seconds(void) {
  return (double)clock() / CLOCKS_PER_SEC;
}

static double smaller(double a, double b) {
  return a < b ? a : b;
}

static unsigned char* read_file(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  if (file == NULL || fseek(file, 0, SEEK_END) != 0)
    stop("the file cannot be read");
  *size = (size_t)ftell(file);
  unsigned char* bytes = malloc(*size + 1);
  if (bytes == NULL || fseek(file, 0, SEEK_SET) != 0 || fread(bytes, 1, *size, file) != *size)
    stop("the file cannot be read");
  fclose(file);
  return bytes;
}

/* Seconds of a frame, over all of them. */
static double play(const anic_asset* asset, anic_context* context, uint32_t vertices,
                   const anic_output* output) {
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  check(anic_get_asset_info(asset, &info));
  const double begin = seconds();
  for (uint32_t f = 0; f < info.frame_count; ++f) {
    check(anic_seek_frame(context, f));
    const anic_status status =
        anic_write_positions(context, 0, ANIC_WHEN_CURRENT, 0, vertices, output);
    if (status != ANIC_E_ABSENT)
      check(status);
  }
  return (seconds() - begin) / info.frame_count;
}

int main(int argc, char** argv) {
  if (argc < 2)
    stop("usage: native_speed FILE.anic [RUNS]");
  const int runs = argc > 2 ? atoi(argv[2]) : 10;
  size_t size;
  unsigned char* bytes = read_file(argv[1], &size);
  anic_asset* asset = NULL;
  double open = 1e9, frame = 1e9;
  for (int run = 0; run < runs; ++run) {
    anic_close_asset(asset);
    const double begin = seconds();
    check(anic_open_asset(bytes, size, NULL, &asset, NULL));
    open = smaller(open, seconds() - begin);
  }
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  anic_context* context;
  anic_output output = ANIC_INIT(anic_output);
  check(anic_get_mesh(asset, 0, &mesh));
  check(anic_create_context(asset, NULL, &context));
  output.size = mesh.vertex_count * 3 * sizeof(float);
  output.data = malloc(output.size + 1);
  if (output.data == NULL)
    stop("no memory");
  for (int run = 0; run < runs; ++run)
    frame = smaller(frame, play(asset, context, mesh.vertex_count, &output));
  printf("{\"open\": %.3f, \"frame\": %.3f}\n", 1e3 * open, 1e6 * frame);
  anic_destroy_context(context);
  anic_close_asset(asset);
  free(output.data);
  free(bytes);
  return 0;
}
