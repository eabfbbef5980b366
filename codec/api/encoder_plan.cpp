// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Options of the host.
#include "codec/api/encoder_objects.h"
#include "codec/api/guarded.h"
#include "codec/api/host_choices.h"
#include "codec/api/host_values.h"

#include <cmath>
#include <optional>

namespace anicodec {
namespace {

constexpr double kDefaultPercent = 0.05;

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
  if (host.keyframes > 0) {
    if (options.basis != BasisChoice::kAuto && options.basis != BasisChoice::kKeyframes)
      refuse("a number of key-frames goes with a basis of key-frames only");
    options.basis = BasisChoice::kKeyframes;
    options.keyframes = host.keyframes;
  }
  if (host.metadata)
    options.metadata = host.metadata;
  if (amount(host.attribute_error, "attribute_error") > 0)
    options.attributes.error = {host.flags & ANIC_ENCODE_ERROR_PERCENT
                                    ? AttributeBound::Measure::kPercent
                                    : AttributeBound::Measure::kUnits,
                                host.attribute_error};
}

}  // namespace

EncodeOptions options_of(const anic_encode_options& host) {
  if (host.flags & ~kKnownFlags)
    refuse("there are unknown flags");
  EncodeOptions options;
  set_choices(host, &options);
  set_goal(host, options);
  set_method(host, options);
  options.most_bytes = host.max_bytes;
  options.encoder = "anicodec " + std::to_string(ANIC_VERSION_MAJOR) + "." +
                    std::to_string(ANIC_VERSION_MINOR) + "." + std::to_string(ANIC_VERSION_PATCH);
  return options;
}

}  // namespace anicodec
