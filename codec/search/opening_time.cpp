// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/opening_time.h"

#include "sdk/prediction/predictor.h"

namespace anicodec {
namespace {

// Coefficients: lines through dance, flag, face, chicken and horse at --kg 0.1: `anicodec_bench
// open`. Weights: about the share that a profile of the same shows.
constexpr double kOfWeight = 110, kOfCoefficient = 1.4, kOfBit = 25;

}  // namespace

double opening_nanoseconds(const LinearSettings& settings, const EncodedSegment& encoded,
                           size_t vertices) {
  const double channels = traits_of(encoded.sizes.kind).channels;
  const double components = encoded.sizes.components, n = static_cast<double>(vertices);
  const double bits = 8.0 * static_cast<double>(encoded.coefficient_bytes);
  const double reading = kOfWeight * static_cast<double>(encoded.time_weights) +
                         kOfCoefficient * n * components * channels + kOfBit * bits;

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

double bytes_per_nanosecond(bool smallest) {
  return smallest ? 0 : 3e-5;
}

}  // namespace anicodec
