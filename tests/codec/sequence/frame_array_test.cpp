// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/frame_array.h"

#include "codec/encode.h"
#include "codec/sequence/error.h"
#include "codec/sequence/machine_memory.h"
#include "corpus/clips.h"

#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr size_t kLarge = size_t{1} << 19;  // floats: two megabytes

/// A folder for files, and the settings of before afterwards.
class FrameArrayTest : public testing::Test {
 protected:
  ~FrameArrayTest() override {
    set_memory_for_frames(half_of_machine());
    if (had_folder_)
      ::setenv("TMPDIR", folder_.c_str(), 1);
    else
      ::unsetenv("TMPDIR");
  }

 private:
  const bool had_folder_ = std::getenv("TMPDIR") != nullptr;
  const std::string folder_ = had_folder_ ? std::getenv("TMPDIR") : "";
};

TEST_F(FrameArrayTest, LiesInFilesBeyondTheMemory) {
  set_memory_for_frames(3 * 5 * kLarge);
  FrameArray a(kLarge);
  EXPECT_EQ(frame_bytes_on_disk(), 0U);
  {
    FrameArray b(kLarge);
    EXPECT_EQ(frame_bytes_on_disk(), 4 * kLarge);
    std::iota(b.begin(), b.end(), 0.0F);
    for (size_t i = 0; i < 3; ++i)
      b.push_back(static_cast<float>(kLarge + i));
    const FrameArray copy = b;
    a = std::move(b);
    EXPECT_EQ(a, copy);
    EXPECT_EQ(a[kLarge + 2], static_cast<float>(kLarge + 2));
    EXPECT_EQ(a[kLarge / 2], static_cast<float>(kLarge / 2));
  }
  a = {};
  a.shrink_to_fit();
  EXPECT_EQ(frame_bytes_on_disk(), 0U);
  const FrameArray again(kLarge, 1.0F);
  EXPECT_EQ(frame_bytes_on_disk(), 0U);
}

TEST_F(FrameArrayTest, LeavesNoFile) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "frame_array_test";
  std::filesystem::create_directory(folder);
  ::setenv("TMPDIR", folder.c_str(), 1);
  set_memory_for_frames(0);
  const FrameArray a(kLarge);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove(folder);
}

TEST_F(FrameArrayTest, NamesTheFolderThatHasNoRoom) {
  ::setenv("TMPDIR", "/no/such/folder", 1);
  set_memory_for_frames(0);
  EXPECT_NO_THROW(FrameArray(1000));
  try {
    const FrameArray a(kLarge);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInternal);
    EXPECT_EQ(std::string(error.what()).find("/no/such/folder: 2097216 bytes of frames"), 0U)
        << error.what();
  }
}

// As large as no array is.
TEST_F(FrameArrayTest, RefusesMoreThanThereIs) {
  set_memory_for_frames(UINT64_MAX);
  EXPECT_THROW(FrameAllocator<float>().allocate(SIZE_MAX / 16), std::bad_alloc);
  set_memory_for_frames(0);
  EXPECT_THROW(FrameAllocator<float>().allocate(SIZE_MAX / 16), Error);
  EXPECT_EQ(frame_bytes_on_disk(), 0U);
}

TEST_F(FrameArrayTest, EncodesTheSameBytesFromFiles) {
  EncodeOptions options;
  options.effort = Effort::kFast;
  options.target = {ErrorMetric::kKg, 0.2, false};
  const MeshSequence clip = corpus::make_scaled("limb", 3000, 40);
  const Bytes in_memory = encode(clip, options).file;
  set_memory_for_frames(0);
  const MeshSequence filed = clip;
  EXPECT_EQ(frame_bytes_on_disk(), size_t{12} * clip.vertex_count * clip.frame_count);
  EXPECT_EQ(encode(filed, options).file, in_memory);
}

}  // namespace
}  // namespace anicodec
