// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Options of the host.
#include "codec/api/encoder_objects.h"
#include "codec/api/guarded.h"

#include <cmath>
#include <optional>

namespace anicodec {
namespace {

constexpr double kDefaultPercent = 0.05;

[[noreturn]] void refuse(const std::string& text) {
  throw EncoderFailure(ANIC_E_ARGUMENT, text);
}

/// An enumerator of the host as one of ours. Throws for a number that is not in the table.
template <class Ours, class Theirs, size_t kCount>
Ours chosen(Theirs value, const Ours (&table)[kCount], const char* what) {
  const auto i = static_cast<size_t>(value);
  if (static_cast<int32_t>(value) < 0 || i >= kCount)
    refuse(std::string(what) + ": there is no choice " +
           std::to_string(static_cast<int32_t>(value)));
  return table[i];
}

uint32_t within(uint32_t value, uint32_t standard, uint32_t most, const char* what) {
  if (value > most)
    refuse(std::string(what) + " must be from 1 to " + std::to_string(most) + ", not " +
           std::to_string(value));
  return value == 0 ? standard : value;
}

/// A number that is finite and not negative.
double amount(double value, const char* what) {
  if (!(std::isfinite(value) && value >= 0))
    refuse(std::string(what) + " must be finite and not negative");
  return value;
}

void set_goal(const anic_encode_options& host, EncodeOptions& options) {
  constexpr ErrorMetric kMetrics[] = {
      ErrorMetric::kNone, ErrorMetric::kMaxError, ErrorMetric::kKg,           ErrorMetric::kRmse,
      ErrorMetric::kSize, ErrorMetric::kBpfv,     ErrorMetric::kDisplacement, ErrorMetric::kSted};
  const ErrorMetric metric = chosen(host.goal, kMetrics, "goal");
  const bool percent = host.flags & ANIC_ENCODE_PERCENT;
  if (host.flags & ANIC_ENCODE_LOSSLESS) {
    if (metric != ErrorMetric::kNone || host.max_error != 0)
      refuse("lossless goes without a goal and a largest error");
    options.target = {ErrorMetric::kMaxError, 0, false};
    return;
  }
  if (metric != ErrorMetric::kNone) {
    if (!(std::isfinite(host.goal_value) && host.goal_value > 0))
      refuse("the goal must be finite and greater than 0");
    const bool length = metric == ErrorMetric::kMaxError || metric == ErrorMetric::kRmse ||
                        metric == ErrorMetric::kDisplacement;
    if (percent && !length)
      refuse("only lengths are in per cent of the diagonal");
    options.target = {metric, host.goal_value, percent};
  }
  if (amount(host.max_error, "the largest error") > 0) {
    const Target bound{ErrorMetric::kMaxError, host.max_error,
                       (host.flags & ANIC_ENCODE_CAP_PERCENT) != 0};
    if (metric == ErrorMetric::kNone)
      options.target = bound;
    else
      options.cap = bound;
  } else if (metric == ErrorMetric::kNone && host.keyframes == 0) {
    options.target = {ErrorMetric::kMaxError, kDefaultPercent, true};
  }
}

void set_method(const anic_encode_options& host, EncodeOptions& options) {
  constexpr BasisChoice kBases[] = {BasisChoice::kAuto, BasisChoice::kKeyframes,
                                    BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories};
  constexpr KeyframeMethod kMethods[] = {KeyframeMethod::kPivot, KeyframeMethod::kGas,
                                         KeyframeMethod::kUniform};
  constexpr std::optional<InterpolationChoice> kInterpolations[] = {
      std::nullopt, InterpolationChoice::kLinear, InterpolationChoice::kMsgi,
      InterpolationChoice::kAuto};
  constexpr KeyframePoses kPoses[] = {KeyframePoses::kNative, KeyframePoses::kDraco,
                                      KeyframePoses::kAuto};
  constexpr Effort kEfforts[] = {Effort::kNormal, Effort::kFast, Effort::kBest};
  constexpr OrderMode kOrders[] = {OrderMode::kVertices, OrderMode::kFree, OrderMode::kAll};
  options.basis = chosen(host.basis, kBases, "basis");
  if (host.keyframes > 0) {
    if (options.basis != BasisChoice::kAuto && options.basis != BasisChoice::kKeyframes)
      refuse("a number of key-frames goes with a basis of key-frames only");
    options.basis = BasisChoice::kKeyframes;
    options.keyframes = host.keyframes;
  }
  options.select = chosen(host.selection, kMethods, "selection");
  options.interpolation = chosen(host.interpolation, kInterpolations, "interpolation");
  options.keyframe_poses = chosen(host.keyframe_coder, kPoses, "coder of key-frames");
  options.order = chosen(host.order, kOrders, "order");
  options.smallest = (host.flags & ANIC_ENCODE_SMALLEST) != 0;
  if (host.metadata)
    options.metadata = host.metadata;
  options.effort = chosen(host.effort, kEfforts, "effort");
}

void set_attributes(const anic_encode_options& host, AttributeOptions& attributes) {
  attributes.keep = (host.flags & ANIC_ENCODE_NO_ATTRIBUTES) == 0;
  attributes.uv_bits = within(host.uv_bits, attributes.uv_bits, 24, "the bits of UV");
  attributes.colour_bits =
      within(host.colour_bits, attributes.colour_bits, 16, "the bits of colours");
  if (amount(host.attribute_error, "the error of attributes") > 0)
    attributes.error = {host.flags & ANIC_ENCODE_ERROR_PERCENT ? AttributeBound::Measure::kPercent
                                                               : AttributeBound::Measure::kUnits,
                        host.attribute_error};
  if (amount(host.normal_error, "the error of normals") > 0)
    attributes.normals = host.normal_error;
}

}  // namespace

EncodingPlan encoding_plan(const anic_encode_options& host) {
  constexpr MassageMode kModes[] = {MassageMode::kOff, MassageMode::kOn, MassageMode::kAuto};
  constexpr uint64_t kKnown = ANIC_ENCODE_PERCENT | ANIC_ENCODE_CAP_PERCENT |
                              ANIC_ENCODE_ERROR_PERCENT | ANIC_ENCODE_NO_ATTRIBUTES |
                              ANIC_ENCODE_ROOT_MOTION | ANIC_ENCODE_LOSSLESS | ANIC_ENCODE_SMALLEST;
  if (host.flags & ~kKnown)
    refuse("there are unknown flags");
  EncodingPlan plan;
  plan.options.root_motion = (host.flags & ANIC_ENCODE_ROOT_MOTION) != 0;
  set_goal(host, plan.options);
  set_method(host, plan.options);
  set_attributes(host, plan.options.attributes);
  plan.options.most_bytes = host.max_bytes;
  plan.mode = chosen(host.massage, kModes, "massage");
  if (amount(host.massage_strength, "the strength of massage") > 0)
    plan.massage.strength = host.massage_strength;
  plan.massage.tolerance = amount(host.massage_tolerance, "the tolerance of massage");
  plan.options.encoder = "anicodec " + std::to_string(ANIC_VERSION_MAJOR) + "." +
                         std::to_string(ANIC_VERSION_MINOR) + "." +
                         std::to_string(ANIC_VERSION_PATCH);
  return plan;
}

}  // namespace anicodec
