// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_coding.h"

#include "format/binary_coder.h"
#include "sdk/base/float_control.h"
#include "sdk/pose/pose_prediction.h"

#include <utility>

namespace anicodec {
namespace {

/// Codes the pose, or decodes into it; stops when a stream has run out.
template <class Coder>
void code_pose(Coder& coder, const Topology& topology, PoseSurface& surface,
               Vector<int32_t>& pose) {
  FloatControl control;
  if (!surface.made) {
    CornerTable table(topology.coded_vertices, topology.triangles);
    Vector<uint32_t> order = growth_order(table);
    const uint32_t corners = table.corner_count();
    surface.made.emplace(
        PoseSurface::Made{std::move(table), std::move(order), CornerMarks(corners)});
  }
  PosePrediction prediction(surface.made->table, surface.made->marks);
  for (uint32_t v : surface.made->order) {
    if constexpr (Coder::kDecodes) {
      if (!coder.ok())
        return;
    }
    prediction.begin(v, pose.data());
    for (int step = 0; step < 3; ++step) {
      int32_t& x = pose[size_t{3} * v + prediction.axis(step)];
      const StudentMixture& mixture = prediction.expect(step);
      x = prediction.weights(step).code(coder, mixture, x);
      prediction.learn(step, x);
    }
  }
}

}  // namespace

Bytes encode_pose(const Topology& topology, const Vector<int32_t>& pose) {
  Vector<int32_t> copy = pose;
  BinaryEncoder encoder;
  PoseSurface surface;
  code_pose(encoder, topology, surface, copy);
  return encoder.finish();
}

Status decode_pose(ByteView stream, const Topology& topology, PoseSurface* surface,
                   Vector<int32_t>* pose) {
  pose->assign(size_t{3} * topology.coded_vertices, 0);
  BinaryDecoder decoder(stream.data, stream.size);
  code_pose(decoder, topology, *surface, *pose);
  return decoder.finish() ? Status::kOk : Status::kEntropy;
}

}  // namespace anicodec
