// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_SOLUTION_H_
#define ANICODEC_CODEC_SEARCH_SOLUTION_H_

#include "codec/search/coded_segment.h"

#include <cstddef>
#include <vector>

namespace anicodec {

/// A way to code the clip.
struct Solution {
  std::vector<CodedSegment> segments;
  size_t bytes = 0;  ///< of the file

  std::vector<const EncodedSegment*> encoded() const;
  /// The bytes, and what opening is worth.
  double price() const;
  double squared_error() const;
  double max_error() const;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_SOLUTION_H_
