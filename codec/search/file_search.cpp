// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/file_search.h"

#include "codec/file/clip_file.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

constexpr int kRateRounds = 4;
constexpr double kRoom = 0.003;  // of the file, for attributes that change with the pose

}  // namespace

std::vector<const EncodedSegment*> CodedClip::encoded() const {
  std::vector<const EncodedSegment*> list = positions.encoded();
  for (const CodedSegment& segment : attributes.segments)
    list.push_back(&segment.encoded);
  std::ranges::stable_sort(list, {}, [](const EncodedSegment* s) { return s->sizes.first_frame; });
  return list;
}

void make_room(const std::vector<AttributeResult>& attributes, ClipsRecord* record) {
  for (ClipRecord& clip : record->clips) {
    for (const AttributeResult& a : attributes)
      clip.attribute_errors.push_back({0, static_cast<uint16_t>(a.number), 0, 0});
  }
}

CodedClip FileSearch::run(const ClipsRecord& record) {
  const std::optional<double> allowed =
      allowed_bytes(bound_, input_.sequence.vertex_count, input_.sequence.frame_count);
  double positions_bytes = allowed.value_or(0);
  CodedClip coded;
  for (int round = 0; round < kRateRounds; ++round) {
    coded.positions =
        round == 0 ? control_.solve() : control_.solve_within(std::max(positions_bytes, 1.0));
    coded.attributes = encode_moving_attributes(input_, stored_, options_,
                                                coded.positions.segments[0].encoded.reference);
    if (!allowed || coded.attributes.segments.empty())
      break;
    ClipsRecord with_errors = record;
    make_room(coded.attributes.results, &with_errors);
    const auto bytes =
        static_cast<double>(clip_file_bytes(with_errors, input_.layout, coded.encoded()));
    if (bytes <= *allowed)
      break;
    // With another pose the attributes take some bytes more or less: room for them.
    positions_bytes -= bytes - *allowed + (round + 1) * kRoom * *allowed;
  }
  return coded;
}

}  // namespace anicodec
