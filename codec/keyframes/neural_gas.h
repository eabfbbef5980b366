// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_KEYFRAMES_NEURAL_GAS_H_
#define ANICODEC_CODEC_KEYFRAMES_NEURAL_GAS_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

struct NeuralGasOptions {
  size_t iterations = 100;
  double final_neighbourhood = 0.01;  ///< the first is half the number of prototypes
  uint64_t seed = 0;  ///< 0: start at evenly spaced frames, else at frames drawn with this seed
};

/// Clustering of frames in Gram form: a prototype is a combination of frames, kept as a row of
/// coefficients.
struct NeuralGas {
  Eigen::MatrixXd prototypes;          ///< prototypes x frames, rows sum to one
  Eigen::MatrixXd squared_distances;   ///< prototypes x frames
  std::vector<double> neighbourhoods;  ///< range of every iteration, falling
  std::vector<double> costs;  ///< before every iteration and after the last: sum over the frames of
                              ///< the squared distance to the nearest prototype
};

/// Batch Neural Gas (thesis chapter 5; Cottrell, Hammer, Hasenfuss and Villmann 2006): every
/// iteration ranks the prototypes by distance from each frame and moves each prototype to the mean
/// of the frames weighted with exp(-rank / neighbourhood), the neighbourhood shrinking
/// geometrically. gram: frames x frames inner products; 1 <= count <= frames. Distances only: any
/// centring will do. Cost O(iterations count frames^2). Deterministic, same bits for any number of
/// threads.
NeuralGas neural_gas(const Eigen::MatrixXd& gram, size_t count,
                     const NeuralGasOptions& options = {});

/// The frame nearest to every prototype, ascending. A frame near several prototypes goes to the
/// nearest of them and the others take their next; frames that repeat one already taken are passed
/// over, so fewer than the prototypes come out where the clip has fewer distinct frames.
std::vector<uint32_t> prototype_frames(const NeuralGas& gas, const Eigen::MatrixXd& gram);

/// Squared distance up to which two frames count as repeated: the rounding of the products.
double repeat_tolerance(const Eigen::MatrixXd& gram);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_KEYFRAMES_NEURAL_GAS_H_
