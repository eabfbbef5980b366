// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_CODED_SEGMENT_H_
#define ANICODEC_CODEC_SEARCH_CODED_SEGMENT_H_

#include "codec/segment/encoded_segment.h"

#include <string>

namespace anicodec {

/// A coded segment and what its decoder shows.
struct CodedSegment {
  EncodedSegment encoded;
  Segment opened;
  SegmentError error;
  double opening = 0;  ///< what its opening time is worth, in bytes
  double asked = 0;    ///< the error that it was coded for
  std::string what;    ///< how it was coded, in a few words
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_CODED_SEGMENT_H_
