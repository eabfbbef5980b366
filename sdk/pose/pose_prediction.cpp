// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_prediction.h"

#include "sdk/base/small_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

constexpr double kNoise = 1e-2;         // variance of rounding and the like
constexpr double kShrink = 1.02;        // of a local regression towards the global one, relative
constexpr double kShrinkBy = 0.3;       // and absolute
constexpr double kPatchRegular = 1e-3;  // weight of the parallelogram in its patch
constexpr double kNear = 0.1;           // softens the weights of near points of a fit, in lengths^4

}  // namespace

PosePrediction::PosePrediction(const CornerTable& table, CornerMarks& marks)
    : table_(table),
      corner_marks_(marks),
      known_(table.vertex_count(), false),
      vertex_stamp_(table.vertex_count(), 0),
      unknown_index_(table.vertex_count(), -1),
      samples_(table.vertex_count()) {
  corner_marks_.begin(table.vertex_count());
  std::array<double, kVectors> vector_start{}, vector_variance{};
  std::array<double, kHeights> height_start{}, height_variance{};
  std::array<double, kSpreads> spread_start{}, spread_variance{};
  vector_start[1] = 0.4;  // the patch
  vector_variance.fill(0.05);
  height_variance.fill(0.05);
  spread_variance.fill(0.1);
  height_start[0] = 0.5;  // the quadratic fit
  spread_start[0] = 0.5;  // the neighbours' errors
  spread_start[2] = 0.1;
  for (size_t k = 0; k < kKinds; ++k) {
    offset_slow_[k].start(kVectors, vector_start, vector_variance);
    offset_fast_[k].start(kVectors, vector_start, vector_variance);
    height_slow_[k].start(kHeights, height_start, height_variance);
    height_fast_[k].start(kHeights, height_start, height_variance);
    for (auto& role : spread_of_)
      role[k].start(kSpreads, spread_start, spread_variance);
  }
}

Vector3 PosePrediction::position(uint32_t v) const {
  const int32_t* p = positions_ + size_t{3} * v;
  return {{double(p[0]), double(p[1]), double(p[2])}};
}

uint32_t PosePrediction::corners(uint32_t v) const {
  return std::min(table_.valence(v), kMostCorners);
}

void PosePrediction::begin(uint32_t v, const int32_t* positions) {
  positions_ = positions;
  vertex_ = v;
  neighbours_.clear();
  unknown_.assign(1, v);
  unknown_index_[v] = 0;
  gates_.clear();
  gather_gates();
  if (gates_.empty()) {
    kind_ = neighbours_.empty() ? kAlone : kBeside;
    base_ = !neighbours_.empty() ? mean_ : any_ ? position(last_) : Vector3{};
    for (size_t i = 0; i < 3; ++i)
      axis_[i] = i;
    return;
  }
  kind_ = gates_.size() == 1 ? kOneGate : gates_.size() == 2 ? kTwoGates : kMoreGates;
  gather_nearby();
  patch_ = solved_patch();
}

/// Parallelograms over the edges of the vertex's triangles, the neighbours, and from them the base,
/// the normal and what the regressions start from.
void PosePrediction::gather_gates() {
  Vector3 normal, forward;
  double valences = 0;
  base_ = mean_ = Vector3{};
  for (uint32_t i = 0; i < corners(vertex_); ++i) {
    uint32_t c = table_.corner(vertex_, i), o = table_.opposite(c);
    uint32_t va = table_.vertex(CornerTable::next(c));
    uint32_t vb = table_.vertex(CornerTable::previous(c));
    note_neighbour(va);
    note_neighbour(vb);
    if (!known(va) || !known(vb) || o == CornerTable::kNone || !known(table_.vertex(o)) ||
        gates_.size() == kMostGates)
      continue;
    Vector3 a = position(va), b = position(vb), apex = position(table_.vertex(o));
    gates_.push_back(a + b - apex);
    base_ += gates_.back();
    normal += cross(b - a, apex - a);
    forward += 0.5 * (a + b) - apex;
    valences += static_cast<double>(table_.valence(va)) + table_.valence(vb);
  }
  if (!neighbours_.empty())
    mean_ = (1.0 / static_cast<double>(neighbours_.size())) * mean_;
  if (gates_.empty())
    return;
  double each = 1.0 / static_cast<double>(gates_.size());
  base_ = each * base_;
  choose_axes(normal);
  make_vectors(each * forward, each * valences);
}

void PosePrediction::note_neighbour(uint32_t w) {
  if (w == vertex_ || vertex_stamp_[w] == vertex_ + 1)
    return;
  vertex_stamp_[w] = vertex_ + 1;
  if (known(w)) {
    neighbours_.push_back(w);
    mean_ += position(w);
  } else {
    bool fits = unknown_.size() < kMostUnknown;
    unknown_index_[w] = static_cast<int8_t>(fits ? static_cast<int>(unknown_.size()) : -1);
    if (fits)
      unknown_.push_back(w);
  }
}

/// The axis nearest the normal is last, the one farthest from it first.
void PosePrediction::choose_axes(const Vector3& normal) {
  for (size_t i = 0; i < 3; ++i) {
    axis_[i] = i;
    share_[i] = 1;
  }
  correlation_ = 0;
  double size = length(normal);
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

/// The vectors whose combination is the offset from the base, but for the patch.
void PosePrediction::make_vectors(const Vector3& forward, double valences) {
  disagreement_ = length_ = tangential_ = normal_error_ = 0;
  mean_offset_ = Vector3{};
  for (const Vector3& gate : gates_)
    disagreement_ += length(gate - base_);
  disagreement_ /= static_cast<double>(gates_.size());
  for (uint32_t w : neighbours_) {
    const Sample& s = samples_[w];
    length_ += length(position(w) - base_);
    tangential_ += static_cast<double>(s.error[0]);
    normal_error_ += static_cast<double>(s.error[1]);
    mean_offset_ += Vector3{{double(s.offset[0]), double(s.offset[1]), double(s.offset[2])}};
  }
  double each = 1.0 / static_cast<double>(neighbours_.size());
  length_ *= each;
  tangential_ *= each;
  normal_error_ *= each;
  mean_offset_ = each * mean_offset_;
  uint32_t valence = std::max(table_.valence(vertex_), 3U);
  vectors_ = {mean_ - base_,
              Vector3{},
              mean_offset_,
              forward,
              (6.0 / valence - 1) * forward,
              (valences / 12 - 1) * forward,
              gates_.size() > 1 ? gates_[0] - base_ : Vector3{},
              gates_.size() > 2 ? gates_[1] - base_ : Vector3{}};
}

/// Known vertices in the first two rings.
void PosePrediction::gather_nearby() {
  nearby_.assign(neighbours_.begin(), neighbours_.begin() + static_cast<ptrdiff_t>(std::min(
                                                                neighbours_.size(), kMostNearby)));
  for (size_t q = 0; q < nearby_.size() && nearby_.size() < kMostNearby; ++q) {
    uint32_t w = nearby_[q];
    for (uint32_t i = 0; i < corners(w); ++i) {
      uint32_t c = table_.corner(w, i);
      for (uint32_t d : {CornerTable::next(c), CornerTable::previous(c)}) {
        uint32_t u = table_.vertex(d);
        if (!known(u) || vertex_stamp_[u] == vertex_ + 1 || nearby_.size() == kMostNearby)
          continue;
        vertex_stamp_[u] = vertex_ + 1;
        nearby_.push_back(u);
      }
    }
  }
}

/// The vertex and its unknown neighbours where all pairs of triangles among them and known vertices
/// come closest to parallelograms, by least squares.
Vector3 PosePrediction::solved_patch() {
  SmallSystem<kMostUnknown, 3> system;
  for (uint32_t u : unknown_) {
    for (uint32_t i = 0; i < corners(u); ++i) {
      uint32_t first = table_.corner(u, i) / 3 * 3;
      for (uint32_t c = first; c < first + 3; ++c) {
        uint32_t o = table_.opposite(c);
        if (o == CornerTable::kNone)
          continue;
        uint32_t& mark = corner_marks_[std::min(c, o)];
        if (mark == corner_marks_.base() + vertex_ + 1)
          continue;
        mark = corner_marks_.base() + vertex_ + 1;
        const uint32_t vertices[4] = {table_.vertex(CornerTable::next(c)),
                                      table_.vertex(CornerTable::previous(c)), table_.vertex(c),
                                      table_.vertex(o)};
        constexpr double kSigns[4] = {1, 1, -1, -1};
        int index[4];  // in the system; -1 for a known vertex
        bool complete = true;
        Vector3 right;
        for (size_t k = 0; k < 4; ++k) {
          uint32_t w = vertices[k];
          index[k] = -1;
          if (known(w)) {
            right = right - kSigns[k] * (position(w) - base_);
          } else {
            index[k] = w == vertex_ || vertex_stamp_[w] == vertex_ + 1 ? unknown_index_[w] : -1;
            complete &= index[k] >= 0;
          }
        }
        if (!complete)
          continue;
        for (size_t k = 0; k < 4; ++k) {
          if (index[k] < 0)
            continue;
          auto row = static_cast<size_t>(index[k]);
          for (size_t l = 0; l < 4; ++l) {
            if (index[l] >= 0)
              system.a[row][index[l]] += kSigns[k] * kSigns[l];
          }
          for (size_t d = 0; d < 3; ++d)
            system.b[row][d] += kSigns[k] * right[d];
        }
      }
    }
  }
  for (size_t i = 0; i < unknown_.size(); ++i)
    system.a[i][i] += kPatchRegular;
  if (!system.solve(unknown_.size()))
    return base_;
  return base_ + Vector3{{system.b[0][0], system.b[0][1], system.b[0][2]}};
}

/// A spread as regressed, kept in reason.
double PosePrediction::kept_within(double spread, double usual) const {
  double low = 0.15 * usual, high = 8 * usual + 8 * length_;
  return spread > low ? (spread < high ? spread : high) : low;
}

const StudentMixture& PosePrediction::expect(int step) {
  mixture_.clear();
  if (gates_.empty())
    expect_far(step);
  else if (step < 2)
    expect_tangential(step);
  else
    expect_height();
  return mixture_;
}

/// Without a parallelogram: near the known neighbours or the last vertex.
void PosePrediction::expect_far(int step) {
  double usual = far_usual_[kind_], mean = base_[axis_[step]];
  mixture_.add(mean, 0.1 * usual);
  mixture_.add(mean, 0.3 * usual);
  mixture_.add(mean, usual);
  mixture_.add(mean, step > 0 ? std::fabs(residual_[axis_[step - 1]]) : 3 * usual);
}

/// Adds the regressors z, of which the global regression left `rest`, to a regression nearby.
template <size_t kSize>
void PosePrediction::accumulate(const std::array<double, kSize>& z, double rest, double spread,
                                SmallSystem<kSize>& system) {
  double weight = 1 / (spread * spread + kNoise);
  for (size_t m = 0; m < kSize; ++m) {
    for (size_t o = 0; o <= m; ++o)
      system.a[m][o] += weight * z[m] * z[o];
    system.b[m][0] += weight * z[m] * rest;
  }
}

/// The solution, kept close to 0; 0 where there is none.
template <size_t kSize>
std::array<double, kSize> PosePrediction::shrunk_solution(SmallSystem<kSize> system) {
  for (size_t m = 0; m < kSize; ++m)
    system.a[m][m] = system.a[m][m] * kShrink + kShrinkBy;
  std::array<double, kSize> x{};
  if (system.solve(kSize)) {
    for (size_t m = 0; m < kSize; ++m)
      x[m] = system.b[m][0];
  }
  return x;
}

/// Regressions nearby on what remains of the global one, over so many of the nearest vertices; the
/// weights serve both tangential axes.
void PosePrediction::solve_local_offsets() {
  SmallSystem<kVectors> system;
  size_t q = 0;
  for (size_t reach = 0; reach < kReaches; ++reach) {
    for (; q < std::min(nearby_.size(), kReach[reach]); ++q) {
      const Sample& s = samples_[nearby_[q]];
      if (!(s.spread[0] > 0))
        continue;
      for (int step = 0; step < 2; ++step) {
        std::array<double, kVectors> z;
        for (size_t m = 0; m < kVectors; ++m)
          z[m] = static_cast<double>(s.vectors[m][axis_[step]]);
        double rest = static_cast<double>(s.offset[axis_[step]]) - offset_slow_[kind_].predict(z);
        accumulate(z, rest, static_cast<double>(s.spread[0]), system);
      }
    }
    local_weights_[reach] = shrunk_solution(system);
  }
}

/// The same of the heights.
void PosePrediction::solve_local_heights() {
  SmallSystem<kHeights> system;
  size_t q = 0;
  for (size_t reach = 0; reach < kReaches; ++reach) {
    for (; q < std::min(nearby_.size(), kReach[reach]); ++q) {
      const Sample& s = samples_[nearby_[q]];
      if (!(s.spread[1] > 0))
        continue;
      std::array<double, kHeights> z;
      for (size_t m = 0; m < kHeights; ++m)
        z[m] = static_cast<double>(s.heights[m]);
      double rest = static_cast<double>(s.height) - height_slow_[kind_].predict(z);
      accumulate(z, rest, static_cast<double>(s.spread[1]), system);
    }
    std::array<double, kHeights> x = shrunk_solution(system);
    local_height_[reach] = 0;
    for (size_t m = 0; m < kHeights; ++m)
      local_height_[reach] += x[m] * h_[m];
  }
}

void PosePrediction::expect_tangential(int step) {
  size_t d = axis_[step];
  if (step == 0) {
    vectors_[1] = patch_ - base_;
    solve_local_offsets();
  }
  for (size_t m = 0; m < kVectors; ++m)
    z_[m] = vectors_[m][d];
  regressed_ = offset_slow_[kind_].predict(z_);
  double start = base_[d] + (step == 1 ? correlation_ * residual_[axis_[0]] : 0);
  expected_ = start + regressed_;
  s_ = {tangential_,         disagreement_, length_,
        length(vectors_[1]), usual_[0],     step == 1 ? std::fabs(relative_error_) : 0};
  double usual = tangential_ > 0 ? tangential_ : usual_[0];
  spread_now_ = kept_within(spread_of_[0][kind_].predict(s_), std::max(usual, 1e-3));
  double scale = spread_now_ * share_[step];
  for (double factor : {0.45, 0.9, 1.8})
    mixture_.add(expected_, factor * scale);
  mixture_.add(start, 0.9 * scale);
  mixture_.add(start + vectors_[1][d], 0.9 * scale);
  mixture_.add(start + offset_fast_[kind_].predict(z_), 0.8 * scale);
  for (const auto& weights : local_weights_) {
    double local = 0;
    for (size_t m = 0; m < kVectors; ++m)
      local += weights[m] * z_[m];
    mixture_.add(expected_ + local, 0.8 * scale);
  }
}

/// Height of q along the last axis above the plane of the normal through the base.
double PosePrediction::height_of(const Vector3& q) const {
  size_t i = axis_[0], j = axis_[1], k = axis_[2];
  return q[k] - base_[k] +
         (normal_[i] * (q[i] - base_[i]) + normal_[j] * (q[j] - base_[j])) / normal_[k];
}

/// Height at the vertex's place of a plane or a quadric through the nearby vertices, fitted by
/// moving least squares.
double PosePrediction::fitted_height(bool quadratic) const {
  constexpr size_t kTerms = 6;
  size_t terms = quadratic ? 6 : 3;
  double scale = std::max(length_, 1e-6);
  const int32_t* place = positions_ + size_t{3} * vertex_;
  SmallSystem<kTerms> system;
  for (uint32_t w : nearby_) {
    Vector3 q = position(w);
    double u = (q[axis_[0]] - place[axis_[0]]) / scale;
    double t = (q[axis_[1]] - place[axis_[1]]) / scale;
    double h = height_of(q);
    double squared = u * u + t * t + h * h / (scale * scale);
    double weight = 1 / (kNear + squared * squared);
    const double term[kTerms] = {1, u, t, u * u, u * t, t * t};
    for (size_t m = 0; m < terms; ++m) {
      for (size_t o = 0; o <= m; ++o)
        system.a[m][o] += weight * term[m] * term[o];
      system.b[m][0] += weight * term[m] * h;
    }
  }
  constexpr double kRegular[kTerms] = {1e-6, 0.003, 0.003, 0.02, 0.02, 0.02};
  for (size_t m = 0; m < terms; ++m)
    system.a[m][m] += kRegular[m];
  return system.solve(terms) ? system.b[0][0] : 0;
}

void PosePrediction::expect_height() {
  const int32_t* place = positions_ + size_t{3} * vertex_;
  size_t i = axis_[0], j = axis_[1], k = axis_[2];
  plane_ = base_[k] -
           (normal_[i] * (place[i] - base_[i]) + normal_[j] * (place[j] - base_[j])) / normal_[k];
  double quadric = fitted_height(true), plane = fitted_height(false);
  h_ = {quadric,           plane,
        height_of(patch_), gates_.size() > 1 ? height_of(gates_[0]) : 0,
        height_of(mean_),  dot(normal_, mean_offset_) / normal_[k]};
  regressed_ = height_slow_[kind_].predict(h_);
  expected_ = plane_ + regressed_;
  double disagreement = 0;
  for (const Vector3& gate : gates_)
    disagreement += std::fabs(height_of(gate));
  disagreement /= static_cast<double>(gates_.size());
  s_ = {normal_error_,
        std::fabs(quadric - plane) / share_[2],
        disagreement / share_[2],
        std::fabs(h_[2] - quadric) / share_[2],
        usual_[1],
        static_cast<double>(samples_[vertex_].error[0])};
  double usual = normal_error_ > 0 ? normal_error_ : usual_[1];
  spread_now_ = kept_within(spread_of_[1][kind_].predict(s_), std::max(usual, 1e-3));
  double scale = spread_now_ * share_[2];
  for (double factor : {0.45, 0.9, 1.8})
    mixture_.add(expected_, factor * scale);
  mixture_.add(plane_ + quadric, 0.9 * scale);
  mixture_.add(plane_ + plane, 0.9 * scale);
  mixture_.add(plane_ + height_fast_[kind_].predict(h_), 0.8 * scale);
  solve_local_heights();
  for (double local : local_height_)
    mixture_.add(expected_ + local, 0.8 * scale);
}

void PosePrediction::learn(int step, int32_t value) {
  size_t d = axis_[step];
  Sample& sample = samples_[vertex_];
  if (gates_.empty()) {
    residual_[d] = value - base_[d];
    far_usual_[kind_] += 0.1 * (std::fabs(residual_[d]) - far_usual_[kind_]);
    sample.error[0] += static_cast<float>(kind_ == kBeside ? std::fabs(residual_[d]) / 3 : 0);
  } else {
    double error = value - expected_;
    relative_error_ = error / share_[step];
    double magnitude = std::fabs(relative_error_);
    int role = step == 2;
    double scale = spread_now_ * share_[step], noise = kNoise + scale * scale;
    if (role == 0) {
      residual_[d] = value - base_[d] - regressed_;
      offset_fast_[kind_].learn(z_, value - base_[d], noise);
      offset_slow_[kind_].learn(z_, value - base_[d], noise);
      sample.error[0] += static_cast<float>(0.5 * magnitude);
      for (size_t m = 0; step == 1 && m < kVectors; ++m) {
        for (size_t axis = 0; axis < 3; ++axis)
          sample.vectors[m][axis] = static_cast<float>(vectors_[m][axis]);
      }
    } else {
      height_fast_[kind_].learn(h_, value - plane_, noise);
      height_slow_[kind_].learn(h_, value - plane_, noise);
      sample.error[1] = static_cast<float>(magnitude + 1e-3);
      for (size_t m = 0; m < kHeights; ++m)
        sample.heights[m] = static_cast<float>(h_[m]);
      sample.height = static_cast<float>(value - plane_);
    }
    sample.offset[d] = static_cast<float>(value - base_[d]);
    sample.spread[role] = static_cast<float>(spread_now_);
    spread_of_[role][kind_].learn(s_, magnitude, 0.1 + spread_now_ * spread_now_);
    usual_[role] += 0.01 * (magnitude - usual_[role]);
  }
  if (step == 2) {
    if (kind_ == kBeside)
      sample.error[1] = static_cast<float>(usual_[1]);
    known_[vertex_] = true;
    last_ = vertex_;
    any_ = true;
  }
}

}  // namespace anicodec
