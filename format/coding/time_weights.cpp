// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/time_weights.h"

#include "format/coding/cosine_transform.h"
#include "format/coding/magnitude_class.h"
#include "format/coding/recursive_least_squares.h"
#include "format/coding/weight_model.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>

namespace anicodec {
namespace {

constexpr int32_t kStep = 1 << kWeightFractionBits;
constexpr int32_t kValueLimit = kWeightLimit * kStep;
constexpr uint32_t kMaxChannels = 3;
constexpr double kBitWorth = 0.14;        ///< squared steps to a bit when predictors are compared
constexpr int32_t kMostSpread = 1 << 28;  ///< of predictions, in 1/16 step

int32_t sign(int32_t x) {
  return (x > 0) - (x < 0);
}

/// Codes and counts, and keeps what it would write: for trying a predictor out.
class TrialEncoder {
 public:
  [[maybe_unused]] static constexpr bool kAdapts = true, kDecodes = false;

  /// `least`: cost of the best predictor so far.
  explicit TrialEncoder(const std::atomic<double>& least) : least_(least) {}

  bool bit(uint32_t p, bool value) {
    decisions_.push_back(p << 1 | (value ? 1U : 0U));
    return counter_.bit(p, value);
  }

  bool bit(AdaptiveBit& model, bool value) {
    bit(model.probability(), value);
    model.update(value);
    return value;
  }

  template <class Distribution>
  uint32_t symbol(const Distribution& distribution, uint32_t s) {
    const uint32_t start = distribution.start(s), last = distribution.start(s + 1) - 1;
    decisions_.push_back(kPart | start << kSymbolBits | last);
    return counter_.symbol(distribution, s);
  }

  uint32_t raw(int count, uint32_t value) {
    for (int i = count - 1; i >= 0; --i)
      bit(kProbabilityOne / 2, (value >> i & 1) != 0);
    return value;
  }

  void fail() {}

  void add_error(double squared) { error_ += squared; }

  double bits() const { return static_cast<double>(counter_.total()) / kBitCostOne; }

  /// Whether the predictor can still be the best. Its cost is summed in another order at the end.
  bool ok() const {
    return error_ + kBitWorth * bits() <= least_.load(std::memory_order_relaxed) * (1 + 1e-9);
  }

  void write(BinaryEncoder& encoder) const {
    for (const uint32_t decision : decisions_) {
      if (decision & kPart)
        encoder.part(decision >> kSymbolBits & kMask, (decision & kMask) + 1);
      else
        encoder.bit(decision >> 1, (decision & 1) != 0);
    }
  }

 private:
  static constexpr uint32_t kPart = 1U << 31, kMask = kSymbolScale - 1;

  const std::atomic<double>& least_;
  double error_ = 0;
  BitCounter counter_;
  Vector<uint32_t> decisions_;  ///< probability and bit; with kPart, start and last of a part
};

/// True once a decoder's stream has run out, or a trial costs too much: what follows is not worth the
/// time.
template <class Coder>
bool exhausted(const Coder& coder) {
  if constexpr (Coder::kDecodes || std::is_same_v<Coder, TrialEncoder>)
    return !coder.ok();
  return false;
}

/// The values that a component is encoded from. A decoder has none.
struct Source {
  const double* x;
  double lambda;
};

}  // namespace

struct TimeWeightModel::State {
  explicit State(const Vector<uint32_t>& runs);

  template <class Coder>
  void code(Coder& coder, uint32_t channels, const Source* source, WeightPredictor& predictor,
            int32_t* values);

  /// The predictor that takes the fewest bits to name, for the last components had it.
  uint32_t likeliest() const {
    uint32_t p = 0;
    while (p + 1 < kWeightPredictors && predictor_[p].probability() > kProbabilityOne / 2)
      ++p;
    return p;
  }

 private:
  using Filter = RecursiveLeastSquares<6, 990>;

  /// Magnitudes of a component's coded integers, in kWeightUnit.
  struct Trace {
    uint32_t channels = 0;       ///< 0: no component yet
    Vector<uint32_t> magnitude;  ///< channels x frames
    Vector<uint8_t> any;         ///< of each frame: is anything not 0?

    void start(uint32_t channel_count, uint32_t frames) {
      channels = channel_count;
      magnitude.assign(size_t{channel_count} * frames, 0);
      any.assign(frames, uint8_t{0});
    }
  };

  template <class Coder>
  void code_forward(Coder& coder, uint32_t channels, const Source* source, bool regression,
                    int32_t* values);
  template <class Coder>
  void code_cosine(Coder& coder, uint32_t channels, const Source* source, int32_t* values);

  template <class Coder, class Code>
  static int32_t code_value(Coder& coder, double x, double lambda, const Code& code);
  int32_t evidence(size_t index, uint32_t c) const;
  void learn(uint32_t index, uint32_t c, int32_t q, uint32_t rate);
  uint32_t previous(const Trace& trace, int64_t f, int reach) const;
  uint32_t pattern(const Trace& trace, uint32_t f) const;
  WeightSurroundings surroundings(uint32_t channels, uint32_t c, uint32_t index, uint32_t before,
                                  uint32_t first) const;
  Filter& filter_of(uint32_t channels, uint32_t c);
  Filter::Vector regressors(const int32_t* v, uint32_t f, uint32_t c) const;
  static int32_t rounded_prediction(double predicted);

  /// Place of frame f of the run at hand in a component's arrays, which hold all runs.
  size_t at(uint32_t c, size_t f) const { return size_t{c} * all_frames_ + begin_ + f; }

  Vector<uint32_t> runs_;
  uint32_t all_frames_ = 0;
  uint32_t begin_ = 0, frames_ = 0;  ///< of the run at hand
  AdaptiveBit predictor_[kWeightPredictors - 1];
  WeightModel model_;
  Filter filters_[2][3];     ///< per number of channels (1, 3) and channel
  int32_t agreement_[3][3];  ///< of the signs of two channels, in this component
  Vector<int32_t> coded_;    ///< of this component, channels x frames
  Trace trace_;              ///< of the component at hand
  Trace before_[2];          ///< of the last one coded over frames; over frequencies
  std::optional<CosineTransform> transform_;  ///< the last one used
  uint32_t slow_[3];
};

TimeWeightModel::State::State(const Vector<uint32_t>& runs) : runs_(runs) {
  for (uint32_t run : runs_)
    all_frames_ += run;
}

/// Codes the integer nearest to x, or one nearer to zero if that is worth the bits: code(coder, q). x
/// is ignored by a decoder.
template <class Coder, class Code>
int32_t TimeWeightModel::State::code_value(Coder& coder, double x, double lambda,
                                           const Code& code) {
  int32_t q = 0;
  if constexpr (!Coder::kDecodes) {
    const double size = std::min(x < 0 ? -x : x, 1e8);
    int32_t best = std::min(static_cast<int32_t>(size + 0.5), (1 << 24) - 1);
    if (lambda > 0 && best > 0 && best < 200) {
      const int32_t nearest = best;
      double least = std::numeric_limits<double>::max();
      for (int32_t candidate = nearest; candidate >= 0; --candidate) {
        if (candidate < nearest - 1 && !(candidate == 0 && nearest == 2))
          break;
        BitCounter counter;
        code(counter, x < 0 ? -candidate : candidate);
        const double cost = (size - candidate) * (size - candidate) +
                            lambda * static_cast<double>(counter.total()) / kBitCostOne;
        if (cost < least) {
          least = cost;
          best = candidate;
        }
      }
    }
    q = x < 0 ? -best : best;
  }
  return code(coder, q);
}

/// Predicts the sign of the value at `index` from the signs of the channels before it.
int32_t TimeWeightModel::State::evidence(size_t index, uint32_t c) const {
  int32_t sum = 0;
  for (uint32_t e = 0; e < c; ++e)
    sum += agreement_[c][e] * sign(coded_[at(e, index)]);
  return sum;
}

/// rate: of the channel's running mean, in 1/32.
void TimeWeightModel::State::learn(uint32_t index, uint32_t c, int32_t q, uint32_t rate) {
  const uint32_t m = static_cast<uint32_t>(std::min(q < 0 ? -q : q, 65535)) * kWeightUnit;
  trace_.magnitude[at(c, index)] = m;
  coded_[at(c, index)] = q;
  if (q != 0) {
    trace_.any[begin_ + index] = 1;
    for (uint32_t e = 0; e < c; ++e) {
      int32_t& agreement = agreement_[c][e];
      agreement += 32 * sign(q) * sign(coded_[at(e, index)]) - agreement / 8;
    }
  }
  slow_[c] = ((32 - rate) * slow_[c] + rate * m) >> 5;
}

/// Mean over the channels of an earlier component's magnitudes around f: weights 1 2 1 (reach 1) or
/// equal (reach 2).
uint32_t TimeWeightModel::State::previous(const Trace& trace, int64_t f, int reach) const {
  if (trace.channels == 0)
    return 8 * kWeightUnit;
  uint64_t sum = 0, weight = 0;
  for (uint32_t c = 0; c < trace.channels; ++c)
    for (int64_t d = -reach; d <= reach; ++d) {
      const int64_t near = f + d;
      if (near < 0 || near >= int64_t{frames_})
        continue;
      const uint64_t w = reach == 1 && d == 0 ? 2 : 1;
      sum += w * trace.magnitude[at(c, static_cast<size_t>(near))];
      weight += w;
    }
  return static_cast<uint32_t>(sum / weight);
}

/// Frames at which an earlier component is not 0: bit 0 before f, bit 1 f, bit 2 behind it.
uint32_t TimeWeightModel::State::pattern(const Trace& trace, uint32_t f) const {
  if (trace.channels == 0)
    return 0;
  const uint8_t* any = &trace.any[begin_ + f];
  return (f > 0 ? any[-1] : 0U) | any[0] * 2U | (f + 1 < frames_ ? any[1] * 4U : 0U);
}

/// The surroundings of the value at `index`, without `expected` and what tells its sign. first:
/// what stands for magnitudes before index 0.
WeightSurroundings TimeWeightModel::State::surroundings(uint32_t channels, uint32_t c,
                                                        uint32_t index, uint32_t before,
                                                        uint32_t first) const {
  const uint32_t* m = &trace_.magnitude[at(c, index)];
  WeightSurroundings s{};
  s.recent = index == 0 ? 2 * first : index == 1 ? m[-1] : (5 * m[-1] + 3 * m[-2]) >> 3;
  s.slow = slow_[c];
  for (uint32_t e = 0; e < channels; ++e) {
    if (e != c)
      s.beside += e < c       ? trace_.magnitude[at(e, index)]
                  : index > 0 ? trace_.magnitude[at(e, index) - 1]
                              : first;
  }
  s.beside >>= channels == kMaxChannels;  // mean of the two others
  s.before = before;
  return s;
}

/// The regression of channel c, started if it is new: a straight line.
TimeWeightModel::State::Filter& TimeWeightModel::State::filter_of(uint32_t channels, uint32_t c) {
  Filter& filter = filters_[channels == 1 ? 0 : 1][c];
  if (filter.size() == 0)
    filter.start(4 + c, {1, 1}, {0.04, 0.04, 0.04, 0.04, 0.04, 0.04});
  return filter;
}

/// The value before frame f, its first three differences, and the integers of the channels before.
TimeWeightModel::State::Filter::Vector TimeWeightModel::State::regressors(const int32_t* v,
                                                                          uint32_t f,
                                                                          uint32_t c) const {
  constexpr double kValue = 1.0 / kStep;
  Filter::Vector z{};
  if (f > 0)
    z[0] = v[-1] * kValue;
  if (f > 1)
    z[1] = (v[-1] - v[-2]) * kValue;
  if (f > 2)
    z[2] = (v[-1] - 2 * v[-2] + v[-3]) * kValue;
  if (f > 3)
    z[3] = (v[-1] - 3 * v[-2] + 3 * v[-3] - v[-4]) * kValue;
  for (uint32_t e = 0; e < c; ++e)
    z[4 + e] = coded_[at(e, f)];
  return z;
}

/// Rounded to a quarter of a step; the comparison is false for what is not a number.
int32_t TimeWeightModel::State::rounded_prediction(double predicted) {
  const double quarters = predicted * 4;
  const double limit = kWeightLimit * 4.0;
  return static_cast<int32_t>(
      quarters > -limit && quarters < limit
          ? (static_cast<int64_t>(quarters + limit + 0.5) - kWeightLimit * int64_t{4}) * (kStep / 4)
          : 0);
}

template <class Coder>
void TimeWeightModel::State::code_forward(Coder& coder, uint32_t channels, const Source* source,
                                          bool regression, int32_t* values) {
  std::fill_n(slow_, 3, 0);
  for (uint32_t f = 0; f < frames_ && !exhausted(coder); ++f) {
    const uint32_t before = previous(before_[0], f, 1), around = pattern(before_[0], f);
    for (uint32_t c = 0; c < channels; ++c) {
      int32_t* v = values + at(c, f);
      const int32_t held = f > 0 ? v[-1] : 0, line = f > 1 ? 2 * v[-1] - v[-2] : held;
      Filter& filter = filter_of(channels, c);
      const Filter::Vector z = regressors(v, f, c);
      const int32_t regressed = rounded_prediction(filter.predict(z));
      const int32_t prediction = regression ? regressed : line;
      WeightSurroundings s = surroundings(channels, c, f, before, 0);
      s.expected = (2 * s.recent + 2 * s.slow + s.beside + s.before) / 6;
      s.pattern = around;
      s.signs[0] = f > 0 ? coded_[at(c, f) - 1] : 0;
      s.signs[1] = regression ? (held - regressed) >> 3 : held - line;
      s.evidence = evidence(f, c);
      const uint32_t spread = static_cast<uint32_t>(std::min(std::abs(line - held), kMostSpread)) *
                              (kWeightUnit / kStep);
      const double x = source ? source->x[at(c, f)] - prediction * (1.0 / kStep) : 0;
      const int32_t q = code_value(
          coder, x, source ? source->lambda : 0,
          [&](auto& to, int32_t given) { return model_.code_frame(to, s, spread, given); });
      *v = std::clamp(prediction + q * kStep, -kValueLimit, kValueLimit);
      if constexpr (std::is_same_v<Coder, TrialEncoder>) {
        const double miss = *v * (1.0 / kStep) - source->x[at(c, f)];
        coder.add_error(miss * miss);
      }
      learn(f, c, q, 5);
      const double noise = slow_[c] * (1.0 / kWeightUnit);
      filter.learn(z, *v * (1.0 / kStep), 1.0 / 12 + noise * noise);
    }
  }
}

template <class Coder>
void TimeWeightModel::State::code_cosine(Coder& coder, uint32_t channels, const Source* source,
                                         int32_t* values) {
  if (!transform_ || transform_->length() != frames_)
    transform_.emplace(frames_);
  const CosineTransform& transform = *transform_;
  Vector<double> target(source ? size_t{channels} * frames_ : 0);
  if (source)
    for (uint32_t c = 0; c < channels; ++c)
      transform.forward(source->x + at(c, 0), &target[size_t{c} * frames_]);
  std::fill_n(slow_, 3, 4 * kWeightUnit);
  for (uint32_t k = 0; k < frames_ && !exhausted(coder); ++k) {
    const uint32_t before = before_[1].channels ? previous(before_[1], k, 2) : 0;
    const uint32_t around = pattern(before_[1], k);
    for (uint32_t c = 0; c < channels; ++c) {
      WeightSurroundings s = surroundings(channels, c, k, before, 10 * kWeightUnit);
      s.expected = (s.recent + 2 * s.slow + s.beside + 2 * s.before) / 6;
      s.pattern = around;
      const int32_t* coded = &coded_[at(c, k)];
      s.signs[0] = k > 0 ? coded[-1] : 0;
      s.signs[1] = k > 1 ? coded[-2] : 0;
      s.evidence = evidence(k, c);
      const double x = source ? target[size_t{c} * frames_ + k] : 0;
      int32_t q = code_value(coder, x, source ? source->lambda : 0, [&](auto& to, int32_t given) {
        return model_.code_frequency(to, s, k, given);
      });
      q = std::clamp(q, -CosineTransform::kLimit, CosineTransform::kLimit);
      learn(k, c, q, 8);
    }
  }
  for (uint32_t c = 0; c < channels; ++c)
    transform.inverse(&coded_[at(c, 0)], values + at(c, 0));
}

template <class Coder>
void TimeWeightModel::State::code(Coder& coder, uint32_t channels, const Source* source,
                                  WeightPredictor& predictor, int32_t* values) {
  const auto wanted = static_cast<uint32_t>(predictor);
  uint32_t p = 0;
  while (p + 1 < kWeightPredictors && coder.bit(predictor_[p], wanted > p))
    ++p;
  predictor = static_cast<WeightPredictor>(p);
  const bool cosine = predictor == WeightPredictor::kCosine;
  std::fill_n(values, size_t{channels} * all_frames_, 0);
  trace_.start(channels, all_frames_);
  coded_.assign(size_t{channels} * all_frames_, 0);
  for (auto& row : agreement_)
    std::fill(std::begin(row), std::end(row), 0);
  uint32_t run_end = 0;
  begin_ = 0;
  for (uint32_t run : runs_) {
    run_end += run;
    frames_ = run;
    if (!cosine)
      code_forward(coder, channels, source, predictor == WeightPredictor::kRegression, values);
    // Pieces of a length as equal as can be, none of them longer than a transform.
    for (uint32_t pieces = (run - 1) / CosineTransform::kMaxLength + 1; cosine && pieces > 0;
         --pieces) {
      frames_ = (run_end - begin_) / pieces;
      code_cosine(coder, channels, source, values);
      begin_ += frames_;
    }
    begin_ = run_end;
  }
  std::swap(before_[cosine], trace_);
}

void TimeWeightModel::Release::operator()(State* state) const {
  state->~State();
  if (memory)
    memory->give_back(state, sizeof(State));
  else
    ::operator delete(state);
}

template <class... Arguments>
TimeWeightModel::StatePointer TimeWeightModel::make_state(const Arguments&... arguments) {
  struct Room {
    HostAllocator<State> allocator;
    State* state = allocator.allocate(1);

    ~Room() {  // of a state that could not be made
      if (state)
        allocator.deallocate(state, 1);
    }
  };

  Room room;
  StatePointer made(new (room.state) State(arguments...), Release{room.allocator.memory()});
  room.state = nullptr;
  return made;
}

TimeWeightModel::TimeWeightModel(const Vector<uint32_t>& runs)
    : frames_(std::accumulate(runs.begin(), runs.end(), 0U)), state_(make_state(runs)) {}

TimeWeightModel::~TimeWeightModel() = default;

TimeWeightModel::TimeWeightModel(TimeWeightModel&&) noexcept = default;
TimeWeightModel& TimeWeightModel::operator=(TimeWeightModel&&) noexcept = default;

Status TimeWeightModel::decode(BinaryDecoder& decoder, uint32_t channels, int32_t* values) {
  if (channels != 1 && channels != kMaxChannels)
    return Status::kArgument;
  if (frames_ == 0)
    return Status::kOk;
  WeightPredictor predictor{};
  state_->code(decoder, channels, nullptr, predictor, values);
  return decoder.ok() ? Status::kOk : Status::kEntropy;
}

#if !defined(ANICODEC_DECODER_ONLY)
TimeWeightModel::Choice TimeWeightModel::encode(BinaryEncoder& encoder, uint32_t channels,
                                                const double* x, double lambda, int32_t* values,
                                                uint32_t allowed, const RunTasks& run) {
  struct Trial {
    Trial(const std::atomic<double>& least, size_t size) : coder(least), values(size) {}

    TrialEncoder coder;
    Vector<int32_t> values;
    Choice choice{WeightPredictor::kLine, 0, 0};
    double cost = std::numeric_limits<double>::infinity();
  };

  const Source source{x, lambda};
  Choice best{WeightPredictor::kLine, 0, 0};
  if (frames_ == 0)
    return best;
  const size_t size = size_t{channels} * frames_;
  std::atomic<double> least{std::numeric_limits<double>::max()};
  std::array<std::optional<Trial>, kWeightPredictors> trials;
  // The likeliest first: it cuts the others short.
  const uint32_t first = state_->likeliest();
  run(kWeightPredictors, [&](size_t k) {
    const auto p = static_cast<uint32_t>(k == 0 ? first : k - (k <= first ? 1 : 0));
    if (!(allowed >> p & 1))
      return;
    if (tried_[p])
      *tried_[p] = *state_;
    else
      tried_[p] = make_state(*state_);
    Trial& trial = trials[p].emplace(least, size);
    trial.choice.predictor = static_cast<WeightPredictor>(p);
    tried_[p]->code(trial.coder, channels, &source, trial.choice.predictor, trial.values.data());
    if (!trial.coder.ok())
      return;
    for (size_t i = 0; i < size; ++i) {
      const double d = trial.values[i] * (1.0 / kStep) - x[i];
      trial.choice.squared_error += d * d;
    }
    trial.choice.bits = trial.coder.bits();
    trial.cost = trial.choice.squared_error + kBitWorth * trial.choice.bits;
    for (double known = least; trial.cost < known;) {
      if (least.compare_exchange_weak(known, trial.cost))
        break;
    }
  });
  size_t winner = kWeightPredictors;
  double cost = std::numeric_limits<double>::infinity();
  for (size_t p = 0; p < kWeightPredictors; ++p) {
    if (trials[p] && trials[p]->cost < cost) {
      cost = trials[p]->cost;
      winner = p;
    }
  }
  if (winner == kWeightPredictors) {
    state_->code(encoder, channels, &source, best.predictor, values);
    return best;
  }
  trials[winner]->coder.write(encoder);
  std::copy(trials[winner]->values.begin(), trials[winner]->values.end(), values);
  std::swap(state_, tried_[winner]);
  return trials[winner]->choice;
}
#endif

}  // namespace anicodec
