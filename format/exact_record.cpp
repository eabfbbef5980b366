// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/exact_record.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

constexpr uint8_t kErrs = 8;  // of axis 0

}  // namespace

Bytes ExactRecord::write() const {
  ByteWriter w;
  uint8_t used = 0;
  for (int axis = 0; axis < 3; ++axis)
    used = static_cast<uint8_t>(used | (lattices[axis].is_used() ? 1 << axis : 0) |
                                (lattices[axis].errs ? kErrs << axis : 0));
  w.u8(used);
  w.u64(hash);
  w.f64(noise);
  for (const Lattice& lattice : lattices) {
    if (!lattice.is_used())
      continue;
    w.f64(lattice.origin);
    w.f64(lattice.step);
    w.u32(static_cast<uint32_t>(lattice.first));
    w.varint(lattice.count);
  }
  w.raw(stream);
  return std::move(w.bytes());
}

Status ExactRecord::read(ByteView view, const Limits::Segment& segment, const Limits::Mesh& mesh,
                         ExactRecord* out) {
  ByteReader r(view);
  const uint64_t positions = uint64_t{segment.frames} * mesh.coded_vertices;
  const uint8_t used = r.u8();
  if (used >> 6 != 0 || ((used >> 3) & ~used) != 0)
    return Status::kRecord;
  out->hash = r.u64();
  out->noise = r.f64();
  bool good = std::isfinite(out->noise) && out->noise > 0;
  for (int axis = 0; axis < 3; ++axis) {
    Lattice& lattice = out->lattices[axis];
    lattice = {};
    if (!(used >> axis & 1))
      continue;
    lattice.origin = r.f64();
    lattice.step = r.f64();
    good &= std::isfinite(lattice.origin) && std::isfinite(lattice.step) && lattice.step > 0;
    lattice.first = static_cast<int32_t>(r.u32());
    lattice.errs = used >> axis & kErrs;
    lattice.count = r.varint32(
        lattice.errs ? static_cast<uint32_t>(std::min<uint64_t>(positions, INT32_MAX)) : INT32_MAX);
    if (lattice.count == 0)
      r.fail();
  }
  if (!r.ok())
    return Status::kRecord;
  out->stream = r.raw(r.remaining());
  return good ? Status::kOk : Status::kQuantizer;
}

}  // namespace anicodec
