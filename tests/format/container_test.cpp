// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/container.h"

#include "format/checksum.h"

#include <memory>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Bytes text(const char* s) {
  return {s, s + std::char_traits<char>::length(s)};
}

Bytes example() {
  ContainerWriter writer;
  writer.add("LIMI", true, kNoMesh, kNoSegment, text("limits"));
  writer.add("MESH", true, 0, kNoSegment, text("a mesh of some length"));
  writer.add("note", false, kNoMesh, kNoSegment, {});
  writer.add("BASI", true, 0, 3, text("basis"));
  return writer.finish();
}

Status status_of(const Bytes& bytes) {
  // An exactly sized copy, so that a sanitizer sees a read past the end.
  std::unique_ptr<uint8_t[]> copy(new uint8_t[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), copy.get());
  ContainerReader reader;
  return reader.open({copy.get(), bytes.size()}).status;
}

// The table of example(): the second entry names a mesh, the fourth a mesh and a segment.
constexpr size_t kSecondEntry = kHeaderBytes + 10, kTableBytes = 10 + 11 + 10 + 12;

/// Changes a byte of header or table and makes the checksum fit again.
Bytes with_byte(size_t at, uint8_t value) {
  Bytes bytes = example();
  bytes[at] = value;
  Bytes covered(bytes.begin(), bytes.begin() + kHeaderBytes + kTableBytes);
  std::fill_n(covered.begin() + 32, 4, uint8_t{0});
  auto checksum = static_cast<uint32_t>(xxh64(covered));
  for (int i = 0; i < 4; ++i)
    bytes[32 + i] = static_cast<uint8_t>(checksum >> (8 * i));
  return bytes;
}

TEST(Container, RoundTrips) {
  Bytes bytes = example();
  ContainerReader reader;
  ASSERT_TRUE(reader.open(bytes).ok());
  ASSERT_EQ(reader.chunks().size(), 4U);
  const Chunk* mesh = reader.find("MESH", 0);
  ASSERT_NE(mesh, nullptr);
  EXPECT_EQ(mesh->offset, kHeaderBytes + kTableBytes + 6);
  ByteView payload;
  ASSERT_TRUE(reader.payload(*mesh, &payload).ok());
  EXPECT_EQ(Bytes(payload.data, payload.data + payload.size), text("a mesh of some length"));
  EXPECT_EQ(reader.find("MESH", 1), nullptr);
  EXPECT_NE(reader.find("BASI", 0, 3), nullptr);
  EXPECT_EQ(chunk_name(mesh->type), "MESH");
}

TEST(Container, RejectsEveryTruncation) {
  Bytes bytes = example();
  for (size_t n = 0; n < bytes.size(); ++n)
    EXPECT_NE(status_of({bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(n)}), Status::kOk)
        << n;
}

TEST(Container, NoticesEveryChangedByte) {
  Bytes bytes = example();
  for (size_t i = 0; i < bytes.size(); ++i) {
    Bytes changed = bytes;
    changed[i] ^= 0x10;
    ContainerReader reader;
    Failure failure = reader.open(changed);
    for (const Chunk& chunk : reader.chunks()) {
      ByteView payload;
      if (failure.ok())
        failure = reader.payload(chunk, &payload);
    }
    EXPECT_FALSE(failure.ok()) << i;
  }
}

TEST(Container, NamesWhatIsWrong) {
  EXPECT_EQ(status_of(text("PNG file?")), Status::kMagic);
  EXPECT_EQ(status_of({}), Status::kMagic);
  EXPECT_EQ(status_of({0x89, 'A', 'N'}), Status::kTruncated);
  EXPECT_EQ(status_of(with_byte(8, 9)), Status::kVersion);
  EXPECT_EQ(status_of(with_byte(16, 1)), Status::kFeature);
  EXPECT_EQ(status_of(with_byte(12, 3)), Status::kHeader);    // an entry more than chunks
  EXPECT_EQ(status_of(with_byte(12, 5)), Status::kHeader);    // too few bytes for as many
  EXPECT_EQ(status_of(with_byte(13, 255)), Status::kHeader);  // by far
  EXPECT_EQ(status_of(with_byte(30, 1)), Status::kTruncated);
  EXPECT_EQ(status_of(with_byte(kSecondEntry + 8, 19)), Status::kHeader);         // reserved flag
  EXPECT_EQ(status_of(with_byte(kSecondEntry + 9, 0x80)), Status::kChunkBounds);  // mesh 21 << 7
  EXPECT_EQ(status_of(with_byte(kHeaderBytes + kTableBytes - 1, 0x85)), Status::kHeader);  // size
  EXPECT_EQ(status_of(with_byte(kSecondEntry + 10, 99)), Status::kChunkBounds);            // size
  EXPECT_EQ(status_of(with_byte(kSecondEntry + 10, 20)), Status::kFileSize);
  Bytes damaged = example();
  damaged[40] ^= 1;
  EXPECT_EQ(status_of(damaged), Status::kHeaderChecksum);
  Bytes longer = example();
  longer.push_back(0);
  EXPECT_EQ(status_of(longer), Status::kTrailingBytes);
}

}  // namespace
}  // namespace anicodec
