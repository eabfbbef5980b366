// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/neural_gas.h"

#include "codec/algebra/gram.h"
#include "codec/parallel/parallel.h"
#include "codec/sequence/random.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kGasTile = 32;

// Weights below this part of the nearest prototype's are taken as zero.
constexpr double kNegligible = 1e-12;

// Neighbourhood below which only the nearest prototype moves: once still, always still.
constexpr double kLastNeighbourhood = 0.03;

// Frames where the prototypes start: the middles of equal parts of the clip, or drawn at random.
std::vector<size_t> start_frames(size_t frames, size_t count, uint64_t seed) {
  std::vector<size_t> start(count);
  if (seed == 0) {
    for (size_t i = 0; i < count; i++) {
      start[i] = (2 * i + 1) * frames / (2 * count);
    }
    return start;
  }
  SplitMix64 random(seed);
  std::vector<size_t> all(frames);
  std::iota(all.begin(), all.end(), size_t{0});
  for (size_t i = 0; i < count; i++) {
    std::swap(all[i], all[i + random.next() % (frames - i)]);
    start[i] = all[i];
  }
  return start;
}

void measure_distances(const MatrixXd& gram, const MatrixXd& prototypes, MatrixXd& distances) {
  const Index count = prototypes.rows();
  const Index tiles = (gram.cols() + kGasTile - 1) / kGasTile;
  MatrixXd& products = distances;
  parallel_for(Index{0}, tiles, [&](Index t) {
    const Index first = t * kGasTile;
    const Index width = std::min(kGasTile, gram.cols() - first);
    products.middleCols(first, width).noalias() = prototypes * gram.middleCols(first, width);
  });
  VectorXd norms(count);
  for (Index i = 0; i < count; i++) {
    norms[i] = products.row(i).dot(prototypes.row(i));
  }
  parallel_for(Index{0}, gram.cols(), [&](Index f) {
    auto column = distances.col(f).array();
    column = (norms.array() - 2 * column + gram(f, f)).max(0.0);
  });
}

// Moves every prototype to the mean of the frames, weighted by the rank it has for them. Returns
// whether any moved.
bool move_prototypes(const MatrixXd& distances, double neighbourhood, MatrixXd& prototypes) {
  const Index count = distances.rows();
  const Index frames = distances.cols();
  const auto reach = static_cast<Index>(-std::log(kNegligible) * neighbourhood) + 1;
  const Index ranks = std::min(count, reach);
  VectorXd weight(ranks);
  for (Index r = 0; r < ranks; r++) {
    weight[r] = std::exp(-static_cast<double>(r) / neighbourhood);
  }
  MatrixXd moved = MatrixXd::Zero(count, frames);
  parallel_for(Index{0}, frames, [&](Index f) {
    std::vector<std::pair<double, Index>> order(static_cast<size_t>(count));
    for (Index i = 0; i < count; i++) {
      order[static_cast<size_t>(i)] = {distances(i, f), i};
    }
    std::partial_sort(order.begin(), order.begin() + ranks, order.end());
    for (Index r = 0; r < ranks; r++) {
      moved(order[static_cast<size_t>(r)].second, f) = weight[r];
    }
  });
  for (Index i = 0; i < count; i++) {
    const double sum = moved.row(i).sum();
    if (sum > 0) {
      moved.row(i) /= sum;
    } else {  // no frame is near: it stays
      moved.row(i) = prototypes.row(i);
    }
  }
  prototypes.swap(moved);
  return prototypes != moved;
}

}  // namespace

NeuralGas neural_gas(const MatrixXd& gram, size_t count, const NeuralGasOptions& options) {
  const auto prototypes = static_cast<Index>(count);
  NeuralGas gas;
  gas.prototypes = MatrixXd::Zero(prototypes, gram.rows());
  gas.squared_distances.resize(prototypes, gram.rows());
  const auto start = start_frames(static_cast<size_t>(gram.rows()), count, options.seed);
  for (Index i = 0; i < prototypes; i++) {
    gas.prototypes(i, static_cast<Index>(start[static_cast<size_t>(i)])) = 1;
  }
  const double first = static_cast<double>(count) / 2;
  const double steps = options.iterations > 1 ? static_cast<double>(options.iterations - 1) : 1;
  bool still = false;
  for (size_t t = 0; t <= options.iterations; t++) {
    measure_distances(gram, gas.prototypes, gas.squared_distances);
    gas.costs.push_back(gas.squared_distances.colwise().minCoeff().sum());
    if (t == options.iterations || still) {
      break;
    }
    const double done = static_cast<double>(t) / steps;
    gas.neighbourhoods.push_back(first * std::pow(options.final_neighbourhood / first, done));
    still = !move_prototypes(gas.squared_distances, gas.neighbourhoods.back(), gas.prototypes) &&
            gas.neighbourhoods.back() < kLastNeighbourhood;
  }
  return gas;
}

std::vector<uint32_t> prototype_frames(const NeuralGas& gas, const MatrixXd& gram) {
  std::vector<std::tuple<double, Index, Index>> pairs;
  pairs.reserve(static_cast<size_t>(gas.squared_distances.size()));
  for (Index f = 0; f < gram.rows(); f++) {
    for (Index i = 0; i < gas.prototypes.rows(); i++) {
      pairs.emplace_back(gas.squared_distances(i, f), i, f);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  const double tolerance = repeat_tolerance(gram);
  std::vector<bool> placed(static_cast<size_t>(gas.prototypes.rows()), false);
  std::vector<bool> passed(static_cast<size_t>(gram.rows()), false);
  std::vector<uint32_t> frames;
  for (const auto& [distance, i, f] : pairs) {
    if (placed[static_cast<size_t>(i)] || passed[static_cast<size_t>(f)]) {
      continue;
    }
    placed[static_cast<size_t>(i)] = true;
    frames.push_back(static_cast<uint32_t>(f));
    for (Index g = 0; g < gram.rows(); g++) {
      if (g == f || squared_distance(gram, f, g) <= tolerance) {
        passed[static_cast<size_t>(g)] = true;
      }
    }
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

double repeat_tolerance(const MatrixXd& gram) {
  return 1e-13 * gram.diagonal().maxCoeff();
}

}  // namespace anicodec
