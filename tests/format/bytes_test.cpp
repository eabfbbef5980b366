// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/bytes.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(ByteReader, RefusesWhatIsMissingOrNotShortest) {
  const uint8_t long_zero[] = {0x80, 0x00};
  ByteReader reader({long_zero, 2});
  reader.varint();
  EXPECT_FALSE(reader.ok());
  ByteWriter writer;
  writer.varint(UINT64_MAX);
  writer.varint(300);
  writer.f64(-2.5);
  ByteReader back(writer.bytes());
  EXPECT_EQ(back.varint(), UINT64_MAX);
  EXPECT_EQ(back.varint(300), 300U);
  EXPECT_EQ(back.f64(), -2.5);
  EXPECT_TRUE(back.finished());
  back.u8();
  EXPECT_FALSE(back.ok());
}

}  // namespace
}  // namespace anicodec
