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
  std::array<double, kVectors> vector_start{}, vector_variance{};
  std::array<double, kHeights> height_start{}, height_variance{};
  std::array<double, kSizes> size_start{}, size_variance{};
  vector_variance.fill(0.05);
  height_variance.fill(0.05);
  size_variance.fill(0.1);
  size_start[0] = 0.5;  // the neighbours' errors
  size_start[1] = 0.1;  // how long edges are, or how far parallelograms are apart
  for (int follows = 0; follows < 2; ++follows) {
    const bool more = follows == 1;
    if (more) {
      // Halfway between the two places that the other one tells.
      vector_start[kOwnVectors] = vector_start[kOwnVectors + 1] = 0.5;
      height_start[kOwnHeights] = height_start[kOwnHeights + 1] = 0.5;
      size_start[1] = 0;
    }
    for (size_t k = 0; k < kKinds; ++k) {
      offset_[follows][k].start(more ? kVectors : kOwnVectors, vector_start, vector_variance);
      height_[follows][k].start(more ? kHeights : kOwnHeights, height_start, height_variance);
      size_of_[follows][0][k].start(more ? kSizes : kOwnSizes, size_start, size_variance);
      size_of_[follows][1][k].start(more ? kSizes - 1 : kOwnSizes - 1, size_start, size_variance);
    }
  }
}

void PosePrediction::restart() {
  std::fill(known_.begin(), known_.end(), Known());
}

Vector3 PosePrediction::place(const int32_t* places, uint32_t v) {
  const int32_t* p = places + size_t{3} * v;
  return {{double(p[0]), double(p[1]), double(p[2])}};
}

void PosePrediction::Frame::add(const Vector3& a, const Vector3& b, const Vector3& apex) {
  normal += cross(b - a, apex - a);
  forward += 0.5 * (a + b) - apex;
  base += a + b - apex;
  ++gates;
}

bool PosePrediction::Frame::finish() {
  if (gates == 0)
    return false;
  base = (1.0 / gates) * base;
  const double size = length(normal);
  if (!(size > 0))
    return false;
  normal = (1 / size) * normal;
  forward = forward - dot(forward, normal) * normal;
  const double ahead = length(forward);
  if (!(ahead > 0))
    return false;
  forward = (1 / ahead) * forward;
  return true;
}

/// How far the image is from the parallelograms there, in the directions here.
void PosePrediction::follow_frames(const Frame& here, const Frame& there, const Vector3& image) {
  const Vector3 off = image - there.base;
  const double along = dot(off, there.forward), up = dot(off, there.normal),
               side = dot(off, cross(there.normal, there.forward));
  const Vector3 turned = along * here.forward + side * cross(here.normal, here.forward) +
                         (turn_->mirrors() ? -up : up) * here.normal;
  vectors_[kOwnVectors + 1] = here.base + turned - base_;
}

void PosePrediction::begin(uint32_t v, const int32_t* positions) {
  positions_ = positions;
  vertex_ = v;
  turn_ = nullptr;
  gather();
  if (!gates_.empty()) {
    kind_ = gates_.size() == 1 ? kOneGate : gates_.size() == 2 ? kTwoGates : kMoreGates;
    return;
  }
  kind_ = neighbours_.empty() ? kAlone : kBeside;
  base_ = kind_ == kBeside ? mean_ : vertex_ > 0 ? position(vertex_ - 1) : Vector3{};
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
  gate_vertices_.clear();
  base_ = mean_ = Vector3{};
  const uint32_t corners = std::min(table_.valence(vertex_), kMostCorners);
  for (uint32_t i = 0; i < corners; ++i) {
    const uint32_t c = table_.corner(vertex_, i), o = table_.opposite(c);
    const uint32_t va = table_.vertex(next_corner(c));
    const uint32_t vb = table_.vertex(previous_corner(c));
    note_neighbour(va);
    note_neighbour(vb);
    if (va >= vertex_ || vb >= vertex_ || o == CornerTable::kNone || table_.vertex(o) >= vertex_ ||
        gates_.size() == kMostGates)
      continue;
    const Vector3 a = position(va), b = position(vb), apex = position(table_.vertex(o));
    const Vector3 gate = a + b - apex;
    gates_.push_back(gate);
    gate_vertices_.push_back({va, vb, table_.vertex(o)});
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
  if (w >= vertex_ || known_[w].stamp == vertex_ + 1)
    return;
  known_[w].stamp = vertex_ + 1;
  neighbours_.push_back(w);
  mean_ += position(w);
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
              gates_.size() > 2 ? gates_[1] - base_ : Vector3{},
              Vector3{},
              Vector3{}};
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
  const double usual = far_usual_[follows()][kind_];
  expected_ = {base_[axis_[step]], usual, usual, usual,
               step > 0 ? std::fabs(residual_[axis_[step - 1]]) : usual};
  return expected_;
}

void PosePrediction::expect_tangential(int step) {
  const size_t d = axis_[step];
  for (size_t m = 0; m < kVectors; ++m)
    z_[m] = vectors_[m][d];
  regressed_ = offset_[follows()][kind_].predict(z_);
  const double start = base_[d] + (step == 1 ? correlation_ * residual_[axis_[0]] : 0);
  s_ = {error_[0],
        length_,
        spread_,
        usual_[follows()][0],
        step == 1 ? std::fabs(relative_error_) : 0,
        length(vectors_[kOwnVectors] - vectors_[kOwnVectors + 1])};
  const double usual = error_[0] > 0 ? error_[0] : usual_[follows()][0];
  size_ = kept_within(size_of_[follows()][0][kind_].predict(s_), std::max(usual, kLeast));
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
        dot(normal_, drift_) / normal_[k], height_of(base_ + vectors_[kOwnVectors]),
        height_of(base_ + vectors_[kOwnVectors + 1])};
  regressed_ = height_[follows()][kind_].predict(h_);
  const double before = static_cast<double>(known_[vertex_].error[0]);
  s_ = {error_[1],
        spread / share_[2],
        usual_[follows()][1],
        before,
        std::fabs(h_[kOwnHeights] - h_[kOwnHeights + 1]) / share_[2],
        0};
  const double usual = error_[1] > 0 ? error_[1] : usual_[follows()][1];
  size_ = kept_within(size_of_[follows()][1][kind_].predict(s_), std::max(usual, kLeast));
  const double share = share_[2];
  expected_ = {ground_ + regressed_, size_ * share, error_[1] * share, spread, before * share};
}

void PosePrediction::learn(int step, int32_t value) {
  gates_.empty() ? learn_far(step, value) : learn_near(step, value);
  if (step == 2 && follows())
    turn_->learn(there_, position(vertex_) - anchor_);
}

void PosePrediction::learn_far(int step, int32_t value) {
  const size_t d = axis_[step];
  residual_[d] = value - base_[d];
  far_usual_[follows()][kind_] += 0.1 * (std::fabs(residual_[d]) - far_usual_[follows()][kind_]);
  if (kind_ == kAlone)
    return;
  Known& known = known_[vertex_];
  known.error[0] += static_cast<float>(std::fabs(residual_[d]) / 3);
  if (step == 2)
    known.error[1] = static_cast<float>(usual_[follows()][1]);
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
    offset_[follows()][kind_].learn(z_, value - base_[d], noise);
    known.error[0] += static_cast<float>(0.5 * magnitude);
  } else {
    height_[follows()][kind_].learn(h_, value - ground_, noise);
    known.error[1] = static_cast<float>(magnitude + kLeast);
  }
  known.offset[d] = static_cast<float>(value - base_[d]);
  size_of_[follows()][role][kind_].learn(s_, magnitude, 0.1 + size_ * size_);
  usual_[follows()][role] += 0.01 * (magnitude - usual_[follows()][role]);
}

}  // namespace anicodec
