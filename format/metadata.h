// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_METADATA_H_
#define ANICODEC_FORMAT_METADATA_H_

#include "format/bytes.h"

#include <algorithm>
#include <cstdint>

namespace anicodec {

/// The longest JSON text in chunk META (spec/06-chunks.md, section 14).
inline constexpr size_t kMaxMetadataBytes = size_t{1} << 20;
/// Objects and arrays in one another: programs that read JSON recurse.
inline constexpr uint32_t kMaxMetadataNesting = 32;

/// Whether bytes are UTF-8 (RFC 3629): shortest forms, no surrogates, at most U+10FFFF. O(bytes).
inline bool is_utf8(ByteView text) {
  for (size_t i = 0; i < text.size;) {
    const uint8_t first = text.data[i++];
    if (first < 0x80)
      continue;
    const size_t more = first >= 0xC2 && first < 0xE0   ? 1
                        : first >= 0xE0 && first < 0xF0 ? 2
                        : first >= 0xF0 && first < 0xF5 ? 3
                                                        : 0;
    if (more == 0 || text.size - i < more)
      return false;
    const uint8_t second = text.data[i];
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90))
      return false;
    for (size_t k = 0; k < more; ++k) {
      if ((text.data[i++] & 0xC0) != 0x80)
        return false;
    }
  }
  return true;
}

/// How deep objects and arrays lie in one another, of text that is JSON.
inline uint32_t nesting(ByteView json) {
  uint32_t depth = 0, most = 0;
  bool in_text = false;
  for (size_t i = 0; i < json.size; ++i) {
    const uint8_t c = json.data[i];
    if (in_text && c == '\\')
      ++i;
    else if (c == '"')
      in_text = !in_text;
    else if (!in_text && (c == '{' || c == '['))
      most = std::max(most, ++depth);
    else if (!in_text && (c == '}' || c == ']') && depth > 0)
      --depth;
  }
  return most;
}

/// Whether chunk META may hold these bytes, as far as a decoder looks at them: it does not read the JSON itself.
inline bool is_metadata(ByteView text) {
  return text.size > 0 && text.size <= kMaxMetadataBytes && is_utf8(text) &&
         nesting(text) <= kMaxMetadataNesting;
}

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_METADATA_H_
