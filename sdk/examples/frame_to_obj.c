/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors */
#include <anicodec/anicodec.h>

#include <stdio.h>
#include <stdlib.h>

static int read_file(void* user, uint64_t offset, void* to, size_t size) {
  return fseek(user, (long)offset, SEEK_SET) != 0 || fread(to, 1, size, user) != size;
}

int main(int argc, char** argv) {
  FILE* file = argc > 1 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL || fseek(file, 0, SEEK_END) != 0)
    return fprintf(stderr, "usage: frame_to_obj CLIP.anic > FRAME.obj\n"), 1;
  anic_reader reader = {file, read_file};
  anic_asset* clip;
  anic_context* player;
  anic_failure why = ANIC_INIT(anic_failure);
  if (anic_open_asset_from_reader(&reader, (uint64_t)ftell(file), NULL, &clip, &why))
    return fprintf(stderr, "%s: %s\n", anic_get_status_text(why.status), why.detail), 1;
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  anic_polygons faces = ANIC_INIT(anic_polygons);
  anic_get_mesh(clip, 0, &mesh);
  anic_get_polygons(clip, 0, &faces);
  anic_output out = ANIC_INIT(anic_output);
  out.size = mesh.vertex_count * 3 * sizeof(float);
  float* p = out.data = malloc(out.size + 1);
  if (p == NULL || anic_create_context(clip, NULL, &player) || anic_seek_frame(player, 10) ||
      anic_write_positions(player, 0, ANIC_WHEN_CURRENT, 0, mesh.vertex_count, &out))
    return fprintf(stderr, "this clip has no frame 10\n"), 1;
  for (uint32_t v = 0; v < mesh.vertex_count; ++v)
    printf("v %.9g %.9g %.9g\n", p[3 * v], p[3 * v + 1], p[3 * v + 2]);
  for (uint32_t f = 0; f < faces.polygon_count; ++f) {
    for (uint32_t c = faces.offsets[f]; c < faces.offsets[f + 1]; ++c)
      printf(c == faces.offsets[f] ? "f %u" : " %u", (unsigned)(faces.corners[c] + 1));
    puts("");
  }
  anic_destroy_context(player);
  anic_close_asset(clip);
  return free(p), 0;
}
