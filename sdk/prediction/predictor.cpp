// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/prediction/predictor.h"

#include "format/sort.h"
#include "sdk/base/float_control.h"
#include "sdk/prediction/prediction_job.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

constexpr uint16_t kSparse[] = {1, 4, 12, 36, 108, 324};
constexpr uint16_t kMedium[] = {0,  1,  2,  3,   5,   8,   12,  18,  26,
                                36, 50, 70, 100, 140, 200, 280, 400, 560};

/// Components after which the prior is renewed: the first ones tell most of the motion, later ones nothing new.
constexpr uint16_t kRenewals[] = {1, 3, 7, 9};

// 2^(i / 4) in binary32.
constexpr float kQuarterPowers[] = {1.0f, 0x1.306fep+0f, 0x1.6a09e6p+0f, 0x1.ae89fap+0f};

const PredictionKernels& prediction_kernels() {
#if defined(ANICODEC_PREDICTION_AVX2)
  static const PredictionKernels& best =
      fastest_kernels(kPredictionKernelsAvx512, kPredictionKernelsAvx2, kPredictionKernelsPortable);
  return best;
#else
  return kPredictionKernelsPortable;
#endif
}

/// Components of a schedule, ascending; *count receives their number.
const uint16_t* refit_components(RefitSchedule schedule, size_t* count) {
  switch (schedule) {
    case RefitSchedule::kSparse:
      *count = std::size(kSparse);
      return kSparse;
    case RefitSchedule::kMedium:
      *count = std::size(kMedium);
      return kMedium;
    case RefitSchedule::kNone:
      break;
  }
  *count = 0;
  return kSparse;
}

}  // namespace

Vector<size_t> renewals_of(const PredictionParameters& parameters, size_t components) {
  Vector<size_t> list;
  if (parameters.alike == 0)
    return list;
  for (const uint16_t j : kRenewals)
    if (size_t{j} + 1 < components)
      list.push_back(j);
  return list;
}

Vector<size_t> refits_of(const PredictionParameters& parameters, size_t components) {
  Vector<size_t> list = renewals_of(parameters, components);
  size_t count = 0;
  const uint16_t* refits = refit_components(parameters.schedule, &count);
  for (size_t i = 0; i < count && size_t{refits[i]} + 1 < components; ++i)
    list.push_back(refits[i]);
  sort_ascending(list.begin(), list.end());
  list.resize(static_cast<size_t>(std::unique(list.begin(), list.end()) - list.begin()));
  return list;
}

float omega_value(uint8_t byte) {
  const int exponent = byte / 4 - 32;
  const float power = exponent < 0 ? 1.0f / static_cast<float>(uint64_t{1} << -exponent)
                                   : static_cast<float>(uint64_t{1} << exponent);
  return kQuarterPowers[byte % 4] * power;  // exact
}

uint8_t omega_byte(double energy) {
  const double omega = 1 / (1.0 / 12 + energy + 0.05);
  return static_cast<uint8_t>(std::clamp(std::round(4 * std::log2(omega)) + 128, 0.0, 255.0));
}

Status check_prediction(const VertexOrder& order, const PredictionParameters& parameters) {
  const int m = order.neighbour_count;
  if (m < 8 || m > kMaxNeighbours || m % 4 != 0)
    return Status::kArgument;
  if ((parameters.channels != 1 && parameters.channels != 3) || parameters.radius == 0 ||
      static_cast<uint8_t>(parameters.schedule) >= kRefitScheduleCount)
    return Status::kArgument;
  return Status::kOk;
}

void ranked_positions(const VertexOrder& order, const int32_t* positions, Vector<float>* out) {
  const size_t n = order.vertex_count();
  out->resize(3 * n);
  for (size_t r = 0; r < n; ++r)
    for (size_t d = 0; d < 3; ++d)
      (*out)[3 * r + d] = static_cast<float>(positions[3 * size_t{order.order[r]} + d]);
}

Status CoefficientReconstruction::init(const VertexOrder& order, const int32_t* positions,
                                       const PredictionParameters& parameters,
                                       const PredictionResiduals& residuals, float* y,
                                       const PredictionLearning& learning) {
  if (Status s = check_prediction(order, parameters); s != Status::kOk)
    return s;
  const size_t n = order.vertex_count();
  const auto channels = static_cast<size_t>(parameters.channels);
  const size_t components = residuals.components;
  order_ = &order;
  ranked_positions(order, positions, &positions_);
  omega_.resize(components * channels);
  for (size_t s = 0; s < omega_.size(); ++s)
    omega_[s] = omega_value(residuals.omega[s / channels]);
  const auto in_samples = [&](Vector<size_t> list) {
    for (size_t& after : list)
      after = (after + 1) * channels;
    return list;
  };
  refits_ = in_samples(refits_of(parameters, components));
  renewals_ = in_samples(renewals_of(parameters, components));
  job_ = {};
  job_.neighbour_count = order.neighbour_count;
  job_.vertices = n;
  job_.samples = components * channels;
  job_.neighbours = order.neighbours.data();
  job_.positions = positions_.data();
  job_.radius = parameters.radius;
  job_.omega = omega_.data();
  job_.refits = refits_.data();
  job_.refit_count = refits_.size();
  job_.alike = alike_value(parameters.alike);
  job_.renewals = renewals_.data();
  job_.renewal_count = renewals_.size();
  job_.wide_samples = std::min(residuals.wide_components, components) * channels;
  job_.wide = residuals.wide;
  job_.narrow = residuals.narrow;
  job_.y = y;
  job_.stride = coefficient_stride(job_.samples);
  if (learning.continued)
    job_.continued = learning.continued->data();
  if (learning.learnt) {
    learning.learnt->resize(n * learnt_floats(static_cast<size_t>(order.neighbour_count)));
    job_.learnt = learning.learnt->data();
  }
  std::fill_n(y + n * job_.stride, job_.stride, 0.0f);
  return Status::kOk;
}

void CoefficientReconstruction::run(size_t first, size_t last) const {
  const FloatControl control;
  prediction_kernels().reconstruct(job_, first, last);
}

}  // namespace anicodec
