// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/clip_search.h"

#include "codec/file/clip_file.h"
#include "codec/segment/coefficient_slices.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

constexpr int kRateRounds = 4;
constexpr double kRoom = 0.003;  // of the file, for attributes that change with the pose
constexpr double kSliceGrowth = 0.003;        // of the file, that slices may take
constexpr size_t kSlicedCoefficients = 1 << 16;  // two milliseconds to read: fewer are in one slice

/// Segments in the order of the file.
std::vector<const EncodedSegment*> all_segments(const CodedClip& clip) {
  std::vector<const EncodedSegment*> list = clip.positions.segments();
  for (const CodedPart& part : clip.attributes.parts)
    list.push_back(&part.encoded);
  std::ranges::stable_sort(list, {}, [](const EncodedSegment* s) { return s->sizes.first_frame; });
  return list;
}

size_t coefficients_of(const EncodedSegment& segment, const MeshLayout& layout) {
  const size_t channels = segment.sizes.kind == BasisKind::kEigentrajectories ? 1 : 3;
  return size_t{layout.sizes.coded_vertices} * segment.sizes.components * channels;
}

/// Room for the errors of attributes that move, which are yet to be measured.
Vector<AttributeError> errors_of(const std::vector<AttributeResult>& attributes) {
  Vector<AttributeError> errors;
  for (const AttributeResult& a : attributes) {
    if (a.kept)
      errors.push_back({0, static_cast<uint16_t>(a.number), 0, 0});
  }
  return errors;
}

}  // namespace

Bytes CodedClip::file(ClipsRecord record, const MeshLayout& layout) const {
  for (ClipRecord& clip : record.clips) {
    if (clip.attribute_errors.empty())
      clip.attribute_errors = errors_of(attributes.results);
  }
  return clip_file(record, layout, all_segments(*this));
}

CodedClip ClipSearch::run(const ClipsRecord& record) {
  const std::optional<double> allowed =
      allowed_bytes(target_, input_.sequence.vertex_count, input_.sequence.frame_count);
  double positions_bytes = allowed.value_or(0);
  CodedClip coded;
  for (int round = 0; round < kRateRounds; ++round) {
    coded.positions =
        round == 0 ? control_.solve() : control_.solve_within(std::max(positions_bytes, 1.0));
    coded.attributes = encode_moving_attributes(input_, stored_, options_,
                                                coded.positions.parts[0].encoded.reference);
    if (!allowed || coded.attributes.parts.empty())
      break;
    const auto bytes = static_cast<double>(coded.file(record, input_.layout).size());
    if (bytes <= *allowed)
      break;
    // With another pose the attributes take some bytes more or less: room for them.
    positions_bytes -= bytes - *allowed + (round + 1) * kRoom * *allowed;
  }
  slice(record, allowed, &coded);
  return coded;
}

/// Puts coefficients into slices, which changes nothing that is decoded.
void ClipSearch::slice(const ClipsRecord& record, std::optional<double> allowed,
                       CodedClip* coded) const {
  const auto file_size = [&] {
    return static_cast<double>(coded->file(record, input_.layout).size());
  };
  const double bytes = file_size();
  std::vector<EncodedSegment*> segments;
  for (std::vector<CodedPart>* parts : {&coded->positions.parts, &coded->attributes.parts}) {
    for (CodedPart& part : *parts)
      segments.push_back(&part.encoded);
  }
  size_t all = 1;
  for (const EncodedSegment* segment : segments)
    all += segment->bytes();
  for (EncodedSegment* segment : segments) {
    if (options_.slices == 1 || !CoefficientSlices::applies_to(*segment))
      continue;
    const CoefficientSlices coefficients(*segment, input_.layout);
    EncodedSegment sliced = *segment;
    if (options_.slices > 0)
      sliced = coefficients.in(options_.slices);
    else if (coefficients_of(*segment, input_.layout) >= kSlicedCoefficients)
      sliced = coefficients.within(kSliceGrowth * bytes * static_cast<double>(segment->bytes()) /
                                   static_cast<double>(all));
    std::swap(*segment, sliced);
    if (allowed && file_size() > *allowed)
      std::swap(*segment, sliced);
  }
}

}  // namespace anicodec
