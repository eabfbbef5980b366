// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_PLY_HEADER_H_
#define ANICODEC_TOOLS_IO_FORMATS_PLY_HEADER_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

size_t size_of(PlyType type);

inline bool is_integer(PlyType type) {
  return type < PlyType::kFloat32;
}

struct PlyProperty {
  std::string name;
  bool list = false;
  PlyType count_type = PlyType::kUint8;  ///< of a list
  PlyType type = PlyType::kFloat32;
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  size_t body = 0;       ///< offset of the first byte after the header
  size_t body_line = 1;  ///< line where an ascii body begins
};

/// Throws Error(kInput) "name:line: reason". No list has a count that is not an integer, and
/// neither an element nor a property of one element occurs twice.
PlyHeader parse_ply_header(std::string_view bytes, std::string_view name);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_PLY_HEADER_H_
