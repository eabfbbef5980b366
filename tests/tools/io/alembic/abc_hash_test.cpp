// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_hash.h"

#include <string>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

std::string hex(const AbcHash& hash) {
  std::string out;
  for (unsigned char c : bytes_of(hash)) {
    constexpr char kDigits[] = "0123456789abcdef";
    out += kDigits[c >> 4];
    out += kDigits[c & 15];
  }
  return out;
}

/// 0, 1, 2 ... 255, 0 ...
std::string counting(size_t size) {
  std::string out(size, '\0');
  for (size_t i = 0; i < size; ++i)
    out[i] = static_cast<char>(i);
  return out;
}

TEST(AbcHash, IsMurmur3) {
  EXPECT_EQ(murmur3(""), (AbcHash{0, 0}));
  EXPECT_EQ(murmur3("The quick brown fox jumps over the lazy dog"),
            (AbcHash{0xe34bbc7bbc071b6c, 0x7a433ca9c49a9347}));
}

TEST(AbcHash, IsSpooky) {
  EXPECT_EQ(hex(spooky("")), "1909f56bfc062723c751e8b465ee728b");
}

TEST(AbcHash, DiffersWithEveryByte) {
  for (size_t size : {1, 7, 8, 9, 15, 16, 17, 31, 32, 48, 100, 191, 192, 200, 288, 1000}) {
    const std::string bytes = counting(size);
    for (size_t i = 0; i < size; ++i) {
      std::string other = bytes;
      other[i] ^= 1;
      EXPECT_NE(spooky(bytes), spooky(other)) << size << " " << i;
      EXPECT_NE(murmur3(bytes), murmur3(other)) << size << " " << i;
    }
    EXPECT_NE(spooky(bytes), spooky(bytes + '\0'));
  }
}

}  // namespace
}  // namespace anicodec::tools
