// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// What the vertices decoded so far say of the next one's position (spec/09c-reference-pose.md).
#ifndef ANICODEC_SDK_POSE_POSE_PREDICTION_H_
#define ANICODEC_SDK_POSE_POSE_PREDICTION_H_

#include "format/memory.h"
#include "format/recursive_least_squares.h"
#include "format/student_mixture.h"
#include "sdk/base/small_solver.h"
#include "sdk/base/vector3.h"
#include "sdk/pose/surface_growth.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Predicts a vertex from parallelograms of earlier ones and from what surrounds them, by linear
/// regression on the vertices already known: recursively over all of them and, around each vertex,
/// over those nearby (in the manner of X. Li and M. Orchard, "Edge-directed prediction for lossless
/// compression of natural images", 2001). The coordinate nearest the surface normal comes last, as
/// a height over the other two.
///
/// IEEE binary64, round to nearest, every sum in the order written, nothing but + - * / and square
/// root: a decoder repeats it exactly. Time per vertex is bounded whatever the triangles are.
/// Memory: about 210 bytes per vertex.
class PosePrediction {
 public:
  /// Table and marks must outlive it; marks.begin() is called here. Cost: O(vertices), however many
  /// corners there are.
  PosePrediction(const CornerTable& table, CornerMarks& marks);

  /// Turns to a vertex: each once. `positions`: vertices x 3, those of earlier ones are final.
  void begin(uint32_t v, const int32_t* positions);

  /// Axis of the coordinate that is coded as the step-th, 0..2.
  size_t axis(int step) const { return axis_[step]; }

  /// What is expected of the coordinate of this step. @pre steps in order
  const StudentMixture& expect(int step);

  /// Weights that go with expect().
  MixtureWeights& weights(int step) { return weights_[kind_][step]; }

  /// The coordinate turned out to be `value`.
  void learn(int step, int32_t value);

 private:
  enum Kind : uint8_t { kAlone, kBeside, kOneGate, kTwoGates, kMoreGates };

  static constexpr size_t kKinds = 5;
  static constexpr size_t kVectors = 8, kHeights = 6, kSpreads = 6;
  static constexpr uint32_t kMostCorners = 32;  ///< of a vertex that are looked at
  static constexpr size_t kMostNearby = 32, kMostUnknown = 10, kMostGates = 16;

  static constexpr size_t kReaches = 3;
  static constexpr size_t kReach[kReaches] = {6, 14, 32};  ///< nearby vertices of a regression

  template <size_t kSize>
  using Slow = RecursiveLeastSquares<kSize, 997>;
  template <size_t kSize>
  using Fast = RecursiveLeastSquares<kSize, 970>;
  using Vectors = std::array<Vector3, kVectors>;

  /// What a known vertex was predicted from and what came of it.
  struct Sample {
    float vectors[kVectors][3], offset[3];  ///< offset: from the mean parallelogram
    float heights[kHeights], height;
    float spread[2];  ///< expected, tangential and normal; 0: nothing to learn from
    float error[2];   ///< magnitudes, tangential and normal
  };

  Vector3 position(uint32_t v) const;

  bool known(uint32_t v) const { return known_[v]; }

  uint32_t corners(uint32_t v) const;
  void note_neighbour(uint32_t w);
  void gather_gates();
  void gather_nearby();
  Vector3 solved_patch();
  void choose_axes(const Vector3& normal);
  void make_vectors(const Vector3& forward, double valences);
  template <size_t kSize>
  static void accumulate(const std::array<double, kSize>& z, double rest, double spread,
                         SmallSystem<kSize>& system);
  template <size_t kSize>
  static std::array<double, kSize> shrunk_solution(SmallSystem<kSize> system);
  void solve_local_offsets();
  void solve_local_heights();
  double fitted_height(bool quadratic) const;
  double height_of(const Vector3& q) const;
  double kept_within(double spread, double usual) const;
  void expect_far(int step);
  void expect_tangential(int step);
  void expect_height();

  const CornerTable& table_;
  CornerMarks& corner_marks_;
  const int32_t* positions_ = nullptr;
  Vector<bool> known_;
  Vector<uint32_t> vertex_stamp_;  ///< vertex that noted them last
  Vector<int8_t> unknown_index_;
  Vector<Sample> samples_;

  MixtureWeights weights_[kKinds][3];
  Slow<kVectors> offset_slow_[kKinds];
  Fast<kVectors> offset_fast_[kKinds];
  Slow<kHeights> height_slow_[kKinds];
  Fast<kHeights> height_fast_[kKinds];
  Slow<kSpreads> spread_of_[2][kKinds];
  double usual_[2] = {100, 10};       ///< running means of the errors, tangential and normal
  double far_usual_[2] = {1e4, 300};  ///< the same for kAlone and kBeside

  // Of the vertex at hand.
  uint32_t vertex_ = 0, last_ = 0;
  bool any_ = false;
  Kind kind_ = kAlone;
  Vector<uint32_t> neighbours_, unknown_, nearby_;
  Vector<Vector3> gates_;
  Vector3 base_, normal_, mean_, patch_, mean_offset_;
  Vectors vectors_;
  size_t axis_[3] = {0, 1, 2};
  double share_[3] = {1, 1, 1};  ///< of the spread that falls on an axis, given those before
  double correlation_ = 0;       ///< of the errors along the first two axes
  double length_ = 0;            ///< mean distance of the known neighbours from the base
  double disagreement_ = 0;      ///< of the parallelograms
  double tangential_ = 0, normal_error_ = 0;  ///< mean errors of the known neighbours
  std::array<double, kVectors> local_weights_[kReaches] = {}, z_{};
  double local_height_[kReaches] = {};
  std::array<double, kHeights> h_{};
  std::array<double, kSpreads> s_{};
  // Of the step at hand and those before.
  double regressed_ = 0, expected_ = 0, spread_now_ = 0, plane_ = 0, relative_error_ = 0;
  double residual_[3] = {0, 0, 0};
  StudentMixture mixture_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_PREDICTION_H_
