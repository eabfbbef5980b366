// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <cstring>

#define XXH_INLINE_ALL
#include "corpus/clips.h"

#include <xxhash.h>

namespace anicodec::corpus {
namespace {

uint64_t hash(const FrameArray& positions) {
  std::vector<uint8_t> bytes;
  bytes.reserve(positions.size() * 4);
  for (float x : positions) {
    auto bits = std::bit_cast<uint32_t>(x);
    for (int shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<uint8_t>(bits >> shift));
  }
  return XXH64(bytes.data(), bytes.size(), 0);
}

}  // namespace

std::string manifest() {
  // Names and descriptions hold nothing that JSON would escape.
  std::string text = "{\"clips\": [\n";
  const char* separator = "";
  for (const ClipInfo& clip : clips()) {
    MeshSequence s = make_clip(clip.name);
    char hash_text[20];
    std::snprintf(hash_text, sizeof hash_text, "%016" PRIx64, hash(s.positions));
    text += separator;
    text += "  {\"name\": \"" + clip.name + "\", \"vertices\": " + std::to_string(s.vertex_count) +
            ", \"faces\": " + std::to_string(s.polygons.size()) +
            ", \"frames\": " + std::to_string(s.frame_count) + ", \"positions_xxh64\": \"" +
            hash_text + "\",\n   \"licence\": \"CC0-1.0\", \"description\": \"" + clip.description +
            "\"}";
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace anicodec::corpus
