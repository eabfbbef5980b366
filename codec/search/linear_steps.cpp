// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/linear_steps.h"

#include <algorithm>

namespace anicodec {
namespace {

constexpr double kPoseFactor = 1.4;  ///< between steps of the pose that are tried

// `encode --kg 0.1 --effort normal` of flag, dance and horse with 4 to 64 eighths: cloth does best with
// 32, characters with 4 to 8.
constexpr uint8_t kAlike = 8;

// Steps that do either of two things.
constexpr const char *kFinerOrCoarserPose = "finer or yet coarser pose",
                     *kOtherPrior = "stronger or weaker prior by motion",
                     *kOtherPose = "mean or rank-three pose";

void fewer_neighbours(LinearChoice& choice, BasisKind) {
  constexpr int kFewest = 8, kStep = 4;
  choice.settings.neighbours =
      static_cast<uint8_t>(std::max(choice.settings.neighbours - kStep, kFewest));
}

}  // namespace

const std::vector<LinearStep>& linear_steps() {
  using enum Effort;
  static const std::vector<LinearStep> steps = {
      {"coarser pose", [](LinearChoice& c, BasisKind) { c.settings.pose_factor *= kPoseFactor; }},
      {kFinerOrCoarserPose,
       [](LinearChoice& c, BasisKind) {
         const bool coarser = c.settings.pose_factor > LinearSettings{}.pose_factor;
         c.settings.pose_factor *= coarser ? kPoseFactor : 1 / kPoseFactor;
       }},
      {"pose of a frame",
       [](LinearChoice& c, BasisKind) { c.pose = ReferencePose::kFrame, c.base = Base::kAffine; }},
      {"prior by motion", [](LinearChoice& c, BasisKind) { c.settings.alike = kAlike; }},
      {kOtherPrior,
       [](LinearChoice& c, BasisKind) {
         c.settings.alike = c.settings.alike > 0 ? 4 * kAlike : kAlike / 2;
       }},
      {kOtherPose,
       [](LinearChoice& c, BasisKind kind) {
         const bool shapes = kind == BasisKind::kEigenshapes;
         c.pose = shapes ? ReferencePose::kRankThree : ReferencePose::kMean;
         c.base = Base::kAffine;
       }},
      {"lambda 0.05", [](LinearChoice& c, BasisKind) { c.settings.lambda = 0.05; }},
      {"coarser weights", [](LinearChoice& c, BasisKind) { c.settings.weight_factor *= 1.2; }},
      {"2 passes per level", [](LinearChoice& c, BasisKind) { c.settings.passes_per_level = 2; }},
      {"fewer components", [](LinearChoice& c, BasisKind) { c.settings.rank_factor *= 1.5; }},
      {"radius 16", [](LinearChoice& c, BasisKind) { c.settings.radius = 16; }, kBest},
      {"20 neighbours", [](LinearChoice& c, BasisKind) { c.settings.neighbours = 20; }, kBest},
      {"24 neighbours", [](LinearChoice& c, BasisKind) { c.settings.neighbours = 24; }, kBest},
      {"lambda 0.11", [](LinearChoice& c, BasisKind) { c.settings.lambda = 0.11; }, kBest},
      {"yet coarser weights", [](LinearChoice& c, BasisKind) { c.settings.weight_factor *= 1.2; },
       kBest},
      {"finer pose", [](LinearChoice& c, BasisKind) { c.settings.pose_factor /= 1.2; }, kBest},
      {"finer weights", [](LinearChoice& c, BasisKind) { c.settings.weight_factor /= 1.15; },
       kBest},
      {"more components", [](LinearChoice& c, BasisKind) { c.settings.rank_factor /= 1.5; }, kBest},
      {"radius 9", [](LinearChoice& c, BasisKind) { c.settings.radius = 9; }, kBest},
  };
  return steps;
}

const char* meaning_of(const LinearStep& step, const LinearChoice& changed) {
  if (step.name == kFinerOrCoarserPose)
    return changed.settings.pose_factor > LinearSettings{}.pose_factor ? "yet coarser pose"
                                                                       : "finer pose";
  if (step.name == kOtherPrior)
    return changed.settings.alike > kAlike ? "stronger prior by motion" : "weaker prior by motion";
  if (step.name == kOtherPose)
    return changed.pose == ReferencePose::kMean ? "mean pose" : "rank-three pose";
  return step.name;
}

const std::vector<LinearStep>& opening_steps() {
  static const std::vector<LinearStep> steps = {
      {"sparse refits",
       [](LinearChoice& c, BasisKind) { c.settings.schedule = RefitSchedule::kSparse; }},
      {"4 neighbours fewer", fewer_neighbours},
      {"8 neighbours fewer", fewer_neighbours},
      {"no refits", [](LinearChoice& c, BasisKind) { c.settings.schedule = RefitSchedule::kNone; }},
  };
  return steps;
}

const char* mean_of(WeightPredictor predictor) {
  switch (predictor) {
    case WeightPredictor::kLine:
      return nullptr;
    case WeightPredictor::kRegression:
      return "weights by regression";
    case WeightPredictor::kCosine:
      return "weights by cosines";
  }
  return nullptr;
}

std::vector<std::string> search_means() {
  std::vector<std::string> names = {kRegionsMean, kJointRoundingMean, kRefittedWeightsMean};
  for (uint32_t p = 0; p < kWeightPredictors; ++p) {
    if (const char* name = mean_of(static_cast<WeightPredictor>(p)))
      names.emplace_back(name);
  }
  for (const LinearStep& step : linear_steps())
    names.emplace_back(step.name);
  return names;
}

}  // namespace anicodec
