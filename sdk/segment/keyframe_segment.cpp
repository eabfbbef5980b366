// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/keyframe_segment.h"

#include "sdk/base/bounded_float.h"
#include "sdk/mesh/draco_poses.h"
#include "sdk/mesh/plain_coding.h"
#include "sdk/msgi/msgi_memory.h"
#include "sdk/pose/pose_coding.h"
#include "sdk/segment/resident_writer.h"
#include "sdk/segment/series_coding.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

constexpr uint8_t kSumToOne = 1, kRigid = 2;

/// Rotation matrix and translation of a quaternion (x, y, z, w) of any length. False when an entry
/// is too large.
bool rigid_motion(const double q[4], const double t[3], Affine* map) {
  double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  double s = n > 0 ? 2 / n : 0;
  double x = q[0], y = q[1], z = q[2], w = q[3];
  double r[9] = {1 - s * (y * y + z * z), s * (x * y - z * w),     s * (x * z + y * w),
                 s * (x * y + z * w),     1 - s * (x * x + z * z), s * (y * z - x * w),
                 s * (x * z - y * w),     s * (y * z + x * w),     1 - s * (x * x + y * y)};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      if (!to_float(r[3 * i + j], &map->m[4 * i + j]))
        return false;
    }
    if (!to_float(t[i], &map->m[4 * i + 3]))
      return false;
  }
  return true;
}

/// Draco's differences from parents, coded vertices x 3 each. Vertices that it does not hold
/// are plain integers.
Status read_draco_poses(const SegmentRecord& record, const SegmentContext& context,
                        Vector<Vector<int32_t>>* poses) {
  const size_t n = context.topology->coded_vertices;
  const uint32_t k = context.sizes->components;
  const Limits::Segment& sizes = *context.sizes;
  const ByteView bytes{record.pose.data, sizes.draco_bytes};
  if (Status s = decode_draco_poses(bytes, *context.topology, sizes.draco_points, k, poses);
      s != Status::kOk)
    return s;
  const size_t held = context.topology->vertices_in_triangles;
  const ByteView rest{record.pose.data + sizes.draco_bytes, record.pose.size - sizes.draco_bytes};
  Vector<int32_t> plain;
  if (Status s = decode_plain_integers(rest, 3 * (n - held) * k, 3, &plain); s != Status::kOk)
    return s;
  for (size_t j = 0; j < k; ++j)
    (*poses)[j].insert((*poses)[j].end(),
                       plain.begin() + static_cast<ptrdiff_t>(3 * (n - held) * j),
                       plain.begin() + static_cast<ptrdiff_t>(3 * (n - held) * (j + 1)));
  return Status::kOk;
}

/// Key-frames as integers, coded vertices x 3 each.
Status read_poses(const SegmentRecord& record, const SegmentContext& context,
                  const KeyframeParameters& parameters, Vector<Vector<int32_t>>* poses) {
  const Limits::Segment& sizes = *context.sizes;
  const Vector<uint32_t>& parents = parameters.parents;
  if (sizes.draco_bytes > record.pose.size)
    return Status::kSegment;
  if (sizes.draco_bytes == 0) {
    if (context.corners)
      return decode_poses(record.pose, *context.corners, PoseSteps::kAny, parents, poses);
    return decode_poses(record.pose, CornerTable(*context.topology), PoseSteps::kAny, parents,
                        poses);
  }
  if (Status s = read_draco_poses(record, context, poses); s != Status::kOk)
    return s;
  for (size_t j = 0; j < poses->size(); ++j) {
    if (parents[j] == 0)
      continue;
    Vector<int32_t>& pose = (*poses)[j];
    const Vector<int32_t>& parent = (*poses)[parents[j] - 1];
    for (size_t i = 0; i < pose.size(); ++i)
      pose[i] =
          static_cast<int32_t>(static_cast<uint32_t>(pose[i]) + static_cast<uint32_t>(parent[i]));
  }
  return Status::kOk;
}

Status read_motions(ByteView bytes, const KeyframeParameters& parameters, DecodedIntegers* integers,
                    Segment* out) {
  BinaryDecoder decoder(bytes.data, bytes.size);
  SeriesCoding coding;
  Vector<int32_t> series[7];
  for (Vector<int32_t>& s : series) {
    if (!coding.code(decoder, out->frames, 0, &s))
      return Status::kEntropy;
    integers->add("motion", s.data(), s.size());
  }
  if (!decoder.finish())
    return Status::kEntropy;
  out->motions.resize(out->frames);
  for (size_t f = 0; f < out->frames; ++f) {
    double q[4], t[3];
    for (size_t i = 0; i < 4; ++i)
      q[i] = std::ldexp(series[i][f], -parameters.rotation_bits);
    for (size_t i = 0; i < 3; ++i)
      t[i] = series[4 + i][f] * parameters.translation_step;
    if (!rigid_motion(q, t, &out->motions[f]))
      return Status::kNonFinite;
  }
  return Status::kOk;
}

/// Interpolation between the decoded key-frames.
Status set_up_msgi(const KeyframeParameters& parameters, const Vector<Vector<int32_t>>& poses,
                   const SegmentContext& context, Segment* out) {
  const size_t coordinates = 3 * size_t{context.topology->coded_vertices};
  Vector<Vector<float>> points;
  Vector<const float*> inputs;
  for (const Vector<int32_t>& pose : poses) {
    Vector<float>& x = points.emplace_back(coordinates);
    for (size_t i = 0; i < coordinates; ++i) {
      if (!to_float(parameters.origin[i % 3] + parameters.step * pose[i], &x[i]))
        return Status::kNonFinite;
    }
  }
  for (const Vector<float>& x : points)
    inputs.push_back(x.data());
  Msgi::Options options;
  options.leaf_faces = parameters.leaf_faces;
  options.most_bytes = static_cast<size_t>(
      std::min<uint64_t>(msgi_bytes(*context.sizes, *context.mesh_sizes), SIZE_MAX));
  const Vector<uint32_t>& triangles = context.topology->triangles;
  out->msgi.resize(1);
  Status s =
      out->msgi[0].init(triangles.data(), triangles.size() / 3, context.topology->coded_vertices,
                        inputs.data(), inputs.size(), options);
  if (s == Status::kOk && out->msgi[0].scratch_bytes() > msgi_frame_bytes(*context.mesh_sizes))
    s = Status::kLimit;
  out->weight_scale = parameters.step;
  if (context.vertex_coded)
    out->vertex_coded = *context.vertex_coded;
  return s;
}

}  // namespace

Bytes KeyframeParameters::write() const {
  ByteWriter w;
  w.u8(static_cast<uint8_t>((sum_to_one ? kSumToOne : 0) | (rigid ? kRigid : 0)));
  for (double x : origin)
    w.f64(x);
  w.f64(step);
  w.u8(weight_bits);
  if (rigid) {
    w.u8(rotation_bits);
    w.f64(translation_step);
  }
  if (leaf_faces > 0)
    w.u8(leaf_faces);
  uint32_t before = 0;
  for (uint32_t f : frames) {
    w.varint(f - before);
    before = f;
  }
  for (uint32_t p : parents)
    w.varint(p);
  return std::move(w.bytes());
}

Status KeyframeParameters::read(ByteView bytes, const Limits::Segment& sizes) {
  const uint32_t components = sizes.components;
  const bool msgi = sizes.reconstruction == Reconstruction::kMsgi;
  ByteReader r(bytes);
  const uint8_t flags = r.u8();
  sum_to_one = flags & kSumToOne;
  rigid = flags & kRigid;
  bool finite = true;
  for (double& x : origin) {
    x = r.f64();
    finite &= std::isfinite(x);
  }
  step = r.f64();
  weight_bits = r.u8();
  if (rigid) {
    rotation_bits = r.u8();
    translation_step = r.f64();
  }
  leaf_faces = msgi ? r.u8() : uint8_t{0};
  if (!r.ok() || (msgi && leaf_faces == 0) || components > r.remaining())
    return Status::kRecord;
  uint64_t before = 0;
  frames.resize(components);
  for (uint32_t& f : frames) {
    before += r.varint(sizes.frames);
    if (before >= sizes.frames)
      return Status::kRecord;
    f = static_cast<uint32_t>(before);
  }
  parents.resize(components);
  for (uint32_t j = 0; j < components; ++j)
    parents[j] = r.varint32(j);
  if (!r.finished() || (flags & ~(kSumToOne | kRigid)))
    return Status::kRecord;
  if (!finite || !std::isfinite(step) || step <= 0 || weight_bits > 24 || rotation_bits > 27 ||
      !std::isfinite(translation_step) || translation_step <= 0)
    return Status::kQuantizer;
  return Status::kOk;
}

Status open_keyframe_segment(const SegmentRecord& record, const SegmentContext& context,
                             DecodedIntegers& integers, Segment* out) {
  KeyframeParameters parameters;
  uint32_t k = context.sizes->components;
  if (k == 0)
    return Status::kSegment;
  if (Status s = parameters.read(record.parameters, *context.sizes); s != Status::kOk)
    return s;
  const bool msgi = out->reconstruction == Reconstruction::kMsgi;
  if (msgi && !parameters.sum_to_one)
    return Status::kSegment;
  Vector<Vector<int32_t>> poses;
  if (Status s = read_poses(record, context, parameters, &poses); s != Status::kOk)
    return s;
  for (uint32_t j = 0; j < k; ++j) {
    integers.add("key-frame", poses[j].data(), poses[j].size());
    if (!context.advance(poses[j].size()))
      return Status::kCancelled;
  }
  BinaryDecoder decoder(record.weights.data, record.weights.size);
  SeriesCoding coding;
  Vector<Vector<int32_t>> series(k);
  int32_t one = 1 << parameters.weight_bits;
  uint32_t first = parameters.sum_to_one ? 1 : 0;
  if (parameters.sum_to_one)
    series[0].assign(out->frames, one);
  for (uint32_t j = first; j < k; ++j) {
    if (!coding.code(decoder, out->frames, 0, &series[j]))
      return Status::kEntropy;
    integers.add("weights", series[j].data(), series[j].size());
    for (size_t f = 0; parameters.sum_to_one && f < out->frames; ++f)
      series[0][f] = static_cast<int32_t>(static_cast<uint32_t>(series[0][f]) -
                                          static_cast<uint32_t>(series[j][f]));
  }
  if (!decoder.finish())
    return Status::kEntropy;
  double unit = std::ldexp(parameters.step, -parameters.weight_bits);
  out->weights.resize(size_t{out->frames} * k);
  for (size_t f = 0; f < out->frames; ++f) {
    for (size_t j = 0; j < k; ++j) {
      if (!to_float(unit * series[j][f], &out->weights[f * k + j]))
        return Status::kNonFinite;
    }
  }
  if (parameters.rigid) {
    if (Status s = read_motions(record.motion, parameters, &integers, out); s != Status::kOk)
      return s;
  } else if (record.motion.size != 0) {
    return Status::kRecord;
  }
  for (size_t i = 0; i < 3; ++i) {
    float unused;
    if (!to_float(parameters.origin[i], &unused))
      return Status::kNonFinite;
    out->origin[i] = parameters.origin[i];
  }
  out->keyframe_frames = parameters.frames;
  if (msgi) {
    if (Status s = set_up_msgi(parameters, poses, context, out); s != Status::kOk)
      return s;
  }
  ResidentWriter writer(context.vertex_coded, out);
  for (uint32_t j = 0; j < k; ++j) {
    if (!writer.vectors(j, poses[j].data()))
      return Status::kQuantizer;
  }
  return Status::kOk;
}

}  // namespace anicodec
