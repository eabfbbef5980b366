// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_coding.h"

#include "format/binary_coder.h"
#include "sdk/base/float_control.h"
#include "sdk/pose/dependent_steps.h"
#include "sdk/pose/exact_coordinates.h"
#include "sdk/pose/pose_models.h"
#include "sdk/pose/pose_prediction.h"

#include <cstddef>
#include <optional>

namespace anicodec {
namespace {

/// Codes the pose, or decodes into it; stops when a stream has run out.
template <class Coder>
void code_pose(Coder& coder, const PoseSurface& surface, PoseCoding coding, Vector<int32_t>& pose) {
  const FloatControl control;
  PosePrediction prediction(surface.table);
  PoseModels models;
  std::optional<ExactCoordinates> exact;
  if (coding == PoseCoding::kExact)
    exact.emplace(surface.table.vertex_count());
  size_t state[3] = {0, 0, 0};
  for (const uint32_t v : surface.order) {
    if constexpr (Coder::kDecodes) {
      if (!coder.ok())
        return;
    }
    prediction.begin(v, pose.data());
    for (int step = 0; step < 3; ++step) {
      const size_t axis = prediction.axis(step);
      int32_t& x = pose[size_t{3} * v + axis];
      const PosePrediction::Expectation expected = prediction.expect(step);
      if (exact && exact->code(coder, prediction, expected.mean, pose.data(), v, axis, &x)) {
        // One of the candidates.
      } else if (coding == PoseCoding::kDependent) {
        const int32_t parity = DependentSteps::parity(state[axis]);
        const int32_t half =
            models.code(coder, prediction.kind(), step, halved(expected, parity), (x - parity) / 2);
        x = 2 * half + parity;
        state[axis] = DependentSteps::next(state[axis], half);
      } else {
        x = models.code(coder, prediction.kind(), step, expected, x);
      }
      prediction.learn(step, x);
    }
  }
}

}  // namespace

Bytes encode_pose(const PoseSurface& surface, PoseCoding coding, const Vector<int32_t>& pose) {
  Vector<int32_t> copy = pose;
  BinaryEncoder encoder;
  code_pose(encoder, surface, coding, copy);
  return encoder.finish();
}

Status decode_pose(ByteView stream, const PoseSurface& surface, PoseCoding coding,
                   Vector<int32_t>* pose) {
  pose->assign(size_t{3} * surface.table.vertex_count(), 0);
  BinaryDecoder decoder(stream.data, stream.size);
  code_pose(decoder, surface, coding, *pose);
  return decoder.finish() ? Status::kOk : Status::kEntropy;
}

}  // namespace anicodec
