// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_SEGMENT_CODER_H_
#define ANICODEC_CODEC_SEARCH_SEGMENT_CODER_H_

#include "codec/search/coded_part.h"

#include <optional>

namespace anicodec {

/// One way of coding a segment: a kind of basis.
class SegmentCoder {
 public:
  virtual ~SegmentCoder() = default;

  /// Codes with an error of at most `rmse` (scene units, over the source's vertices), close to it.
  /// Nothing when it cannot be reached.
  virtual std::optional<CodedPart> at_rmse(double rmse) = 0;

  /// Codes with about that error, by one quick trial that chooses no settings; nothing if there is
  /// no quicker way than at_rmse().
  virtual std::optional<CodedPart> near_rmse(double /*rmse*/) { return std::nullopt; }
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_SEGMENT_CODER_H_
