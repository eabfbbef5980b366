// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CHECK_FILE_H_
#define ANICODEC_CODEC_CHECK_FILE_H_

#include "codec/connectivity/attribute_encode.h"
#include "codec/metrics/metrics.h"
#include "codec/plan/encode_result.h"
#include "codec/search/encoder_input.h"
#include "format/bounds_record.h"

#include <cstdint>
#include <vector>

namespace anicodec {

class KeptLearning;

/// Errors of a decoded clip against its source.
struct MeasuredClip {
  Comparison positions;
  Vector<AttributeError> attributes;  ///< those that move
};

/// The file as it decodes.
struct CheckedFile {
  std::vector<MeasuredClip> clips;
  std::vector<BoundsRecord> bounds;  ///< of each segment; without boxes those of attributes
};

/// Opens a file and plays it through the interface that programs use, and compares each clip with the source:
/// positions, and the attributes that change over time, whose errors over all clips are filled in.
/// `is_lossless`: the file must have the source's bits; `learning`: OpenOptions::learning. Throws Error(kInternal) for a file that cannot be opened, that decodes to other
/// integers or bits, or with an attribute further off than was asked for. Cost: that of playing all frames.
CheckedFile check_file(const Bytes& bytes, const EncoderInput& input,
                       const std::vector<StoredAttribute>& stored, bool is_lossless,
                       KeptLearning* learning, std::vector<AttributeResult>* attributes);

/// Opens a file and checks that its segments decode to their integers. Throws Error(kInternal).
void check_hashes(const Bytes& bytes);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CHECK_FILE_H_
