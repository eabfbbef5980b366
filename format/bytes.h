// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Little-endian byte writer and reader, independent of the machine's byte order
// (spec/03-conventions.md).
#ifndef ANICODEC_FORMAT_BYTES_H_
#define ANICODEC_FORMAT_BYTES_H_

#include "format/memory.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace anicodec {

using Bytes = Vector<uint8_t>;

/// A range of bytes owned by someone else.
struct ByteView {
  const uint8_t* data = nullptr;
  size_t size = 0;

  ByteView() = default;

  ByteView(const uint8_t* bytes, size_t count) : data(bytes), size(count) {}

  ByteView(const Bytes& bytes)
      : data(bytes.data()), size(bytes.size()) {}  // NOLINT: implicit by design
};

class ByteWriter {
 public:
  void u8(uint8_t x) { bytes_.push_back(x); }

  void u16(uint16_t x) { little(x, 2); }

  void u32(uint32_t x) { little(x, 4); }

  void u64(uint64_t x) { little(x, 8); }

  void f32(float x) {
    uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    u32(bits);
  }

  void f64(double x) {
    uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    u64(bits);
  }

  /// Seven bits per byte, least significant first, the top bit set on all but the last byte.
  void varint(uint64_t x) {
    for (; x >= 0x80; x >>= 7)
      u8(static_cast<uint8_t>(x | 0x80));
    u8(static_cast<uint8_t>(x));
  }

  void raw(ByteView view) { bytes_.insert(bytes_.end(), view.data, view.data + view.size); }

  /// A varint length, then the bytes.
  void block(ByteView view) {
    varint(view.size);
    raw(view);
  }

  void text(const String& s) { block({reinterpret_cast<const uint8_t*>(s.data()), s.size()}); }

  size_t size() const { return bytes_.size(); }

  Bytes& bytes() { return bytes_; }

 private:
  void little(uint64_t x, int count) {
    for (int i = 0; i < count; ++i)
      bytes_.push_back(static_cast<uint8_t>(x >> (8 * i)));
  }

  Bytes bytes_;
};

/// Reads what ByteWriter writes. Past the end every read gives 0 and ok() turns false for good, so
/// a record is read whole and checked once.
class ByteReader {
 public:
  explicit ByteReader(ByteView view) : view_(view) {}

  bool ok() const { return ok_; }

  /// True when all bytes were read and none was missing.
  bool finished() const { return ok_ && at_ == view_.size; }

  size_t position() const { return at_; }

  size_t remaining() const { return view_.size - at_; }

  void fail() { ok_ = false; }

  uint8_t u8() { return static_cast<uint8_t>(little(1)); }

  uint16_t u16() { return static_cast<uint16_t>(little(2)); }

  uint32_t u32() { return static_cast<uint32_t>(little(4)); }

  uint64_t u64() { return little(8); }

  float f32() {
    uint32_t bits = u32();
    float x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  }

  double f64() {
    uint64_t bits = u64();
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  }

  /// A varint of at most `limit`; a larger one, or one not in its shortest form, fails.
  uint64_t varint(uint64_t limit = UINT64_MAX) {
    uint64_t x = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      uint8_t b = u8();
      uint64_t bits = b & 0x7FU;
      if (shift == 63 && bits > 1)
        break;
      x |= bits << shift;
      if (!(b & 0x80)) {
        if ((b == 0 && shift > 0) || x > limit)
          break;
        return x;
      }
    }
    ok_ = false;
    return 0;
  }

  uint32_t varint32(uint32_t limit = UINT32_MAX) { return static_cast<uint32_t>(varint(limit)); }

  ByteView raw(uint64_t count) {
    if (!ok_ || count > remaining()) {
      ok_ = false;
      return {};
    }
    ByteView part(view_.data + at_, static_cast<size_t>(count));
    at_ += part.size;
    return part;
  }

  ByteView block() { return raw(varint()); }

  String text() {
    ByteView part = block();
    return part.size ? String(reinterpret_cast<const char*>(part.data), part.size) : String();
  }

 private:
  uint64_t little(size_t count) {
    if (!ok_ || count > remaining()) {
      ok_ = false;
      return 0;
    }
    uint64_t x = 0;
    for (size_t i = 0; i < count; ++i)
      x |= uint64_t{view_.data[at_ + i]} << (8 * i);
    at_ += count;
    return x;
  }

  ByteView view_;
  size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_BYTES_H_
