// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_LISTING_LISTING_H_
#define ANICODEC_TOOLS_LISTING_LISTING_H_

#include "format/bytes.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// A line of a listing: a range of bytes, and what it means.
struct ListedField {
  uint64_t offset = 0;
  uint64_t size = 0;
  std::string name;
  std::string value;
};

/// Reads a range of a file field by field and writes down each. Past the end fields read as 0, and
/// ok() turns false.
class FieldReader {
 public:
  /// `offset` is where the view stands in the file.
  FieldReader(ByteView view, uint64_t offset, std::vector<ListedField>& out)
      : reader_(view), offset_(offset), out_(out) {}

  uint8_t u8(std::string_view name);
  uint16_t u16(std::string_view name);
  uint32_t u32(std::string_view name);
  uint64_t u64(std::string_view name);
  uint32_t hex32(std::string_view name);
  uint64_t hex64(std::string_view name);
  double f32(std::string_view name);
  double f64(std::string_view name);
  uint64_t varint(std::string_view name);
  void text(std::string_view name);
  /// Bytes in hexadecimal.
  void hex(std::string_view name, uint64_t size);
  /// Bytes of which only the number is listed.
  void bytes(std::string_view name, uint64_t size);
  /// A varint length and so many bytes; lists both.
  void block(std::string_view name);
  /// All that is left, if there is anything.
  void rest(std::string_view name);

  /// Adds the meaning of a number to the last line.
  void explain(std::string_view meaning);

  bool ok() const { return reader_.ok(); }

  uint64_t remaining() const { return reader_.remaining(); }

 private:
  template <typename Value>
  Value listed(std::string_view name, uint64_t begin, Value x);
  void line(std::string_view name, uint64_t begin, std::string value);

  ByteReader reader_;
  uint64_t offset_;
  std::vector<ListedField>& out_;
};

/// Every byte of an .anic file, in file order, without gaps: header, table, the fields of the
/// records, the streams by their size. Reads as far as it can: whatever does not parse is listed as
/// bytes.
std::vector<ListedField> list_fields(ByteView file);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_LISTING_LISTING_H_
