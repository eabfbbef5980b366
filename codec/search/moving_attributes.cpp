// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/moving_attributes.h"

#include "codec/plan/encoding_memory.h"
#include "codec/search/basis_search.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/sequence/error.h"
#include "sdk/clip/attribute_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

/// Rounding of a value in binary32, against its magnitude.
constexpr double kRounding = 0x1p-22;

/// A reference pose for a file whose positions need none: frame 0.
std::shared_ptr<const EncodedPose> own_pose(const EncoderInput& input) {
  constexpr double kStep = 0x1p-12;  // of the largest coordinate
  Eigen::Vector3d origin;
  const Eigen::MatrixXd pose = input.centred_first_pose(&origin);
  const double largest = pose.cwiseAbs().maxCoeff();
  return encode_reference_pose(pose, origin, largest * kStep, input.layout);
}

/// How three components of an attribute differ from those of frame 0 as stored.
struct Offsets {
  FrameArray frames;   ///< frames x entries x 3
  double spread = 0;   ///< largest distance of an element from the mean of its entry
  double largest = 0;  ///< of the means
};

class OffsetReader {
 public:
  OffsetReader(const EncoderInput& input, const StoredAttribute& stored)
      : input_(input),
        stored_(stored),
        attribute_(input.sequence.attributes[stored.source]),
        copies_(stored.surface.coded_vertices, 0) {
    for (uint32_t entry : stored.surface.vertex_coded)
      ++copies_[entry];
  }

  Offsets read(uint32_t first_component) const {
    const uint32_t n = attribute_.components, width = std::min(n - first_component, 3U);
    const Vector<uint32_t>& entries = stored_.surface.vertex_coded;
    const size_t row = size_t{3} * stored_.surface.coded_vertices;
    Offsets result;
    result.frames.resize(row * input_.sequence.frame_count);
    std::vector<double> sums(row), moved(size_t{3} * entries.size());
    // All frames of the clip decide, so that parts of it agree.
    std::vector<float> other_frame(row);
    for (size_t f = 0; f < attribute_.frames; ++f) {
      const bool is_own =
          f >= input_.first_frame && f - input_.first_frame < input_.sequence.frame_count;
      const float* values = attribute_.values.data() + f * entries.size() * n + first_component;
      const float* at_rest = stored_.rest.data() + first_component;
      std::fill(sums.begin(), sums.end(), 0.0);
      for (size_t e = 0; e < entries.size(); ++e) {
        const size_t at = size_t{stored_.rows[e]} * n;
        for (size_t c = 0; c < width; ++c) {
          moved[3 * e + c] =
              static_cast<double>(values[at + c]) - static_cast<double>(at_rest[at + c]);
          sums[size_t{3} * entries[e] + c] += moved[3 * e + c];
        }
      }
      float* means =
          is_own ? result.frames.data() + row * (f - input_.first_frame) : other_frame.data();
      for (size_t i = 0; i < row; ++i)
        means[i] = static_cast<float>(sums[i] / copies_[i / 3]);
      for (size_t e = 0; e < entries.size(); ++e) {
        const float* mean = means + size_t{3} * entries[e];
        double away = 0, size = 0;
        for (size_t c = 0; c < width; ++c) {
          const auto m = static_cast<double>(mean[c]);
          away += (moved[3 * e + c] - m) * (moved[3 * e + c] - m);
          size += m * m;
        }
        result.spread = std::max(result.spread, std::sqrt(away));
        if (is_own)
          result.largest = std::max(result.largest, std::sqrt(size));
      }
    }
    return result;
  }

  double largest_value() const {
    double largest = 0;
    for (float x : attribute_.values)
      largest = std::max(largest, std::abs(static_cast<double>(x)));
    return largest;
  }

 private:
  const EncoderInput& input_;
  const StoredAttribute& stored_;
  const Attribute& attribute_;
  std::vector<uint32_t> copies_;  ///< elements of each entry
};

/// The pose of a mesh as that of an attribute's entries.
std::shared_ptr<const EncodedPose> pose_of_entries(const EncodedPose& pose,
                                                   const MeshLayout& layout,
                                                   const StoredAttribute& stored) {
  auto result = std::make_shared<EncodedPose>();
  result->grid = surface_pose(pose.grid, layout.topology, stored.header.domain, stored.surface);
  return result;
}

std::vector<CodedSegment> encode_offsets(const EncoderInput& input, const StoredAttribute& stored,
                                         FrameArray frames, double most,
                                         const SearchOptions& options,
                                         const std::shared_ptr<const EncodedPose>& pose) {
  EncoderInput trajectories(input, stored.surface, std::move(frames));
  trajectories.pose = pose_of_entries(*pose, input.layout, stored);
  SearchOptions attribute_options = options;
  attribute_options.basis = BasisChoice::kEigentrajectories;
  attribute_options.keyframes.reset();
  const Bound bound{ErrorMetric::kMaxError, most};
  trajectories.bound_clips(std::vector<ClipGoal>(trajectories.clips.size(), {bound, {}, 0}));
  std::vector<CodedSegment> segments =
      BasisSearch(trajectories, attribute_options, bound).solve().segments;
  for (CodedSegment& segment : segments)
    segment.encoded.reference = pose;
  return segments;
}

}  // namespace

MovingAttributes encode_moving_attributes(const EncoderInput& input,
                                          const std::vector<StoredAttribute>& stored,
                                          const SearchOptions& options,
                                          std::shared_ptr<const EncodedPose> pose) {
  MovingAttributes out;
  for (const StoredAttribute& s : stored) {
    const Attribute& attribute = input.sequence.attributes[s.source];
    if (!s.moves)
      continue;
    AttributeResult result;
    result.kind = attribute.kind;
    result.name = attribute.name;
    result.number = s.number;
    result.asked = s.bound;
    const OffsetReader reader(input, s);
    const double rounding = kRounding * reader.largest_value();
    std::vector<CodedSegment> segments;
    for (uint32_t first = 0; first < attribute.components; first += 3) {
      Offsets offsets = reader.read(first);
      const double bound = result.asked - offsets.spread - rounding;
      if (!(rounding < result.asked / 4))
        throw Error(ErrorKind::kUsage,
                    attribute.name + ": the error asked for is finer than float32 values can keep");
      if (!(offsets.largest > bound))
        continue;
      if (!pose)
        pose = own_pose(input);
      try {
        for (CodedSegment& segment :
             encode_offsets(input, s, std::move(offsets.frames), bound, options, pose)) {
          Limits::Segment& sizes = segment.encoded.sizes;
          sizes.attribute = s.number;
          sizes.first_component = first;
          sizes.domain = attribute.domain;
          sizes.entries = s.surface.coded_vertices;
          segments.push_back(std::move(segment));
        }
      } catch (const OverMemory& error) {
        throw OverMemory(attribute.name + ": " + error.what());
      } catch (const Error& error) {
        throw Error(error.kind(), attribute.name + ": " + error.what());
      }
    }
    for (CodedSegment& segment : segments) {
      result.bytes += segment.encoded.bytes();
      result.components = std::max(result.components, segment.encoded.sizes.components);
      out.segments.push_back(std::move(segment));
    }
    out.results.push_back(std::move(result));
  }
  return out;
}

}  // namespace anicodec
