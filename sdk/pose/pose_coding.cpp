// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_coding.h"

#include "format/coding/rans_coder.h"
#include "sdk/base/float_control.h"
#include "sdk/pose/dependent_steps.h"
#include "sdk/pose/exact_coordinates.h"
#include "sdk/pose/exact_pose.h"
#include "sdk/pose/partner_names.h"
#include "sdk/pose/pose_model.h"
#include "sdk/pose/pose_prediction.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

/// Codes poses one after the other, or decodes into them.
template <class Coder>
class PosesCoder {
 public:
  /// exact: of an encoder, whether a pose that would have dependent steps has exact coordinates instead.
  PosesCoder(Coder& coder, const CornerTable& table, PoseSteps steps, bool exact)
      : coder_(coder), table_(table), steps_(steps), exact_(exact), prediction_(table) {}

  /// False when the stream is no such pose. `parent`: an earlier pose, or null.
  bool code(Vector<int32_t>& pose, const Vector<int32_t>* parent, const PosePartners* partners) {
    prediction_.restart();
    std::fill_n(state_, 3, size_t{0});
    std::optional<ExactCoordinates> exact;
    if (steps_ == PoseSteps::kDependent && coder_.raw(1, exact_))
      exact.emplace(table_.vertex_count());
    std::optional<PartnerNames> names;
    PoseTurn time;  // from the parent on
    if (!parent && coder_.raw(1, partners != nullptr))
      names.emplace(table_);
    for (uint32_t v = 0; v < table_.vertex_count(); ++v) {
      if constexpr (Coder::kDecodes) {
        if (!coder_.ok())
          return false;
      }
      prediction_.begin(v, pose.data());
      if (parent) {
        prediction_.follow(
            time, [](uint32_t w) { return w; }, parent->data());
      } else if (names) {
        if (!names->code(coder_, v, prediction_.neighbours(), partners))
          return false;
        if (names->has(v)) {
          const uint32_t strand = names->strand(v);
          prediction_.follow(
              names->turn(strand),
              [&](uint32_t w) {
                const uint32_t u = names->image(w, strand);
                return u != v ? u : PartnerNames::kNone;  // not known yet
              },
              pose.data());
        }
      }
      for (int step = 0; step < 3; ++step)
        code_step(v, step, exact ? &*exact : nullptr, pose);
    }
    return true;
  }

 private:
  void code_step(uint32_t v, int step, ExactCoordinates* exact, Vector<int32_t>& pose) {
    const size_t axis = prediction_.axis(step);
    int32_t& x = pose[size_t{3} * v + axis];
    const PosePrediction::Expectation expected = prediction_.expect(step);
    if (exact) {
      if (!exact->code(coder_, prediction_, expected.mean, pose.data(), v, axis, &x))
        x = model_.code(coder_, step, expected, x);
    } else if (steps_ == PoseSteps::kDependent) {
      const int32_t parity = DependentSteps::parity(state_[axis]);
      const int32_t half = model_.code(coder_, step, halved(expected, parity), (x - parity) / 2);
      x = 2 * half + parity;
      state_[axis] = DependentSteps::next(state_[axis], half);
    } else {
      x = model_.code(coder_, step, expected, x);
    }
    prediction_.learn(step, x);
  }

  Coder& coder_;
  const CornerTable& table_;
  PoseSteps steps_;
  bool exact_;
  PosePrediction prediction_;
  PoseModel model_;
  size_t state_[3] = {0, 0, 0};
};

template <class Coder>
bool code_poses(Coder& coder, const CornerTable& table, PoseSteps steps,
                const Vector<uint32_t>& parents, const PosePartners* partners,
                Vector<Vector<int32_t>>& poses, bool exact = false) {
  const FloatControl control;
  PosesCoder<Coder> poses_coder(coder, table, steps, exact);
  for (size_t j = 0; j < poses.size(); ++j) {
    if (!poses_coder.code(poses[j], parents[j] > 0 ? &poses[parents[j] - 1] : nullptr, partners))
      return false;
  }
  return true;
}

}  // namespace

Bytes encode_poses(const CornerTable& table, PoseSteps steps, const Vector<Vector<int32_t>>& poses,
                   const Vector<uint32_t>& parents, const PosePartners* partners) {
  Vector<Vector<int32_t>> copy = poses;
  RansEncoder encoder;
  code_poses(encoder, table, steps, parents, partners, copy);
  return encoder.finish();
}

Bytes encode_exact_pose(const CornerTable& table, const Vector<int32_t>& pose,
                        const PosePartners* partners) {
  Vector<Vector<int32_t>> copy = {pose};
  RansEncoder encoder;
  code_poses(encoder, table, PoseSteps::kDependent, {0}, partners, copy, true);
  return encoder.finish();
}

Status decode_poses(ByteView stream, const CornerTable& table, PoseSteps steps,
                    const Vector<uint32_t>& parents, Vector<Vector<int32_t>>* poses) {
  poses->assign(parents.size(), Vector<int32_t>(size_t{3} * table.vertex_count(), 0));
  RansDecoder decoder(stream);
  const bool coded = code_poses(decoder, table, steps, parents, nullptr, *poses);
  return coded && decoder.finish() ? Status::kOk : Status::kEntropy;
}

Bytes encode_pose(const CornerTable& table, PoseSteps steps, const Vector<int32_t>& pose,
                  const PosePartners* partners) {
  return encode_poses(table, steps, {pose}, {0}, partners);
}

Status decode_pose(ByteView stream, const CornerTable& table, PoseSteps steps,
                   Vector<int32_t>* pose) {
  Vector<Vector<int32_t>> poses;
  const Status status = decode_poses(stream, table, steps, {0}, &poses);
  *pose = std::move(poses[0]);
  return status;
}

}  // namespace anicodec
