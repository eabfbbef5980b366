// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_ANIMATION_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_ANIMATION_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/gltf/gltf_document.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace anicodec::tools {

/// Local transforms and morph weights of all nodes at one time.
struct GltfPose {
  std::vector<std::array<double, 3>> translations, scales;
  std::vector<std::array<double, 4>> rotations;  ///< x y z w
  std::vector<std::vector<double>> weights;
  std::vector<double> visible;  ///< 0 or 1, of a node without its ancestors
};

/// The pose that nodes have without animation.
GltfPose pose_at_rest(const GltfDocument& document);

/// An animation whose keys have been read and checked: finite, in the order of time.
class GltfClip {
 public:
  /// Throws Error(kInput) naming the sampler.
  GltfClip(const GltfDocument& document, uint32_t animation, uint64_t memory_limit);

  double first_time() const { return first_time_; }

  double last_time() const { return last_time_; }

  /// The grid of frames that the keys of all channels stand on. Nothing where they stand on none.
  std::optional<FrameRate> key_grid() const;

  /// Times of the keys of all channels, in order, each once.
  std::vector<double> key_times() const;

  /// The rate of the channel with most keys, by the median of the gaps between them; 0 without.
  double key_density() const;

  /// True when a channel changes a value of one of the nodes.
  bool moves(const std::vector<bool>& nodes) const;

  /// Plays another animation at the same time. A node that both move moves as there.
  void join(GltfClip other);

  /// Sets what the animation moves, at a time. A key within `tolerance` seconds is taken as it is.
  void apply(double time, double tolerance, GltfPose& pose) const;

 private:
  struct Track {
    uint32_t node = 0;
    GltfPath path = GltfPath::kTranslation;
    uint32_t element = 0;  ///< of weights, the first
    GltfInterpolation interpolation = GltfInterpolation::kLinear;
    uint32_t components = 0;   ///< of a key's value; three such values for a cubic spline
    std::vector<float> times;  ///< seconds
    std::vector<float> values;
  };

  static void evaluate(const Track& track, double time, double tolerance, double* out);

  std::vector<Track> tracks_;
  double first_time_ = 0, last_time_ = 0;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_ANIMATION_H_
