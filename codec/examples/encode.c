/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Encodes a sheet that waves, a frame at a time, and tells how far it is. */
#include <anicodec/encode.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 32, FRAMES = 48 };

/* Computes a frame. */
static int wave(void* user, uint32_t frame, float* positions) {
  (void)user;
  for (int i = 0; i < SIDE * SIDE; ++i) {
    const double x = i % SIDE / (SIDE - 1.0), y = i / SIDE / (SIDE - 1.0);
    positions[3 * i] = (float)x;
    positions[3 * i + 1] = (float)y;
    positions[3 * i + 2] = (float)(0.1 * sin(6 * x + 2 * y + 0.2 * frame));
  }
  return 0;
}

static int tell(void* user, const char* stage, double done) {
  (void)user;
  fprintf(stderr, "\r%s %3.0f %% ", stage, 100 * done);
  return 0;
}

static int put(void* file, const void* bytes, size_t size) {
  return fwrite(bytes, 1, size, file) != size;
}

int main(int argc, char** argv) {
  static uint32_t quads[(SIDE - 1) * (SIDE - 1) * 4], offsets[(SIDE - 1) * (SIDE - 1) + 1];
  uint32_t corners = 0, polygons = 0;
  for (uint32_t i = 0; i < SIDE * (SIDE - 1); ++i) {
    if (i % SIDE == SIDE - 1)
      continue;
    quads[corners++] = i;
    quads[corners++] = i + 1;
    quads[corners++] = i + SIDE + 1;
    quads[corners++] = i + SIDE;
    offsets[++polygons] = corners;
  }
  FILE* file = argc > 1 ? fopen(argv[1], "wb") : NULL;
  if (file == NULL)
    return fprintf(stderr, "usage: encode OUT.anic\n"), 1;

  anic_encoder* encoder;
  anic_source_clip clip = ANIC_INIT(anic_source_clip);
  anic_source_mesh mesh = ANIC_INIT(anic_source_mesh);
  anic_encode_options options = ANIC_INIT(anic_encode_options);
  anic_encoding result = ANIC_INIT(anic_encoding);
  clip.name = "sheet";
  clip.frame_count = FRAMES;
  clip.rate_numerator = 24;
  mesh.vertex_count = SIDE * SIDE;
  mesh.polygon_count = polygons;
  mesh.offsets = offsets;
  mesh.corners = quads;
  mesh.read = wave;
  options.goal = ANIC_GOAL_MAX_ERROR;
  options.goal_value = 0.05;
  options.flags = ANIC_ENCODE_PERCENT;
  options.progress.report = tell;
  options.writer.user = file;
  options.writer.write = put;
  if (anic_create_encoder(&encoder) != ANIC_OK)
    return fprintf(stderr, "no memory\n"), 1;
  if (anic_set_source_clip(encoder, &clip) != ANIC_OK ||
      anic_add_source_mesh(encoder, &mesh, NULL) != ANIC_OK ||
      anic_encode(encoder, &options, &result) != ANIC_OK || fclose(file) != 0)
    return fprintf(stderr, "%s\n", anic_get_encoder_text(encoder)), 1;
  printf("%lu bytes, largest error %.3g\n", (unsigned long)result.size, result.max_error);
  return anic_destroy_encoder(encoder), 0;
}
