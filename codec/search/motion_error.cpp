// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/motion_error.h"

#include "codec/metrics/metrics.h"
#include "codec/segment/segment_player.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace anicodec {
namespace {

/// Plays the frames of segments, by the vertices of the source.
class Player {
 public:
  Player(const std::vector<CodedSegment>& segments, const EncoderInput& input)
      : segments_(segments), input_(input) {}

  std::span<const float> frame(uint32_t f) {
    const auto segment = std::ranges::find_if(segments_, [f](const CodedSegment& p) {
      return f < p.encoded.sizes.first_frame + p.encoded.sizes.frames;
    });
    return by_source(player_.play(segment->opened, f - segment->encoded.sizes.first_frame));
  }

  std::span<const float> by_source(const float* coded) {
    const auto& coded_of = input_.layout.source_coded;
    source_.resize(3 * coded_of.size());
    for (size_t v = 0; v < coded_of.size(); ++v)
      std::copy_n(coded + size_t{3} * coded_of[v], 3, source_.data() + 3 * v);
    return source_;
  }

 private:
  const std::vector<CodedSegment>& segments_;
  const EncoderInput& input_;
  SegmentPlayer player_;
  std::vector<float> source_;
};

}  // namespace

double motion_error(ErrorMetric metric, const std::vector<CodedSegment>& segments,
                    const EncoderInput& input) {
  Player decoded(segments, input), original(segments, input);
  CompareOptions options;
  options.sted = metric == ErrorMetric::kSted;
  double worst = 0;
  for (const InputClip& clip : input.clips) {
    const uint32_t first = clip.frames.first;
    const Comparison compared = compare(
        input.sequence.polygons, input.sequence.vertex_count, clip.frames.count,
        [&](uint32_t f) { return original.by_source(input.shown().frame(first + f)); },
        [&](uint32_t f) { return decoded.frame(first + f); }, options);
    const double share = clip.tolerance > 0 ? clip.tolerance : 1;
    worst = std::max(worst,
                     (options.sted ? compared.sted.sted : compared.max_displacement_error) / share);
  }
  return worst;
}

}  // namespace anicodec
