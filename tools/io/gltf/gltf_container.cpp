// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_container.h"

#include "tools/io/base/byte_order.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/text_cursor.h"

#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <string>

namespace anicodec::tools {
namespace {

constexpr int kMaxDepth = 64;
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// Before the parser, whose callbacks cost the square of an array's length.
void check_depth(std::string_view text, std::string_view name) {
  int depth = 0;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{'))
      ++depth;
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
    if (depth > kMaxDepth)
      fail_input(name, "the JSON is nested deeper than " + std::to_string(kMaxDepth) + " levels");
  }
}

nlohmann::json parse_json(std::string_view text, std::string_view name) {
  check_depth(text, name);
  try {
    nlohmann::json document = nlohmann::json::parse(text);
    if (!document.is_object())
      fail_input(name, "the JSON is not an object");
    return document;
  } catch (const nlohmann::json::parse_error& e) {
    fail_input(name, "is not valid JSON, at byte " + std::to_string(e.byte) + " of its text");
  } catch (const nlohmann::json::exception&) {
    fail_input(name, "the JSON has a number that is too large");
  }
}

uint32_t word(std::string_view bytes, size_t offset) {
  return load<uint32_t>(bytes.data() + offset, std::endian::little);
}

int digit_of(char c) {
  if (c >= 'A' && c <= 'Z')
    return c - 'A';
  if (c >= 'a' && c <= 'z')
    return c - 'a' + 26;
  if (c >= '0' && c <= '9')
    return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

int hex_of(char c) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  size_t i = kDigits.find(c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c);
  return i == std::string_view::npos ? -1 : static_cast<int>(i);
}

}  // namespace

GltfContainer open_gltf(std::string_view bytes, std::string_view name) {
  GltfContainer out;
  if (!bytes.starts_with("glTF")) {
    if (bytes.starts_with("\xEF\xBB\xBF"))
      bytes.remove_prefix(3);
    out.document = parse_json(bytes, name);
    return out;
  }
  if (bytes.size() < 20)
    fail_input(name, "the GLB is truncated: " + std::to_string(bytes.size()) + " bytes");
  if (word(bytes, 4) != 2)
    fail_input(name, "GLB version " + std::to_string(word(bytes, 4)) + "; version 2 is read");
  if (word(bytes, 8) != bytes.size())
    fail_input(name, "the GLB header says " + std::to_string(word(bytes, 8)) +
                         " bytes, but the file has " + std::to_string(bytes.size()));
  bool first = true;
  for (size_t at = 12; at < bytes.size();) {
    if (bytes.size() - at < 8 || word(bytes, at) > bytes.size() - at - 8)
      fail_input(name, "the GLB chunk at byte " + std::to_string(at) + " is truncated");
    std::string_view chunk = bytes.substr(at + 8, word(bytes, at));
    uint32_t type = word(bytes, at + 4);
    if (first != (type == kJsonChunk))
      fail_input(name, "the first GLB chunk, and no other, holds JSON");
    if (first)
      out.document = parse_json(chunk, name);
    else if (type == kBinaryChunk && !out.binary)
      out.binary = chunk;
    first = false;
    at += 8 + chunk.size();
  }
  return out;
}

bool is_data_uri(std::string_view uri) {
  return uri.starts_with("data:");
}

std::vector<char> decode_data_uri(std::string_view uri, const JsonNode& node) {
  constexpr std::string_view kMark = ";base64,";
  size_t mark = uri.find(kMark);
  if (mark == std::string_view::npos)
    node.fail("the data URI is not in base64");
  std::string_view text = uri.substr(mark + kMark.size());
  while (!text.empty() && text.back() == '=')
    text.remove_suffix(1);
  std::vector<char> out;
  out.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int count = 0;
  for (char c : text) {
    int digit = digit_of(c);
    if (digit < 0)
      node.fail("the data URI has a character that is not base64");
    bits = bits << 6 | static_cast<uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out.push_back(static_cast<char>(bits >> count & 0xFF));
    }
  }
  return out;
}

std::string decoded_uri(std::string_view uri) {
  std::string path;
  for (size_t i = 0; i < uri.size(); ++i) {
    int high = i + 2 < uri.size() ? hex_of(uri[i + 1]) : -1;
    int low = i + 2 < uri.size() ? hex_of(uri[i + 2]) : -1;
    if (uri[i] == '%' && high >= 0 && low >= 0) {
      path += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

std::string encoded_uri(std::string_view path) {
  constexpr std::string_view kDigits = "0123456789ABCDEF", kPlain = "-._~/+,=@()!$&';";
  std::string uri;
  for (const char c : path) {
    const auto byte = static_cast<uint8_t>(c);
    if (std::isalnum(byte) || kPlain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      uri += '%';
      uri += kDigits[byte >> 4];
      uri += kDigits[byte & 15];
    }
  }
  return uri;
}

std::string path_of_uri(std::string_view uri, const JsonNode& node, bool allow_outside) {
  if (uri.find("://") != std::string_view::npos || uri.starts_with("/") || uri.starts_with("file:"))
    node.fail("'" + shown(uri) + "' is not relative to the file; only such buffers are read");
  const std::string path = decoded_uri(uri);
  if (path.find('\0') != std::string::npos)
    node.fail("the URI has a zero byte");
  // Normalised as text, so that a link to a folder is no way out either.
  const std::filesystem::path normal = std::filesystem::path(path).lexically_normal();
  if (!allow_outside && (normal.is_absolute() || (!normal.empty() && *normal.begin() == "..")))
    node.fail("'" + shown(path) +
              "' leads out of the folder of the file; --allow-outside reads it, "
              "and with it whatever file the document names");
  return normal.string();
}

}  // namespace anicodec::tools
