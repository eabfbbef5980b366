// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Damaged and greedy files: those of tests/conformance, every prefix of them, every byte changed.
#include "build_paths.h"
#include "format/container.h"
#include "tests/api/opened.h"
#include "tests/codec/edited_file.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

namespace anicodec {
namespace {

struct Entry {
  std::string file;
  int status = 0;
  Bytes bytes;
};

/// Files of a kind in tests/conformance/MANIFEST: "valid", "invalid" or "limit".
std::vector<Entry> listed(const std::string& wanted) {
  const std::string folder = std::string(ANICODEC_SOURCE_DIR) + "/tests/conformance/";
  std::ifstream manifest(folder + "MANIFEST");
  std::vector<Entry> result;
  for (std::string line; std::getline(manifest, line);) {
    std::istringstream words(line);
    std::string kind, digest;
    Entry entry;
    words >> kind >> entry.file >> digest >> entry.status;
    if (kind != wanted)
      continue;
    std::ifstream file(folder + entry.file, std::ios::binary);
    entry.bytes.assign(std::istreambuf_iterator<char>(file), {});
    EXPECT_FALSE(entry.bytes.empty()) << entry.file;
    result.push_back(std::move(entry));
  }
  EXPECT_FALSE(result.empty());
  return result;
}

/// Reads metadata and boxes without opening; a file may lack them.
anic_status read_unopened(const Bytes& file) {
  const char* text;
  size_t bytes;
  anic_box box;
  anic_status status = anic_read_metadata(file.data(), file.size(), &text, &bytes);
  const auto is_well = [&] { return status == ANIC_OK || status == ANIC_E_ABSENT; };
  for (uint32_t mesh = 0; is_well(); ++mesh)
    status = anic_read_bounds(file.data(), file.size(), mesh, 0, 0, &box);
  return status == ANIC_E_ARGUMENT ? ANIC_OK : status;  // there is no such mesh
}

/// Opens and compares hashes; what opens is played. Nothing is kept.
anic_status tried(const Bytes& file, CountingMemory* memory) {
  anic_options options = ANIC_INIT(anic_options);
  options.allocator = memory->allocator();
  options.max_bytes = 8 << 20;
  anic_asset* raw = nullptr;
  anic_failure failure = ANIC_INIT(anic_failure);
  anic_status status = anic_open_asset(file.data(), file.size(), &options, &raw, &failure);
  EXPECT_EQ(failure.status, status);
  {
    const Asset asset(raw);
    EXPECT_EQ(asset != nullptr, status == ANIC_OK);
    if (asset) {
      status = anic_verify_asset(raw);
      const Context context = context_of(asset);
      const uint32_t frames = info_of(asset).frame_count;
      for (const uint32_t f : {0U, frames / 2, frames - 1}) {
        anic_box box;
        EXPECT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
        if (anic_compute_bounds(context.get(), 0, ANIC_WHEN_CURRENT, &box) == ANIC_OK) {
          for (int c = 0; c < 3; ++c)
            EXPECT_TRUE(std::isfinite(box.min[c]) && std::isfinite(box.max[c]));
        }
      }
    }
  }
  EXPECT_EQ(memory->held, 0U);
  return status == ANIC_OK ? read_unopened(file) : status;
}

anic_status tried(const Bytes& file) {
  CountingMemory memory;
  return tried(file, &memory);
}

TEST(Hostile, ConformanceFilesHaveTheirStatus) {
  for (const Entry& entry : listed("valid"))
    EXPECT_EQ(tried(entry.bytes), ANIC_OK) << entry.file;
  std::vector<int> seen;
  for (const Entry& entry : listed("invalid")) {
    EXPECT_EQ(tried(entry.bytes), entry.status) << entry.file;
    seen.push_back(entry.status);
  }
  // One for each code that a file by itself can cause.
  for (int status = ANIC_E_MAGIC; status < ANIC_E_LIMIT; ++status) {
    const bool exists =
        std::string(anic_get_status_text(static_cast<anic_status>(status))) != "unknown status";
    EXPECT_EQ(std::count(seen.begin(), seen.end(), status) > 0, exists && status != ANIC_E_MESHES)
        << status;
  }
}

TEST(Hostile, GreedyFilesTakeNothing) {
  for (const Entry& entry : listed("limit")) {
    CountingMemory memory;
    EXPECT_EQ(tried(entry.bytes, &memory), ANIC_E_LIMIT) << entry.file;
    EXPECT_LT(memory.peak, 4096U) << entry.file;
  }
}

TEST(Hostile, EveryPrefixIsRefused) {
  for (const Entry& entry : listed("valid")) {
    for (size_t size = 0; size < entry.bytes.size(); ++size) {
      const Bytes prefix(entry.bytes.begin(), entry.bytes.begin() + size);
      const anic_status status = tried(prefix);
      ASSERT_EQ(status, size == 0 ? ANIC_E_MAGIC : ANIC_E_TRUNCATED) << entry.file << " " << size;
    }
  }
}

TEST(Hostile, EveryPrefixOfAStreamPlaysOrWaits) {
  for (const Entry& entry : listed("valid")) {
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    anic_stream* stream = nullptr;
    ASSERT_EQ(anic_create_stream(&options, &stream), ANIC_OK);
    size_t opened = 0;
    for (size_t i = 0; i < entry.bytes.size(); ++i) {
      ASSERT_EQ(anic_push_bytes(stream, &entry.bytes[i], 1), ANIC_OK) << entry.file << " " << i;
      anic_stream_info info = ANIC_INIT(anic_stream_info);
      anic_get_stream_info(stream, &info);
      anic_asset* asset = nullptr;
      if (info.playable && opened++ % 50 != 0 && !info.complete)
        continue;
      const anic_status status = anic_open_asset_from_stream(stream, &asset, nullptr);
      ASSERT_EQ(status, info.playable ? ANIC_OK : ANIC_E_STATE) << entry.file << " " << i;
      anic_close_asset(asset);
    }
    EXPECT_GT(opened, 0U);
    anic_destroy_stream(stream);
    EXPECT_EQ(memory.held, 0U);
  }
}

/// Which bytes of a file are changed: of larger ones about as many as of others, for each change opens
/// the whole.
size_t step_of(const Entry& entry) {
  constexpr size_t kChanges = 256;
  return entry.bytes.size() / kChanges + 1;
}

/// Whether a byte lies in a chunk that nobody reads, for its type is not known.
bool is_skipped(const Bytes& file, size_t at) {
  ContainerReader reader;
  if (!reader.open(file).ok())
    return false;
  for (const Chunk& chunk : reader.chunks()) {
    if (at >= chunk.offset && at - chunk.offset < chunk.size)
      return !chunk.required && chunk.type != chunk_type("META") &&
             chunk.type != chunk_type("BNDS") && chunk.type != chunk_type("ATTR");
  }
  return false;
}

TEST(SlowHostile, ChangedBytesAreNoticed) {
  for (Entry& entry : listed("valid")) {
    for (size_t i = 0; i < entry.bytes.size(); i += step_of(entry)) {
      if (is_skipped(entry.bytes, i))
        continue;
      uint8_t& byte = entry.bytes[i];
      const uint8_t old = byte;
      byte = static_cast<uint8_t>(old ^ 0x20);
      ASSERT_NE(tried(entry.bytes), ANIC_OK) << entry.file << " " << i;
      byte = old;
    }
  }
}

// With checksums that fit, so that the chunks' contents are decoded.
TEST(SlowHostile, ChangedBytesOfAChunkAreSurvived) {
  size_t refused = 0, all = 0;
  for (const Entry& entry : listed("valid")) {
    EditedFile file(entry.bytes);
    for (EditedFile::Part& part : file.parts) {
      for (size_t i = 0; i < part.payload.size(); i += step_of(entry)) {
        uint8_t& byte = part.payload[i];
        const uint8_t old = byte;
        for (const int value : {old ^ 1, 0xFF}) {
          byte = static_cast<uint8_t>(value);
          const anic_status status = tried(file.bytes());
          ASSERT_NE(status, ANIC_E_INTERNAL);
          ASSERT_NE(status, ANIC_E_MEMORY);
          refused += status != ANIC_OK;
          ++all;
        }
        byte = old;
      }
    }
  }
  EXPECT_GT(refused, all / 2);
}

}  // namespace
}  // namespace anicodec
