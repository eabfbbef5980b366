// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_BYTE_SOURCE_H_
#define ANICODEC_TOOLS_IO_FILES_BYTE_SOURCE_H_

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// Bytes read piece by piece at any offset: a file too large to hold beside what is made of it, or
/// memory. read() fills the whole span or throws Error(kInput).
struct ByteSource {
  std::string name;  ///< for messages
  uint64_t size = 0;
  std::function<void(uint64_t offset, std::span<char> bytes)> read;
};

/// The bytes must outlive the source.
ByteSource memory_source(std::string_view bytes, std::string name);

/// Opens a regular file. Throws Error(kInput) where there is none.
ByteSource file_source(const std::string& path);

/// Replaces `bytes` by the whole content of a regular file, reusing its memory. Throws
/// Error(kInput).
void read_file(const std::string& path, std::string& bytes);

/// Replaces `bytes` by all that the standard input has. Throws Error(kInput).
void read_standard_input(std::string& bytes);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_BYTE_SOURCE_H_
