/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Flat functions for JavaScript over anicodec.h: numbers cross the edge, and addresses in the
 * module's memory; no struct does. An instance of the module holds one clip. A function that gives
 * several numbers leaves them in web_numbers(), as doubles in the order in which it stores them. */
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
static double numbers[512];
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

static double address(const void* p) {
  return (double)(uintptr_t)p;
}

static int give_box(anic_status status, const anic_box* box) {
  for (int i = 0; i < 3 && status == ANIC_OK; ++i) {
    numbers[i] = (double)box->min[i];
    numbers[3 + i] = (double)box->max[i];
  }
  return status;
}

/* ---- memory and texts ---- */

EXPORT(numbers) double* web_numbers(void) {
  return numbers;
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

/* The fault of the file: text; numbers: offset. */
EXPORT(failure_detail) const char* web_failure_detail(void) {
  numbers[0] = (double)failure.offset;
  return failure.detail != NULL ? failure.detail : "";
}

EXPORT(failure_chunk) const char* web_failure_chunk(void) {
  return failure.chunk;
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

/* The metadata of a file that is not opened. numbers: where in `file`, bytes. */
EXPORT(read_metadata) int web_read_metadata(const void* file, uint32_t size) {
  const char* text;
  size_t bytes;
  const anic_status status = anic_read_metadata(file, size, &text, &bytes);
  numbers[0] = address(text);
  numbers[1] = (double)bytes;
  return status;
}

/* A box of a file that is not opened. numbers: least, greatest. */
EXPORT(read_bounds)

int web_read_bounds(const void* file, uint32_t size, uint32_t mesh, uint32_t first,
                    uint32_t count) {
  anic_box box = {{0}, {0}};
  return give_box(anic_read_bounds(file, size, mesh, first, count, &box), &box);
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
  anic_stream_info info = ANIC_INIT(anic_stream_info);
  const anic_status status = anic_get_stream_info(stream, &info);
  numbers[0] = (double)info.received_bytes;
  numbers[1] = (double)info.file_bytes;
  /* A page opens once before the end: with a layer, where there are any. */
  numbers[2] = info.playable && (info.arrived_layers > 0 || info.layers == 0);
  numbers[3] = info.complete;
  return status;
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
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  const anic_status status = anic_get_asset_info(asset, &info);
  const double all[] = {
      info.mesh_count,
      info.segment_count,
      info.frame_count,
      (double)info.rate_numerator / (info.rate_denominator ? info.rate_denominator : 1),
      info.up,
      info.rate_assumed,
      info.uneven,
      info.loop,
      info.closed,
      info.partial,
      info.start_time,
      info.duration,
      info.loop_duration,
      info.metres_per_unit,
      info.diagonal,
      info.max_error,
      info.rmse,
      info.kg,
      info.max_displacement_error,
      (double)info.resident_bytes,
      (double)info.context_bytes,
      info.origin[0],
      info.origin[1],
      info.origin[2]};
  memcpy(numbers, all, sizeof all);
  return status;
}

EXPORT(name) const char* web_name(void) {
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  return anic_get_asset_info(asset, &info) == ANIC_OK ? info.name : "";
}

EXPORT(clip_count) uint32_t web_clip_count(void) {
  return anic_get_clip_count(asset);
}

EXPORT(clip) int web_clip(uint32_t clip) {
  anic_clip info = ANIC_INIT(anic_clip);
  const anic_status status = anic_get_clip(asset, clip, &info);
  const double all[] = {
      address(info.name),
      info.first_frame,
      info.frame_count,
      (double)info.rate_numerator / (info.rate_denominator ? info.rate_denominator : 1),
      info.rate_assumed,
      info.uneven,
      info.loop,
      info.closed,
      info.open,
      info.start_time,
      info.duration,
      info.loop_duration,
      info.diagonal,
      info.max_error,
      info.rmse,
      info.kg,
      info.max_displacement_error};
  memcpy(numbers, all, sizeof all);
  return status;
}

EXPORT(event_count) uint32_t web_event_count(uint32_t clip) {
  return anic_get_event_count(asset, clip);
}

EXPORT(event) int web_event(uint32_t clip, uint32_t event) {
  anic_event info = ANIC_INIT(anic_event);
  const anic_status status = anic_get_event(asset, clip, event, &info);
  const double all[] = {address(info.name), info.seconds};
  memcpy(numbers, all, sizeof all);
  return status;
}

static int give_motion(anic_status status, const anic_root_motion* motion) {
  numbers[0] = motion->turn;
  for (int i = 0; i < 3; ++i) {
    numbers[1 + i] = motion->move[i];
    numbers[4 + i] = motion->pivot[i];
  }
  for (int i = 0; i < 12; ++i)
    numbers[7 + i] = motion->matrix[i];
  return status;
}

EXPORT(root_motion)

int web_root_motion(uint32_t clip, double seconds, int sampling, int wrap) {
  anic_root_motion motion = ANIC_INIT(anic_root_motion);
  const anic_status status = anic_get_root_motion(asset, clip, seconds, sampling, wrap, &motion);
  return give_motion(status, &motion);
}

EXPORT(root_step)

int web_root_step(uint32_t clip, double from, double to, int sampling, int wrap) {
  anic_root_motion motion = ANIC_INIT(anic_root_motion);
  const anic_status status = anic_get_root_step(asset, clip, from, to, sampling, wrap, &motion);
  return give_motion(status, &motion);
}

EXPORT(mesh) int web_mesh(uint32_t mesh) {
  anic_mesh info = ANIC_INIT(anic_mesh);
  const anic_status status = anic_get_mesh(asset, mesh, &info);
  const double all[] = {info.vertex_count, info.coded_vertex_count, info.polygon_count,
                        info.corner_count, info.triangle_count,     info.attribute_count,
                        address(info.name)};
  memcpy(numbers, all, sizeof all);
  return status;
}

EXPORT(polygons) int web_polygons(uint32_t mesh) {
  anic_polygons polygons = ANIC_INIT(anic_polygons);
  const anic_status status = anic_get_polygons(asset, mesh, &polygons);
  const double all[] = {polygons.polygon_count, address(polygons.offsets),
                        address(polygons.corners)};
  memcpy(numbers, all, sizeof all);
  return status;
}

EXPORT(attribute) int web_attribute(uint32_t mesh, uint32_t attribute) {
  anic_attribute a = ANIC_INIT(anic_attribute);
  const anic_status status = anic_get_attribute(asset, mesh, attribute, &a);
  const double all[] = {a.kind,          a.domain,          a.count,
                        a.components,    a.label_count,     a.moves,
                        address(a.name), address(a.values), address(a.labels)};
  memcpy(numbers, all, sizeof all);
  return status;
}

EXPORT(label_name) const char* web_label_name(uint32_t mesh, uint32_t attribute, uint32_t label) {
  return anic_get_label_name(asset, mesh, attribute, label);
}

EXPORT(material) int web_material(uint32_t mesh, uint32_t attribute, uint32_t label) {
  anic_material m = ANIC_INIT(anic_material);
  const anic_status status = anic_get_material(asset, mesh, attribute, label, &m);
  const double all[] = {m.base_colour[0],
                        m.base_colour[1],
                        m.base_colour[2],
                        m.base_colour[3],
                        m.metallic,
                        m.roughness,
                        m.emissive[0],
                        m.emissive[1],
                        m.emissive[2],
                        m.alpha,
                        m.alpha_cutoff,
                        m.double_sided,
                        address(m.base_colour_texture),
                        address(m.metallic_roughness_texture),
                        address(m.normal_texture),
                        address(m.occlusion_texture),
                        address(m.emissive_texture)};
  memcpy(numbers, all, sizeof all);
  return status;
}

EXPORT(frame_time) double web_frame_time(uint32_t frame) {
  return anic_get_frame_time(asset, frame);
}

EXPORT(clip_bounds) int web_clip_bounds(uint32_t mesh) {
  anic_box box = {{0}, {0}};
  return give_box(anic_get_clip_bounds(asset, mesh, &box), &box);
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
  anic_box box = {{0}, {0}};
  return give_box(anic_compute_bounds(context, mesh, ANIC_WHEN_CURRENT, &box), &box);
}

/* numbers: position, normal, tangent */
EXPORT(surface_frame)

int web_surface_frame(const anic_context* context, uint32_t mesh, uint32_t a, uint32_t b,
                      uint32_t c, double weight_a, double weight_b, double weight_c) {
  const anic_surface_point point = {{a, b, c}, {(float)weight_a, (float)weight_b, (float)weight_c}};
  anic_surface_frame frame = {{0}, {0}, {0}};
  const anic_status status =
      anic_get_surface_frame(context, mesh, ANIC_WHEN_CURRENT, &point, &frame);
  for (int i = 0; i < 3; ++i) {
    numbers[i] = (double)frame.position[i];
    numbers[3 + i] = (double)frame.normal[i];
    numbers[6 + i] = (double)frame.tangent[i];
  }
  return status;
}

/* values: origin, direction, farthest; numbers: distance, triangle, weights, side */
EXPORT(intersect_ray)

int web_intersect_ray(const anic_context* context, uint32_t mesh, const float* values, int32_t side,
                      const uint32_t* triangles, uint32_t triangle_count, float* work,
                      uint32_t work_size) {
  anic_ray ray = ANIC_INIT(anic_ray);
  anic_hit hit;
  memcpy(ray.origin, values, sizeof ray.origin);
  memcpy(ray.direction, values + 3, sizeof ray.direction);
  ray.farthest = values[6];
  ray.side = side;
  const anic_status status = anic_intersect_ray(context, mesh, ANIC_WHEN_CURRENT, &ray, triangles,
                                                triangle_count, work, work_size, &hit);
  if (status == ANIC_OK) {
    const double all[] = {(double)hit.distance,         hit.triangle,
                          (double)hit.point.weights[0], (double)hit.point.weights[1],
                          (double)hit.point.weights[2], hit.side};
    memcpy(numbers, all, sizeof all);
  }
  return status;
}

/* ---- render vertices ---- */

/* numbers: status, address of the plan */
EXPORT(create_plan)

anic_render_plan* web_create_plan(uint32_t mesh, double crease_angle, int32_t source_edges) {
  anic_render_plan_options options = ANIC_INIT(anic_render_plan_options);
  anic_render_plan* plan = NULL;
  options.crease_angle = crease_angle;
  options.source_edges = source_edges != 0;
  /* The frame must show the mesh, which may not be there in the first ones. */
  do
    numbers[0] = anic_create_render_plan(asset, mesh, &options, NULL, &plan);
  while (numbers[0] == ANIC_E_ABSENT && ++options.reference_frame > 0);
  return plan;
}

EXPORT(destroy_plan) void web_destroy_plan(anic_render_plan* plan) {
  anic_destroy_render_plan(plan);
}

EXPORT(plan_info) int web_plan_info(const anic_render_plan* plan) {
  anic_render_info info = ANIC_INIT(anic_render_info);
  const anic_status status = anic_get_render_info(plan, &info);
  const double all[] = {info.vertex_count,
                        info.triangle_count,
                        info.group_count,
                        address(info.vertices),
                        address(info.corners),
                        address(info.indices),
                        address(info.triangle_polygons),
                        address(info.group_materials),
                        address(info.group_begin),
                        info.normal_group_count,
                        address(info.normal_groups),
                        address(info.normal_centres),
                        address(info.normal_begin),
                        address(info.normal_corners)};
  memcpy(numbers, all, sizeof all);
  return status;
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
  anic_basis b = ANIC_INIT(anic_basis);
  const anic_status status = anic_get_basis(asset, segment, &b);
  const double all[] = {b.kind,
                        b.reconstruction,
                        b.target,
                        b.mesh,
                        b.attribute,
                        b.first_component,
                        b.first_frame,
                        b.frame_count,
                        b.vertex_count,
                        b.components,
                        b.wide_components,
                        b.channels,
                        b.weight_channels,
                        (double)b.origin[0],
                        (double)b.origin[1],
                        (double)b.origin[2],
                        address(b.pose),
                        address(b.wide),
                        address(b.narrow),
                        (double)b.pose_count,
                        (double)b.wide_count,
                        (double)b.narrow_count,
                        address(b.vertex_shape),
                        b.regions,
                        address(b.vertex_region)};
  memcpy(numbers, all, sizeof all);
  return status;
}

/* numbers: count of parts; then 31 for each: segment, share, addresses of weights, shape and
 * corrections, count of corrections, pose_map, motion, address of the pose_maps of regions */
EXPORT(parts) int web_parts(const anic_context* context, uint32_t mesh) {
  anic_parts parts = ANIC_INIT(anic_parts);
  const anic_status status = anic_get_parts(context, mesh, ANIC_WHEN_CURRENT, &parts);
  double* to = numbers;
  *to++ = parts.count;
  for (uint32_t p = 0; p < parts.count; ++p) {
    const anic_part* part = &parts.parts[p];
    *to++ = part->segment;
    *to++ = (double)part->share;
    *to++ = address(part->weights);
    *to++ = address(part->shape);
    *to++ = address(part->corrections);
    *to++ = part->correction_count;
    for (int i = 0; i < 12; ++i)
      *to++ = (double)part->pose_map[i];
    for (int i = 0; i < 12; ++i)
      *to++ = (double)part->motion[i];
    *to++ = address(parts.pose_maps[p]);
  }
  return status;
}
