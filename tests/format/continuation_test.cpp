// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/continuation.h"

#include "format/records.h"
#include "tests/format/three_frames.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Bytes of_text(const char* s) {
  return {s, s + std::char_traits<char>::length(s)};
}

Bytes two_poses() {
  ContainerWriter writer;
  writer.add("LIMI", true, kNoMesh, kNoSegment, three_frames().write());
  writer.add("note", false, kNoMesh, kNoSegment, {});
  writer.add("MESH", true, 0, kNoSegment, of_text("a mesh of some length"));
  writer.add("POSE", true, 0, kNoSegment, of_text("its pose"));
  writer.add("POSE", true, 0, 3, of_text("a pose of a segment"));
  writer.add("BASI", true, 0, 3, of_text("basis"));
  return writer.finish();
}

TEST(Continuation, LeavesOutMeshesAndGetsThemBack) {
  const Bytes whole = two_poses();
  ContainerReader file, continuation;
  ASSERT_TRUE(file.open(whole).ok());
  const Bytes less = without_meshes(file);
  EXPECT_EQ(less.size(), whole.size() - 21 - 8 - 2 * 11 + 10);  // with the hash of the meshes
  EXPECT_EQ(continuation.open(less).status, Status::kFeature);
  EXPECT_EQ(continuation.open_prefix(less).status, Status::kFeature);
  ASSERT_TRUE(continuation.open_of_stream(less).ok());
  EXPECT_TRUE(continuation.is_continuation());
  EXPECT_FALSE(file.is_continuation());
  EXPECT_EQ(continuation.find("MESH", 0), nullptr);
  EXPECT_NE(continuation.find("POSE", 0, 3), nullptr);
  const Bytes back = with_meshes(file, continuation);
  ContainerReader restored;
  ASSERT_TRUE(restored.open(back).ok());
  EXPECT_EQ(restored.chunks().size(), file.chunks().size());
  EXPECT_EQ(mesh_hash(restored), mesh_hash(file));
}

TEST(Continuation, SaysWhichMeshesItFollows) {
  const Bytes whole = two_poses();
  ContainerReader file, continuation;
  ASSERT_TRUE(file.open(whole).ok());
  const Bytes less = without_meshes(file);
  ASSERT_TRUE(continuation.open_of_stream(less).ok());
  Limits limits;
  ASSERT_EQ(Limits::read(continuation.unchecked(*continuation.find("LIMI")), &limits), Status::kOk);
  EXPECT_EQ(limits.continued_meshes, mesh_hash(file));
  // Every chunk of a mesh counts, chunks of segments do not.
  ContainerWriter other;
  other.add("LIMI", true, kNoMesh, kNoSegment, three_frames().write());
  other.add("MESH", true, 0, kNoSegment, of_text("a mesh of some length"));
  other.add("POSE", true, 0, kNoSegment, of_text("its pose"));
  Bytes same = other.finish();
  ContainerReader reader;
  ASSERT_TRUE(reader.open(same).ok());
  EXPECT_EQ(mesh_hash(reader), mesh_hash(file));
  other.add("ATTR", false, 0, kNoSegment, of_text("more"));
  same = other.finish();
  ASSERT_TRUE(reader.open(same).ok());
  EXPECT_NE(mesh_hash(reader), mesh_hash(file));
}

TEST(Continuation, IdentifiesSegments) {
  const Bytes record = of_text("record"), layer = of_text("layer"), other = of_text("other");
  const uint64_t one = segment_identity(record, {layer, other});
  EXPECT_EQ(segment_identity(record, {layer, other}), one);
  EXPECT_NE(segment_identity(record, {other, layer}), one);
  EXPECT_NE(segment_identity(record, {layer}), one);
  EXPECT_NE(segment_identity(other, {layer, other}), one);
}

TEST(Continuation, ReadsLikeTheFileThatItIsWithItsMeshes) {
  const Bytes whole = two_poses();
  ContainerReader file;
  ASSERT_TRUE(file.open(whole).ok());
  const Bytes less = without_meshes(file);
  Bytes both = whole;
  both.insert(both.end(), less.begin(), less.end());
  for (size_t n = whole.size() + 8; n <= both.size(); ++n) {
    const ByteView view(both.data(), n);
    ContainerReader continuation;
    if (!continuation.open_of_stream({view.data + whole.size(), n - whole.size()}).ok())
      continue;
    continuation.add_meshes(file, view);
    EXPECT_EQ(continuation.is_complete(), n == both.size());
    ASSERT_EQ(continuation.chunks().size(), file.chunks().size());
    for (size_t i = 0; i < file.chunks().size(); ++i) {
      const Chunk &a = file.chunks()[i], &b = continuation.chunks()[i];
      EXPECT_EQ(chunk_key(a), chunk_key(b));
      ByteView expected, seen;
      ASSERT_TRUE(file.payload(a, &expected).ok());
      if (a.type == chunk_type("LIMI"))
        continue;
      if (continuation.has(b)) {
        ASSERT_TRUE(continuation.payload(b, &seen).ok());
        EXPECT_TRUE(std::equal(seen.data, seen.data + seen.size, expected.data,
                               expected.data + expected.size));
      } else {
        EXPECT_FALSE(n == both.size() || is_of_mesh(b));
      }
    }
    EXPECT_NE(continuation.find("POSE", 0), nullptr);
    EXPECT_EQ(continuation.find("MESH", 1), nullptr);
  }
}

TEST(Continuation, EndsWhereTheNextFileBegins) {
  Bytes two = two_poses();
  const size_t first = two.size();
  const Bytes next = two_poses();
  two.insert(two.end(), next.begin(), next.end());
  ContainerReader file;
  EXPECT_EQ(file.open(two).status, Status::kTrailingBytes);
  EXPECT_EQ(file.open_prefix(two).status, Status::kTrailingBytes);
  ASSERT_TRUE(file.open_of_stream(two).ok());
  EXPECT_EQ(file.file_size(), first);
  EXPECT_TRUE(file.is_complete());
}

}  // namespace
}  // namespace anicodec
