// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_prediction.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

constexpr double kNoise = 1e-2;  // variance of rounding and the like
constexpr double kLeast = 1e-3;  // of a usual error

}  // namespace

PosePrediction::PosePrediction(const CornerTable& table)
    : table_(table), known_(table.vertex_count()) {
  std::array<double, kVectors> no_vector{}, vector_variance{};
  std::array<double, kHeights> no_height{}, height_variance{};
  std::array<double, kSizes> size_start{}, size_variance{};
  vector_variance.fill(0.05);
  height_variance.fill(0.05);
  size_variance.fill(0.1);
  size_start[0] = 0.5;  // the neighbours' errors
  size_start[1] = 0.1;  // how long edges are, or how far parallelograms are apart
  for (size_t k = 0; k < kKinds; ++k) {
    offset_[k].start(kVectors, no_vector, vector_variance);
    height_[k].start(kHeights, no_height, height_variance);
    size_of_[0][k].start(kSizes, size_start, size_variance);
    size_of_[1][k].start(kSizes - 1, size_start, size_variance);
  }
}

Vector3 PosePrediction::position(uint32_t v) const {
  const int32_t* p = positions_ + size_t{3} * v;
  return {{double(p[0]), double(p[1]), double(p[2])}};
}

void PosePrediction::begin(uint32_t v, const int32_t* positions) {
  positions_ = positions;
  vertex_ = v;
  gather();
  if (!gates_.empty()) {
    kind_ = gates_.size() == 1 ? kOneGate : gates_.size() == 2 ? kTwoGates : kMoreGates;
    return;
  }
  kind_ = neighbours_.empty() ? kAlone : kBeside;
  base_ = kind_ == kBeside ? mean_ : any_ ? position(last_) : Vector3{};
  for (size_t i = 0; i < 3; ++i)
    axis_[i] = i;
}

/// Parallelograms over the edges of the vertex's triangles, the neighbours, and from them the base,
/// the normal and what the regressions start from.
void PosePrediction::gather() {
  Vector3 normal, forward;
  double valences = 0;
  neighbours_.clear();
  gates_.clear();
  base_ = mean_ = Vector3{};
  const uint32_t corners = std::min(table_.valence(vertex_), kMostCorners);
  for (uint32_t i = 0; i < corners; ++i) {
    const uint32_t c = table_.corner(vertex_, i), o = table_.opposite(c);
    const uint32_t va = table_.vertex(CornerTable::next(c));
    const uint32_t vb = table_.vertex(CornerTable::previous(c));
    note_neighbour(va);
    note_neighbour(vb);
    if (!known_[va].known || !known_[vb].known || o == CornerTable::kNone ||
        !known_[table_.vertex(o)].known || gates_.size() == kMostGates)
      continue;
    const Vector3 a = position(va), b = position(vb), apex = position(table_.vertex(o));
    const Vector3 gate = a + b - apex;
    gates_.push_back(gate);
    base_ += gate;
    normal += cross(b - a, apex - a);
    forward += 0.5 * (a + b) - apex;
    valences += static_cast<double>(table_.valence(va)) + table_.valence(vb);
  }
  if (!neighbours_.empty())
    mean_ = (1.0 / static_cast<double>(neighbours_.size())) * mean_;
  if (gates_.empty())
    return;
  const double each = 1.0 / static_cast<double>(gates_.size());
  base_ = each * base_;
  choose_axes(normal);
  make_vectors(each * forward, each * valences);
}

void PosePrediction::note_neighbour(uint32_t w) {
  Known& k = known_[w];
  if (w == vertex_ || k.stamp == vertex_ + 1)
    return;
  k.stamp = vertex_ + 1;
  if (k.known) {
    neighbours_.push_back(w);
    mean_ += position(w);
  }
}

/// The axis nearest the normal is last, the one farthest from it first.
void PosePrediction::choose_axes(const Vector3& normal) {
  for (size_t i = 0; i < 3; ++i) {
    axis_[i] = i;
    share_[i] = 1;
  }
  correlation_ = 0;
  const double size = length(normal);
  normal_ = Vector3{{0, 0, 1}};
  if (!(size > 0))
    return;
  normal_ = (1 / size) * normal;
  size_t k = 0;
  for (size_t i = 1; i < 3; ++i) {
    if (std::fabs(normal_[i]) > std::fabs(normal_[k]))
      k = i;
  }
  size_t i = (k + 1) % 3, j = (k + 2) % 3;
  if (std::fabs(normal_[i]) > std::fabs(normal_[j]))
    std::swap(i, j);
  axis_[0] = i;
  axis_[1] = j;
  axis_[2] = k;
  // A round error in the tangent plane, seen along the axes one after the other.
  share_[0] = std::sqrt(1 - normal_[i] * normal_[i]);
  share_[1] = std::fabs(normal_[k]) / share_[0];
  share_[2] = 1 / std::fabs(normal_[k]);
  correlation_ = -normal_[i] * normal_[j] / (share_[0] * share_[0]);
}

/// The vectors whose combination is the offset from the base.
void PosePrediction::make_vectors(const Vector3& forward, double valences) {
  spread_ = length_ = error_[0] = error_[1] = 0;
  drift_ = Vector3{};
  for (const Vector3& gate : gates_)
    spread_ += length(gate - base_);
  spread_ /= static_cast<double>(gates_.size());
  for (uint32_t w : neighbours_) {
    const Known& k = known_[w];
    length_ += length(position(w) - base_);
    error_[0] += static_cast<double>(k.error[0]);
    error_[1] += static_cast<double>(k.error[1]);
    drift_ += Vector3{{double(k.offset[0]), double(k.offset[1]), double(k.offset[2])}};
  }
  const double each = 1.0 / static_cast<double>(neighbours_.size());
  length_ *= each;
  error_[0] *= each;
  error_[1] *= each;
  drift_ = each * drift_;
  const uint32_t valence = std::max(table_.valence(vertex_), 3U);
  vectors_ = {mean_ - base_,
              drift_,
              forward,
              (6.0 / valence - 1) * forward,
              (valences / 12 - 1) * forward,
              gates_.size() > 1 ? gates_[0] - base_ : Vector3{},
              gates_.size() > 2 ? gates_[1] - base_ : Vector3{}};
}

/// An error as regressed, kept in reason.
double PosePrediction::kept_within(double size, double usual) const {
  const double low = 0.15 * usual, high = 8 * usual + 8 * length_;
  return size > low ? (size < high ? size : high) : low;
}

PosePrediction::Expectation PosePrediction::expect(int step) {
  if (!gates_.empty()) {
    step < 2 ? expect_tangential(step) : expect_height();
    return expected_;
  }
  // Near the known neighbours or the last vertex.
  const double usual = far_usual_[kind_];
  expected_ = {base_[axis_[step]], usual, usual, usual,
               step > 0 ? std::fabs(residual_[axis_[step - 1]]) : usual};
  return expected_;
}

void PosePrediction::expect_tangential(int step) {
  const size_t d = axis_[step];
  for (size_t m = 0; m < kVectors; ++m)
    z_[m] = vectors_[m][d];
  regressed_ = offset_[kind_].predict(z_);
  const double start = base_[d] + (step == 1 ? correlation_ * residual_[axis_[0]] : 0);
  s_ = {error_[0], length_, spread_, usual_[0], step == 1 ? std::fabs(relative_error_) : 0};
  const double usual = error_[0] > 0 ? error_[0] : usual_[0];
  size_ = kept_within(size_of_[0][kind_].predict(s_), std::max(usual, kLeast));
  const double share = share_[step];
  expected_ = {start + regressed_, size_ * share, error_[0] * share, spread_ * share,
               (step == 1 ? s_[4] : length_) * share};
}

/// Height of q along the last axis above the plane of the normal through the base.
double PosePrediction::height_of(const Vector3& q) const {
  const size_t i = axis_[0], j = axis_[1], k = axis_[2];
  return q[k] - base_[k] +
         (normal_[i] * (q[i] - base_[i]) + normal_[j] * (q[j] - base_[j])) / normal_[k];
}

void PosePrediction::expect_height() {
  const int32_t* place = positions_ + size_t{3} * vertex_;
  const size_t i = axis_[0], j = axis_[1], k = axis_[2];
  ground_ = base_[k] -
            (normal_[i] * (place[i] - base_[i]) + normal_[j] * (place[j] - base_[j])) / normal_[k];
  double spread = 0;
  for (const Vector3& gate : gates_)
    spread += std::fabs(height_of(gate));
  spread /= static_cast<double>(gates_.size());
  h_ = {gates_.size() > 1 ? height_of(gates_[0]) : 0, height_of(mean_),
        dot(normal_, drift_) / normal_[k]};
  regressed_ = height_[kind_].predict(h_);
  const double before = static_cast<double>(known_[vertex_].error[0]);
  s_ = {error_[1], spread / share_[2], usual_[1], before, 0};
  const double usual = error_[1] > 0 ? error_[1] : usual_[1];
  size_ = kept_within(size_of_[1][kind_].predict(s_), std::max(usual, kLeast));
  const double share = share_[2];
  expected_ = {ground_ + regressed_, size_ * share, error_[1] * share, spread, before * share};
}

void PosePrediction::learn(int step, int32_t value) {
  gates_.empty() ? learn_far(step, value) : learn_near(step, value);
  if (step == 2) {
    known_[vertex_].known = true;
    last_ = vertex_;
    any_ = true;
  }
}

void PosePrediction::learn_far(int step, int32_t value) {
  const size_t d = axis_[step];
  residual_[d] = value - base_[d];
  far_usual_[kind_] += 0.1 * (std::fabs(residual_[d]) - far_usual_[kind_]);
  if (kind_ == kAlone)
    return;
  Known& known = known_[vertex_];
  known.error[0] += static_cast<float>(std::fabs(residual_[d]) / 3);
  if (step == 2)
    known.error[1] = static_cast<float>(usual_[1]);
}

void PosePrediction::learn_near(int step, int32_t value) {
  const size_t d = axis_[step];
  Known& known = known_[vertex_];
  relative_error_ = (value - expected_.mean) / share_[step];
  const double magnitude = std::fabs(relative_error_);
  const double noise = kNoise + expected_.scale * expected_.scale;
  const int role = step == 2;
  if (role == 0) {
    residual_[d] = value - base_[d] - regressed_;
    offset_[kind_].learn(z_, value - base_[d], noise);
    known.error[0] += static_cast<float>(0.5 * magnitude);
  } else {
    height_[kind_].learn(h_, value - ground_, noise);
    known.error[1] = static_cast<float>(magnitude + kLeast);
  }
  known.offset[d] = static_cast<float>(value - base_[d]);
  size_of_[role][kind_].learn(s_, magnitude, 0.1 + size_ * size_);
  usual_[role] += 0.01 * (magnitude - usual_[role]);
}

}  // namespace anicodec
