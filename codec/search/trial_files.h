// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_TRIAL_FILES_H_
#define ANICODEC_CODEC_SEARCH_TRIAL_FILES_H_

#include "codec/file/encode_options.h"
#include "codec/search/encoder_input.h"
#include "codec/search/solution.h"

#include <vector>

namespace anicodec {

/// Puts coded parts together to files, and lists what they measured.
class TrialFiles {
 public:
  /// Parts are corrected to the caps of the input. Both references must outlive this object.
  TrialFiles(const EncoderInput& input, const EncodeOptions& options)
      : input_(input), options_(options) {}

  Solution put_together(std::vector<CodedPart> parts);

  /// The same, for trials that only show the way: the list does not have them.
  Solution unlisted(std::vector<CodedPart> parts) const;

  const std::vector<Trial>& trials() const { return trials_; }

 private:
  const EncoderInput& input_;
  const EncodeOptions& options_;
  std::vector<Trial> trials_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_TRIAL_FILES_H_
