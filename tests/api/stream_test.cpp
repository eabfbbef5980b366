// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/container.h"
#include "tests/api/opened.h"

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

void expect_same(const Asset& a, const Asset& b) {
  ASSERT_EQ(info_of(a).frame_count, info_of(b).frame_count);
  EXPECT_EQ(info_of(a).resident_bytes, info_of(b).resident_bytes);
  for (uint32_t f = 0; f < info_of(a).frame_count; ++f)
    ASSERT_EQ(frame(a, f), frame(b, f));
}

TEST(AnicStream, TakesAFileByteByByte) {
  const Bytes& file = encoded_clip("limb", BasisChoice::kEigentrajectories);
  const Stream stream = new_stream();
  bool was_playable = false;
  uint32_t layers = 0;
  for (size_t i = 0; i < file.size(); ++i) {
    ASSERT_EQ(anic_push_bytes(stream.get(), &file[i], 1), ANIC_OK);
    const anic_stream_info info = info_of(stream);
    EXPECT_EQ(info.received_bytes, i + 1);
    EXPECT_EQ(info.complete, i + 1 == file.size());
    EXPECT_GE(info.arrived_layers, layers);
    EXPECT_GE(info.playable, was_playable);
    if (info.playable && !was_playable) {
      EXPECT_LT(i + 1, file.size());
      EXPECT_EQ(info.file_bytes, file.size());
      EXPECT_EQ(info.playable_segments, info.segment_count);
    }
    was_playable = info.playable;
    layers = info.arrived_layers;
  }
  EXPECT_EQ(layers, info_of(stream).layers);
  const uint8_t more = 0;
  expect_same(open(stream), open(file));
  EXPECT_EQ(anic_push_bytes(stream.get(), &more, 1), ANIC_E_TRAILING_BYTES);
}

TEST(AnicStream, PlaysEachLayerThatArrives) {
  const Bytes& file = encoded_clip("limb", BasisChoice::kEigentrajectories);
  const Asset whole = open(file);
  ContainerReader reader;
  ASSERT_TRUE(reader.open(file).ok());
  const Stream stream = new_stream();
  size_t at = 0;
  double error = 1e30;
  uint32_t coarser = 0;
  for (const Chunk& chunk : reader.chunks()) {
    const size_t end = chunk.offset + chunk.size;
    ASSERT_EQ(anic_push_bytes(stream.get(), file.data() + at, end - at), ANIC_OK);
    at = end;
    anic_asset* none = nullptr;
    if (!info_of(stream).playable) {
      EXPECT_EQ(anic_open_asset_from_stream(stream.get(), &none, nullptr), ANIC_E_STATE);
      continue;
    }
    const Asset asset = open(stream);
    EXPECT_EQ(info_of(asset).partial, at < file.size());
    double now = 0;
    for (uint32_t f = 0; f < info_of(whole).frame_count; ++f)
      now = std::max(now, largest_difference(frame(asset, f), frame(whole, f)));
    EXPECT_LE(now, error);
    coarser += now < error && now > 0;
    error = now;
    EXPECT_LT(now, 0.3 * info_of(whole).diagonal);
    EXPECT_EQ(anic_verify_asset(asset.get()), at < file.size() ? ANIC_E_STATE : ANIC_OK);
  }
  EXPECT_EQ(at, file.size());
  EXPECT_EQ(error, 0);
  EXPECT_GE(coarser, 1U);  // played before its end
}

TEST(AnicStream, PlaysByTheBaseBeforeAnyLayer) {
  for (const auto& [name, basis] : cases()) {
    SCOPED_TRACE(name);
    const Bytes& file = encoded_clip(name, basis);
    ContainerReader reader;
    ASSERT_TRUE(reader.open(file).ok());
    const Chunk* record = reader.find("SEGM", 0, 0);
    ASSERT_NE(record, nullptr);
    const Stream stream = new_stream();
    ASSERT_EQ(anic_push_bytes(stream.get(), file.data(), record->offset + record->size), ANIC_OK);
    EXPECT_EQ(info_of(stream).arrived_layers, 0U);
    ASSERT_TRUE(info_of(stream).playable);
    const Asset base = open(stream), whole = open(file);
    EXPECT_LT(largest_difference(frame(base, 0), frame(whole, 0)), info_of(whole).diagonal);
  }
}

TEST(AnicStream, GivesWhatAWholeFileGives) {
  for (const auto& [name, basis] : cases()) {
    SCOPED_TRACE(name);
    const Bytes& file = encoded_clip(name, basis);
    const Asset whole = open(file);
    for (size_t piece : {size_t{7}, size_t{1000}, file.size()}) {
      CountingMemory memory;
      anic_options options = ANIC_INIT(anic_options);
      options.allocator = memory.allocator();
      {
        const Stream stream = new_stream(&options);
        for (size_t at = 0; at < file.size(); at += piece) {
          ASSERT_EQ(
              anic_push_bytes(stream.get(), file.data() + at, std::min(piece, file.size() - at)),
              ANIC_OK);
        }
        expect_same(open(stream), whole);
      }
      EXPECT_EQ(memory.held, 0U);
    }
  }
}

TEST(AnicStream, SegmentsThatAreNotThereAreNotPlayed) {
  // As it stands, cut before the last chunk that a segment needs.
  for (const auto& [name, basis] : cases()) {
    const Bytes& file = encoded_clip(name, basis);
    for (size_t cut = 0; cut < file.size(); cut += 1 + file.size() / 60) {
      const Stream stream = new_stream();
      ASSERT_EQ(anic_push_bytes(stream.get(), file.data(), cut), ANIC_OK);
      if (!info_of(stream).playable)
        continue;
      const Asset asset = open(stream);
      const Context context = context_of(asset);
      std::vector<float> out(size_t{3} * vertices_of(asset));
      const anic_output output = floats(out);
      anic_box box;
      uint32_t there = 0;
      for (uint32_t f = 0; f < info_of(asset).frame_count; ++f) {
        ASSERT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
        const anic_status status = anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0,
                                                        vertices_of(asset), &output);
        ASSERT_TRUE(status == ANIC_OK || status == ANIC_E_ABSENT);
        EXPECT_EQ(anic_compute_bounds(context.get(), 0, ANIC_WHEN_CURRENT, &box), status);
        there += status == ANIC_OK;
      }
      EXPECT_GT(there, 0U);
    }
  }
}

TEST(AnicStream, FailsAsSoonAsAChunkIsDamaged) {
  Bytes file = encoded_clip("cloth", BasisChoice::kEigenshapes);
  ContainerReader reader;
  ASSERT_TRUE(reader.open(file).ok());
  const Chunk chunk = *reader.find("MESH", 0);
  file[chunk.offset] ^= 1;
  const Stream stream = new_stream();
  EXPECT_EQ(anic_push_bytes(stream.get(), file.data(), chunk.offset + 3), ANIC_OK);
  EXPECT_EQ(anic_push_bytes(stream.get(), file.data() + chunk.offset + 3, 1000),
            ANIC_E_CHUNK_CHECKSUM);
  anic_failure failure = ANIC_INIT(anic_failure);
  anic_get_stream_failure(stream.get(), &failure);
  EXPECT_STREQ(failure.chunk, "MESH");
  EXPECT_EQ(failure.offset, chunk.offset);
  EXPECT_EQ(anic_push_bytes(stream.get(), file.data(), 1), ANIC_E_CHUNK_CHECKSUM);
  anic_asset* asset = nullptr;
  EXPECT_EQ(anic_open_asset_from_stream(stream.get(), &asset, &failure), ANIC_E_CHUNK_CHECKSUM);

  const Stream limited = [] {
    anic_options options = ANIC_INIT(anic_options);
    options.max_vertices = 5;
    return new_stream(&options);
  }();
  EXPECT_EQ(anic_push_bytes(limited.get(), file.data(), chunk.offset), ANIC_E_LIMIT);
}

struct FileInMemory {
  const Bytes& file;
  uint64_t fail_from = UINT64_MAX;
  uint64_t read = 0;

  anic_reader reader() {
    return {this, [](void* user, uint64_t offset, void* to, size_t size) {
              auto* self = static_cast<FileInMemory*>(user);
              if (offset + size > self->file.size() || offset + size > self->fail_from)
                return 1;
              std::memcpy(to, self->file.data() + offset, size);
              self->read += size;
              return 0;
            }};
  }
};

TEST(AnicReader, OpensThroughACallback) {
  for (const auto& [name, basis] : cases()) {
    const Bytes& file = encoded_clip(name, basis);
    FileInMemory source{file};
    const anic_reader reader = source.reader();
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    anic_asset* asset = nullptr;
    ASSERT_EQ(anic_open_asset_from_reader(&reader, file.size(), &options, &asset, nullptr),
              ANIC_OK);
    EXPECT_EQ(source.read, file.size());
    expect_same(Asset(asset), open(file));
    EXPECT_EQ(memory.held, 0U);
  }
}

TEST(AnicReader, ChecksLimitsBeforeItReadsTheRest) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.01, true};
  options.basis = BasisChoice::kEigenshapes;
  options.effort = Effort::kFast;
  const Bytes file = encode(corpus::make_clip("cloth"), options).file;
  ASSERT_GT(file.size(), 8192U);
  FileInMemory source{file};
  const anic_reader reader = source.reader();
  anic_options limited = ANIC_INIT(anic_options);
  limited.max_frames = 3;
  anic_asset* asset = nullptr;
  anic_failure failure = ANIC_INIT(anic_failure);
  EXPECT_EQ(anic_open_asset_from_reader(&reader, file.size(), &limited, &asset, &failure),
            ANIC_E_LIMIT);
  EXPECT_EQ(source.read, 4096U);
  EXPECT_STREQ(failure.chunk, "LIMI");
  for (uint64_t fail : {uint64_t{10}, uint64_t{4096}, uint64_t{file.size() - 1}}) {
    source.fail_from = fail;
    EXPECT_EQ(anic_open_asset_from_reader(&reader, file.size(), nullptr, &asset, &failure),
              ANIC_E_READ);
  }
  source.fail_from = UINT64_MAX;
  EXPECT_EQ(anic_open_asset_from_reader(&reader, file.size() - 1, nullptr, &asset, &failure),
            ANIC_E_TRUNCATED);
  EXPECT_EQ(anic_open_asset_from_reader(&reader, 0, nullptr, &asset, &failure), ANIC_E_MAGIC);
}

}  // namespace
}  // namespace anicodec
