// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/binary_coder.h"

#include <utility>

namespace anicodec {
namespace {

/// The encoder leaves out zero bytes at the end, of the last kTail bytes only.
constexpr size_t kTail = 8;

/// From low to the number in [low, low + range) with the most zero bits at its end.
uint64_t distance_to_end(uint64_t low, uint64_t range) {
  uint64_t mask = ~uint64_t{0};
  while (((0 - low) & mask) >= range)  // the distance to the next multiple of mask + 1
    mask >>= 1;
  return (0 - low) & mask;
}

/// Zero bytes at the low end of x, at most 8.
size_t zero_bytes(uint64_t x) {
  size_t n = 0;
  for (; n < 8 && (x & 0xff) == 0; ++n)
    x >>= 8;
  return n;
}

}  // namespace

void BinaryEncoder::carry() {
  // low_ is below 2^64 in total, so a byte below 255 exists before the first one is reached.
  for (size_t i = bytes_.size(); i-- > 0;)
    if (++bytes_[i] != 0)
      return;
}

void BinaryEncoder::shift() {
  for (int s = 56; s >= 32; s -= 8)
    bytes_.push_back(static_cast<uint8_t>(low_ >> s));
  low_ <<= 32;
  range_ <<= 32;
}

Vector<uint8_t> BinaryEncoder::finish() {
  add(distance_to_end(low_, range_));
  const size_t kept = kTail - zero_bytes(low_);
  for (size_t i = 0; i < kept; ++i)
    bytes_.push_back(static_cast<uint8_t>(low_ >> (56 - 8 * i)));
  return std::move(bytes_);
}

BinaryDecoder::BinaryDecoder(const uint8_t* bytes, size_t size) : bytes_(bytes), size_(size) {
  range_ = 0;
  shift();
  shift();
  range_ = ~uint64_t{0};
  if (code_ == range_)  // no encoder gets there; every later step keeps code_ < range_
    failed_ = true;
}

void BinaryDecoder::shift() {
  range_ <<= 32;
  for (int i = 0; i < 4; ++i, ++position_)
    code_ = code_ << 8 | (position_ < size_ ? bytes_[position_] : 0u);
  if (position_ > size_ && position_ - size_ > kTail)
    failed_ = true;
}

bool BinaryDecoder::finish() const {
  if (failed_)
    return false;
  uint64_t end = 0;  // the last kTail bytes the encoder had, those left out included
  for (size_t i = position_ - kTail; i < position_; ++i)
    end = end << 8 | (i < size_ ? bytes_[i] : 0u);
  return size_ + zero_bytes(end) == position_ && distance_to_end(end - code_, range_) == code_;
}

}  // namespace anicodec
