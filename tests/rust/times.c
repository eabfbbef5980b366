/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * The times that bindings/rust/anicodec/examples/times.rs prints, in C.
 *
 * usage: times CLIP.anic [ROUNDS]
 */
#include <anicodec/anicodec.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double used(void) {
  return (double)clock() / CLOCKS_PER_SEC;
}

static double least(double a, double b) {
  return a < b ? a : b;
}

int main(int argc, char** argv) {
  const int rounds = argc > 2 ? atoi(argv[2]) : 5;
  FILE* file = argc > 1 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL)
    return fprintf(stderr, "usage: times CLIP.anic [ROUNDS]\n"), 1;
  fseek(file, 0, SEEK_END);
  const size_t size = (size_t)ftell(file);
  unsigned char* bytes = malloc(size);
  rewind(file);
  if (fread(bytes, 1, size, file) != size)
    return 1;
  fclose(file);
  double open = 1e9, frame = 1e9;
  for (int r = 0; r < rounds; ++r) {
    anic_asset* asset;
    anic_context* context;
    double start = used();
    if (anic_open_asset(bytes, size, NULL, &asset, NULL) != ANIC_OK ||
        anic_create_context(asset, NULL, &context) != ANIC_OK)
      return fprintf(stderr, "%s: refused\n", argv[1]), 1;
    open = least(open, used() - start);
    anic_mesh mesh = ANIC_INIT(anic_mesh);
    anic_asset_info info = ANIC_INIT(anic_asset_info);
    anic_get_mesh(asset, 0, &mesh);
    anic_get_asset_info(asset, &info);
    anic_output out = ANIC_INIT(anic_output);
    out.size = 12 * (size_t)mesh.vertex_count;
    out.data = malloc(out.size);
    start = used();
    for (uint32_t f = 0; f < info.frame_count; ++f) {
      anic_seek_time(context, anic_get_frame_time(asset, f), ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP);
      anic_write_positions(context, 0, ANIC_WHEN_CURRENT, 0, mesh.vertex_count, &out);
    }
    frame = least(frame, (used() - start) / info.frame_count);
    free(out.data);
    anic_destroy_context(context);
    anic_close_asset(asset);
  }
  printf("%.3f %.5f\n", 1e3 * open, 1e3 * frame);
  free(bytes);
  return 0;
}
