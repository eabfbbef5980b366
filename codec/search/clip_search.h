// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_CLIP_SEARCH_H_
#define ANICODEC_CODEC_SEARCH_CLIP_SEARCH_H_

#include "codec/connectivity/attribute_encode.h"
#include "codec/file/encode_options.h"
#include "codec/search/encoder_input.h"
#include "codec/search/moving_attributes.h"
#include "codec/search/rate_control.h"
#include "codec/search/solution.h"
#include "format/records.h"

#include <vector>

namespace anicodec {

/// The clip and its moving attributes, coded.
struct CodedClip {
  Solution positions;
  MovingAttributes attributes;

  /// The file. Errors of attributes are those of the record, 0 where it has none.
  Bytes file(ClipsRecord record, const MeshLayout& layout) const;
};

/// Searches positions and moving attributes for a target of the whole file: where that is a size,
/// positions get what the attributes leave.
class ClipSearch {
 public:
  /// All references must outlive this object.
  ClipSearch(const EncoderInput& input, const std::vector<StoredAttribute>& stored,
             const EncodeOptions& options, const Target& target)
      : input_(input),
        stored_(stored),
        options_(options),
        target_(target),
        control_(input, options, target) {}

  /// `record`: for the size of the file. Throws Error(kUsage) when the target cannot be reached.
  CodedClip run(const ClipsRecord& record);

  /// The trials of the first search of the positions.
  const std::vector<Trial>& trials() const { return control_.trials(); }

  const std::vector<std::string>& notes() const { return control_.notes(); }

 private:
  const EncoderInput& input_;
  const std::vector<StoredAttribute>& stored_;
  const EncodeOptions& options_;
  Target target_;
  RateControl control_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_CLIP_SEARCH_H_
