// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/opening_time.h"

#include "sdk/prediction/predictor.h"

namespace anicodec {
namespace {

/// Nanoseconds of a coder for a time weight, for a coefficient, and for each bit of that.
struct CoderTime {
  double weight, coefficient, bit;
};

// Of coefficients, lines through dance, flag, face, chicken and horse at --kg 0.1: `anicodec_bench open`.
// Of weights, about what a profile of the same shows.
constexpr CoderTime kMixing{220, 28, 75}, kBatches{80, 1, 18};

}  // namespace

double opening_nanoseconds(const LinearSettings& settings, const EncodedSegment& encoded,
                           size_t vertices) {
  const double channels = encoded.sizes.kind == BasisKind::kEigenshapes ? 3 : 1;
  const double components = encoded.sizes.components, n = static_cast<double>(vertices);
  const double bits = 8.0 * static_cast<double>(encoded.coefficient_bytes);
  const CoderTime& coder = settings.coder == CoefficientCoder::kBatches ? kBatches : kMixing;
  const auto weights = static_cast<double>(encoded.time_weights);
  const double reading =
      coder.weight * weights + coder.coefficient * n * components * channels + coder.bit * bits;

  PredictionParameters prediction;
  prediction.schedule = settings.schedule;
  prediction.alike = settings.alike;
  const Vector<size_t> refits = refits_of(prediction, encoded.sizes.components);
  const double learnt = refits.empty() ? 0 : static_cast<double>(refits.back() + 1);
  double distances = 0;  // that renewed priors are made from, of a pair of neighbours
  for (const size_t after : renewals_of(prediction, encoded.sizes.components))
    distances += static_cast<double>(after + 1) * channels;
  const double m = settings.neighbours;
  const double of_vertex = 0.025 * m * m * m + channels * components * 0.33 * m +
                           channels * learnt * 0.028 * m * m +
                           static_cast<double>(refits.size()) * (0.2 * m * m + 0.003 * m * m * m) +
                           0.014 * distances * m * m;
  return reading + n * of_vertex;
}

double bytes_per_nanosecond(OpeningChoice opening) {
  switch (opening) {
    case OpeningChoice::kSmall:
      return 0;
    case OpeningChoice::kAuto:
      return 1e-4;
    case OpeningChoice::kFast:
      return 5e-4;
  }
  return 0;
}

}  // namespace anicodec
