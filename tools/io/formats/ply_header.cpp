// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/ply_header.h"

#include "tools/io/base/mesh.h"
#include "tools/io/base/text_cursor.h"

#include <algorithm>
#include <functional>
#include <set>

namespace anicodec::tools {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr TypeName kTypeNames[] = {
    {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},       {"uchar", PlyType::kUint8},
    {"uint8", PlyType::kUint8},    {"short", PlyType::kInt16},     {"int16", PlyType::kInt16},
    {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},   {"int", PlyType::kInt32},
    {"int32", PlyType::kInt32},    {"uint", PlyType::kUint32},     {"uint32", PlyType::kUint32},
    {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64},
    {"float64", PlyType::kFloat64}};

PlyType parse_type(TextCursor& in) {
  std::string_view word = in.word("type");
  for (const TypeName& known : kTypeNames) {
    if (known.name == word)
      return known.type;
  }
  in.fail("unknown type '" + shown(word) + "'");
}

PlyEncoding parse_format(TextCursor& in) {
  std::string_view encoding = in.word("format");
  std::string_view version = in.word("version");
  if (version != "1.0")
    in.fail("version '" + shown(version) + "' is not 1.0");
  if (encoding == "ascii")
    return PlyEncoding::kAscii;
  if (encoding == "binary_little_endian")
    return PlyEncoding::kLittleEndian;
  if (encoding == "binary_big_endian")
    return PlyEncoding::kBigEndian;
  in.fail("unknown format '" + shown(encoding) + "'");
}

using Names = std::set<std::string, std::less<>>;

void refuse_second(std::string_view name, Names& before, TextCursor& in) {
  if (!before.emplace(name).second)
    in.fail("'" + shown(name) + "' is declared twice");
}

PlyElement parse_element(Names& before, TextCursor& in) {
  PlyElement element;
  element.name = in.word("name");
  refuse_second(element.name, before, in);
  int64_t count = in.integer("count");
  if (count < 0)
    in.fail("the count " + std::to_string(count) + " is negative");
  element.count = static_cast<uint64_t>(count);
  return element;
}

PlyProperty parse_property(Names& before, TextCursor& in) {
  PlyProperty property;
  if (TextCursor ahead = in; ahead.word("type") == "list") {
    in.word("type");
    property.list = true;
    property.count_type = parse_type(in);
    if (!is_integer(property.count_type))
      in.fail("the count of a list is not an integer type");
  }
  property.type = parse_type(in);
  property.name = in.word("name");
  refuse_second(property.name, before, in);
  return property;
}

}  // namespace

size_t size_of(PlyType type) {
  constexpr size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

PlyHeader parse_ply_header(std::string_view bytes, std::string_view name) {
  // The first line tells how lines end, and so where a binary body begins.
  std::string_view newline = bytes.starts_with("ply\r\n") ? "\r\n"
                             : bytes.starts_with("ply\n") ? "\n"
                             : bytes.starts_with("ply\r") ? "\r"
                                                          : "";
  if (newline.empty())
    fail_input(name, "is not a PLY file: it does not begin with a line 'ply'");

  PlyHeader header;
  Names elements, properties;  // those of the last element
  bool has_format = false;
  size_t offset = 3 + newline.size();
  for (size_t line = 2;; ++line) {
    size_t end = bytes.find(newline, offset);
    if (end == std::string_view::npos)
      fail_input(name, "the header has no end_header");
    TextCursor in(bytes.substr(offset, end - offset), name, {}, line);
    offset = end + newline.size();
    if (in.at_line_end())
      continue;
    std::string_view keyword = in.word("keyword");
    if (keyword == "comment" || keyword == "obj_info") {
      continue;
    } else if (keyword == "format") {
      if (has_format)
        in.fail("a second format");
      header.encoding = parse_format(in);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(elements, in));
      properties.clear();
    } else if (keyword == "property") {
      if (header.elements.empty())
        in.fail("a property comes before the first element");
      header.elements.back().properties.push_back(parse_property(properties, in));
    } else if (keyword == "end_header") {
      in.end_line();
      if (!has_format)
        in.fail("the header names no format");
      header.body = offset;
      header.body_line = line + 1;
      return header;
    } else {
      in.fail("unknown header line '" + shown(keyword) + "'");
    }
    in.end_line();
  }
}

}  // namespace anicodec::tools
