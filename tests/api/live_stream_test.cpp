// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files of a live stream, one after the other.
#include "codec/file/live_stream.h"

#include "codec/encode_live.h"
#include "corpus/clips.h"
#include "tests/api/opened.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// A clip in so many files of a third of a second.
std::vector<Bytes> streamed(uint32_t count, double key_every) {
  const MeshSequence clip = corpus::make_scaled("limb", 300, 8 * count);
  MeshSequence mesh = clip;
  mesh.positions = {};
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.2, true};
  options.effort = Effort::kFast;
  LiveEncoder encoder(mesh, options, key_every);
  std::vector<Bytes> all;
  const auto size = static_cast<ptrdiff_t>(clip.positions.size() / count);
  for (auto at = clip.positions.begin(); at < clip.positions.end(); at += size)
    all.push_back(encoder.encode({at, at + size}).file);
  return all;
}

/// A third of a clip in each file, which all begin anew.
const std::vector<Bytes>& files() {
  static const std::vector<Bytes> made = streamed(3, 0);
  return made;
}

/// Five files of which the first and the fourth begin anew.
const std::vector<Bytes>& learning_files() {
  static const std::vector<Bytes> made = streamed(5, 1);
  return made;
}

/// Pushes a file of a stream, and turns to it first where there is one before.
void push_next(const Stream& stream, const Bytes& file) {
  if (info_of(stream).complete) {
    ASSERT_EQ(anic_advance_stream(stream.get()), ANIC_OK);
  }
  ASSERT_EQ(anic_push_bytes(stream.get(), file.data(), file.size()), ANIC_OK);
}

/// The status of opening the file at hand, and the positions of its first frame.
anic_status opened(const Stream& stream, std::vector<float>* positions = nullptr) {
  anic_asset* made = nullptr;
  const anic_status status = anic_open_asset_from_stream(stream.get(), &made, nullptr);
  const Asset asset(made);
  if (status == ANIC_OK && positions)
    *positions = frame(asset, 0);
  return status == ANIC_OK ? anic_verify_asset(asset.get()) : status;
}

Bytes stream_bytes() {
  Bytes all;
  for (const Bytes& file : files())
    all.insert(all.end(), file.begin(), file.end());
  return all;
}

/// Expects the file at hand to be what it is with its meshes.
void expect_file(const Stream& stream, size_t number, const Bytes& whole) {
  EXPECT_EQ(info_of(stream).file_number, number);
  EXPECT_EQ(info_of(stream).file_bytes, files()[number].size());
  const Asset asset = open(stream), expected = open(whole);
  EXPECT_EQ(anic_verify_asset(asset.get()), ANIC_OK);
  ASSERT_EQ(info_of(asset).frame_count, 8U);
  for (uint32_t f = 0; f < 8; ++f)
    EXPECT_EQ(frame(asset, f), frame(expected, f));
  anic_clip clip = ANIC_INIT(anic_clip);
  ASSERT_EQ(anic_get_clip(asset.get(), 0, &clip), ANIC_OK);
  EXPECT_NEAR(clip.start_time, static_cast<double>(8 * number) / 24, 1e-9);
}

TEST(LiveStream, GivesOneFileAfterTheOther) {
  const Bytes all = stream_bytes();
  const std::vector<Bytes> whole = read_live_stream({"stream", all}).files;
  ASSERT_EQ(whole.size(), 3U);
  EXPECT_LT(files()[1].size(), files()[0].size());
  for (const size_t piece : {size_t{1}, size_t{100}, all.size()}) {
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    {
      const Stream stream = new_stream(&options);
      size_t number = 0;
      for (size_t at = 0; at < all.size(); at += piece) {
        const size_t size = std::min(piece, all.size() - at);
        ASSERT_EQ(anic_push_bytes(stream.get(), all.data() + at, size), ANIC_OK);
        if (!info_of(stream).complete) {
          EXPECT_EQ(anic_advance_stream(stream.get()), ANIC_E_STATE);
        }
        for (; info_of(stream).complete; ++number) {
          expect_file(stream, number, whole[number]);
          const uint64_t waiting = info_of(stream).waiting_bytes;
          ASSERT_EQ(anic_advance_stream(stream.get()), ANIC_OK);
          EXPECT_EQ(info_of(stream).received_bytes + info_of(stream).waiting_bytes, waiting);
        }
      }
      EXPECT_EQ(number, 3U);
      EXPECT_EQ(info_of(stream).received_bytes, 0U);
    }
    EXPECT_EQ(memory.held, 0U);
    EXPECT_EQ(memory.small, 0U);
  }
}

TEST(LiveStream, PlaysContinuationsBeforeTheyAreComplete) {
  const Stream stream = new_stream();
  ASSERT_EQ(anic_push_bytes(stream.get(), files()[0].data(), files()[0].size()), ANIC_OK);
  ASSERT_EQ(anic_advance_stream(stream.get()), ANIC_OK);
  size_t coarse = 0;
  for (const uint8_t& byte : files()[1]) {
    ASSERT_EQ(anic_push_bytes(stream.get(), &byte, 1), ANIC_OK);
    if (info_of(stream).playable && !info_of(stream).complete) {
      ++coarse;
      EXPECT_TRUE(info_of(open(stream)).partial);
    }
  }
  EXPECT_GT(coarse, 0U);
  EXPECT_FALSE(info_of(open(stream)).partial);
}

TEST(LiveStream, GoesOnLearning) {
  const Stream stream = new_stream();
  size_t number = 0;
  for (const Bytes& file : learning_files()) {
    push_next(stream, file);
    std::vector<float> once, again;
    EXPECT_EQ(opened(stream, &once), ANIC_OK) << number;
    EXPECT_EQ(opened(stream, &again), ANIC_OK) << number;  // the file at hand can always be opened
    EXPECT_EQ(once, again);
    ++number;
  }
  const auto size = [](const std::vector<Bytes>& made, size_t i) { return made[i].size(); };
  const std::vector<Bytes> anew = streamed(5, 0);
  for (const size_t i : {1U, 2U, 4U})
    EXPECT_LT(size(learning_files(), i), size(anew, i)) << i;
}

TEST(LiveStream, NoticesALostFileAndGoesOnWhereOneBeginsAnew) {
  const std::vector<Bytes>& all = learning_files();
  Stream stream = new_stream();
  const auto expect = [&](size_t file, anic_status status) {
    push_next(stream, all[file]);
    EXPECT_EQ(opened(stream), status) << file;
  };
  expect(0, ANIC_OK);
  expect(2, ANIC_E_SEGMENT_MISSING);
  expect(1, ANIC_OK);  // late, but what it continues is there
  expect(1, ANIC_OK);  // twice
  expect(2, ANIC_OK);
  expect(4, ANIC_E_SEGMENT_MISSING);
  expect(3, ANIC_OK);
  expect(4, ANIC_OK);

  stream = new_stream();  // one that joins late has the meshes, and waits
  push_next(stream, all[0]);
  push_next(stream, all[2]);
  EXPECT_EQ(opened(stream), ANIC_E_SEGMENT_MISSING);
  push_next(stream, all[3]);
  EXPECT_EQ(opened(stream), ANIC_OK);
  push_next(stream, all[4]);
  EXPECT_EQ(opened(stream), ANIC_OK);
}

TEST(LiveStream, ReadsDamagedFilesThatLearnWithoutHarm) {
  const std::vector<Bytes>& all = learning_files();
  for (size_t i = 0; i < all[1].size(); i += 7) {
    Bytes damaged = all[1];
    damaged[i] ^= 0x10;
    const Stream stream = new_stream();
    push_next(stream, all[0]);
    EXPECT_EQ(opened(stream), ANIC_OK);
    ASSERT_EQ(anic_advance_stream(stream.get()), ANIC_OK);
    if (anic_push_bytes(stream.get(), damaged.data(), damaged.size()) == ANIC_OK) {
      EXPECT_NE(opened(stream), ANIC_OK) << i;
    }
  }
}

TEST(LiveStream, RefusesWhatIsNone) {
  anic_asset* asset = nullptr;
  EXPECT_EQ(anic_open_asset(files()[1].data(), files()[1].size(), nullptr, &asset, nullptr),
            ANIC_E_FEATURE);
  const Bytes all = stream_bytes();
  EXPECT_EQ(anic_open_asset(all.data(), all.size(), nullptr, &asset, nullptr),
            ANIC_E_TRAILING_BYTES);

  const Stream second = new_stream();
  EXPECT_EQ(anic_push_bytes(second.get(), files()[1].data(), files()[1].size()), ANIC_E_FEATURE);
  EXPECT_EQ(anic_advance_stream(second.get()), ANIC_E_FEATURE);
  EXPECT_EQ(anic_advance_stream(nullptr), ANIC_E_ARGUMENT);

  const Stream stream = new_stream();
  ASSERT_EQ(anic_push_bytes(stream.get(), files()[0].data(), files()[0].size()), ANIC_OK);
  const uint8_t garbage[2] = {0x89, 'B'};
  EXPECT_EQ(anic_push_bytes(stream.get(), garbage, 1), ANIC_OK);
  EXPECT_EQ(anic_push_bytes(stream.get(), garbage + 1, 1), ANIC_E_TRAILING_BYTES);
}

TEST(LiveStream, RefusesContinuationsOfOtherMeshes) {
  const Bytes other = encoded_clip("limb", BasisChoice::kEigentrajectories, 12);
  Stream stream = new_stream();
  ASSERT_EQ(anic_push_bytes(stream.get(), other.data(), other.size()), ANIC_OK);
  ASSERT_EQ(anic_advance_stream(stream.get()), ANIC_OK);
  EXPECT_EQ(anic_push_bytes(stream.get(), files()[1].data(), files()[1].size()), ANIC_E_MESHES);
  // A second file with meshes takes the place of the first.
  stream = new_stream();
  for (const Bytes* file : {&other, files().data(), &files()[1]}) {
    ASSERT_EQ(anic_push_bytes(stream.get(), file->data(), file->size()), ANIC_OK);
    open(stream);
    ASSERT_EQ(anic_advance_stream(stream.get()), ANIC_OK);
  }
  Bytes all = other;
  all.insert(all.end(), files()[1].begin(), files()[1].end());
  EXPECT_ANY_THROW(read_live_stream({"stream", all}));
}

TEST(LiveStream, NoticesEveryDamagedByteOfAContinuation) {
  Bytes damaged = files()[1];
  for (size_t i = 0; i < damaged.size(); ++i) {
    damaged[i] ^= 0x20;
    const Stream stream = new_stream();
    ASSERT_EQ(anic_push_bytes(stream.get(), files()[0].data(), files()[0].size()), ANIC_OK);
    ASSERT_EQ(anic_advance_stream(stream.get()), ANIC_OK);
    anic_status status = anic_push_bytes(stream.get(), damaged.data(), damaged.size());
    if (status == ANIC_OK) {
      EXPECT_FALSE(info_of(stream).complete) << i;
    }
    damaged[i] ^= 0x20;
  }
}

TEST(LiveStream, EndsCleanlyWhicheverAllocationFails) {
  const Bytes all = stream_bytes();
  size_t calls = 0;
  for (size_t fail = 0; fail == 0 || fail < calls; fail += 1 + fail / 8) {
    CountingMemory memory;
    memory.fail_at = fail == 0 ? SIZE_MAX : fail - 1;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    anic_stream* made = nullptr;
    anic_status status = anic_create_stream(&options, &made);
    const Stream stream(made);
    if (made)
      status = anic_push_bytes(made, all.data(), all.size());
    for (int i = 0; i < 3 && status == ANIC_OK; ++i) {
      anic_asset* asset = nullptr;
      status = anic_open_asset_from_stream(made, &asset, nullptr);
      anic_close_asset(asset);
      if (status == ANIC_OK)
        status = anic_advance_stream(made);
    }
    EXPECT_EQ(status, fail == 0 ? ANIC_OK : ANIC_E_MEMORY) << fail;
    if (fail == 0)
      calls = memory.calls;
  }
  EXPECT_GT(calls, 50U);
}

}  // namespace
}  // namespace anicodec
