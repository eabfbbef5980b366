// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/listing/listing.h"

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr size_t kShownBytes = 32;
constexpr size_t kShownText = 60;

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (size_t i = 0; i < text.size() && i < kShownText; ++i) {
    auto c = static_cast<unsigned char>(text[i]);
    out += c < 0x20 || c == 0x7F ? '?' : text[i];
  }
  return out + (text.size() > kShownText ? "...\"" : "\"");
}

}  // namespace

void FieldReader::line(std::string_view name, uint64_t begin, std::string value) {
  uint64_t size = reader_.position() - begin;
  if (!reader_.ok())
    value = "(missing)";
  out_.push_back({offset_ + begin, size, std::string(name), std::move(value)});
}

template <typename Value>
Value FieldReader::listed(std::string_view name, uint64_t begin, Value x) {
  line(name, begin, fmt::format("{}", x));
  return x;
}

uint8_t FieldReader::u8(std::string_view name) {
  uint64_t begin = reader_.position();
  return listed(name, begin, reader_.u8());
}

uint16_t FieldReader::u16(std::string_view name) {
  uint64_t begin = reader_.position();
  return listed(name, begin, reader_.u16());
}

uint32_t FieldReader::u32(std::string_view name) {
  uint64_t begin = reader_.position();
  return listed(name, begin, reader_.u32());
}

uint64_t FieldReader::u64(std::string_view name) {
  uint64_t begin = reader_.position();
  return listed(name, begin, reader_.u64());
}

uint32_t FieldReader::hex32(std::string_view name) {
  uint64_t begin = reader_.position();
  uint32_t x = reader_.u32();
  line(name, begin, fmt::format("0x{:08x}", x));
  return x;
}

uint64_t FieldReader::hex64(std::string_view name) {
  uint64_t begin = reader_.position();
  uint64_t x = reader_.u64();
  line(name, begin, fmt::format("0x{:016x}", x));
  return x;
}

double FieldReader::f32(std::string_view name) {
  uint64_t begin = reader_.position();
  return listed(name, begin, static_cast<double>(reader_.f32()));
}

double FieldReader::f64(std::string_view name) {
  uint64_t begin = reader_.position();
  return listed(name, begin, reader_.f64());
}

uint64_t FieldReader::varint(std::string_view name) {
  uint64_t begin = reader_.position();
  return listed(name, begin, reader_.varint());
}

void FieldReader::text(std::string_view name) {
  uint64_t begin = reader_.position();
  String text = reader_.text();
  line(name, begin, quoted({text.data(), text.size()}));
}

void FieldReader::hex(std::string_view name, uint64_t size) {
  uint64_t begin = reader_.position();
  ByteView view = reader_.raw(size);
  std::string value;
  for (size_t i = 0; i < view.size && i < kShownBytes; ++i)
    value += fmt::format("{}{:02x}", i > 0 ? " " : "", view.data[i]);
  line(name, begin, view.size > kShownBytes ? value + " ..." : value);
}

void FieldReader::bytes(std::string_view name, uint64_t size) {
  if (size == 0)
    return;
  uint64_t begin = reader_.position();
  reader_.raw(size);
  line(name, begin, fmt::format("{} bytes", size));
}

void FieldReader::block(std::string_view name) {
  uint64_t size = varint(fmt::format("{} length", name));
  bytes(name, size);
}

void FieldReader::rest(std::string_view name) {
  uint64_t left = reader_.remaining();
  if (left == 0)
    return;
  uint64_t begin = reader_.position();
  out_.push_back({offset_ + begin, left, std::string(name), fmt::format("{} bytes", left)});
}

void FieldReader::explain(std::string_view meaning) {
  if (reader_.ok())
    out_.back().value += fmt::format(" ({})", meaning);
}

}  // namespace anicodec::tools
