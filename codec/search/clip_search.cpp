// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/clip_search.h"

#include "codec/file/clip_file.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

constexpr int kRateRounds = 4;
constexpr double kRoom = 0.003;  // of the file, for attributes that change with the pose

/// Segments in the order of the file.
std::vector<const EncodedSegment*> all_segments(const CodedClip& clip) {
  std::vector<const EncodedSegment*> list = clip.positions.segments();
  for (const CodedPart& part : clip.attributes.parts)
    list.push_back(&part.encoded);
  std::ranges::stable_sort(list, {}, [](const EncodedSegment* s) { return s->sizes.first_frame; });
  return list;
}

/// Room for the errors of attributes that move, which are yet to be measured.
Vector<AttributeError> errors_of(const std::vector<AttributeResult>& attributes) {
  Vector<AttributeError> errors;
  for (const AttributeResult& a : attributes)
    errors.push_back({0, static_cast<uint16_t>(a.number), 0, 0});
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
  return coded;
}

}  // namespace anicodec
