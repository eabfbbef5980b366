// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_NAME_PATTERN_H_
#define ANICODEC_TOOLS_IO_FILES_NAME_PATTERN_H_

#include <cstddef>
#include <cstdint>
#include <string>

namespace anicodec::tools {

/// An output name with at most one number in it, as frame_%04d.obj.
struct NamePattern {
  std::string before;
  std::string after;
  bool has_number = false;
  size_t width = 0;

  std::string name(uint64_t number) const;
};

/// Throws Error(kUsage) for a % that is no single %d or %0Nd.
NamePattern parse_name_pattern(const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_NAME_PATTERN_H_
