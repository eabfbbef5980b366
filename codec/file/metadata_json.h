// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_METADATA_JSON_H_
#define ANICODEC_CODEC_FILE_METADATA_JSON_H_

#include "codec/sequence/mesh_sequence.h"
#include "format/memory.h"

#include <string>
#include <vector>

namespace anicodec {

/// The payload of chunk META for a JSON object, without blanks between its parts. Throws Error(kUsage) unless `json`
/// is a JSON object in UTF-8 of at most kMaxMetadataBytes.
String checked_metadata(const std::string& json);

/// Metadata, a JSON object or nothing, with what the attributes' numbers mean: under "fields", by the name of an
/// attribute, its "unit", and "whole" if its numbers are to be rounded to whole ones. Throws Error(kUsage) for a unit
/// of an attribute without a name, and for attributes of one name that differ in these.
std::string with_fields(const std::string& json, const std::vector<const Attribute*>& attributes);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_METADATA_JSON_H_
