/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Plays two instances of a clip for a second, one backwards at double speed, into a vertex buffer
 * that holds positions, normals, and where the vertices were one tick before. The memory of clip
 * and instances is one block, whose size is known before the clip is opened.
 */
#include <anicodec/anicodec.h>

#include <stdio.h>
#include <stdlib.h>

typedef struct vertex {
  float position[3];
  float previous[3];
  int16_t normal[4];
} vertex;

static int fail(const char* what, anic_status status) {
  fprintf(stderr, "%s: %s\n", what, anic_get_status_text(status));
  return 1;
}

/* The next tick of an instance. Positions are read again for the normals, so this buffer must not
 * be write-combined. */
static anic_status tick(anic_context* context, const anic_normal_plan* normals, double seconds,
                        vertex* vertices, uint32_t count) {
  anic_output out = ANIC_INIT(anic_output);
  out.size = count * sizeof(vertex);
  out.stride = sizeof(vertex);
  anic_status status = anic_seek_time(context, seconds, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP);
  if (status != ANIC_OK)
    return status;
  out.data = vertices[0].position;
  status = anic_write_positions(context, 0, ANIC_WHEN_CURRENT, 0, count, &out);
  if (status != ANIC_OK)
    return status;
  out.data = vertices[0].previous;
  out.size -= sizeof(float) * 3;
  status = anic_write_positions(context, 0, ANIC_WHEN_PREVIOUS, 0, count, &out);
  if (status != ANIC_OK)
    return status;
  out.data = vertices[0].normal;
  out.size -= sizeof(float) * 3;
  out.format = ANIC_FORMAT_SNORM16X4;
  return anic_write_normals(normals, vertices[0].position, sizeof(vertex), 0, count, &out);
}

int main(int argc, char** argv) {
  FILE* file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL) {
    fprintf(stderr, "usage: play CLIP.anic\n");
    return 1;
  }
  fseek(file, 0, SEEK_END);
  const size_t size = (size_t)ftell(file);
  unsigned char* bytes = malloc(size);
  rewind(file);
  if (bytes == NULL || fread(bytes, 1, size, file) != size)
    return fail(argv[1], ANIC_E_READ);
  fclose(file);

  /* What may a file ask for, and what does this one ask for? */
  anic_options options = ANIC_INIT(anic_options);
  options.max_vertices = 1000000;
  options.max_bytes = (uint64_t)1 << 30;
  anic_requirements needs = ANIC_INIT(anic_requirements);
  anic_status status = anic_get_requirements(bytes, size, &options, &needs);
  if (status != ANIC_OK)
    return fail(argv[1], status);
  const size_t block_size = (size_t)(needs.block_bytes + 2 * needs.context_bytes);
  void* block = malloc(block_size);
  anic_asset* asset;
  anic_failure failure = ANIC_INIT(anic_failure);
  anic_init_block_allocator(block, block_size, &options.allocator);
  if (anic_open_asset(bytes, size, &options, &asset, &failure) != ANIC_OK) {
    fprintf(stderr, "%s: byte %llu, chunk '%s': %s (%s)\n", argv[1],
            (unsigned long long)failure.offset, failure.chunk, anic_get_status_text(failure.status),
            failure.detail);
    return 1;
  }
  free(bytes);

  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  const anic_allocator heap = {0};
  anic_normal_plan* normals;
  anic_context* instance[2];
  anic_get_asset_info(asset, &info);
  anic_get_mesh(asset, 0, &mesh);
  if ((status = anic_create_normal_plan(asset, 0, NULL, &heap, &normals)) != ANIC_OK)
    return fail("normals", status);
  for (int i = 0; i < 2; ++i) {
    if ((status = anic_create_context(asset, NULL, &instance[i])) != ANIC_OK)
      return fail("context", status);
  }
  printf("%u vertices, %u triangles, %u frames, %.3f s; %llu bytes, and %llu for an instance\n",
         (unsigned)mesh.vertex_count, (unsigned)mesh.triangle_count, (unsigned)info.frame_count,
         info.loop_duration, (unsigned long long)info.resident_bytes,
         (unsigned long long)info.context_bytes);

  vertex* vertices = malloc(mesh.vertex_count * sizeof(vertex));
  for (int t = 0; t <= 60 && status == ANIC_OK; ++t) {
    const double elapsed = t / 60.0;
    for (int i = 0; i < 2 && status == ANIC_OK; ++i) {
      const double speed = i == 0 ? 1 : -2;
      status = tick(instance[i], normals, speed * elapsed, vertices, mesh.vertex_count);
      if (t % 20 == 0 && status == ANIC_OK) {
        anic_box box;
        anic_compute_bounds(instance[i], 0, ANIC_WHEN_CURRENT, &box);
        printf("%.2f s, instance %d: x %.4g .. %.4g, y %.4g .. %.4g, z %.4g .. %.4g\n", elapsed, i,
               box.min[0], box.max[0], box.min[1], box.max[1], box.min[2], box.max[2]);
      }
    }
  }
  if (status != ANIC_OK)
    return fail("playing", status);
  free(vertices);
  for (int i = 0; i < 2; ++i)
    anic_destroy_context(instance[i]);
  anic_destroy_normal_plan(normals);
  anic_close_asset(asset);
  free(block);
  return 0;
}
