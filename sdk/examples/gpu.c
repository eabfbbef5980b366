/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * The work of a vertex shader, done in C: the basis of a segment lies in buffers, a frame is a
 * handful of weights. The result is compared with what the library itself makes of the frame.
 *
 * In GLSL, with the basis in 16 bits, two to a uint, and weights and matrices of an instance in a
 * buffer; with one channel a weight is a vec3 and basis(j, v) one number:
 *
 * - vec3 x = (pose_map * vec4(pose(v), 1.0)).xyz;  // pose_map and weights of the vertex' region
 * - for (uint j = 0u; j < components; ++j) x += weights[j] * basis(j, v);
 * - x = (motion * vec4(x + origin, 1.0)).xyz;
 */
#include <anicodec/anicodec.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void transform(const float* map, const float* in, float* out) {
  for (int r = 0; r < 3; ++r)
    out[r] = map[4 * r] * in[0] + map[4 * r + 1] * in[1] + map[4 * r + 2] * in[2] + map[4 * r + 3];
}

/* The vertex shader. */
static void shade(const anic_basis* basis, const anic_part* part, const float* pose_maps,
                  uint32_t v, float* x) {
  const size_t b = v / ANIC_BLOCK_VERTICES, i = v % ANIC_BLOCK_VERTICES;
  const uint32_t wide = basis->wide_components, narrow = basis->components - wide;
  if (part->shape != NULL) { /* ANIC_RECONSTRUCTION_MSGI: a buffer that changes with the frame */
    const uint32_t point = basis->vertex_shape != NULL ? basis->vertex_shape[v] : v;
    transform(part->motion, part->shape + 3 * (size_t)point, x);
    return;
  }
  const size_t region = basis->vertex_region != NULL ? basis->vertex_region[v] : 0;
  const float* weights = part->weights + region * basis->components * basis->weight_channels;
  x[0] = x[1] = x[2] = 0;
  if (basis->pose != NULL) {
    float pose[3];
    for (size_t c = 0; c < 3; ++c)
      pose[c] = basis->pose[(b * 3 + c) * ANIC_BLOCK_VERTICES + i];
    transform(pose_maps + 12 * region, pose, x);
  }
  for (uint32_t j = 0; j < basis->components; ++j) {
    for (size_t c = 0; c < 3; ++c) {
      const size_t channel = basis->channels == 3 ? c : 0;
      const size_t weight = basis->weight_channels == 3 ? 3 * (size_t)j + c : j;
      const float value =
          j < wide
              ? (float)basis
                    ->wide[((b * wide + j) * basis->channels + channel) * ANIC_BLOCK_VERTICES + i]
              : (float)basis->narrow[((b * narrow + j - wide) * basis->channels + channel) *
                                         ANIC_BLOCK_VERTICES +
                                     i];
      x[c] += weights[weight] * value;
    }
  }
  float still[3];
  for (int c = 0; c < 3; ++c)
    still[c] = x[c] + basis->origin[c];
  transform(part->motion, still, x);
}

int main(int argc, char** argv) {
  FILE* file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL) {
    fprintf(stderr, "usage: gpu CLIP.anic\n");
    return 1;
  }
  fseek(file, 0, SEEK_END);
  const size_t size = (size_t)ftell(file);
  unsigned char* bytes = malloc(size);
  rewind(file);
  anic_asset* asset = NULL;
  anic_context* context = NULL;
  if (bytes == NULL || fread(bytes, 1, size, file) != size ||
      anic_open_asset(bytes, size, NULL, &asset, NULL) != ANIC_OK ||
      anic_create_context(asset, NULL, &context) != ANIC_OK)
    return 1;
  fclose(file);
  free(bytes);

  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  anic_get_asset_info(asset, &info);
  anic_get_mesh(asset, 0, &mesh);
  anic_output out = ANIC_INIT(anic_output);
  out.size = 3 * sizeof(float) * mesh.vertex_count;
  float* expected = out.data = malloc(out.size);
  float* made = malloc(out.size);
  double worst = 0;
  for (double t = 0; t <= info.duration; t += 0.05) {
    anic_parts shown = ANIC_INIT(anic_parts);
    if (anic_seek_time(context, t, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP) != ANIC_OK ||
        anic_write_positions(context, 0, ANIC_WHEN_CURRENT, 0, mesh.vertex_count, &out) !=
            ANIC_OK ||
        anic_get_parts(context, 0, ANIC_WHEN_CURRENT, &shown) != ANIC_OK)
      return 1;
    for (uint32_t v = 0; v < 3 * mesh.vertex_count; ++v)
      made[v] = 0;
    for (uint32_t p = 0; p < shown.count; ++p) {
      const anic_part* part = &shown.parts[p];
      anic_basis basis = ANIC_INIT(anic_basis);
      if (anic_get_basis(asset, part->segment, &basis) != ANIC_OK)
        return 1;
      for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
        float x[3];
        shade(&basis, part, shown.pose_maps[p], v, x);
        for (int c = 0; c < 3; ++c)
          made[3 * v + c] += part->share * x[c];
      }
      for (uint32_t k = 0; k < part->correction_count; ++k) { /* few: a second, small buffer */
        for (int c = 0; c < 3; ++c)
          made[3 * part->corrections[k].vertex + c] += part->share * part->corrections[k].delta[c];
      }
    }
    for (uint32_t v = 0; v < 3 * mesh.vertex_count; ++v)
      worst = fmax(worst, fabs((double)made[v] - (double)expected[v]));
  }
  printf("largest difference %.3g, %.3g of the diagonal\n", worst, worst / info.diagonal);
  free(expected);
  free(made);
  anic_destroy_context(context);
  anic_close_asset(asset);
  return worst <= 1e-4 * info.diagonal ? 0 : 1;
}
