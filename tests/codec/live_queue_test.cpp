// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/live_queue.h"

#include "codec/sequence/error.h"
#include "corpus/clips.h"

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

class LiveQueues : public testing::Test {
 protected:
  LiveQueues() {
    clip_ = corpus::make_scaled("limb", 200, 20);
    mesh_ = clip_;
    mesh_.positions = {};
    options_.target = {ErrorMetric::kMaxError, 0.2, true};
    options_.effort = Effort::kFast;
    live_.piece = 8 / clip_.rate.value();
    live_.threads = 1;
  }

  std::vector<Bytes> encoded() const {
    LiveEncoder encoder(mesh_, options_);
    std::vector<Bytes> files;
    const size_t frame = size_t{3} * clip_.vertex_count;
    for (size_t f = 0; f < clip_.frame_count; f += 8) {
      const auto begin = clip_.positions.begin() + static_cast<ptrdiff_t>(f * frame);
      files.push_back(
          encoder
              .encode({begin, begin + static_cast<ptrdiff_t>(
                                          std::min<size_t>(8, clip_.frame_count - f) * frame)})
              .file);
    }
    return files;
  }

  MeshSequence clip_, mesh_;
  EncodeOptions options_;
  LiveOptions live_;
};

TEST_F(LiveQueues, MakesTheFilesOfTheEncoder) {
  LiveQueue queue(mesh_, options_, live_);
  EXPECT_EQ(queue.frames_of_piece(), 8U);
  EXPECT_FALSE(queue.take());
  for (uint32_t f = 0; f < clip_.frame_count; ++f)
    EXPECT_TRUE(queue.push(clip_.frame(f)));
  EXPECT_EQ(queue.state().pushed_frames, 20U);
  EXPECT_FALSE(queue.state().ended);
  queue.end();
  std::vector<Bytes> files;
  uint64_t first = 0;
  while (const std::optional<QueuedPiece> piece = queue.take(kForever)) {
    EXPECT_EQ(piece->first_frame, first);
    EXPECT_NEAR(piece->start_time, static_cast<double>(first) / clip_.rate.value(), 1e-9);
    EXPECT_EQ(piece->is_key, first == 0);
    EXPECT_EQ(piece->has_mesh, first == 0);
    first += piece->frames;
    files.push_back(piece->file);
  }
  EXPECT_EQ(files, encoded());
  const LiveState state = queue.state();
  EXPECT_TRUE(state.ended);
  EXPECT_EQ(state.waiting_frames + state.late_frames + state.waiting_pieces, 0U);
  EXPECT_THROW(queue.push(clip_.frame(0)), Error);
}

TEST_F(LiveQueues, SaysHowFarBehindItIs) {
  live_.most_waiting = 10;
  LiveQueue queue(mesh_, options_, live_);
  uint32_t pushed = 0;
  while (pushed < 40 && queue.push(clip_.frame(pushed % 20)))
    ++pushed;
  const LiveState state = queue.state();
  EXPECT_LE(state.waiting_frames, 10U);
  EXPECT_LE(state.late_frames, state.waiting_frames);
  for (; pushed < 40; ++pushed)
    EXPECT_TRUE(queue.push(clip_.frame(pushed % 20), {}, kForever));
  queue.end();
  uint64_t frames = 0;
  while (const std::optional<QueuedPiece> piece = queue.take(kForever))
    frames += piece->frames;
  EXPECT_EQ(frames, 40U);
}

TEST_F(LiveQueues, RefusesAFrameAndGoesOn) {
  LiveQueue queue(mesh_, options_, live_);
  std::vector<float> bad(clip_.frame(0).begin(), clip_.frame(0).end());
  bad[7] = NAN;
  EXPECT_THROW(queue.push(bad), Error);
  bad.pop_back();
  EXPECT_THROW(queue.push(bad), Error);
  const std::span<const float> values = clip_.frame(0);
  EXPECT_THROW(queue.push(clip_.frame(0), {&values, 1}), Error);
  EXPECT_EQ(queue.state().pushed_frames, 0U);
  EXPECT_TRUE(queue.push(clip_.frame(0)));
  queue.end();
  EXPECT_EQ(queue.take(kForever)->frames, 1U);
  EXPECT_FALSE(queue.take(kForever));
}

TEST_F(LiveQueues, GivesWhatEndsTheEncoding) {
  options_.target = {ErrorMetric::kMaxError, 1e-9, false};
  LiveQueue queue(mesh_, options_, live_);
  for (uint32_t f = 0; f < 20; ++f) {
    try {
      queue.push(clip_.frame(f));
    } catch (const Error&) {
    }
  }
  try {
    queue.take(kForever);
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("the frames from 0 on"));
  }
  EXPECT_THROW(queue.push(clip_.frame(0)), Error);
  EXPECT_FALSE(queue.state().ended);
}

TEST_F(LiveQueues, StopsWhoeverWaits) {
  live_.most_waiting = 8;
  LiveQueue queue(mesh_, options_, live_);
  std::thread taker([&] { EXPECT_THROW(while (queue.take(kForever)), Error); });
  queue.push(clip_.frame(0));
  queue.stop();
  taker.join();
  EXPECT_THROW(queue.push(clip_.frame(0)), Error);
  EXPECT_THROW(queue.take(), Error);
}

TEST_F(LiveQueues, RefusesOptionsWithoutSense) {
  const auto refused = [&](LiveOptions live) {
    EXPECT_THROW(LiveQueue(mesh_, options_, live), Error);
  };
  refused({0});
  refused({1e9});
  refused({NAN});
  refused({1, -1});
  refused({1, 4, -1});
  refused({1, 4, 0, 5});
  mesh_.vertex_count = 0;
  refused({});
}

}  // namespace
}  // namespace anicodec
