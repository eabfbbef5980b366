// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_INTERPOLATION_RESTING_PARTS_H_
#define ANICODEC_CODEC_INTERPOLATION_RESTING_PARTS_H_

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// Vertices that are at one place in all inputs of an interpolation: the base of what moves, which an
/// interpolation of lengths and angles leaves in shape and not in place.
class RestingParts {
 public:
  /// inputs: vertex_count x 3 each. A vertex rests if no input has it further from where the first
  /// has it than a millionth of the diagonal of all inputs. Cost: O(vertices x inputs).
  RestingParts(std::span<const uint32_t> triangles, uint32_t vertex_count,
               std::span<const std::span<const float>> inputs);

  bool empty() const { return places_.empty(); }

  /// Moves every component that rests in part as a whole, so that its resting vertices come as close to
  /// their places as they can; a turn that this leaves open, as about two vertices, stays as it is.
  /// Nothing is bent. Cost: O(vertices).
  void anchor(std::span<float> positions) const;

 private:
  struct Place {
    uint32_t vertex;
    float at[3];
  };

  std::vector<Place> places_;
  std::vector<uint32_t> component_;  ///< of each vertex, kNoIndex without face
  uint32_t component_count_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_INTERPOLATION_RESTING_PARTS_H_
