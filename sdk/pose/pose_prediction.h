// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The next vertex's position, predicted from the decoded vertices (spec/09b-reference-pose.md).
#ifndef ANICODEC_SDK_POSE_POSE_PREDICTION_H_
#define ANICODEC_SDK_POSE_POSE_PREDICTION_H_

#include "format/coding/recursive_least_squares.h"
#include "format/memory.h"
#include "sdk/base/vector3.h"
#include "sdk/pose/corner_table.h"
#include "sdk/pose/pose_turn.h"

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
/// 0.6 microseconds as a rule. Memory: 24 bytes per vertex.
class PosePrediction {
 public:
  /// How a vertex is surrounded: by nothing, by known vertices, by this many parallelograms of
  /// such.
  enum Kind : uint8_t { kAlone, kBeside, kOneGate, kTwoGates, kMoreGates };

  static constexpr uint32_t kKinds = 5;

  /// The table must outlive it. O(vertices).
  explicit PosePrediction(const CornerTable& table);

  /// Another pose begins: nothing is known of it. Knowledge learnt from earlier poses stays.
  void restart();

  /// Turns to a vertex: each once. `positions`: vertices x 3, those of earlier ones are final.
  void begin(uint32_t v, const int32_t* positions);

  /// The vertex is like another place, whose surroundings are known: predict from there, too.
  ///   turn     of that place into this one; learns
  ///   image    image(w): the vertex there that w is like, or UINT32_MAX
  ///   places   positions of images, vertices x 3
  /// Without an image of the vertex, or of any neighbour of it, nothing changes.
  template <class Image>
  void follow(PoseTurn& turn, const Image& image, const int32_t* places);

  Kind kind() const { return kind_; }

  /// Whether there is another place to predict from.
  bool follows() const { return turn_ != nullptr; }

  /// The vertex as that place has it. @pre follows()
  const Vector3& likely() const { return likely_; }

  /// Axis of the coordinate that is coded as the step-th, 0..2.
  size_t axis(int step) const { return axis_[step]; }

  /// The knowledge of a coordinate before it is coded, in steps of the grid.
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
  static constexpr size_t kVectors = 9, kHeights = 5, kSizes = 6;
  static constexpr size_t kOwnVectors = 7, kOwnHeights = 3, kOwnSizes = 5;

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

  /// The outcome at a known vertex.
  struct Known {
    float offset[3] = {0, 0, 0};  ///< from the mean parallelogram
    float error[2] = {0, 0};      ///< magnitudes, tangential and along the normal
    uint32_t stamp = 0;           ///< one more than the vertex that noted it last
  };

  struct Gate {
    uint32_t a, b, apex;
  };

  /// A frame of directions at an edge and the parallelogram over it.
  struct Frame {
    Vector3 normal, forward, base;
    uint32_t gates = 0;

    void add(const Vector3& a, const Vector3& b, const Vector3& apex);
    /// Makes the directions perpendicular, of length one; false if there are none.
    bool finish();
  };

  static Vector3 place(const int32_t* places, uint32_t v);

  Vector3 position(uint32_t v) const { return place(positions_, v); }

  void follow_frames(const Frame& here, const Frame& there, const Vector3& image);
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

  // For vertices that follow another place, and for the others.
  Filter<kVectors> offset_[2][kKinds];
  Filter<kHeights> height_[2][kKinds];
  Filter<kSizes> size_of_[2][2][kKinds];
  double usual_[2][2] = {{100, 10},
                         {100, 10}};  ///< running means of the errors, tangential and normal
  double far_usual_[2][2] = {{1e4, 300}, {100, 30}};  ///< the same for kAlone and kBeside

  // The vertex at hand.
  uint32_t vertex_ = 0;
  Kind kind_ = kAlone;
  List<uint32_t, size_t{2} * kMostCorners> neighbours_;
  List<Vector3, kMostGates> gates_;
  List<Gate, kMostGates> gate_vertices_;
  PoseTurn* turn_ = nullptr;
  Vector3 there_, anchor_, likely_;  ///< the image from its neighbours; here: those, and the vertex
  Vector3 base_, normal_, mean_, drift_;
  std::array<Vector3, kVectors> vectors_{};
  size_t axis_[3] = {0, 1, 2};
  double share_[3] = {1, 1, 1};  ///< of the error that falls on an axis, given those before
  double correlation_ = 0;       ///< of the errors along the first two axes
  double length_ = 0;            ///< mean distance of the known neighbours from the base
  double spread_ = 0;            ///< of the parallelograms
  double error_[2] = {0, 0};     ///< mean errors of the known neighbours

  // The step at hand and those before.
  std::array<double, kVectors> z_{};
  std::array<double, kHeights> h_{};
  std::array<double, kSizes> s_{};
  double regressed_ = 0, size_ = 0, ground_ = 0, relative_error_ = 0;
  double residual_[3] = {0, 0, 0};
  Expectation expected_;
};

template <class Image>
void PosePrediction::follow(PoseTurn& turn, const Image& image, const int32_t* places) {
  const uint32_t u = image(vertex_);
  if (u == UINT32_MAX)
    return;
  // Neighbours on both sides; for the first vertex of a part, the one before it.
  Vector3 here, there;
  uint32_t count = 0;
  const auto add = [&](uint32_t w) {
    const uint32_t x = image(w);
    if (x == UINT32_MAX)
      return;
    here += position(w);
    there += place(places, x);
    ++count;
  };
  for (const uint32_t w : neighbours_)
    add(w);
  if (kind_ == kAlone && vertex_ > 0)
    add(vertex_ - 1);
  if (count == 0)
    return;
  turn_ = &turn;
  const double each = 1.0 / count;
  anchor_ = each * here;
  there_ = place(places, u) - each * there;
  likely_ = anchor_ + turn.apply(there_);
  if (gates_.empty()) {
    base_ = likely_;
    return;
  }
  Frame frame_here, frame_there;
  for (const Gate& g : gate_vertices_) {
    const uint32_t a = image(g.a), b = image(g.b), apex = image(g.apex);
    if (a == UINT32_MAX || b == UINT32_MAX || apex == UINT32_MAX)
      continue;
    frame_here.add(position(g.a), position(g.b), position(g.apex));
    frame_there.add(place(places, a), place(places, b), place(places, apex));
  }
  vectors_[kOwnVectors] = likely_ - base_;
  vectors_[kOwnVectors + 1] = vectors_[kOwnVectors];
  if (frame_here.finish() && frame_there.finish())
    follow_frames(frame_here, frame_there, place(places, u));
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_PREDICTION_H_
