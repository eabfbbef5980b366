// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// All memory of an asset comes from its allocator; only Draco takes some of the global heap, no
// more than anic_get_requirements() says.
#include "tests/api/all_files.h"
#include "tests/heap_count.h"

namespace anicodec {
namespace {

/// Heap memory taken while a file was looked at, opened, played and closed.
struct Taken {
  size_t announced = 0, opening = 0, query = 0, playing = 0;
  int64_t left = 0;
};

Taken taken_by(const Bytes& file) {
  CountingMemory memory;
  anic_options options = ANIC_INIT(anic_options);
  options.allocator = memory.allocator();
  Taken taken;
  anic_requirements needs = ANIC_INIT(anic_requirements);
  {
    const HeapCount heap;
    EXPECT_EQ(anic_get_requirements(file.data(), file.size(), &options, &needs), ANIC_OK);
    taken.query = heap.peak();
  }
  taken.announced = static_cast<size_t>(needs.draco_bytes);
  anic_asset* asset = nullptr;
  {
    const HeapCount heap;
    EXPECT_EQ(anic_open_asset(file.data(), file.size(), &options, &asset, nullptr), ANIC_OK);
    taken.opening = heap.peak();
    taken.left = heap.held();
  }
  const HeapCount heap;
  anic_context* context = nullptr;
  EXPECT_EQ(anic_create_context(asset, nullptr, &context), ANIC_OK);
  EXPECT_EQ(anic_seek_time(context, 0.01, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP), ANIC_OK);
  anic_box box;
  anic_compute_bounds(context, 0, ANIC_WHEN_CURRENT, &box);
  EXPECT_EQ(anic_verify_asset(asset), ANIC_OK);
  anic_destroy_context(context);
  anic_close_asset(asset);
  taken.playing = heap.peak();
  return taken;
}

TEST(Heap, IsCounted) {
  const HeapCount heap;
  auto* const volatile memory = new char[1000];
  EXPECT_GE(heap.peak(), 1000U);
  EXPECT_EQ(heap.calls(), 1U);
  delete[] memory;
  EXPECT_EQ(heap.held(), 0);
}

TEST(Heap, TakesOnlyWhatIsAnnounced) {
  for (const auto& [name, file] : all_files()) {
    const Taken taken = taken_by(file);
    EXPECT_EQ(taken.query, 0U) << name;
    EXPECT_LE(taken.opening, taken.announced) << name;
    EXPECT_EQ(taken.left, 0) << name;
    EXPECT_EQ(taken.playing, 0U) << name;
  }
}

}  // namespace
}  // namespace anicodec
