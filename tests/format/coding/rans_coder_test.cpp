// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/rans_coder.h"

#include "format/coding/symbol_row.h"
#include "tests/random.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Symbols, bits and raw numbers in turns, through any coder; `values` are what is coded.
template <class Coder>
void code_all(Coder& coder, std::vector<uint32_t>& values) {
  SymbolRow rows[3];
  AdaptiveBit bits[2];
  for (size_t i = 0; i < values.size(); ++i) {
    uint32_t& x = values[i];
    if (i % 5 < 3)
      x = code_row_symbol(coder, rows[i % 3], rows[(i + 1) % 3], rows[2], x % 8);
    else if (i % 5 == 3)
      x = coder.bit(bits[i % 2], x % 2 != 0) ? 1 : 0;
    else
      x = coder.raw(static_cast<int>(i % 13), x & ((1U << i % 13) - 1));
  }
}

std::vector<uint32_t> drawn(size_t count) {
  Random random(7);
  std::vector<uint32_t> values(count);
  for (uint32_t& x : values)
    x = random() % 64 ? random() % 2 : random() % 4096;
  return values;
}

TEST(RansCoder, ReturnsWhatWasCoded) {
  for (const size_t count : {0U, 1U, 2U, 5U, 1000U, 30000U}) {
    std::vector<uint32_t> values = drawn(count);
    RansEncoder encoder;
    code_all(encoder, values);
    const Bytes bytes = encoder.finish();
    std::vector<uint32_t> decoded(count);
    RansDecoder decoder(bytes);
    code_all(decoder, decoded);
    EXPECT_EQ(decoded, values);
    EXPECT_TRUE(decoder.ok());
    EXPECT_TRUE(decoder.finish());
  }
}

TEST(RansCoder, TakesWhatTheProbabilitiesSay) {
  AdaptiveBit model;
  RansEncoder encoder;
  for (int i = 0; i < 100000; ++i)
    encoder.bit(model, i % 100 == 0);
  const double bits = static_cast<double>(encoder.finish().size()) * 8;
  EXPECT_GT(bits, 100000 * 0.0808);  // entropy of 1 %
  EXPECT_LT(bits, 100000 * 0.1);
}

TEST(RansCoder, RefusesOtherBytes) {
  std::vector<uint32_t> values = drawn(2000);
  RansEncoder encoder;
  code_all(encoder, values);
  const Bytes bytes = encoder.finish();
  const auto accepts = [&](const Bytes& changed) {
    RansDecoder decoder(changed);
    std::vector<uint32_t> decoded(values.size());
    code_all(decoder, decoded);
    return decoder.finish();
  };
  EXPECT_TRUE(accepts(bytes));
  for (size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_FALSE(accepts(Bytes(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(size))));
  for (const size_t more : {1U, 2U}) {
    Bytes longer = bytes;
    longer.resize(bytes.size() + more, 0);
    EXPECT_FALSE(accepts(longer));
  }
  // Whatever other bytes are accepted are those of other values, which an encoder writes.
  for (size_t i = 0; i < bytes.size(); ++i) {
    Bytes changed = bytes;
    changed[i] ^= 16;
    RansDecoder decoder(changed);
    std::vector<uint32_t> decoded(values.size());
    code_all(decoder, decoded);
    if (!decoder.finish())
      continue;
    RansEncoder again;
    code_all(again, decoded);
    EXPECT_EQ(again.finish(), changed);
  }
}

TEST(RansCoder, RunsOut) {
  const Bytes none(16, 255);
  RansDecoder decoder(none);
  std::vector<uint32_t> decoded(4000);
  EXPECT_TRUE(decoder.ok());
  code_all(decoder, decoded);
  EXPECT_FALSE(decoder.ok());
  EXPECT_FALSE(RansDecoder(Bytes(16, 0)).ok());  // states below their range
  EXPECT_FALSE(RansDecoder(Bytes()).ok());
}

}  // namespace
}  // namespace anicodec
