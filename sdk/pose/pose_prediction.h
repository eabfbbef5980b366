// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// What the vertices decoded so far say of the next one's position (spec/09b-reference-pose.md).
#ifndef ANICODEC_SDK_POSE_POSE_PREDICTION_H_
#define ANICODEC_SDK_POSE_POSE_PREDICTION_H_

#include "format/memory.h"
#include "format/recursive_least_squares.h"
#include "sdk/base/vector3.h"
#include "sdk/pose/surface_growth.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Predicts a vertex from parallelograms of earlier ones and from what surrounds them, by linear
/// regression on the vertices already known. The coordinate nearest the surface normal comes last,
/// as a height over the other two.
///
/// IEEE binary64, round to nearest, every sum in the order written, nothing but + - * / and square
/// root: a decoder repeats it exactly. Time per vertex is bounded whatever the triangles are, about
/// 0.6 microseconds as a rule. Memory: 32 bytes per vertex.
class PosePrediction {
 public:
  /// How a vertex is surrounded: by nothing, by known vertices, by this many parallelograms of
  /// such.
  enum Kind : uint8_t { kAlone, kBeside, kOneGate, kTwoGates, kMoreGates };

  static constexpr uint32_t kKinds = 5;

  /// The table must outlive it. O(vertices).
  explicit PosePrediction(const CornerTable& table);

  /// Turns to a vertex: each once. `positions`: vertices x 3, those of earlier ones are final.
  void begin(uint32_t v, const int32_t* positions);

  Kind kind() const { return kind_; }

  /// Axis of the coordinate that is coded as the step-th, 0..2.
  size_t axis(int step) const { return axis_[step]; }

  /// What is known of a coordinate before it is coded, in steps of the grid.
  struct Expectation {
    double mean = 0;
    double scale = 0;   ///< expected magnitude of the error
    double near = 0;    ///< of the errors of known neighbours
    double spread = 0;  ///< of the parallelograms
    double before = 0;  ///< error along the axis before; at the first, how long the edges are
  };

  /// @pre steps in order
  Expectation expect(int step);

  /// The coordinate turned out to be `value`.
  void learn(int step, int32_t value);

  /// Parallelograms of the vertex at hand, and its known neighbours, as its triangles list them.
  const auto& gates() const { return gates_; }

  const auto& neighbours() const { return neighbours_; }

 private:
  static constexpr uint32_t kMostCorners = 32;  ///< of a vertex that are looked at
  static constexpr size_t kMostGates = 16;
  static constexpr size_t kVectors = 7, kHeights = 3, kSizes = 5;

  /// A list whose length is bounded.
  template <class T, size_t kMost>
  class List {
   public:
    void clear() { size_ = 0; }

    void push_back(const T& x) { items_[size_++] = x; }

    size_t size() const { return size_; }

    bool empty() const { return size_ == 0; }

    const T& operator[](size_t i) const { return items_[i]; }

    const T* begin() const { return items_.data(); }

    const T* end() const { return items_.data() + size_; }

   private:
    std::array<T, kMost> items_{};
    size_t size_ = 0;
  };

  template <size_t kInputs>
  using Filter = RecursiveLeastSquares<kInputs, 994>;

  /// What came of a known vertex.
  struct Known {
    float offset[3] = {0, 0, 0};  ///< from the mean parallelogram
    float error[2] = {0, 0};      ///< magnitudes, tangential and along the normal
    uint32_t stamp = 0;           ///< one more than the vertex that noted it last
    bool known = false;
  };

  Vector3 position(uint32_t v) const;
  void note_neighbour(uint32_t w);
  void gather();
  void choose_axes(const Vector3& normal);
  void make_vectors(const Vector3& forward, double valences);
  double kept_within(double size, double usual) const;
  double height_of(const Vector3& q) const;
  void expect_tangential(int step);
  void expect_height();
  void learn_far(int step, int32_t value);
  void learn_near(int step, int32_t value);

  const CornerTable& table_;
  const int32_t* positions_ = nullptr;
  Vector<Known> known_;

  Filter<kVectors> offset_[kKinds];
  Filter<kHeights> height_[kKinds];
  Filter<kSizes> size_of_[2][kKinds];
  double usual_[2] = {100, 10};       ///< running means of the errors, tangential and normal
  double far_usual_[2] = {1e4, 300};  ///< the same for kAlone and kBeside

  // Of the vertex at hand.
  uint32_t vertex_ = 0, last_ = 0;
  bool any_ = false;
  Kind kind_ = kAlone;
  List<uint32_t, size_t{2} * kMostCorners> neighbours_;
  List<Vector3, kMostGates> gates_;
  Vector3 base_, normal_, mean_, drift_;
  std::array<Vector3, kVectors> vectors_{};
  size_t axis_[3] = {0, 1, 2};
  double share_[3] = {1, 1, 1};  ///< of the error that falls on an axis, given those before
  double correlation_ = 0;       ///< of the errors along the first two axes
  double length_ = 0;            ///< mean distance of the known neighbours from the base
  double spread_ = 0;            ///< of the parallelograms
  double error_[2] = {0, 0};     ///< mean errors of the known neighbours

  // Of the step at hand and those before.
  std::array<double, kVectors> z_{};
  std::array<double, kHeights> h_{};
  std::array<double, kSizes> s_{};
  double regressed_ = 0, size_ = 0, ground_ = 0, relative_error_ = 0;
  double residual_[3] = {0, 0, 0};
  Expectation expected_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_PREDICTION_H_
