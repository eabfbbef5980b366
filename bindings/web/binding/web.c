/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Flat functions for JavaScript over anicodec.h: numbers cross the edge, and addresses in the
 * module's memory. An instance of the module holds one clip. A function that gives more than a number
 * leaves a struct at web_result(), whose fields JavaScript reads by the tables of interface.js. */
#include "bindings/web/binding/struct_layout.h"

#include <anicodec/anicodec.h>

#include <stdlib.h>
#include <string.h>

#define EXPORT(name) __attribute__((export_name("web_" #name), visibility("default")))
#define IMPORT(name) __attribute__((import_module("env"), import_name("web_" #name)))

/* Gets the share of an opening that is done; anything but 0 stops it. */
IMPORT(progress) int web_progress(double done);

static anic_asset* asset;
static anic_stream* stream;
static anic_failure failure;
static int is_without_memory;

static union {
  anic_asset_info info;
  anic_clip clip;
  anic_event event;
  anic_root_motion motion;
  anic_mesh mesh;
  anic_polygons polygons;
  anic_attribute attribute;
  anic_material material;
  anic_box box;
  anic_surface_frame frame;
  anic_hit hit;
  anic_render_info render;
  anic_basis basis;
  anic_parts parts;
  anic_stream_info stream;
  uint32_t numbers[2];
} result;

static char* clip_names_text;
static const char** clip_names;
static uint32_t clip_names_count;

static void* allocate(void* user, size_t size, size_t alignment) {
  void* memory;
  (void)user;
  memory = alignment <= 8
               ? malloc(size)
               : aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == NULL)
    is_without_memory = 1; /* the library throws, and the module stops */
  return memory;
}

static void release(void* user, void* memory, size_t size) {
  (void)user;
  (void)size;
  free(memory);
}

static int report(void* user, double done) {
  (void)user;
  return web_progress(done);
}

static anic_options options_of(double quality, uint32_t flags, double max_bytes) {
  anic_options options = ANIC_INIT(anic_options);
  options.quality = quality;
  options.flags = flags;
  options.max_bytes = (uint64_t)max_bytes;
  options.allocator.allocate = allocate;
  options.allocator.release = release;
  options.progress.report = report;
  options.clips = clip_names;
  options.clip_count = clip_names_count;
  return options;
}

static anic_output output_of(void* data, uint32_t size, uint32_t stride, int32_t format) {
  anic_output output = ANIC_INIT(anic_output);
  output.data = data;
  output.size = size;
  output.stride = stride;
  output.format = format;
  output.scale[0] = output.scale[1] = output.scale[2] = 1;
  return output;
}

/* ---- memory and texts ---- */

/* The struct or the numbers that the last call gave. */
EXPORT(result) void* web_result(void) {
  return &result;
}

EXPORT(allocate) void* web_allocate(uint32_t size) {
  return malloc(size > 0 ? size : 1);
}

EXPORT(release) void web_release(void* memory) {
  free(memory);
}

EXPORT(is_without_memory) int web_is_without_memory(void) {
  return is_without_memory;
}

EXPORT(status_text) const char* web_status_text(int32_t status) {
  return anic_get_status_text(status);
}

/* The fault of the file: anic_failure. */
EXPORT(failure) const void* web_failure(void) {
  return &failure;
}

/* ---- opening ---- */

/* Names of the clips that will be opened, each behind the last with a zero at its end; none: all.
 * Takes memory of web_allocate(). */
EXPORT(choose_clips) int web_choose_clips(char* names, uint32_t size) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < size; ++i)
    count += names[i] == 0;
  free(clip_names_text);
  free((void*)clip_names);
  clip_names_text = names;
  clip_names_count = 0;
  clip_names = malloc(count * sizeof *clip_names + 1);
  if (clip_names == NULL)
    return ANIC_E_MEMORY;
  for (uint32_t begin = 0; clip_names_count < count; begin += (uint32_t)strlen(names + begin) + 1)
    clip_names[clip_names_count++] = names + begin;
  return ANIC_OK;
}

/* The metadata of a file that is not opened: two numbers, where it is and how many bytes. */
EXPORT(read_metadata) int web_read_metadata(const void* file, uint32_t size) {
  const char* text;
  size_t bytes;
  const anic_status status = anic_read_metadata(file, size, &text, &bytes);
  result.numbers[0] = (uint32_t)(uintptr_t)text;
  result.numbers[1] = (uint32_t)bytes;
  return status;
}

/* A box of a file that is not opened. */
EXPORT(read_bounds)

int web_read_bounds(const void* file, uint32_t size, uint32_t mesh, uint32_t first,
                    uint32_t count) {
  return anic_read_bounds(file, size, mesh, first, count, &result.box);
}

EXPORT(open)

int web_open(const void* file, uint32_t size, double quality, uint32_t flags, double max_bytes) {
  const anic_options options = options_of(quality, flags, max_bytes);
  failure = ANIC_INIT(anic_failure);
  return anic_open_asset(file, size, &options, &asset, &failure);
}

EXPORT(stream_begin) int web_stream_begin(double quality, uint32_t flags, double max_bytes) {
  const anic_options options = options_of(quality, flags, max_bytes);
  return anic_create_stream(&options, &stream);
}

EXPORT(stream_push) int web_stream_push(const void* bytes, uint32_t size) {
  const anic_status status = anic_push_bytes(stream, bytes, size);
  failure = ANIC_INIT(anic_failure);
  anic_get_stream_failure(stream, &failure);
  return status;
}

EXPORT(stream_info) int web_stream_info(void) {
  result.stream = ANIC_INIT(anic_stream_info);
  return anic_get_stream_info(stream, &result.stream);
}

/* Turns to the next file of a live stream. */
EXPORT(stream_advance) int web_stream_advance(void) {
  const anic_status status = anic_advance_stream(stream);
  failure = ANIC_INIT(anic_failure);
  anic_get_stream_failure(stream, &failure);
  return status;
}

/* Opens what has arrived, in place of what was open. */
EXPORT(stream_open) int web_stream_open(void) {
  failure = ANIC_INIT(anic_failure);
  anic_close_asset(asset); /* first, for its memory */
  asset = NULL;
  return anic_open_asset_from_stream(stream, &asset, &failure);
}

EXPORT(stream_end) void web_stream_end(void) {
  anic_destroy_stream(stream);
  stream = NULL;
}

/* Compares the hashes in the file with what was decoded. */
EXPORT(verify) int web_verify(void) {
  return anic_verify_asset(asset);
}

/* ---- what is in it ---- */

EXPORT(info) int web_info(void) {
  result.info = ANIC_INIT(anic_asset_info);
  return anic_get_asset_info(asset, &result.info);
}

EXPORT(clip_count) uint32_t web_clip_count(void) {
  return anic_get_clip_count(asset);
}

EXPORT(clip) int web_clip(uint32_t clip) {
  result.clip = ANIC_INIT(anic_clip);
  return anic_get_clip(asset, clip, &result.clip);
}

EXPORT(event_count) uint32_t web_event_count(uint32_t clip) {
  return anic_get_event_count(asset, clip);
}

EXPORT(event) int web_event(uint32_t clip, uint32_t event) {
  result.event = ANIC_INIT(anic_event);
  return anic_get_event(asset, clip, event, &result.event);
}

EXPORT(root_motion)

int web_root_motion(uint32_t clip, double seconds, int sampling, int wrap) {
  result.motion = ANIC_INIT(anic_root_motion);
  return anic_get_root_motion(asset, clip, seconds, sampling, wrap, &result.motion);
}

EXPORT(root_step)

int web_root_step(uint32_t clip, double from, double to, int sampling, int wrap) {
  result.motion = ANIC_INIT(anic_root_motion);
  return anic_get_root_step(asset, clip, from, to, sampling, wrap, &result.motion);
}

EXPORT(mesh) int web_mesh(uint32_t mesh) {
  result.mesh = ANIC_INIT(anic_mesh);
  return anic_get_mesh(asset, mesh, &result.mesh);
}

EXPORT(polygons) int web_polygons(uint32_t mesh) {
  result.polygons = ANIC_INIT(anic_polygons);
  return anic_get_polygons(asset, mesh, &result.polygons);
}

EXPORT(attribute) int web_attribute(uint32_t mesh, uint32_t attribute) {
  result.attribute = ANIC_INIT(anic_attribute);
  return anic_get_attribute(asset, mesh, attribute, &result.attribute);
}

EXPORT(label_name) const char* web_label_name(uint32_t mesh, uint32_t attribute, uint32_t label) {
  return anic_get_label_name(asset, mesh, attribute, label);
}

EXPORT(material) int web_material(uint32_t mesh, uint32_t attribute, uint32_t label) {
  result.material = ANIC_INIT(anic_material);
  return anic_get_material(asset, mesh, attribute, label, &result.material);
}

EXPORT(frame_time) double web_frame_time(uint32_t frame) {
  return anic_get_frame_time(asset, frame);
}

EXPORT(clip_bounds) int web_clip_bounds(uint32_t mesh) {
  return anic_get_clip_bounds(asset, mesh, &result.box);
}

/* ---- playing ---- */

EXPORT(create_context) anic_context* web_create_context(void) {
  anic_context* context = NULL;
  anic_create_context(asset, NULL, &context);
  return context;
}

EXPORT(destroy_context) void web_destroy_context(anic_context* context) {
  anic_destroy_context(context);
}

EXPORT(seek_time)

int web_seek_time(anic_context* context, double seconds, int32_t sampling, int32_t wrap) {
  return anic_seek_time(context, seconds, sampling, wrap);
}

EXPORT(seek_frame) int web_seek_frame(anic_context* context, uint32_t frame) {
  return anic_seek_frame(context, frame);
}

EXPORT(set_clip) int web_set_clip(anic_context* context, uint32_t clip) {
  return anic_set_clip(context, clip);
}

EXPORT(blend)

int web_blend(anic_context* context, uint32_t clip, double seconds, int32_t sampling, int32_t wrap,
              double weight) {
  return anic_blend(context, clip, seconds, sampling, wrap, weight);
}

EXPORT(write_positions)

int web_write_positions(const anic_context* context, uint32_t mesh, uint32_t count, void* data,
                        uint32_t size) {
  const anic_output output = output_of(data, size, 0, ANIC_FORMAT_FLOAT32X3);
  return anic_write_positions(context, mesh, ANIC_WHEN_CURRENT, 0, count, &output);
}

EXPORT(write_attribute)

int web_write_attribute(const anic_context* context, uint32_t mesh, uint32_t attribute,
                        uint32_t count, void* data, uint32_t size) {
  anic_value_output output = ANIC_INIT(anic_value_output);
  output.data = data;
  output.size = size;
  return anic_write_attribute(context, mesh, attribute, ANIC_WHEN_CURRENT, 0, count, &output);
}

EXPORT(compute_bounds) int web_compute_bounds(const anic_context* context, uint32_t mesh) {
  return anic_compute_bounds(context, mesh, ANIC_WHEN_CURRENT, &result.box);
}

EXPORT(surface_frame)

int web_surface_frame(const anic_context* context, uint32_t mesh, uint32_t a, uint32_t b,
                      uint32_t c, double weight_a, double weight_b, double weight_c) {
  const anic_surface_point point = {{a, b, c}, {(float)weight_a, (float)weight_b, (float)weight_c}};
  return anic_get_surface_frame(context, mesh, ANIC_WHEN_CURRENT, &point, &result.frame);
}

/* values: origin, direction, farthest */
EXPORT(intersect_ray)

int web_intersect_ray(const anic_context* context, uint32_t mesh, const float* values, int32_t side,
                      const uint32_t* triangles, uint32_t triangle_count, float* work,
                      uint32_t work_size) {
  anic_ray ray = ANIC_INIT(anic_ray);
  memcpy(ray.origin, values, sizeof ray.origin);
  memcpy(ray.direction, values + 3, sizeof ray.direction);
  ray.farthest = values[6];
  ray.side = side;
  return anic_intersect_ray(context, mesh, ANIC_WHEN_CURRENT, &ray, triangles, triangle_count, work,
                            work_size, &result.hit);
}

/* ---- render vertices ---- */

/* The address of the plan; without one a number: the status. */
EXPORT(create_plan)

anic_render_plan* web_create_plan(uint32_t mesh, double crease_angle, int32_t source_edges) {
  anic_render_plan_options options = ANIC_INIT(anic_render_plan_options);
  anic_render_plan* plan = NULL;
  anic_status status;
  options.crease_angle = crease_angle;
  options.source_edges = source_edges != 0;
  /* The frame must show the mesh, which may not be there in the first ones. */
  do
    status = anic_create_render_plan(asset, mesh, &options, NULL, &plan);
  while (status == ANIC_E_ABSENT && ++options.reference_frame > 0);
  result.numbers[0] = (uint32_t)status;
  return plan;
}

EXPORT(destroy_plan) void web_destroy_plan(anic_render_plan* plan) {
  anic_destroy_render_plan(plan);
}

EXPORT(plan_info) int web_plan_info(const anic_render_plan* plan) {
  result.render = ANIC_INIT(anic_render_info);
  return anic_get_render_info(plan, &result.render);
}

EXPORT(plan_positions)

int web_plan_positions(const anic_render_plan* plan, const anic_context* context, uint32_t count,
                       void* data, uint32_t size) {
  const anic_output output = output_of(data, size, 0, ANIC_FORMAT_FLOAT32X3);
  return anic_write_render_positions(plan, context, ANIC_WHEN_CURRENT, 0, count, &output);
}

EXPORT(plan_normals)

int web_plan_normals(const anic_render_plan* plan, const float* positions, uint32_t count,
                     void* data, uint32_t size, int32_t format) {
  const anic_output output = output_of(data, size, 0, format);
  return anic_write_render_normals(plan, positions, 0, 0, count, &output);
}

EXPORT(plan_attribute)

int web_plan_attribute(const anic_render_plan* plan, const anic_context* context,
                       uint32_t attribute, uint32_t count, void* data, uint32_t size,
                       uint32_t components) {
  anic_value_output output = ANIC_INIT(anic_value_output);
  output.data = data;
  output.size = size;
  output.components = components;
  return anic_write_render_attribute(plan, context, attribute, ANIC_WHEN_CURRENT, 0, count,
                                     &output);
}

/* ---- GPU ---- */

EXPORT(basis) int web_basis(uint32_t segment) {
  result.basis = ANIC_INIT(anic_basis);
  return anic_get_basis(asset, segment, &result.basis);
}

EXPORT(parts) int web_parts(const anic_context* context, uint32_t mesh) {
  result.parts = ANIC_INIT(anic_parts);
  return anic_get_parts(context, mesh, ANIC_WHEN_CURRENT, &result.parts);
}
