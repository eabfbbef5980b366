// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_FILE_SEARCH_H_
#define ANICODEC_CODEC_SEARCH_FILE_SEARCH_H_

#include "codec/connectivity/attribute_encode.h"
#include "codec/plan/encode_options.h"
#include "codec/search/basis_search.h"
#include "codec/search/encoder_input.h"
#include "codec/search/moving_attributes.h"
#include "codec/search/solution.h"
#include "format/records.h"

#include <vector>

namespace anicodec {

/// The clip and its moving attributes, coded.
struct CodedClip {
  Solution positions;
  MovingAttributes attributes;

  /// In the order of the file.
  std::vector<const EncodedSegment*> encoded() const;
};

/// Adds room for the errors of attributes that move, which are yet to be measured.
void make_room(const std::vector<AttributeResult>& attributes, ClipsRecord* record);

/// Searches positions and moving attributes for a bound of the whole file: where that is a size,
/// positions get what the attributes leave.
class FileSearch {
 public:
  /// All references must outlive this object.
  FileSearch(const EncoderInput& input, const std::vector<StoredAttribute>& stored,
             const SearchOptions& options, const Bound& bound)
      : input_(input),
        stored_(stored),
        options_(options),
        bound_(bound),
        control_(input, options, bound) {}

  /// `record`: for the size of the file. Throws Error(kUsage) when the target cannot be reached.
  CodedClip run(const ClipsRecord& record);

  /// The trials of the first search of the positions.
  const std::vector<Trial>& trials() const { return control_.trials(); }

  const std::vector<std::string>& notes() const { return control_.notes(); }

 private:
  const EncoderInput& input_;
  const std::vector<StoredAttribute>& stored_;
  const SearchOptions& options_;
  Bound bound_;
  BasisSearch control_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_FILE_SEARCH_H_
