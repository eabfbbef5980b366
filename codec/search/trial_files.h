// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_TRIAL_FILES_H_
#define ANICODEC_CODEC_SEARCH_TRIAL_FILES_H_

#include "codec/plan/encode_result.h"
#include "codec/search/encoder_input.h"
#include "codec/search/solution.h"
#include "format/records.h"

#include <vector>

namespace anicodec {

/// Puts coded segments together to files, and lists what they measured.
class TrialFiles {
 public:
  /// Parts are corrected to the caps of the input, which must outlive this object.
  explicit TrialFiles(const EncoderInput& input);

  Solution put_together(std::vector<CodedSegment> segments);

  /// The same, for trials that only show the way: the list does not have them.
  Solution unlisted(std::vector<CodedSegment> segments) const;

  const std::vector<Trial>& trials() const { return trials_; }

 private:
  const EncoderInput& input_;
  ClipsRecord record_;
  std::vector<Trial> trials_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_TRIAL_FILES_H_
