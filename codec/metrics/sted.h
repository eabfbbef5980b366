// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_METRICS_STED_H_
#define ANICODEC_CODEC_METRICS_STED_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace anicodec {

struct Sted {
  double sted = 0;  ///< sqrt(spatial^2 + c^2 temporal^2), c = 9.144e-5
  /// Local deviation of relative edge length errors, mean over vertices and frames.
  double spatial = 0;
  double temporal = 0;  ///< error of the speed of vertices against the local speed, mean likewise
};

/// Spatio-temporal edge difference (Vasa and Skala, "A perception correlated comparison method for
/// dynamic meshes", TVCG 17(2), 2011) with the parameters of its authors' tool: neighbourhood width
/// 1, window 5, dt 0.0003. Edges are the sides of the polygons, each once. Frames are added in
/// order. A vertex without edges adds 0 to the spatial part. Memory: about 16 doubles and 30
/// indices a vertex. Cost a frame: two passes over the 30 or so edges around each vertex, on all
/// threads; the result does not depend on their number.
class StedMeter {
 public:
  /// Takes the diameter that speeds are relative to from the first frame of the original.
  StedMeter(const Polygons& polygons, uint32_t vertex_count);

  /// Adds a frame, vertices x 3 each. Returns its spatial part.
  double add(std::span<const float> original, std::span<const float> decoded);

  /// After the last frame. 0 if there was none.
  Sted finish();

 private:
  void list_edges(const Polygons& polygons);
  void list_neighbourhoods();
  double spatial(std::span<const float> original, std::span<const float> decoded);
  void measure_speeds(std::span<const float> original, std::span<const float> decoded);
  void close_frame(uint32_t frame, uint32_t last);

  uint32_t vertices_;
  std::vector<std::pair<uint32_t, uint32_t>> edges_;
  std::vector<size_t> first_;           ///< vertex v has near_[first_[v]] .. near_[first_[v + 1]]
  std::vector<uint32_t> near_;          ///< edges that touch a vertex or one of its neighbours
  std::vector<double> length_, error_;  ///< of each edge in the current frame
  std::vector<double> deviation_;       ///< of each vertex, or any other term to be summed

  uint32_t frames_ = 0;
  double diameter_ = 0;
  std::vector<float> previous_original_, previous_decoded_;
  std::vector<double> speed_;        ///< of the original, the last 10 frames
  std::vector<double> speed_error_;  ///< the last 6 frames
  double spatial_sum_ = 0, temporal_sum_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_METRICS_STED_H_
