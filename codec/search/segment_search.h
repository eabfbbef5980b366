// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_SEGMENT_SEARCH_H_
#define ANICODEC_CODEC_SEARCH_SEGMENT_SEARCH_H_

#include "codec/search/coded_segment.h"

#include <optional>

namespace anicodec {

/// Searches how one kind of basis codes a segment.
class SegmentSearch {
 public:
  virtual ~SegmentSearch() = default;

  /// The segment with an error of at most `rmse` (scene units, over the source's vertices), close to it.
  /// Nothing when it cannot be reached.
  virtual std::optional<CodedSegment> at_rmse(double rmse) = 0;

  /// The segment with about that error, by one quick trial that chooses no settings; nothing if there is
  /// no quicker way than at_rmse().
  virtual std::optional<CodedSegment> near_rmse(double /*rmse*/) { return std::nullopt; }
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_SEGMENT_SEARCH_H_
