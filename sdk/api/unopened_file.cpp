// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: what a file says without being opened.
#include "format/bounds_record.h"
#include "format/metadata.h"
#include "sdk/api/objects.h"
#include "sdk/clip/file_checks.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

Failure read_metadata(ByteView bytes, ByteView* out) {
  ContainerReader file;
  if (Failure failure = file.open_prefix(bytes); !failure.ok())
    return failure;
  const Chunk* chunk = file.find("META");
  if (!chunk)
    return {Status::kAbsent, 0, chunk_type("META"), "the file has no metadata"};
  if (Failure failure = file.payload(*chunk, out); !failure.ok())
    return failure;
  return is_metadata(*out) ? Failure{}
                           : failure_in(*chunk, Status::kRecord,
                                        "the metadata is too long, too deep, or no UTF-8");
}

void include(const Box& box, anic_box* out) {
  for (size_t c = 0; c < 3; ++c) {
    out->min[c] = std::min(out->min[c], box.low[c]);
    out->max[c] = std::max(out->max[c], box.high[c]);
  }
}

/// The box around frames first .. first + count - 1 of a mesh.
Failure read_bounds(ByteView bytes, uint32_t mesh, uint32_t first, uint32_t count, anic_box* out) {
  ContainerReader file;
  if (Failure failure = file.open_prefix(bytes); !failure.ok())
    return failure;
  const Chunk* chunk;
  ByteView payload;
  Limits limits;
  if (Failure f = required_payload(file, "LIMI", kNoMesh, kNoSegment, &chunk, &payload); !f.ok())
    return f;
  if (Status s = Limits::read(payload, &limits); s != Status::kOk)
    return failure_in(*chunk, s, "the limits are malformed");
  if (mesh >= limits.meshes.size())
    return kBadArgument;
  if (first >= limits.frames || count > limits.frames - first)
    return {Status::kFrameRange, 0, 0, "the file has fewer frames"};
  const uint32_t end = count == 0 ? limits.frames : first + count;
  bool is_there = false;
  for (uint32_t number = 0; number < limits.segments.size(); ++number) {
    const Limits::Segment& segment = limits.segments[number];
    const uint32_t from = std::max(first, segment.first_frame);
    const uint32_t to = std::min(end, segment.first_frame + segment.frames);
    if (segment.mesh != mesh || segment.attribute != kPositions || from >= to)
      continue;
    chunk = file.find("BNDS", segment.mesh, number);
    if (!chunk)
      return {Status::kAbsent, 0, chunk_type("BNDS"), "the file has no boxes of these frames"};
    if (Failure f = file.payload(*chunk, &payload); !f.ok())
      return f;
    BoundsRecord bounds;
    if (Status s = BoundsRecord::read(payload, segment.frames, &bounds); s != Status::kOk)
      return failure_in(*chunk, s, "the boxes are malformed");
    const uint32_t step = bounds.every == 0 ? segment.frames : bounds.every;
    for (uint32_t f = from - segment.first_frame; f < to - segment.first_frame;
         f = (f / step + 1) * step)
      include(bounds.of_frame(f), out);
    is_there = true;
  }
  return is_there ? Failure{}
                  : Failure{Status::kAbsent, 0, 0, "the mesh is in none of these frames"};
}

}  // namespace
}  // namespace anicodec

using namespace anicodec;

anic_status anic_read_metadata(const void* file, size_t size, const char** text,
                               size_t* text_bytes) {
  if (!text || !text_bytes || (!file && size > 0))
    return ANIC_E_ARGUMENT;
  *text = nullptr;
  *text_bytes = 0;
  ByteView found;
  const Failure failure = guarded([&] {
    return read_metadata({static_cast<const uint8_t*>(file), size}, &found);
  });
  if (failure.ok()) {
    *text = reinterpret_cast<const char*>(found.data);
    *text_bytes = found.size;
  }
  return c_status(failure.status);
}

anic_status anic_read_bounds(const void* file, size_t size, uint32_t mesh, uint32_t first_frame,
                             uint32_t frame_count, anic_box* out) {
  if (!out || (!file && size > 0))
    return ANIC_E_ARGUMENT;
  anic_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  const Failure failure = guarded([&] {
    return read_bounds({static_cast<const uint8_t*>(file), size}, mesh, first_frame, frame_count,
                       &box);
  });
  if (failure.ok())
    *out = box;
  return c_status(failure.status);
}
