// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Positions bit for bit (spec/09d-exact-positions.md). Written once for encoder and decoder: what
// is predicted is exact arithmetic, single operations of binary64 in the order written.
#ifndef ANICODEC_SDK_EXACT_EXACT_CODING_H_
#define ANICODEC_SDK_EXACT_EXACT_CODING_H_

#include "format/coding/binary_coder.h"
#include "format/coding/recursive_least_squares.h"
#include "format/coding/symbol_model.h"
#include "format/exact_record.h"
#include "format/memory.h"
#include "sdk/exact/earlier_neighbours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace anicodec {

/// Finite numbers of binary32 as integers in ascending order: -0 is -1, and 0 is 0.
inline int32_t ordinal(float x) {
  int32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits < 0 ? -1 - (bits & INT32_MAX) : bits;
}

inline float from_ordinal(int32_t x) {
  const auto bits = static_cast<uint32_t>(x < 0 ? -1 - x : x) | (x < 0 ? 0x80000000U : 0U);
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

inline constexpr int32_t kLargestOrdinal = 0x7F7FFFFF;  ///< of the largest finite number

/// A difference of ordinals modulo 2^32 - 1: it fits 32 bits, and leads back to a finite number.
inline int64_t wrapped(int64_t difference) {
  constexpr int64_t kModulus = UINT32_MAX, kHalf = INT32_MAX;
  return difference + (difference > kHalf ? -kModulus : difference < -kHalf ? kModulus : 0);
}

/// The coordinate of a lattice point, rounded; infinite where it is too large.
inline float lattice_point(const ExactRecord::Lattice& lattice, int64_t k) {
  const double offset = static_cast<double>(k) * lattice.step;
  return static_cast<float>(lattice.origin + offset);
}

/// The nearest of the lattice's points to a coordinate.
inline int64_t nearest_point(const ExactRecord::Lattice& lattice, double x) {
  const double k = std::floor((x - lattice.origin) / lattice.step + 0.5);
  const double first = lattice.first, last = first + (lattice.count - 1.0);
  return static_cast<int64_t>(!(k > first) ? first : k < last ? k : last);
}

class ExactCoding {
 public:
  /// The neighbours must outlive it. Memory: 26 bytes for each vertex, four for each lattice point.
  ExactCoding(const ExactRecord& record, const EarlierNeighbours& neighbours, uint32_t vertices)
      : neighbours_(neighbours),
        vertices_(vertices),
        noise_(record.noise),
        size_(size_t{3} * vertices, 0.0F),
        size_before_(size_t{3} * vertices, 0.0F),
        same_(vertices, 0),
        same_before_(vertices, 0) {
    for (uint32_t c = 0; c < 3; ++c) {
      axes_[c].lattice = record.lattices[c];
      axes_[c].error.assign(record.lattices[c].errs ? record.lattices[c].count : 0, kUnseen);
      Prediction::Vector weights{}, variance{};
      variance.fill(0.1);
      std::fill_n(weights.begin(), EarlierNeighbours::kCount, 0.25);
      axes_[c].prediction.start(kInputs, weights, variance);
      axes_[c].in_space.start(EarlierNeighbours::kCount - 1, {0.25, 0.25, 0.25}, {0.1, 0.1, 0.1});
    }
  }

  /// Codes frame f of `positions`, frames x vertices x 3, given the frames before it. `reference`:
  /// the frame that the encoder predicts it from, one before it. False for a stream that ran out or
  /// that no encoder writes; then the frame holds anything. Cost: O(vertices).
  template <class Coder>
  bool code_frame(Coder& coder, uint32_t f, uint32_t reference, float* positions) {
    const size_t frame = size_t{3} * vertices_;
    if (f > 0) {
      const auto back =
          static_cast<uint32_t>(distance_.code(coder, static_cast<int32_t>(f - 1 - reference)));
      if (back >= f)
        return false;
      reference = f - 1 - back;
    }
    references_.push_back(reference);
    first_ = f == 0;
    at_ = positions + frame * f;
    from_ = positions + frame * reference;
    before_ = reference == 0 ? from_ : positions + frame * references_[reference];
    std::swap(size_, size_before_);
    std::swap(same_, same_before_);
    for (uint32_t v = 0; v < vertices_; ++v) {
      same_[v] = !first_ && code_same(coder, v);
      for (uint32_t c = 0; c < 3; ++c) {
        const size_t i = size_t{3} * v + c;
        if (same_[v]) {
          at_[i] = from_[i];
          size_[i] = 0.5F * size_before_[i];
        } else if (!code_coordinate(coder, v, c)) {
          return false;
        }
      }
      if constexpr (Coder::kDecodes) {
        if (!coder.ok())
          return false;
      }
    }
    return true;
  }

 private:
  static constexpr uint32_t kInputs = 2 * EarlierNeighbours::kCount + 1;
  static constexpr uint32_t kClasses = 64;
  static constexpr int32_t kUnseen = INT32_MIN;
  using Prediction = RecursiveLeastSquares<kInputs>;
  using InSpace = RecursiveLeastSquares<EarlierNeighbours::kCount - 1>;

  struct Axis {
    ExactRecord::Lattice lattice;
    Vector<int32_t> error;  ///< of each lattice point, as last seen
    bool erred = false;     ///< whether the last error of a new point was not 0
    Prediction prediction;
    InSpace in_space;  ///< of frame 0
    SymbolModel<> residual[kClasses];
    SymbolModel<> errors[3];
  };

  template <class Coder>
  bool code_same(Coder& coder, uint32_t v) {
    uint32_t like = 0;
    for (uint32_t i = 0; v > 0 && i < EarlierNeighbours::kCount; ++i)
      like += same_[neighbours_.of(v)[i]];
    const size_t i = size_t{3} * v;
    const bool same = !Coder::kDecodes && std::memcmp(at_ + i, from_ + i, 3 * sizeof(float)) == 0;
    return coder.bit(same_models_[same_before_[v]][like], same);
  }

  /// How far a vertex came to the frame, and how far before to the one that it is predicted from.
  double moved(uint32_t v, uint32_t c) const {
    const size_t i = size_t{3} * v + c;
    return static_cast<double>(at_[i]) - static_cast<double>(from_[i]);
  }

  double moved_before(uint32_t v, uint32_t c) const {
    const size_t i = size_t{3} * v + c;
    return static_cast<double>(from_[i]) - static_cast<double>(before_[i]);
  }

  double from_last_neighbour(uint32_t v, uint32_t c) const {
    return static_cast<double>(at_[size_t{3} * v + c]) -
           static_cast<double>(at_[size_t{3} * neighbours_.of(v)[0] + c]);
  }

  /// From the last neighbour and how far the others are from it; `inputs` are these.
  double predict_in_space(uint32_t v, uint32_t c, InSpace::Vector* inputs) const {
    if (v == 0)
      return 0;
    const uint32_t* const near = neighbours_.of(v);
    const auto from = static_cast<double>(at_[size_t{3} * near[0] + c]);
    for (uint32_t i = 1; i < EarlierNeighbours::kCount; ++i)
      (*inputs)[i - 1] = static_cast<double>(at_[size_t{3} * near[i] + c]) - from;
    const double x = from + axes_[c].in_space.predict(*inputs);
    return std::fabs(x) <= kLargest ? x : from;
  }

  double predict(uint32_t v, uint32_t c, Prediction::Vector* inputs) const {
    constexpr uint32_t kCount = EarlierNeighbours::kCount;
    const uint32_t* const near = v > 0 ? neighbours_.of(v) : nullptr;
    for (uint32_t i = 0; near && i < kCount; ++i) {
      (*inputs)[i] = moved(near[i], c);
      (*inputs)[kCount + i] = moved_before(near[i], c);
    }
    (*inputs)[2 * kCount] = moved_before(v, c);
    const auto from = static_cast<double>(from_[size_t{3} * v + c]);
    const double x = from + axes_[c].prediction.predict(*inputs);
    return std::fabs(x) <= kLargest ? x : from;
  }

  /// How far off the prediction is expected to be, by what it was nearby and before.
  double expected(uint32_t v, uint32_t c) const {
    double near = 0;
    for (uint32_t i = 0; v > 0 && i < EarlierNeighbours::kCount; ++i)
      near += static_cast<double>(size_[size_t{3} * neighbours_.of(v)[i] + c]);
    near *= 0.25;
    double all = near;
    if (!first_)
      all = (near + static_cast<double>(size_before_[size_t{3} * v + c])) * 0.5;
    if (c > 0)
      all = 0.6 * all + 0.4 * static_cast<double>(size_[size_t{3} * v + c - 1]);
    return all;
  }

  /// Two classes for each octave of a ratio, from 2^-5 on.
  static uint32_t class_of(double ratio) {
    uint64_t bits;
    std::memcpy(&bits, &ratio, sizeof bits);
    const int64_t halves = static_cast<int64_t>(bits >> 51) - 2 * 1023 + 10;
    return static_cast<uint32_t>(std::clamp<int64_t>(halves, 0, kClasses - 1));
  }

  /// The distance of the numbers of binary32 around x.
  static double spacing(float x) {
    uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    const int exponent = static_cast<int>(bits >> 23 & 255);
    return std::ldexp(1.0, std::max(exponent, 1) - 150);
  }

  template <class Coder>
  bool code_coordinate(Coder& coder, uint32_t v, uint32_t c) {
    Axis& axis = axes_[c];
    const size_t i = size_t{3} * v + c;
    Prediction::Vector inputs{};
    InSpace::Vector in_space{};
    const double predicted = first_ ? predict_in_space(v, c, &in_space) : predict(v, c, &inputs);
    const double quantum =
        axis.lattice.is_used() ? axis.lattice.step : spacing(static_cast<float>(predicted));
    SymbolModel<>& model = axis.residual[class_of(expected(v, c) / quantum)];
    const bool good = axis.lattice.is_used()
                          ? code_on_lattice(coder, model, predicted, axis, at_ + i)
                          : code_number(coder, model, predicted, at_ + i);
    if (!good)
      return false;
    const auto missed = static_cast<float>(std::fabs(static_cast<double>(at_[i]) - predicted));
    size_[i] = first_ ? missed : 0.7F * missed + 0.3F * size_before_[i];
    if (first_ && v > 0)
      axis.in_space.learn(in_space, from_last_neighbour(v, c), noise_);
    if (!first_ && v % 2 == 0)
      axis.prediction.learn(inputs, moved(v, c), noise_);
    return true;
  }

  /// A number by its distance from the predicted one, modulo 2^32 - 1.
  template <class Coder>
  static bool code_number(Coder& coder, SymbolModel<>& model, double predicted, float* x) {
    const int64_t from = ordinal(static_cast<float>(predicted));
    int64_t residual = 0;
    if constexpr (!Coder::kDecodes)
      residual = wrapped(ordinal(*x) - from);
    return store(wrapped(from + model.code(coder, static_cast<int32_t>(residual))), x);
  }

  template <class Coder>
  static bool code_on_lattice(Coder& coder, SymbolModel<>& model, double predicted, Axis& axis,
                              float* x) {
    const ExactRecord::Lattice& lattice = axis.lattice;
    const int64_t from = nearest_point(lattice, predicted);
    int64_t k = 0;
    if constexpr (!Coder::kDecodes)
      k = nearest_point(lattice, static_cast<double>(*x));
    k = from + model.code(coder, static_cast<int32_t>(k - from));
    if (k < lattice.first || k - lattice.first >= int64_t{lattice.count})
      return false;
    const int64_t point = ordinal(lattice_point(lattice, k));
    if (!lattice.errs)
      return store(point, x);
    int32_t& known = axis.error[static_cast<size_t>(k - lattice.first)];
    const bool is_new = known == kUnseen;
    const int32_t before = is_new ? 0 : known;
    int32_t change = 0;
    if constexpr (!Coder::kDecodes)
      change = static_cast<int32_t>(wrapped(wrapped(ordinal(*x) - point) - before));
    change = axis.errors[is_new ? static_cast<int>(axis.erred) : 2].code(coder, change);
    const int64_t error = wrapped(int64_t{before} + change);
    if (is_new)
      axis.erred = error != 0;
    known = static_cast<int32_t>(error);
    return store(wrapped(point + error), x);
  }

  static bool store(int64_t at, float* x) {
    if (at > kLargestOrdinal || at < -1 - int64_t{kLargestOrdinal})
      return false;
    *x = from_ordinal(static_cast<int32_t>(at));
    return true;
  }

  static constexpr double kLargest = 3.4028234663852886e38;  // of binary32

  const EarlierNeighbours& neighbours_;
  uint32_t vertices_;
  double noise_;
  Axis axes_[3];
  AdaptiveBit same_models_[2][EarlierNeighbours::kCount + 1];
  UnsignedModel distance_;
  Vector<uint32_t> references_;         ///< of the frames so far
  Vector<float> size_, size_before_;    ///< how far predictions missed, in this frame and the last
  Vector<uint8_t> same_, same_before_;  ///< vertices as in the frame that they are predicted from
  bool first_ = true;                   ///< the frame at hand
  float* at_ = nullptr;
  const float *from_ = nullptr, *before_ = nullptr;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_EXACT_EXACT_CODING_H_
