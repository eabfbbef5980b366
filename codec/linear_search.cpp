// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/linear_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace anicodec {
namespace {

constexpr double kClose = 0.99;     // of the error asked for: near enough
constexpr double kRateSlope = 0.5;  // the size goes about as error^-kRateSlope
constexpr size_t kMostComponents = 2000;

}  // namespace

LinearCoder::LinearCoder(const EncoderInput& input, const LinearAnalysis& analysis,
                         format::BasisKind kind, int effort, uint32_t layers)
    : input_(input), analysis_(analysis), kind_(kind), effort_(effort) {
  bool shapes = kind == format::BasisKind::kEigenshapes;
  choice_.pose = shapes ? ReferencePose::kMean : ReferencePose::kRankThree;
  choice_.base = shapes ? Base::kPose : Base::kAffine;
  choice_.settings.layers = layers;
}

const LinearBasis& LinearCoder::basis(ReferencePose pose, Base base) {
  auto [found, fresh] = bases_.try_emplace({pose, base});
  if (fresh)
    found->second = analysis_.basis(kind_, pose, base, kMostComponents, 0);
  return found->second;
}

double LinearCoder::first_step(const Choice& choice, double rmse) {
  const LinearBasis& b = basis(choice.pose, choice.base);
  FrameView clip = input_.frames();
  double budget = rmse * rmse * static_cast<double>(clip.vertex_count * clip.frame_count);
  bool shapes = kind_ == format::BasisKind::kEigenshapes;
  double scalars = static_cast<double>(clip.vertex_count * (shapes ? 3 : 1));
  // Bisection: the error of rounding and of what is left out grows with the step.
  double low = rmse * 1e-6, high = rmse * 1e6;
  LinearSettings settings = choice.settings;
  for (int round = 0; round < 60; ++round) {
    settings.step = std::sqrt(low * high);
    size_t k = component_count(b, settings, clip.vertex_count, clip.frame_count);
    double rest = b.base_energy - b.energies.head(static_cast<Eigen::Index>(k)).sum();
    double error = std::max(rest, 0.0) +
                   0.12 * static_cast<double>(k) * scalars * settings.step * settings.step;
    (error > budget ? high : low) = settings.step;
  }
  return std::sqrt(low * high);
}

LinearCoder::Measured LinearCoder::measured(const Choice& choice, double rmse) {
  Measured m;
  const LinearBasis& b = basis(choice.pose, choice.base);
  m.part.encoded = encode_linear(input_.frames(), b, choice.settings, input_.layout);
  m.part.opened = open_encoded(m.part.encoded, input_.layout);
  m.part.error = measure(m.part.opened, input_.frames(), input_.copies);
  m.part.what = std::to_string(m.part.encoded.sizes.components) +
                (kind_ == format::BasisKind::kEigenshapes ? " eigenshapes" : " eigentrajectories");
  m.rmse = input_.rmse(m.part.error.squared);
  size_t pose = encode_with_poses(input_.layout, m.part.encoded.draco_poses).size();
  m.bytes = static_cast<double>(m.part.encoded.bytes() + pose) *
            std::pow(std::max(m.rmse, rmse * 1e-3) / rmse, kRateSlope);
  return m;
}

void LinearCoder::choose_settings(double rmse) {
  chosen_ = true;
  choice_.settings.step = first_step(choice_, rmse);
  if (effort_ < 2)
    return;
  double least = measured(choice_, rmse).bytes;
  auto consider = [&](auto change) {
    Choice other = choice_;
    change(other);
    if (other.pose != choice_.pose || other.base != choice_.base)
      other.settings.step = first_step(other, rmse);
    double bytes = measured(other, rmse).bytes;
    if (bytes < least) {
      least = bytes;
      choice_ = other;
    }
  };
  bool shapes = kind_ == format::BasisKind::kEigenshapes;
  consider([&](Choice& c) {
    c.pose = ReferencePose::kFrame;
    c.base = Base::kAffine;
  });
  if (effort_ < 4)
    return;
  consider([&](Choice& c) {
    c.pose = shapes ? ReferencePose::kMean : ReferencePose::kRankThree;
    c.base = Base::kAffine;
    if (!shapes)
      c.pose = ReferencePose::kMean;
  });
  consider([](Choice& c) { c.settings.neighbours = 20; });
  if (effort_ < 6)
    return;
  consider([](Choice& c) { c.settings.colours = 2; });
  consider([](Choice& c) { c.settings.radius = 16; });
  consider([](Choice& c) { c.settings.neighbours = 24; });
  consider([](Choice& c) { c.settings.lambda = 0.05; });
  if (effort_ < 8)
    return;
  consider([](Choice& c) { c.settings.lambda = 0.11; });
  consider([](Choice& c) { c.settings.weight_factor = 2; });
  consider([](Choice& c) { c.settings.weight_factor = 2.9; });
  consider([](Choice& c) { c.settings.pose_factor = 1; });
  consider([](Choice& c) { c.settings.pose_factor = 1.6; });
  consider([](Choice& c) { c.settings.rank_factor = 0.3; });
}

std::optional<Part> LinearCoder::at_rmse(double rmse) {
  if (!(rmse > 0))
    return std::nullopt;
  if (!chosen_)
    choose_settings(rmse);
  else
    choice_.settings.step = first_step(choice_, rmse);
  std::optional<Measured> best;
  for (int round = 0; round < 7; ++round) {
    Measured trial = measured(choice_, rmse);
    double ratio = trial.rmse / rmse;
    if (ratio <= 1 && (!best || trial.rmse > best->rmse))
      best = std::move(trial);
    if (best && (best->rmse >= kClose * rmse || round >= 4))
      break;
    // Aim a little below the target: what counts is to end there from below.
    choice_.settings.step *= std::clamp(0.996 / std::max(ratio, 1e-9), 0.25, 4.0);
  }
  if (!best)
    return std::nullopt;
  return std::move(best->part);
}

}  // namespace anicodec
