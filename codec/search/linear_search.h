// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_LINEAR_SEARCH_H_
#define ANICODEC_CODEC_SEARCH_LINEAR_SEARCH_H_

#include "codec/search/encoder_input.h"
#include "codec/search/linear_bases.h"
#include "codec/search/linear_choice.h"
#include "codec/search/linear_steps.h"
#include "codec/search/secant.h"
#include "codec/search/segment_search.h"
#include "codec/segment/linear_basis.h"
#include "codec/segment/linear_segment_encode.h"

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace anicodec {

/// Searches how eigenshapes or eigentrajectories code a segment: finds the pose, the base and the settings
/// that give the smallest streams, and the step that meets an error.
class LinearSearch : public SegmentSearch {
 public:
  /// Steps that are tried: those that kinds are compared after, all of the effort, and those that speed opening, too.
  enum class Steps { kFew, kAll, kOpening };

  /// The analysis, of the frames from `first_frame` on, must outlive the search. Bytes below include
  /// the worth of opening time, unless the `smallest` file is wanted.
  LinearSearch(const EncoderInput& input, const LinearAnalysis& analysis, BasisKind kind,
               Effort effort, uint32_t layers, bool smallest, uint32_t first_frame = 0);

  std::optional<CodedSegment> at_rmse(double rmse) override;
  std::optional<CodedSegment> near_rmse(double rmse) override;

  /// Chooses settings for an error by steps, or goes on with those that a call before left. About the bytes that they take
  /// before joint rounding; 0 for Effort::kFirst.
  double choose_settings(double rmse, Steps wanted);

  /// Chooses settings for an error, and tells about the bytes of the segment that at_rmse() makes of it.
  double prepare(double rmse);

  /// Makes the next at_rmse() give up once it is about to take more bytes.
  void give_up_above(double bytes) { most_bytes_ = bytes; }

  /// The bytes that a segment takes in the file, and the price of its opening.
  double bytes(const CodedSegment& segment) const;

  BasisKind kind() const { return kind_; }

  const LinearAnalysis& analysis() const { return analysis_; }

  bool smallest() const { return smallest_; }

  /// Makes the search use a pose that the file has already, with a base that is an affine image of
  /// it, and the settings as they are.
  void share_pose(std::shared_ptr<const EncodedPose> pose);

  /// Takes over the settings of another search, and with what means it codes.
  void settings_of(const LinearSearch& other) {
    choice_.settings = other.choice_.settings;
    choice_.settings.run_steps.clear();  // of other clips
    choice_.regions = other.choice_.regions;
    choice_.components_of_whole = other.choice_.components_of_whole;
    if (choice_.regions > 1)
      bases_->cut_like(*other.bases_, choice_.regions);
    choice_.steps = other.choice_.steps;
    choice_.aim = other.choice_.aim;
    choice_.price = other.choice_.price;
    thorough_ = other.thorough_;
  }

  /// About the bytes that an error costs, from one trial.
  double probe_once(double rmse);

  /// The same from as few trials as come close to the error, three at most, and with regions.
  double probe(double rmse);

  /// Tries a step that speeds opening only if another search, which has tried all of them, kept it.
  void open_like(const LinearSearch& other);

  /// Whether regions may take off some of what one trial costs.
  bool tries_regions() const;

 private:
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  static constexpr double kLeastExponent = 0.35, kMostExponent = 1.5;  // of errors over steps

  struct Measured {
    CodedSegment segment;
    double rmse = 0;   ///< where clips have bounds, that of the clip furthest from its own
    double bytes = 0;  ///< as they would be at the error asked for
    std::vector<double> excesses;  ///< of clips with bounds
  };

  /// The choice that a search begins with, tried at an error.
  struct Probed {
    double rmse = 0, bytes = 0;
    bool is_near = false;                  ///< close enough to the error for sizes to be compared
    double weights = 0, coefficients = 0;  ///< bytes of them, as they were coded
  };

  /// Settings that fewer steps end with.
  struct Candidate {
    LinearChoice choice;
    double bytes = 0;  ///< as one trial told; 0 if none did
  };

  /// A way to the error asked for, by some settings: trials that come closer.
  struct Approach {
    explicit Approach(LinearChoice by)
        : choice(std::move(by)), secant({choice.exponent, kLeastExponent, kMostExponent}) {}

    LinearChoice choice, tried;
    Secant secant;
    std::optional<CodedSegment> best;
    double estimated = 0;  ///< step
    double expected = 0;   ///< bytes, as the first trial tells
    double closest = 0;    ///< ratio of errors to the one asked for, of trials that keep to it
    int round = 0;
    bool ended = false;
  };

  void try_regions(double rmse);
  double expected_bytes(const LinearChoice& choice);

  static Probed probed(const Measured& trial, double rmse);
  LinearChoice started(LinearChoice choice, double rmse);
  void set_step(const LinearBasis& b, double rmse, LinearSettings& settings) const;
  void begin(const LinearChoice& choice) const;
  Measured measured(const LinearChoice& choice, double rmse);
  /// The same of several, at the same time.
  std::vector<Measured> measured(const std::vector<LinearChoice>& choices, double rmse);
  Measured trial(const LinearChoice& choice, double rmse);
  static void even_out(const Measured& trial, LinearChoice& choice);
  static void learn(const Measured& trial, double rmse, LinearChoice& choice);
  bool try_steps(std::span<const LinearStep> steps, double rmse);
  void turn_down(double rmse, CodedSegment& best);
  void advance(Approach& approach);
  std::optional<CodedSegment> reached(Approach& approach);

  const EncoderInput& input_;
  const LinearAnalysis& analysis_;
  bool smallest_;
  uint32_t first_frame_;
  Vector<uint32_t> runs_;  ///< of clips
  BasisKind kind_;
  Effort effort_;
  LinearChoice choice_;
  bool thorough_ = false;  ///< files are coded with joint rounding and refitted weights
  size_t steps_done_ = 0;  ///< of linear_steps()
  size_t failures_ = 0;    ///< of steps, in a row
  std::vector<LinearStep> opening_steps_ = opening_steps();
  double least_ = 0;       ///< bytes in the trial of the settings chosen, until an error is met
  double least_rmse_ = 0;  ///< in that trial
  Probed probed_;
  bool tried_regions_ = false;
  std::vector<Candidate> earlier_;    ///< until the first error is met
  std::vector<Approach> approaches_;  ///< of the error asked for, prepared
  double asked_ = 0, most_bytes_ = kNoLimit;
  bool chosen_ = false;
  std::unique_ptr<LinearBases> bases_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_LINEAR_SEARCH_H_
