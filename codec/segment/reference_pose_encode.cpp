// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/reference_pose_encode.h"

#include "codec/parallel/parallel.h"
#include "codec/segment/pose_partners.h"
#include "sdk/pose/dependent_steps.h"
#include "sdk/pose/exact_pose.h"
#include "sdk/prediction/vertex_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Dependent steps that are so much finer lead to the same error: the mean squared one of a trellis
/// of eight states is 1.0 dB below that of rounding to steps twice as wide.
constexpr double kDependentStep = 0.565;

Vector<int32_t> rounded_integers(const MatrixXd& values) {
  Vector<int32_t> integers;
  integers.reserve(static_cast<size_t>(values.size()));
  for (Index v = 0; v < values.rows(); ++v) {
    for (Index c = 0; c < 3; ++c)
      integers.push_back(static_cast<int32_t>(std::lround(values(v, c))));
  }
  return integers;
}

/// A pose on a grid, not coded yet. finer: its steps in those asked for.
std::shared_ptr<EncodedPose> on_grid(const MatrixXd& pose, const Eigen::Vector3d& origin,
                                     double step, double finer) {
  auto encoded = std::make_shared<EncodedPose>();
  const double largest = pose.size() > 0 ? pose.cwiseAbs().maxCoeff() : 0;
  // Room for a dependent integer, which is up to two steps off.
  encoded->grid.step = std::max({finer * step, largest / (kMaxReferenceCoordinate - 4), 1e-37});
  std::copy_n(origin.data(), 3, encoded->grid.origin);
  return encoded;
}

/// The pose, rounded, with exact coordinates.
std::shared_ptr<const EncodedPose> encode_exactly(const PosePartners* partners,
                                                  const MatrixXd& pose,
                                                  const Eigen::Vector3d& origin, double step,
                                                  const CornerTable& table) {
  auto encoded = on_grid(pose, origin, step, 1);
  encoded->grid.points = rounded_integers(pose / encoded->grid.step);
  encoded->stream = encode_exact_pose(table, encoded->grid.points, partners);
  return encoded;
}

/// About the nanoseconds of one thread that a decoder takes for a pose. Lines through dance, horse,
/// face, flag and chicken at --kg 0.1: `anicodec_bench pose`.
double pose_nanoseconds(const EncodedPose& pose, double vertices, bool has_partners) {
  return (has_partners ? 920 : 620) * vertices + 28 * static_cast<double>(pose.stream.size());
}

/// The lower of the two halves that are tried for a value in some state.
int32_t lower_half(double value, size_t state) {
  return static_cast<int32_t>(std::floor((value - DependentSteps::parity(state)) / 2));
}

/// The shortest path through the trellis along one axis.
void code_axis(const MatrixXd& values, Index axis, Vector<int32_t>& integers) {
  constexpr size_t kStates = DependentSteps::kStates;
  constexpr double kNever = std::numeric_limits<double>::infinity();

  struct Step {
    uint8_t from = 0, upper = 0;  ///< the state before, and which of its two halves
  };

  const Index n = values.rows();
  std::vector<std::array<Step, kStates>> steps(static_cast<size_t>(n));
  std::array<double, kStates> cost;
  cost.fill(kNever);
  cost[0] = 0;
  for (Index v = 0; v < n; ++v) {
    const double value = values(v, axis);
    std::array<double, kStates> least;
    least.fill(kNever);
    for (uint8_t s = 0; s < kStates; ++s) {
      const int32_t lower = lower_half(value, s);
      for (uint8_t upper = 0; upper < 2; ++upper) {
        const int32_t half = lower + upper;
        const double off = value - (2.0 * half + DependentSteps::parity(s));
        const size_t to = DependentSteps::next(s, half);
        if (cost[s] + off * off < least[to]) {
          least[to] = cost[s] + off * off;
          steps[static_cast<size_t>(v)][to] = {s, upper};
        }
      }
    }
    cost = least;
  }
  auto state = static_cast<size_t>(std::ranges::min_element(cost) - cost.begin());
  for (Index v = n; v-- > 0;) {
    const Step step = steps[static_cast<size_t>(v)][state];
    const int32_t half = lower_half(values(v, axis), step.from) + step.upper;
    integers[static_cast<size_t>(3 * v + axis)] = 2 * half + DependentSteps::parity(step.from);
    state = step.from;
  }
}

}  // namespace

Vector<int32_t> dependent_integers(const MatrixXd& values) {
  Vector<int32_t> integers(static_cast<size_t>(values.size()));
  for (Index axis = 0; axis < 3; ++axis)
    code_axis(values, axis, integers);
  return integers;
}

std::shared_ptr<const EncodedPose> encode_pose_by(const PosePartners* partners,
                                                  const MatrixXd& pose,
                                                  const Eigen::Vector3d& origin, double step,
                                                  const CornerTable& table) {
  auto encoded = on_grid(pose, origin, step, kDependentStep);
  encoded->grid.points = dependent_integers(pose / encoded->grid.step);
  encoded->stream = encode_pose(table, PoseSteps::kDependent, encoded->grid.points, partners);
  return encoded;
}

ReferencePoseEncoder::ReferencePoseEncoder(const MatrixXd& pose, const Eigen::Vector3d& origin,
                                           const MeshLayout& layout, double bytes_per_nanosecond)
    : pose_(pose),
      origin_(origin),
      bytes_per_nanosecond_(bytes_per_nanosecond),
      table_(layout.topology),
      partners_(find_partners(pose, table_)) {}

std::shared_ptr<const EncodedPose> ReferencePoseEncoder::at_step(double step) const {
  const auto coded = [&](const PosePartners* partners) {
    return encode_pose_by(partners, pose_, origin_, step, table_);
  };
  const auto exactly = [&](const PosePartners* partners) {
    return encode_exactly(partners, pose_, origin_, step, table_);
  };
  const bool repeats = !partners_.partner.empty();
  const PosePartners* by = repeats ? &partners_ : nullptr;
  std::shared_ptr<const EncodedPose> best, other;
  // Isolated: a thread that waits here must not begin another trial meanwhile, which takes long.
  isolated([&] {
    parallel_invoke([&] { best = coded(by); },
                    [&] { other = repeats ? coded(nullptr) : exactly(nullptr); });
  });
  if (repeats) {
    if (cost(*other, false) <= cost(*best, true)) {
      best = std::move(other);
      by = nullptr;
    }
    other = exactly(by);
  }
  const bool by_partners = by != nullptr;
  return cost(*other, by_partners) < cost(*best, by_partners) ? other : best;
}

double ReferencePoseEncoder::cost(const EncodedPose& pose, bool has_partners) const {
  return static_cast<double>(pose.stream.size()) +
         bytes_per_nanosecond_ *
             pose_nanoseconds(pose, static_cast<double>(pose_.rows()), has_partners);
}

std::shared_ptr<const EncodedPose> encode_reference_pose(const MatrixXd& pose,
                                                         const Eigen::Vector3d& origin, double step,
                                                         const MeshLayout& layout,
                                                         double bytes_per_nanosecond) {
  return ReferencePoseEncoder(pose, origin, layout, bytes_per_nanosecond).at_step(step);
}

}  // namespace anicodec
