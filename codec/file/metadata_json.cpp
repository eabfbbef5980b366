// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/metadata_json.h"

#include "codec/sequence/error.h"
#include "format/metadata.h"

#include <nlohmann/json.hpp>

namespace anicodec {

String checked_metadata(const std::string& json) {
  if (const ByteView view(reinterpret_cast<const uint8_t*>(json.data()), json.size()); nesting(view) > kMaxMetadataNesting)
    throw Error(ErrorKind::kUsage, "the metadata nests deeper than " + std::to_string(kMaxMetadataNesting));
  const auto parsed = nlohmann::ordered_json::parse(json, nullptr, false);
  if (!parsed.is_object())
    throw Error(ErrorKind::kUsage, "the metadata is not a JSON object in UTF-8");
  const std::string text = parsed.dump();
  if (text.size() > kMaxMetadataBytes)
    throw Error(ErrorKind::kUsage, "the metadata takes " + std::to_string(text.size()) + " bytes; at most " +
                                       std::to_string(kMaxMetadataBytes) + " are possible");
  return String(text.begin(), text.end());
}

}  // namespace anicodec
