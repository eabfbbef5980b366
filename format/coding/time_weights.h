// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Entropy coding of the time weights of a segment (spec/08-entropy.md, section 6).
#ifndef ANICODEC_FORMAT_CODING_TIME_WEIGHTS_H_
#define ANICODEC_FORMAT_CODING_TIME_WEIGHTS_H_

#include "format/coding/binary_coder.h"
#include "format/memory.h"
#include "format/status.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace anicodec {

/// How the weights of a component are predicted in time; chosen per component. Numbers are pinned.
enum class WeightPredictor : uint8_t {
  kLine = 0,        ///< through the two frames before
  kRegression = 1,  ///< on the four frames before and the channels before, which adapts
  kCosine = 2,      ///< discrete cosine transform over the frames of a run
};

constexpr uint32_t kWeightPredictors = 3;

/// Decoded weights are in 1/16 of the weight step.
constexpr int kWeightFractionBits = 4;

/// In steps: a decoded weight is within +-kWeightLimit, one to encode within half of that.
constexpr int32_t kWeightLimit = 1 << 22;

/// Calls task(0) to task(count - 1), in any order and at the same time if it can.
using RunTasks = std::function<void(size_t count, const std::function<void(size_t)>& task)>;

inline void run_in_turn(size_t count, const std::function<void(size_t)>& task) {
  for (size_t i = 0; i < count; ++i)
    task(i);
}

/// Codes the time weights of the components of one segment, one component after the other:
/// `channels` (1 or 3) rows of `frames` values each. The frames are runs, one for each clip that the
/// segment has frames of: nothing is predicted over the end of a run, which would be a hard cut.
/// Contexts and regressions carry over from run to run and from component to component.
/// Memory: 60 kB, and 80 bytes per frame.
class TimeWeightModel {
 public:
  /// `runs`: how many frames each run has, none of them 0.
  explicit TimeWeightModel(const Vector<uint32_t>& runs);

  explicit TimeWeightModel(uint32_t frames)
      : TimeWeightModel(Vector<uint32_t>(frames > 0, frames)) {}

  ~TimeWeightModel();
  TimeWeightModel(TimeWeightModel&&) noexcept;
  TimeWeightModel& operator=(TimeWeightModel&&) noexcept;

  /// Reads a component into `values`: channels x frames. kEntropy: not a stream of an encoder;
  /// values are then arbitrary but within limits. O(frames x channels), with kCosine times the
  /// length of a transform, at most CosineTransform::kMaxLength.
  Status decode(BinaryDecoder& decoder, uint32_t channels, int32_t* values);

  struct Choice {
    WeightPredictor predictor;
    double squared_error;  ///< of all values, in steps^2
    double bits;
  };

  /// Codes real weights `x` (channels x frames, in steps, |x| <= kWeightLimit / 2) by the predictor
  /// with the smallest squared error + 0.14 bits, quantising each with squared error + lambda bits
  /// in mind (0.08 to 0.12 is good; 0 rounds to the nearest). `values` receives what a decoder
  /// gets. `allowed`: bit p for predictor p. `run` tries the predictors; the stream is the same
  /// whatever it does at the same time.
  Choice encode(BinaryEncoder& encoder, uint32_t channels, const double* x, double lambda,
                int32_t* values, uint32_t allowed = (1u << kWeightPredictors) - 1,
                const RunTasks& run = run_in_turn);

 private:
  struct State;

  /// Gives a state back to the memory that it came from.
  struct Release {
    Memory* memory;
    void operator()(State* state) const;
  };

  using StatePointer = std::unique_ptr<State, Release>;

  template <class... Arguments>
  static StatePointer make_state(const Arguments&... arguments);

  uint32_t frames_;  ///< of all runs
  StatePointer state_;
  std::array<StatePointer, kWeightPredictors> tried_;  ///< room of the encoder's trials
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_TIME_WEIGHTS_H_
