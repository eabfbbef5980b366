// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// An opening that the host follows, stops, and lends threads to.
#include "tests/api/opened.h"
#include "tests/sdk/threads.h"

#include <cstring>
#include <thread>

namespace anicodec {
namespace {

/// A host that stops when it is asked for the n-th time.
struct Follower {
  size_t stop_at = SIZE_MAX;
  std::vector<double> shares;
  std::thread::id thread = std::this_thread::get_id();
  size_t elsewhere = 0;  ///< calls on other threads

  anic_progress progress() {
    anic_progress p = {};
    p.user = this;
    p.report = [](void* user, double done) {
      auto* self = static_cast<Follower*>(user);
      self->elsewhere += std::this_thread::get_id() != self->thread;
      self->shares.push_back(done);
      return self->shares.size() > self->stop_at ? 1 : 0;
    };
    return p;
  }
};

anic_threads threads_of_a_host() {
  const HostThreads three = three_threads();
  return {three.host, three.run};
}

TEST(AnicProgress, GrowsToOneAtBoundedSteps) {
  for (const auto& [clip, basis] : cases()) {
    SCOPED_TRACE(clip);
    const Bytes& file = encoded_clip(clip, basis);
    for (const uint64_t flags : {0, static_cast<int>(ANIC_OPEN_BOUNDS)}) {
      Follower follower;
      anic_options options = ANIC_INIT(anic_options);
      options.progress = follower.progress();
      options.flags = flags;
      const Asset asset = open(file, &options);
      ASSERT_GE(follower.shares.size(), 2U);
      EXPECT_EQ(follower.shares.front(), 0);
      EXPECT_TRUE(std::is_sorted(follower.shares.begin(), follower.shares.end()));
      EXPECT_NEAR(follower.shares.back(), 1, 1e-9);
      EXPECT_EQ(follower.elsewhere, 0U);
    }
  }
  // Every component is a step, and every level of the prediction.
  Follower follower;
  anic_options options = ANIC_INIT(anic_options);
  options.progress = follower.progress();
  const Asset asset = open(encoded_clip("limb", BasisChoice::kEigentrajectories), &options);
  anic_basis basis = ANIC_INIT(anic_basis);
  ASSERT_EQ(anic_get_basis(asset.get(), 0, &basis), ANIC_OK);
  EXPECT_GT(follower.shares.size(), basis.components);
}

TEST(AnicProgress, StopsAtEveryStepWithoutALeak) {
  for (const auto& [clip, basis] : cases()) {
    SCOPED_TRACE(clip);
    const Bytes& file = encoded_clip(clip, basis);
    anic_status status = ANIC_E_CANCELLED;
    for (size_t n = 0; status != ANIC_OK; ++n) {
      CountingMemory memory;
      Follower follower;
      follower.stop_at = n;
      anic_options options = ANIC_INIT(anic_options);
      options.allocator = memory.allocator();
      options.progress = follower.progress();
      options.threads = threads_of_a_host();
      options.flags = ANIC_OPEN_BOUNDS;
      anic_asset* asset = nullptr;
      anic_failure failure = ANIC_INIT(anic_failure);
      status = anic_open_asset(file.data(), file.size(), &options, &asset, &failure);
      EXPECT_EQ(failure.status, status);
      if (status == ANIC_OK) {
        EXPECT_EQ(follower.shares.size(), n);
      } else {
        ASSERT_EQ(status, ANIC_E_CANCELLED);
        EXPECT_EQ(asset, nullptr);
        EXPECT_EQ(follower.shares.size(), n + 1);  // nobody is asked again
        EXPECT_EQ(memory.held, 0U);
      }
      anic_close_asset(asset);
      EXPECT_EQ(memory.held, 0U);
    }
  }
}

TEST(AnicProgress, StopsStreamsAndReadersToo) {
  const Bytes& file = encoded_clip("cloth", BasisChoice::kEigenshapes);
  CountingMemory memory;
  Follower follower;
  follower.stop_at = 1;
  anic_options options = ANIC_INIT(anic_options);
  options.allocator = memory.allocator();
  options.progress = follower.progress();
  anic_stream* stream = nullptr;
  ASSERT_EQ(anic_create_stream(&options, &stream), ANIC_OK);
  ASSERT_EQ(anic_push_bytes(stream, file.data(), file.size()), ANIC_OK);
  anic_asset* asset = nullptr;
  EXPECT_EQ(anic_open_asset_from_stream(stream, &asset, nullptr), ANIC_E_CANCELLED);
  // The stream is as it was.
  follower.stop_at = SIZE_MAX;
  EXPECT_EQ(anic_open_asset_from_stream(stream, &asset, nullptr), ANIC_OK);
  anic_close_asset(asset);
  anic_destroy_stream(stream);

  anic_reader reader = {};
  reader.user = const_cast<Bytes*>(&file);
  reader.read = [](void* user, uint64_t offset, void* to, size_t size) {
    std::copy_n(static_cast<const Bytes*>(user)->data() + offset, size, static_cast<uint8_t*>(to));
    return 0;
  };
  follower.shares.clear();
  follower.stop_at = 0;
  EXPECT_EQ(anic_open_asset_from_reader(&reader, file.size(), &options, &asset, nullptr),
            ANIC_E_CANCELLED);
  EXPECT_EQ(memory.held, 0U);
}

TEST(AnicThreads, ChangeNoCoefficient) {
  for (const BasisChoice basis : {BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories}) {
    const Bytes& file = encoded_clip("limb", basis);
    anic_options options = ANIC_INIT(anic_options);
    const Asset alone = open(file, &options);
    options.threads = threads_of_a_host();
    const Asset shared = open(file, &options);
    EXPECT_EQ(anic_verify_asset(shared.get()), ANIC_OK);
    EXPECT_EQ(frame(shared, 3), frame(alone, 3));
  }
}

TEST(AnicThreads, ChangeNoBox) {
  for (const auto& [clip, basis] : cases()) {
    SCOPED_TRACE(clip);
    const Bytes& file = encoded_clip(clip, basis);
    anic_options options = ANIC_INIT(anic_options);
    options.flags = ANIC_OPEN_BOUNDS;
    const Asset alone = open(file, &options);
    options.threads = threads_of_a_host();
    const Asset together = open(file, &options);
    for (uint32_t m = 0; m < info_of(alone).mesh_count; ++m) {
      for (uint32_t f = 0; f < info_of(alone).frame_count; ++f) {
        anic_box a = {}, b = {};
        EXPECT_EQ(anic_get_frame_bounds(alone.get(), m, f, &a),
                  anic_get_frame_bounds(together.get(), m, f, &b));
        EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << f;
      }
    }
  }
}

}  // namespace
}  // namespace anicodec
