/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Decodes a file through the C interface, for tests/conformance/run.py: positions and faces of each mesh. The exit status of
 * a file that is refused is its code, and of a broken promise 99: files open in any rounding mode, and leave it alone; formats
 * of 16 bits hold what float32 does.
 *
 * usage: c_decoder FILE.anic OUT
 */
#include <anicodec/anicodec.h>

#include <fenv.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BROKEN_PROMISE = 99 };

static void stop(int status, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vfprintf(stderr, format, arguments);
  va_end(arguments);
  fputc('\n', stderr);
  exit(status);
}

static void* memory(size_t size) {
  void* p = malloc(size + 1);
  if (p == NULL)
    stop(BROKEN_PROMISE, "no memory");
  return p;
}

static void check(anic_status status, const char* call) {
  if (status != ANIC_OK)
    stop(status, "%s: %s", call, anic_get_status_text(status));
}

static unsigned char* read_file(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  long end = -1;
  if (file != NULL && fseek(file, 0, SEEK_END) == 0)
    end = ftell(file);
  if (end < 0 || fseek(file, 0, SEEK_SET) != 0)
    stop(BROKEN_PROMISE, "%s cannot be read", path);
  unsigned char* bytes = memory((size_t)end);
  *size = fread(bytes, 1, (size_t)end, file);
  fclose(file);
  if (*size != (size_t)end)
    stop(BROKEN_PROMISE, "%s cannot be read", path);
  return bytes;
}

/* OUT.EXTENSION, of other meshes than the first OUT.MESH.EXTENSION. */
static FILE* create(const char* out, uint32_t mesh, const char* extension) {
  char* path = memory(strlen(out) + 32);
  if (mesh == 0)
    sprintf(path, "%s.%s", out, extension);
  else
    sprintf(path, "%s.%u.%s", out, (unsigned)mesh, extension);
  FILE* file = fopen(path, "wb");
  if (file == NULL)
    stop(BROKEN_PROMISE, "%s cannot be written", path);
  free(path);
  return file;
}

static void put(FILE* file, uint32_t x) {
  const unsigned char bytes[4] = {x & 255, x >> 8 & 255, x >> 16 & 255, x >> 24};
  fwrite(bytes, 1, sizeof bytes, file);
}

static void put_float(FILE* file, float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  put(file, bits);
}

/* The value of an element of 16 bits. */
static double value_of(anic_format format, uint16_t bits) {
  if (format == ANIC_FORMAT_UNORM16X3 || format == ANIC_FORMAT_UNORM16X4)
    return bits / 65535.0;
  if (format == ANIC_FORMAT_SNORM16X3 || format == ANIC_FORMAT_SNORM16X4)
    return (bits < 32768 ? bits : bits - 65536) / 32767.0;
  const int exponent = bits >> 10 & 31;
  const double size =
      exponent == 0 ? ldexp(bits & 1023, -24) : ldexp(1024 + (bits & 1023), exponent - 25);
  return bits & 0x8000 ? -size : size;
}

static double clamped(double x, double low, double high) {
  return x < low ? low : x > high ? high : x;
}

/* Compares elements of 16 bits with float32 ones, of which they hold (x - offset) / scale. */
static void check_small(anic_format format, const float* wanted, size_t wanted_components,
                        const unsigned char* small, size_t stride, size_t count,
                        const anic_output* out) {
  const size_t components = format % 2 ? 4 : 3;
  const int is_half = format == ANIC_FORMAT_FLOAT16X3 || format == ANIC_FORMAT_FLOAT16X4;
  const double low = format >= ANIC_FORMAT_SNORM16X3 ? -1 : 0;
  for (size_t i = 0; i < count; ++i) {
    for (size_t c = 0; c < components; ++c) {
      uint16_t bits;
      memcpy(&bits, small + i * stride + 2 * c, sizeof bits);
      double x =
          c < 3 ? ((double)wanted[i * wanted_components + c] - out->offset[c]) / out->scale[c] : 1;
      if (!(fabs(x) < 60000))
        continue;
      if (!is_half)
        x = clamped(x, low, 1);
      const double error = fabs(value_of(format, bits) - x);
      if (!(error <= (is_half ? fabs(x) / 1024 + 1e-6 : 2e-5)))
        stop(BROKEN_PROMISE, "format %d, stride %u: number %u of element %u is %g, not %g",
             (int)format, (unsigned)stride, (unsigned)c, (unsigned)i, value_of(format, bits), x);
    }
  }
}

/* Positions and normals of a pose in every format of 16 bits, packed and with a stride. */
static void check_formats(const anic_asset* asset, const anic_context* context, uint32_t mesh,
                          const float* points, uint32_t count) {
  anic_normal_plan* plan;
  anic_output exact = ANIC_INIT(anic_output);
  float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  unsigned char* small = memory((size_t)24 * count);
  check(anic_create_normal_plan(asset, mesh, NULL, NULL, &plan), "anic_create_normal_plan");
  const uint32_t normal_count = anic_get_normal_count(plan);
  float* normals = memory((size_t)12 * normal_count);
  exact.data = normals;
  exact.size = (size_t)12 * normal_count;
  check(anic_write_normals(plan, points, 0, 0, normal_count, &exact), "anic_write_normals");
  for (size_t i = 0; i < (size_t)3 * count; ++i) {
    low[i % 3] = i < 3 || points[i] < low[i % 3] ? points[i] : low[i % 3];
    high[i % 3] = i < 3 || points[i] > high[i % 3] ? points[i] : high[i % 3];
  }
  for (anic_format format = ANIC_FORMAT_FLOAT16X3; format <= ANIC_FORMAT_SNORM16X4; ++format) {
    for (size_t stride = 0; stride <= 24; stride += 24) {
      const size_t step = stride != 0 ? stride : format % 2 ? 8 : 6;
      anic_output out = ANIC_INIT(anic_output);
      out.data = small;
      out.size = step * count;
      out.stride = stride;
      out.format = format;
      for (int c = 0; c < 3; ++c) {
        out.offset[c] = low[c];
        out.scale[c] = high[c] - low[c] > 1e-30F && high[c] - low[c] < 1e30F ? high[c] - low[c] : 1;
      }
      check(anic_write_positions(context, mesh, ANIC_WHEN_CURRENT, 0, count, &out),
            "anic_write_positions");
      check_small(format, points, 3, small, step, count, &out);
      if (normal_count > count)
        continue;
      out.size = step * normal_count;
      for (int c = 0; c < 3; ++c) {
        out.offset[c] = 0;
        out.scale[c] = 1;
      }
      check(anic_write_normals(plan, points, 0, 0, normal_count, &out), "anic_write_normals");
      check_small(format, normals, 3, small, step, normal_count, &out);
    }
  }
  anic_destroy_normal_plan(plan);
  free(normals);
  free(small);
}

/* A PC2 cache; not-a-number in frames without the mesh. */
static void write_cache(const anic_asset* asset, anic_context* context, uint32_t mesh,
                        uint32_t frames, FILE* file) {
  anic_mesh about = ANIC_INIT(anic_mesh);
  check(anic_get_mesh(asset, mesh, &about), "anic_get_mesh");
  const size_t numbers = (size_t)3 * about.vertex_count;
  float* points = memory(sizeof(float) * numbers);
  fwrite("POINTCACHE2", 1, 12, file);
  put(file, 1);
  put(file, about.vertex_count);
  put_float(file, 0);
  put_float(file, 1);
  put(file, frames);
  for (uint32_t f = 0; f < frames; ++f) {
    anic_output out = ANIC_INIT(anic_output);
    out.data = points;
    out.size = sizeof(float) * numbers;
    check(anic_seek_frame(context, f), "anic_seek_frame");
    const anic_status status =
        anic_write_positions(context, mesh, ANIC_WHEN_CURRENT, 0, about.vertex_count, &out);
    if (status != ANIC_E_ABSENT) {
      check(status, "anic_write_positions");
      if (f == 0 || f + 1 == frames)
        check_formats(asset, context, mesh, points, about.vertex_count);
    }
    for (size_t i = 0; i < numbers; ++i)
      put_float(file, status == ANIC_E_ABSENT ? NAN : points[i]);
  }
  free(points);
}

static void write_faces(const anic_asset* asset, uint32_t mesh, FILE* file) {
  anic_polygons faces = ANIC_INIT(anic_polygons);
  check(anic_get_polygons(asset, mesh, &faces), "anic_get_polygons");
  for (uint32_t p = 0; p < faces.polygon_count; ++p) {
    fputc('f', file);
    for (uint32_t c = faces.offsets[p]; c < faces.offsets[p + 1]; ++c)
      fprintf(file, " %u", (unsigned)(faces.corners[c] + 1));
    fputc('\n', file);
  }
}

int main(int argc, char** argv) {
  if (argc != 3)
    stop(BROKEN_PROMISE, "usage: c_decoder FILE.anic OUT");
  size_t size;
  unsigned char* bytes = read_file(argv[1], &size);
  anic_asset* asset;
  anic_context* context;
  anic_failure why = ANIC_INIT(anic_failure);
  anic_asset_info info = ANIC_INIT(anic_asset_info);
#if defined(FE_UPWARD)
  fesetround(FE_UPWARD);
#endif
  const anic_status status = anic_open_asset(bytes, size, NULL, &asset, &why);
#if defined(FE_UPWARD)
  if (fegetround() != FE_UPWARD)
    stop(BROKEN_PROMISE, "opening has changed the rounding mode");
  fesetround(FE_TONEAREST);
#endif
  if (status != ANIC_OK)
    stop(status, "%s: %s: %s", *why.chunk ? why.chunk : "the file", anic_get_status_text(status),
         why.detail);
  check(anic_verify_asset(asset), "anic_verify_asset");
  check(anic_get_asset_info(asset, &info), "anic_get_asset_info");
  check(anic_create_context(asset, NULL, &context), "anic_create_context");
  for (uint32_t m = 0; m < info.mesh_count; ++m) {
    FILE *cache = create(argv[2], m, "pc2"), *faces = create(argv[2], m, "obj");
    write_cache(asset, context, m, info.frame_count, cache);
    write_faces(asset, m, faces);
    if (fclose(cache) != 0 || fclose(faces) != 0)
      stop(BROKEN_PROMISE, "%s cannot be written", argv[2]);
  }
  anic_destroy_context(context);
  anic_close_asset(asset);
  free(bytes);
  return 0;
}
