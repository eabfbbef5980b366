// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The ways to interpolate between meshes of one connectivity, side by side (thesis chapter 4).
#ifndef ANICODEC_CODEC_INTERPOLATION_INTERPOLATION_H_
#define ANICODEC_CODEC_INTERPOLATION_INTERPOLATION_H_

#include "codec/surface/edge_network.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace anicodec {

enum class InterpolationMethod {
  kLinear,          ///< vertices on straight lines
  kGradients,       ///< deformation gradients, principal logarithms
  kBreadthFirst,    ///< the same, rotations tracked breadth first
  kPml,             ///< tracked by prioritised matrix logarithms
  kPmln,            ///< and normal differences
  kVertexBlending,  ///< lengths and angles, patches merged by blending vertices
  kMsgi             ///< patches blended rigidly, merged by blending edges (sdk/msgi.h)
};

/// All of them, in this order.
std::span<const InterpolationMethod> interpolation_methods();

/// The word of the command line: linear, gradients, bfs, pml, pmln, msgi-v, msgi.
std::string_view name_of(InterpolationMethod method);

struct InterpolationOptions {
  InterpolationMethod method = InterpolationMethod::kMsgi;
  /// Faces of a patch; 0: as many as choose_leaf_faces() says. Only for kMsgi and kVertexBlending.
  uint32_t leaf_faces = 0;
  uint32_t sweeps = 0;  ///< Msgi::Options
  /// Gauss-Newton steps on edge lengths and dihedral angles afterwards (edge_refinement.h): for
  /// offline use, about a second each for 7000 vertices.
  int refinement_steps = 0;
  std::vector<uint32_t> pins;  ///< Msgi::Options
};

class Interpolation {
 public:
  virtual ~Interpolation() = default;

  /// The mesh at one weight per input: vertices x 3. pins: three coordinates per pin. Throws
  /// Error(kUsage) for weights that do not sum to one.
  virtual std::span<const float> evaluate(std::span<const double> weights,
                                          std::span<const float> pins = {}) = 0;
};

/// inputs: vertex_count x 3 each, at least two. Vertices that rest in all inputs decide where
/// methods that know no places (kMsgi, kVertexBlending, refinement) put a mesh, see RestingParts,
/// unless there are pins. Throws Error(kUsage) for fewer, for pins that are out of range, given
/// twice or not for kMsgi; Error(kInput) for what the method cannot work on.
std::unique_ptr<Interpolation> make_interpolation(std::span<const uint32_t> triangles,
                                                  uint32_t vertex_count,
                                                  std::span<const std::span<const float>> inputs,
                                                  const InterpolationOptions& options);

/// The faces of a patch, 8, 4, 2 or 1: the most at which the lengths of edges, half way between the
/// inputs, are about as close to what they should be as at any. Small patches matter where
/// neighbouring triangles turn far against one another; they cost time.
uint32_t choose_leaf_faces(std::span<const uint32_t> triangles, uint32_t vertex_count,
                           std::span<const std::span<const float>> inputs);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_INTERPOLATION_INTERPOLATION_H_
