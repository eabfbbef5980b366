// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/cache_record.h"

#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

/// All that the record says of a cache but its hash; it begins a line.
std::string beginning(const std::string& cache_path) {
  return "# moved by " + printable(std::filesystem::path(cache_path).filename().string()) +
         ", XXH64 ";
}

uint64_t hash_of(const ByteSource& cache) {
  constexpr size_t kPiece = size_t{1} << 20;
  CacheHash hash;
  std::vector<char> piece;
  for (uint64_t at = 0; at < cache.size; at += piece.size()) {
    piece.resize(std::min<uint64_t>(kPiece, cache.size - at));
    cache.read(at, piece);
    hash.add({piece.data(), piece.size()});
  }
  return hash.digest();
}

/// The last line that is not empty.
std::string_view last_line(std::string_view text) {
  const size_t end = text.find_last_not_of("\r\n");
  text = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
  return text.substr(text.find_last_of("\r\n") + 1);
}

}  // namespace

void CacheHash::add(std::string_view bytes) {
  std::vector<int32_t> words(bytes.size() / sizeof(int32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(int32_t));
  hash_.add(words.data(), words.size());
}

std::string cache_record(const std::string& cache_path, uint64_t hash) {
  return fmt::format("{}{:016x}\n", beginning(cache_path), hash);
}

void check_cache_record(std::string_view mesh_text, const std::string& mesh_path,
                        const ByteSource& cache) {
  const std::string_view record = last_line(mesh_text);
  if (!record.starts_with(beginning(cache.name)))
    return;
  const std::string expected = cache_record(cache.name, hash_of(cache));
  if (record != std::string_view(expected).substr(0, expected.size() - 1))
    fail_input(cache.name, "is not the cache that " + mesh_path +
                               " was written with: one of them is of another run; write both anew, "
                               "or remove the last line of the mesh to use them all the same");
}

}  // namespace anicodec::tools
