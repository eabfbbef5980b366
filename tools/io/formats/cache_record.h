// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A mesh and a vertex cache are two files, and one may be of another run than the other. The mesh
// therefore ends with a comment that says which cache it was written with.
#ifndef ANICODEC_TOOLS_IO_FORMATS_CACHE_RECORD_H_
#define ANICODEC_TOOLS_IO_FORMATS_CACHE_RECORD_H_

#include "format/checksum.h"
#include "tools/io/files/byte_source.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// XXH64 of a cache's bytes, which are whole words, fed in pieces of any whole number of them.
class CacheHash {
 public:
  void add(std::string_view bytes);

  uint64_t digest() const { return hash_.digest(); }

 private:
  IntegerHash hash_;
};

/// The comment that ends an OBJ, of the cache's name without folders and its hash.
std::string cache_record(const std::string& cache_path, uint64_t hash);

/// Throws Error(kInput) when the text of a mesh ends with the record of a cache of this name, and
/// this is another: then they come from two runs. Reads the cache once in that case.
void check_cache_record(std::string_view mesh_text, const std::string& mesh_path,
                        const ByteSource& cache);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_CACHE_RECORD_H_
