// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_hash.h"

#include "tools/io/base/byte_order.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace anicodec::tools {
namespace {

uint64_t word(std::string_view bytes, size_t index) {
  return load<uint64_t>(bytes.data() + 8 * index, std::endian::little);
}

/// Fewer than 8 bytes, or the first 8, as a number.
uint64_t part_of_word(std::string_view bytes) {
  std::array<char, 8> padded = {};
  std::copy_n(bytes.data(), std::min<size_t>(bytes.size(), 8), padded.begin());
  return load<uint64_t>(padded.data(), std::endian::little);
}

uint64_t murmur_first(uint64_t k) {
  return std::rotl(k * 0x87c37b91114253d5U, 31) * 0x4cf5ad432745937fU;
}

uint64_t murmur_second(uint64_t k) {
  return std::rotl(k * 0x4cf5ad432745937fU, 33) * 0x87c37b91114253d5U;
}

uint64_t murmur_end(uint64_t h) {
  h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdU;
  h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53U;
  return h ^ (h >> 33);
}

constexpr uint64_t kSpookyConstant = 0xdeadbeefdeadbeefU;
constexpr size_t kSpookyWords = 12, kSpookyBlock = 8 * kSpookyWords;

using ShortState = std::array<uint64_t, 4>;
using LongState = std::array<uint64_t, kSpookyWords>;

void mix(ShortState& h) {
  constexpr int kTurns[] = {50, 52, 30, 41, 54, 48, 38, 37, 62, 34, 5, 36};
  for (size_t i = 0; i < std::size(kTurns); ++i) {
    uint64_t& a = h[(i + 2) % 4];
    a = std::rotl(a, kTurns[i]) + h[(i + 3) % 4];
    h[i % 4] ^= a;
  }
}

void end(ShortState& h) {
  constexpr int kTurns[] = {15, 52, 26, 51, 28, 9, 47, 54, 32, 25, 63};
  for (size_t i = 0; i < std::size(kTurns); ++i) {
    uint64_t &a = h[(i + 3) % 4], &b = h[(i + 2) % 4];
    a ^= b;
    b = std::rotl(b, kTurns[i]);
    a += b;
  }
}

/// Hash of less than two blocks.
AbcHash short_spooky(std::string_view bytes) {
  ShortState h{0, 0, kSpookyConstant, kSpookyConstant};
  const uint64_t length = bytes.size();
  for (; bytes.size() >= 32; bytes.remove_prefix(32)) {
    h[2] += word(bytes, 0);
    h[3] += word(bytes, 1);
    mix(h);
    h[0] += word(bytes, 2);
    h[1] += word(bytes, 3);
  }
  if (bytes.size() >= 16) {
    h[2] += word(bytes, 0);
    h[3] += word(bytes, 1);
    mix(h);
    bytes.remove_prefix(16);
  }
  h[3] += length << 56;
  if (bytes.empty()) {
    h[2] += kSpookyConstant;
    h[3] += kSpookyConstant;
  } else {
    h[2] += part_of_word(bytes);
    h[3] += bytes.size() > 8 ? part_of_word(bytes.substr(8)) : 0;
  }
  end(h);
  return {h[0], h[1]};
}

void mix(std::string_view block, LongState& h) {
  constexpr int kTurns[] = {11, 32, 43, 31, 17, 28, 39, 57, 55, 54, 22, 46};
  for (size_t i = 0; i < kSpookyWords; ++i) {
    uint64_t& before = h[(i + 11) % 12];
    h[i] += word(block, i);
    h[(i + 2) % 12] ^= h[(i + 10) % 12];
    before ^= h[i];
    h[i] = std::rotl(h[i], kTurns[i]);
    before += h[(i + 1) % 12];
  }
}

void end(std::string_view block, LongState& h) {
  constexpr int kTurns[] = {44, 15, 34, 21, 38, 33, 10, 13, 38, 53, 42, 54};
  for (size_t i = 0; i < kSpookyWords; ++i)
    h[i] += word(block, i);
  for (int round = 0; round < 3; ++round) {
    for (size_t i = 0; i < kSpookyWords; ++i) {
      uint64_t &a = h[(i + 11) % 12], &b = h[(i + 1) % 12];
      a += b;
      h[(i + 2) % 12] ^= a;
      b = std::rotl(b, kTurns[i]);
    }
  }
}

}  // namespace

AbcHash murmur3(std::string_view bytes) {
  const uint64_t length = bytes.size();
  uint64_t h1 = 0, h2 = 0;
  for (; bytes.size() >= 16; bytes.remove_prefix(16)) {
    h1 = (std::rotl(h1 ^ murmur_first(word(bytes, 0)), 27) + h2) * 5 + 0x52dce729;
    h2 = (std::rotl(h2 ^ murmur_second(word(bytes, 1)), 31) + h1) * 5 + 0x38495ab5;
  }
  if (bytes.size() > 8)
    h2 ^= murmur_second(part_of_word(bytes.substr(8)));
  if (!bytes.empty())
    h1 ^= murmur_first(part_of_word(bytes));
  h1 ^= length;
  h2 ^= length;
  h1 += h2;
  h2 += h1;
  h1 = murmur_end(h1);
  h2 = murmur_end(h2);
  h1 += h2;
  return {h1, h1 + h2};
}

AbcHash spooky(std::string_view bytes) {
  if (bytes.size() < 2 * kSpookyBlock)
    return short_spooky(bytes);
  LongState h;
  for (size_t i = 0; i < kSpookyWords; ++i)
    h[i] = i % 3 == 2 ? kSpookyConstant : 0;
  for (; bytes.size() >= kSpookyBlock; bytes.remove_prefix(kSpookyBlock))
    mix(bytes, h);
  std::array<char, kSpookyBlock> last = {};
  std::copy(bytes.begin(), bytes.end(), last.begin());
  last.back() = static_cast<char>(bytes.size());
  end({last.data(), last.size()}, h);
  return {h[0], h[1]};
}

AbcHash gather(const AbcHash& so_far, const AbcHash& next) {
  ShortState h{so_far[0], so_far[1], next[0], next[1]};
  end(h);
  return {h[0], h[1]};
}

std::string bytes_of(const AbcHash& hash) {
  std::string out;
  append(hash[0], std::endian::little, out);
  append(hash[1], std::endian::little, out);
  return out;
}

}  // namespace anicodec::tools
