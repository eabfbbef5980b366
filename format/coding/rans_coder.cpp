// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/rans_coder.h"

#include <algorithm>

namespace anicodec {
namespace {

constexpr size_t kHeader = kRansStates * sizeof(uint32_t);

}  // namespace

Bytes RansEncoder::finish() {
  std::array<uint32_t, kRansStates> states;
  states.fill(kRansStart);
  Vector<uint16_t> words;  // last first
  for (size_t i = decisions_.size(); i-- > 0;) {
    uint32_t& state = states[i % kRansStates];
    const uint32_t start = decisions_[i] >> 16, size = decisions_[i] & 0xFFFF;
    if (state >= uint64_t{size} << (32 - kSymbolBits)) {
      words.push_back(static_cast<uint16_t>(state));
      state >>= 16;
    }
    state = state / size * kSymbolScale + state % size + start;
  }
  ByteWriter writer;
  for (const uint32_t state : states)
    writer.u32(state);
  for (size_t i = words.size(); i-- > 0;)
    writer.u16(words[i]);
  return std::move(writer.bytes());
}

RansDecoder::RansDecoder(ByteView bytes) {
  if (bytes.size < kHeader || bytes.size % 2 != 0) {
    states_.fill(kRansStart);
    fail();
    return;
  }
  ByteReader reader(bytes);
  for (uint32_t& state : states_)
    state = reader.u32();
  begun_ = std::all_of(states_.begin(), states_.end(), [](uint32_t s) { return s >= kRansStart; });
  bytes_ = bytes.data + kHeader;
  words_ = (bytes.size - kHeader) / 2;
  if (!begun_)
    fail();
}

bool RansDecoder::finish() const {
  return begun_ && position_ == words_ &&
         std::all_of(states_.begin(), states_.end(), [](uint32_t s) { return s == kRansStart; });
}

}  // namespace anicodec
