// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_API_OPENED_H_
#define ANICODEC_TESTS_API_OPENED_H_

#include "codec/encode.h"
#include "corpus/clips.h"
#include "tests/heap_count.h"

#include <anicodec/anicodec.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {

/// A corpus clip as a file, encoded once for all tests of a build: each runs in a process of its own.
const Bytes& encoded_clip(const std::string& clip, BasisChoice basis, uint32_t frames = 0);

/// Memory of a host that counts, and that can be made to fail.
struct CountingMemory {
  size_t held = 0, peak = 0;
  size_t calls = 0;
  size_t fail_at = SIZE_MAX;  ///< number of the call that fails
  size_t small = 0;           ///< calls with another size than they were given back with

  anic_allocator allocator() {
    anic_allocator a = {};
    a.user = this;
    a.allocate = [](void* user, size_t size, size_t alignment) -> void* {
      auto* self = static_cast<CountingMemory*>(user);
      const HeapPause own;
      if (self->calls++ == self->fail_at)
        return nullptr;
      self->held += size;
      self->peak = std::max(self->peak, self->held);
      auto* memory = static_cast<size_t*>(
          std::aligned_alloc(std::max<size_t>(alignment, 16), (size + 16 + 15) / 16 * 16));
      memory[0] = size;
      return memory + 2;
    };
    a.release = [](void* user, void* memory, size_t size) {
      auto* self = static_cast<CountingMemory*>(user);
      const HeapPause own;
      auto* head = static_cast<size_t*>(memory) - 2;
      self->small += head[0] != size;
      self->held -= size;
      std::free(head);
    };
    return a;
  }
};

struct AssetCloser {
  void operator()(anic_asset* asset) const { anic_close_asset(asset); }
};

using Asset = std::unique_ptr<anic_asset, AssetCloser>;

struct ContextDestroyer {
  void operator()(anic_context* context) const { anic_destroy_context(context); }
};

using Context = std::unique_ptr<anic_context, ContextDestroyer>;

inline Asset open(const Bytes& file, const anic_options* options = nullptr) {
  anic_asset* asset = nullptr;
  anic_failure failure = ANIC_INIT(anic_failure);
  EXPECT_EQ(anic_open_asset(file.data(), file.size(), options, &asset, &failure), ANIC_OK)
      << failure.detail << " at " << failure.offset << " in " << failure.chunk;
  return Asset(asset);
}

/// Opens a file and makes a context again and again, each time with another allocation that fails,
/// until none does: no memory may stay behind. Returns about how many allocations there are.
inline size_t expect_no_leak_whichever_allocation_fails(const Bytes& file) {
  anic_status status = ANIC_E_MEMORY;
  size_t n = 0;
  for (; status != ANIC_OK && n < 10000000; n += n < 200 ? 1 : n / 20) {
    CountingMemory memory;
    memory.fail_at = n;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    options.flags = ANIC_OPEN_BOUNDS;
    anic_asset* asset = nullptr;
    anic_context* context = nullptr;
    status = anic_open_asset(file.data(), file.size(), &options, &asset, nullptr);
    if (status == ANIC_OK)
      status = anic_create_context(asset, nullptr, &context);
    EXPECT_TRUE(status == ANIC_OK || status == ANIC_E_MEMORY) << status << " at " << n;
    anic_destroy_context(context);
    anic_close_asset(asset);
    EXPECT_EQ(memory.held, 0U) << n;
    if (testing::Test::HasFailure())
      break;
  }
  EXPECT_EQ(status, ANIC_OK);
  return n;
}

inline Context context_of(const Asset& asset) {
  anic_context* context = nullptr;
  EXPECT_EQ(anic_create_context(asset.get(), nullptr, &context), ANIC_OK);
  return Context(context);
}

inline anic_asset_info info_of(const Asset& asset) {
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_get_asset_info(asset.get(), &info);
  return info;
}

inline uint32_t vertices_of(const Asset& asset, uint32_t mesh = 0) {
  anic_mesh info = ANIC_INIT(anic_mesh);
  EXPECT_EQ(anic_get_mesh(asset.get(), mesh, &info), ANIC_OK);
  return info.vertex_count;
}

inline anic_output floats(std::vector<float>& to) {
  anic_output output = ANIC_INIT(anic_output);
  output.data = to.data();
  output.size = to.size() * sizeof(float);
  return output;
}

/// Positions of all vertices of mesh 0 in what a context shows.
inline std::vector<float> positions(const Asset& asset, const Context& context,
                                    anic_when when = ANIC_WHEN_CURRENT) {
  std::vector<float> out(size_t{3} * vertices_of(asset));
  const anic_output output = floats(out);
  EXPECT_EQ(anic_write_positions(context.get(), 0, when, 0, vertices_of(asset), &output), ANIC_OK);
  return out;
}

inline std::vector<float> frame(const Asset& asset, uint32_t f) {
  std::vector<float> out(size_t{3} * vertices_of(asset));
  const anic_output output = floats(out);
  EXPECT_EQ(anic_write_frames(asset.get(), 0, &f, 1, 0, vertices_of(asset), &output), ANIC_OK);
  return out;
}

struct StreamDestroyer {
  void operator()(anic_stream* stream) const { anic_destroy_stream(stream); }
};

using Stream = std::unique_ptr<anic_stream, StreamDestroyer>;

inline Stream new_stream(const anic_options* options = nullptr) {
  anic_stream* stream = nullptr;
  EXPECT_EQ(anic_create_stream(options, &stream), ANIC_OK);
  return Stream(stream);
}

inline anic_stream_info info_of(const Stream& stream) {
  anic_stream_info info = ANIC_INIT(anic_stream_info);
  anic_get_stream_info(stream.get(), &info);
  return info;
}

inline Asset open(const Stream& stream) {
  anic_asset* asset = nullptr;
  anic_failure failure = ANIC_INIT(anic_failure);
  EXPECT_EQ(anic_open_asset_from_stream(stream.get(), &asset, &failure), ANIC_OK) << failure.detail;
  return Asset(asset);
}

inline double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return largest;
}

/// Clips and bases that the tests go over.
inline const std::vector<std::pair<std::string, BasisChoice>>& cases() {
  static const std::vector<std::pair<std::string, BasisChoice>> all = {
      {"limb", BasisChoice::kEigentrajectories},
      {"cloth", BasisChoice::kEigenshapes},
      {"rigid", BasisChoice::kKeyframes},
      {"nonmanifold", BasisChoice::kEigenshapes},
      {"polygons", BasisChoice::kKeyframes},
      {"one_triangle", BasisChoice::kEigentrajectories},
      {"points", BasisChoice::kEigenshapes},
      {"uneven", BasisChoice::kEigenshapes},
      {"soup", BasisChoice::kAuto},
      {"painted_box", BasisChoice::kKeyframes},
      {"heated", BasisChoice::kEigentrajectories},
      {"cuts", BasisChoice::kAuto}};
  return all;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_API_OPENED_H_
