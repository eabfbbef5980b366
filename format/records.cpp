// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/records.h"

#include "format/container.h"
#include "format/record_fields.h"
#include "format/sort.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace anicodec {
namespace {

constexpr uint8_t kAssumed = 1, kLoop = 2, kClosed = 4, kMassaged = 8, kTimes = 16,
                  kAttributeErrors = 32, kEvents = 64;

/// Optional field of the limits.
constexpr uint32_t kContinuedMeshes = 1;

/// Optional field of the clips.
constexpr uint32_t kOrigin = 1;

/// Flags of a segment in the limits.
constexpr uint8_t kExact = 1, kRegions = 2, kOfAttribute = 4, kDraco = 8, kLearns = 16;
constexpr uint32_t kContinued = 1;  // tag of a field of SEGM
constexpr uint64_t kMaxAttributeNumbers = uint64_t{1} << 46;

bool is_length(double x) {
  return std::isfinite(x) && x >= 0;
}

Status finished(const ByteReader& reader) {
  return reader.finished() ? Status::kOk : Status::kRecord;
}

bool is_of_attribute(const Limits::Segment& s) {
  return s.attribute != kPositions;
}

/// Whether the format has segments like this: what is not listed here has no meaning yet.
bool is_supported(uint8_t basis, uint8_t reconstruction, uint8_t flags) {
  const auto is = [](uint8_t field, auto value) { return field == static_cast<uint8_t>(value); };
  const bool keyframes = is(basis, BasisKind::kKeyframes);
  const bool trajectories = is(basis, BasisKind::kEigentrajectories);
  return basis <= static_cast<uint8_t>(BasisKind::kEigentrajectories) &&
         (is(reconstruction, Reconstruction::kLinear) ||
          (is(reconstruction, Reconstruction::kMsgi) && keyframes)) &&
         !(flags & ~(kExact | kRegions | kOfAttribute | kDraco | kLearns)) &&
         (!(flags & kLearns) || !keyframes) && (!(flags & kRegions) || trajectories) &&
         (!(flags & kDraco) || keyframes) &&
         (!(flags & kOfAttribute) || (trajectories && flags == kOfAttribute));
}

void write_mesh(const Limits::Mesh& m, ByteWriter& w) {
  for (uint32_t x :
       {m.source_vertices, m.coded_vertices, m.triangles, m.polygons, m.corners, m.attributes})
    w.varint(x);
  if (m.attributes > 0) {
    w.varint(m.attribute_labels);
    w.varint(m.attribute_head);
    w.varint(m.attribute_numbers);
  }
}

Status read_mesh(ByteReader& r, Limits::Mesh* m) {
  constexpr uint32_t kLeastHead = 4;  // of an attribute
  for (uint32_t* x : {&m->source_vertices, &m->coded_vertices, &m->triangles, &m->polygons})
    *x = r.varint32(kMaxVertices);
  m->corners = r.varint32();
  m->attributes = r.varint32(kMaxAttributes);
  if (m->attributes > 0) {
    m->attribute_labels = r.varint32();
    m->attribute_head = r.varint32();
    m->attribute_numbers = r.varint(kMaxAttributeNumbers);
  }
  const bool ok = r.ok() && m->triangles <= kMaxTriangles && m->source_vertices > 0 &&
                  m->coded_vertices > 0 && m->coded_vertices <= m->source_vertices &&
                  m->attribute_head / kLeastHead >= m->attributes &&
                  m->attribute_head >= m->attribute_labels;
  return ok ? Status::kOk : Status::kRecord;
}

void write_segment(const Limits::Segment& s, ByteWriter& w) {
  w.varint(s.mesh);
  w.u8(static_cast<uint8_t>(s.kind));
  w.u8(static_cast<uint8_t>(s.reconstruction));
  w.u8(static_cast<uint8_t>((s.exact ? kExact : 0) | (s.regions > 1 ? kRegions : 0) |
                            (is_of_attribute(s) ? kOfAttribute : 0) |
                            (s.draco_bytes > 0 ? kDraco : 0) | (s.learns ? kLearns : 0)));
  for (uint32_t x : {s.first_frame, s.frames, s.components, s.wide_components, s.corrections})
    w.varint(x);
  if (s.regions > 1)
    w.varint(s.regions);
  if (is_of_attribute(s)) {
    w.varint(s.attribute);
    w.varint(s.first_component / 3);
    w.u8(static_cast<uint8_t>(s.domain));
    w.varint(s.entries);
  }
  if (s.draco_bytes > 0) {
    w.varint(s.draco_bytes);
    w.varint(s.draco_points);
  }
}

/// Reads the optional fields at the end. False: one is malformed.
bool read_limit_fields(ByteReader& r, Limits* out) {
  out->continued_meshes.reset();
  RecordField field;
  while (read_field(r, &field)) {
    if (field.tag != kContinuedMeshes)
      continue;
    if (field.value.size != sizeof(uint64_t))
      return false;
    out->continued_meshes = ByteReader(field.value).u64();
  }
  return r.finished();
}

/// Reads a segment of a file of so many meshes and frames.
Status read_segment(ByteReader& r, size_t meshes, uint32_t frames, Limits::Segment* s) {
  s->mesh = static_cast<uint16_t>(r.varint32(static_cast<uint32_t>(meshes) - 1));
  const uint8_t basis = r.u8(), reconstruction = r.u8(), flags = r.u8();
  if (!r.ok())
    return Status::kRecord;
  if (!is_supported(basis, reconstruction, flags))
    return Status::kFeature;
  s->kind = static_cast<BasisKind>(basis);
  s->reconstruction = static_cast<Reconstruction>(reconstruction);
  s->exact = flags & kExact;
  s->learns = flags & kLearns;
  s->first_frame = r.varint32(kMaxFrames);
  s->frames = r.varint32(kMaxFrames);
  s->components = r.varint32(kMaxComponents);
  s->wide_components = r.varint32(s->components);
  s->corrections = r.varint32();
  if (flags & kRegions)
    s->regions = r.varint32(kMaxRegions);
  if (flags & kOfAttribute) {
    s->attribute = r.varint32(kMaxAttributes - 1);
    s->first_component = 3 * r.varint32((kMaxAttributeComponents - 1) / 3);
    const uint8_t domain = r.u8();
    if (r.ok() && domain > static_cast<uint8_t>(AttributeDomain::kPolygon))
      return Status::kFeature;
    s->domain = static_cast<AttributeDomain>(domain);
    s->entries = r.varint32(kMaxVertices);
  }
  if (flags & kDraco) {
    s->draco_bytes = r.varint32();
    s->draco_points = r.varint32();
  }
  const bool ok = r.ok() && !((flags & kRegions) && s->regions < 2) &&
                  !((flags & kDraco) && (s->draco_bytes == 0 || s->draco_points == 0)) &&
                  s->frames > 0 && s->first_frame < frames && s->frames <= frames - s->first_frame;
  return ok ? Status::kOk : Status::kRecord;
}

}  // namespace

bool Limits::Mesh::operator==(const Mesh& other) const {
  return source_vertices == other.source_vertices && coded_vertices == other.coded_vertices &&
         triangles == other.triangles && polygons == other.polygons && corners == other.corners &&
         attributes == other.attributes && attribute_labels == other.attribute_labels &&
         attribute_head == other.attribute_head && attribute_numbers == other.attribute_numbers;
}

Bytes Limits::write() const {
  ByteWriter w;
  w.varint(clip_frames.empty() ? 1 : clip_frames.size());
  w.varint(meshes.size());
  w.varint(segments.size());
  if (clip_frames.empty())
    w.varint(frames);
  for (uint32_t count : clip_frames)
    w.varint(count);
  for (const Mesh& m : meshes)
    write_mesh(m, w);
  for (const Segment& s : segments)
    write_segment(s, w);
  w.varint(root_frames);
  if (continued_meshes) {
    ByteWriter value;
    value.u64(*continued_meshes);
    write_field(w, kContinuedMeshes, value.bytes());
  }
  return std::move(w.bytes());
}

Status Limits::read(ByteView view, Limits* out) {
  ByteReader r(view);
  uint32_t clip_count = r.varint32(kMaxFrames);
  uint32_t mesh_count = r.varint32(kMaxMeshes);
  uint32_t segment_count = r.varint32(kMaxFrames);
  // A clip takes at least a byte, a mesh 6, a segment 9: no allocation beyond what the chunk can
  // hold.
  if (!r.ok() || clip_count > r.remaining() || mesh_count > r.remaining() / 6 ||
      segment_count > r.remaining() / 9)
    return Status::kRecord;
  if (clip_count == 0 || mesh_count == 0 || segment_count == 0)
    return Status::kRecord;
  out->frames = 0;
  out->clip_frames.assign(clip_count, 0);
  for (uint32_t& count : out->clip_frames) {
    count = r.varint32(kMaxFrames - out->frames);
    if (!r.ok() || count == 0)
      return Status::kRecord;
    out->frames += count;
  }
  out->meshes.assign(mesh_count, {});
  out->segments.assign(segment_count, {});
  for (Mesh& m : out->meshes) {
    if (Status s = read_mesh(r, &m); s != Status::kOk)
      return s;
  }
  for (Segment& s : out->segments) {
    if (Status status = read_segment(r, mesh_count, out->frames, &s); status != Status::kOk)
      return status;
  }
  out->root_frames = r.varint32(out->frames);
  if (!read_limit_fields(r, out))
    return Status::kRecord;
  const Vector<uint32_t> order = out->segments_by_frame();
  for (size_t i = 1; i < order.size(); ++i) {
    const Segment &a = out->segments[order[i - 1]], &b = out->segments[order[i]];
    if (a.same_track(b) && b.first_frame - a.first_frame < a.frames)
      return Status::kRecord;
  }
  for (const Segment& s : out->segments) {
    const Mesh& mesh = out->meshes[s.mesh];
    if (is_of_attribute(s) &&
        (s.attribute >= mesh.attributes || s.entries == 0 || s.entries > mesh.elements(s.domain)))
      return Status::kRecord;
  }
  return Status::kOk;
}

uint64_t Limits::features() const {
  uint64_t features = 0;
  for (const Segment& s : segments)
    features |= (s.draco_bytes > 0 ? kDracoFeature : 0) |
                (s.reconstruction == Reconstruction::kMsgi ? kMsgiFeature : 0) |
                (s.learns ? kLearningFeature : 0);
  return features;
}

Vector<uint32_t> Limits::segments_by_frame() const {
  Vector<uint32_t> order(segments.size());
  std::iota(order.begin(), order.end(), 0U);
  auto at = [&](uint32_t i) {
    const Segment& s = segments[i];
    return std::tuple(s.attribute != kPositions, s.mesh, s.attribute, s.first_component,
                      s.first_frame, i);
  };
  sort_ascending(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return at(a) < at(b); });
  return order;
}

Vector<uint32_t> Limits::runs(uint32_t first, uint32_t count) const {
  Vector<uint32_t> result;
  uint32_t begin = 0;
  for (uint32_t frames_of_clip : clip_frames) {
    const uint32_t from = std::max(first, begin);
    begin += frames_of_clip;
    const uint32_t to = std::min(first + count, begin);
    if (from < to)
      result.push_back(to - from);
  }
  return result;
}

namespace {

void write_clip(const ClipRecord& clip, ByteWriter& w) {
  w.text(clip.name);
  w.varint(clip.rate_numerator);
  w.varint(clip.rate_denominator);
  w.u8(static_cast<uint8_t>((clip.rate_assumed ? kAssumed : 0) | (clip.loop ? kLoop : 0) |
                            (clip.closed ? kClosed : 0) | (clip.massaged ? kMassaged : 0) |
                            (clip.times.empty() ? 0 : kTimes) |
                            (clip.attribute_errors.empty() ? 0 : kAttributeErrors) |
                            (clip.events.empty() ? 0 : kEvents)));
  w.f64(clip.start_time);
  for (double t : clip.times)
    w.f64(t);
  w.u8(static_cast<uint8_t>(clip.asked));
  for (double x : {clip.asked_value, clip.max_error, clip.rmse, clip.kg,
                   clip.max_displacement_error, clip.diagonal})
    w.f64(x);
  if (clip.massaged) {
    w.f64(clip.surface_error);
    w.f64(clip.surface_error_mean);
  }
  if (!clip.attribute_errors.empty()) {
    w.varint(clip.attribute_errors.size());
    for (const AttributeError& e : clip.attribute_errors) {
      w.varint(e.mesh);
      w.varint(e.attribute);
      w.f64(e.max_error);
      w.f64(e.rmse);
    }
  }
  if (!clip.events.empty()) {
    w.varint(clip.events.size());
    for (const ClipEvent& event : clip.events) {
      w.text(event.name);
      w.f64(event.seconds);
    }
  }
}

/// Reads the times of a clip's frames. False: out of range.
bool read_times(ByteReader& r, ClipRecord* out) {
  if (r.remaining() / 8 < out->frames)
    return false;
  out->times.resize(out->frames);
  double before = -HUGE_VAL;
  for (double& t : out->times) {
    t = r.f64();
    if (!std::isfinite(t) || t < before)
      return false;
    before = t;
  }
  return true;
}

bool read_attribute_errors(ByteReader& r, ClipRecord* out) {
  constexpr size_t kLeastBytes = 18;
  const uint64_t count = r.varint(r.remaining() / kLeastBytes);
  if (!r.ok() || count == 0)
    return false;
  out->attribute_errors.resize(static_cast<size_t>(count));
  uint32_t before = 0;
  for (AttributeError& e : out->attribute_errors) {
    e.mesh = static_cast<uint16_t>(r.varint32(kMaxMeshes - 1));
    e.attribute = static_cast<uint16_t>(r.varint32(kMaxAttributes - 1));
    e.max_error = r.f64();
    e.rmse = r.f64();
    const uint32_t key = e.mesh * kMaxAttributes + e.attribute + 1;
    if (!is_length(e.max_error) || !is_length(e.rmse) || key <= before)
      return false;
    before = key;
  }
  return true;
}

bool read_events(ByteReader& r, ClipRecord* out) {
  constexpr size_t kLeastBytes = 9;
  const uint64_t count = r.varint(r.remaining() / kLeastBytes);
  if (!r.ok() || count == 0)
    return false;
  double before = 0;
  for (uint64_t i = 0; i < count; ++i) {
    ClipEvent event;
    event.name = r.text();
    event.seconds = r.f64();
    if (!r.ok() || !std::isfinite(event.seconds) || event.seconds < before)
      return false;
    before = event.seconds;
    out->events.push_back(std::move(event));
  }
  return true;
}

/// Reads a clip that has its frames already. False: a field is out of its range.
bool read_clip(ByteReader& r, ClipRecord* out) {
  out->name = r.text();
  out->rate_numerator = r.varint32();
  out->rate_denominator = r.varint32();
  const uint8_t flags = r.u8();
  out->rate_assumed = flags & kAssumed;
  out->loop = flags & kLoop;
  out->closed = flags & kClosed;
  out->massaged = flags & kMassaged;
  out->start_time = r.f64();
  if ((flags & kTimes) && !read_times(r, out))
    return false;
  const uint8_t asked = r.u8();
  out->asked = static_cast<ErrorMetric>(asked);
  for (double* x : {&out->asked_value, &out->max_error, &out->rmse, &out->kg,
                    &out->max_displacement_error, &out->diagonal})
    *x = r.f64();
  out->surface_error = out->massaged ? r.f64() : 0;
  out->surface_error_mean = out->massaged ? r.f64() : 0;
  for (double x :
       {out->asked_value, out->max_error, out->rmse, out->kg, out->max_displacement_error,
        out->diagonal, out->surface_error, out->surface_error_mean}) {
    if (!is_length(x))
      return false;
  }
  if ((flags & kAttributeErrors) && !read_attribute_errors(r, out))
    return false;
  if ((flags & kEvents) && !read_events(r, out))
    return false;
  return r.ok() && out->rate_numerator != 0 && out->rate_denominator != 0 && !(flags & 0x80) &&
         std::isfinite(out->start_time) && asked <= static_cast<uint8_t>(ErrorMetric::kSted);
}

/// Reads the optional fields at the end. False: one is malformed.
bool read_clip_fields(ByteReader& r, ClipsRecord* out) {
  RecordField field;
  while (read_field(r, &field)) {
    if (field.tag != kOrigin)
      continue;
    if (field.value.size != sizeof out->origin)
      return false;
    ByteReader value(field.value);
    for (double& x : out->origin) {
      x = value.f64();
      if (!std::isfinite(x))
        return false;
    }
  }
  return r.finished();
}

}  // namespace

size_t ClipsRecord::find(const char* name) const {
  const auto found = std::find_if(clips.begin(), clips.end(),
                                  [&](const ClipRecord& clip) { return clip.name == name; });
  return static_cast<size_t>(found - clips.begin());
}

void ClipsRecord::place() {
  uint32_t frame = 0;
  for (ClipRecord& clip : clips) {
    clip.first_frame = frame;
    frame += clip.frames;
  }
}

Bytes ClipsRecord::write() const {
  ByteWriter w;
  w.text(encoder);
  w.u8(up);
  w.u8(static_cast<uint8_t>(order));
  w.f32(static_cast<float>(metres_per_unit));
  for (const ClipRecord& clip : clips)
    write_clip(clip, w);
  if (has_origin()) {
    ByteWriter value;
    for (double x : origin)
      value.f64(x);
    write_field(w, kOrigin, value.bytes());
  }
  return std::move(w.bytes());
}

Status ClipsRecord::read(ByteView view, const Limits& limits, ClipsRecord* out) {
  ByteReader r(view);
  std::fill_n(out->origin, 3, 0.0);
  out->encoder = r.text();
  out->up = r.u8();
  const uint8_t order = r.u8();
  out->order = static_cast<OrderMode>(order);
  out->metres_per_unit = static_cast<double>(r.f32());
  // A clip takes at least 61 bytes.
  if (!r.ok() || out->up > 2 || order > static_cast<uint8_t>(OrderMode::kAll) ||
      !is_length(out->metres_per_unit) || limits.clip_frames.size() > r.remaining() / 61)
    return Status::kRecord;
  out->clips.assign(limits.clip_frames.size(), {});
  for (size_t c = 0; c < out->clips.size(); ++c) {
    out->clips[c].frames = limits.clip_frames[c];
    if (!read_clip(r, &out->clips[c]))
      return Status::kRecord;
  }
  out->place();
  return read_clip_fields(r, out) ? Status::kOk : Status::kRecord;
}

Bytes MeshRecord::write() const {
  ByteWriter w;
  w.text(name);
  w.raw(faces);
  return std::move(w.bytes());
}

Status MeshRecord::read(ByteView view, MeshRecord* out) {
  ByteReader r(view);
  out->name = r.text();
  out->faces = r.raw(r.remaining());
  return finished(r);
}

Bytes PoseRecord::write() const {
  ByteWriter w;
  for (double x : {origin[0], origin[1], origin[2], step})
    w.f64(x);
  w.raw(stream);
  return std::move(w.bytes());
}

Status PoseRecord::read(ByteView view, PoseRecord* out) {
  ByteReader r(view);
  bool finite = true;
  for (double* x : {&out->origin[0], &out->origin[1], &out->origin[2], &out->step}) {
    *x = r.f64();
    finite &= std::isfinite(*x);
  }
  out->stream = r.raw(r.remaining());
  if (!r.ok())
    return Status::kRecord;
  return finite && out->step > 0 ? Status::kOk : Status::kQuantizer;
}

Bytes SegmentRecord::write() const {
  ByteWriter w;
  w.u64(hash);
  for (ByteView part : {parameters, pose, motion, weights})
    w.block(part);
  if (continued != 0) {
    ByteWriter value;
    value.u64(continued);
    write_field(w, kContinued, value.bytes());
  }
  return std::move(w.bytes());
}

Status SegmentRecord::read(ByteView view, SegmentRecord* out) {
  ByteReader r(view);
  out->hash = r.u64();
  for (ByteView* part : {&out->parameters, &out->pose, &out->motion, &out->weights})
    *part = r.block();
  out->continued = 0;
  RecordField field;
  while (read_field(r, &field)) {
    if (field.tag != kContinued)
      continue;
    ByteReader value(field.value);
    out->continued = value.u64();
    if (!value.finished() || out->continued == 0)
      return Status::kRecord;
  }
  return r.finished() ? Status::kOk : Status::kRecord;
}

}  // namespace anicodec
