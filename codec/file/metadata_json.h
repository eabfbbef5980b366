// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_METADATA_JSON_H_
#define ANICODEC_CODEC_FILE_METADATA_JSON_H_

#include "format/memory.h"

#include <string>

namespace anicodec {

/// The payload of chunk META for a JSON object, without blanks between its parts. Throws Error(kUsage) unless `json`
/// is a JSON object in UTF-8 of at most kMaxMetadataBytes.
String checked_metadata(const std::string& json);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_METADATA_JSON_H_
