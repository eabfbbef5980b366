// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/continuation.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Bytes of_text(const char* s) {
  return {s, s + std::char_traits<char>::length(s)};
}

Bytes two_poses() {
  ContainerWriter writer;
  writer.add("LIMI", true, kNoMesh, kNoSegment, of_text("limits"));
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
  EXPECT_EQ(less.size(), whole.size() - 21 - 8 - 2 * 11);
  EXPECT_EQ(continuation.open(less).status, Status::kFeature);
  EXPECT_EQ(continuation.open_prefix(less).status, Status::kFeature);
  ASSERT_TRUE(continuation.open_of_stream(less).ok());
  EXPECT_TRUE(continuation.is_continuation());
  EXPECT_FALSE(file.is_continuation());
  EXPECT_EQ(continuation.find("MESH", 0), nullptr);
  EXPECT_NE(continuation.find("POSE", 0, 3), nullptr);
  EXPECT_EQ(with_meshes(file, continuation), whole);

  const Bytes meshes = only_meshes(file);
  ContainerReader kept;
  ASSERT_TRUE(kept.open(meshes).ok());
  EXPECT_EQ(kept.chunks().size(), 2U);
  EXPECT_EQ(with_meshes(kept, continuation), whole);
}

TEST(Continuation, OfAPrefixIsAPrefix) {
  const Bytes whole = two_poses();
  ContainerReader file;
  ASSERT_TRUE(file.open(whole).ok());
  const Bytes less = without_meshes(file);
  size_t longest = 0;
  for (size_t n = 1; n <= less.size(); ++n) {
    ContainerReader continuation;
    const Failure failure = continuation.open_of_stream({less.data(), n});
    if (failure.status == Status::kTruncated)
      continue;
    ASSERT_TRUE(failure.ok());
    EXPECT_EQ(continuation.is_complete(), n == less.size());
    const Bytes told = with_meshes(file, continuation);
    ASSERT_LE(told.size(), whole.size());
    EXPECT_TRUE(std::equal(told.begin(), told.end(), whole.begin()));
    EXPECT_GE(told.size(), std::max(n, longest));
    longest = told.size();
  }
  EXPECT_EQ(longest, whole.size());
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
