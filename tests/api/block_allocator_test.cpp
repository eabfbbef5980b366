// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include <anicodec/anicodec.h>

#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(BlockAllocator, GivesEachPieceToOneAndAllBackInTheEnd) {
  std::vector<unsigned char> block(100000);
  anic_allocator a;
  ASSERT_EQ(anic_init_block_allocator(block.data(), block.size(), &a), ANIC_OK);
  std::mt19937 random(1);
  std::vector<std::pair<unsigned char*, size_t>> held;
  for (int i = 0; i < 20000; ++i) {
    if (random() % 2 && !held.empty()) {
      const size_t k = random() % held.size();
      for (size_t b = 0; b < held[k].second; ++b)
        ASSERT_EQ(held[k].first[b], static_cast<unsigned char>(held[k].second));
      a.release(a.user, held[k].first, held[k].second);
      held[k] = held.back();
      held.pop_back();
      continue;
    }
    const size_t size = 1 + random() % (random() % 8 ? 200 : 9000);
    auto* memory = static_cast<unsigned char*>(a.allocate(a.user, size, 16));
    if (!memory)
      continue;
    ASSERT_EQ(reinterpret_cast<uintptr_t>(memory) % 16, 0U);
    ASSERT_GE(memory, block.data());
    ASSERT_LE(memory + size, block.data() + block.size());
    std::memset(memory, static_cast<int>(size), size);
    held.emplace_back(memory, size);
  }
  for (const auto& [memory, size] : held)
    a.release(a.user, memory, size);
  EXPECT_NE(a.allocate(a.user, block.size() - 64, 16), nullptr);
  EXPECT_EQ(a.allocate(a.user, 64, 16), nullptr);
}

}  // namespace
}  // namespace anicodec
