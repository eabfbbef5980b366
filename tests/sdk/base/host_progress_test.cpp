// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/base/host_progress.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::ElementsAre;

struct Host {
  std::vector<double> shares;
  size_t stop_at = SIZE_MAX;

  HostProgress progress() {
    return HostProgress(
        [](void* user, double done) {
          auto* self = static_cast<Host*>(user);
          self->shares.push_back(done);
          return self->shares.size() > self->stop_at ? -1 : 0;
        },
        this);
  }
};

TEST(HostProgress, SharesTheCallAmongStages) {
  Host host;
  HostProgress progress = host.progress();
  EXPECT_TRUE(progress.advance(5));  // before any stage
  progress.begin(8, 0.5);
  EXPECT_TRUE(progress.advance(4));
  EXPECT_TRUE(progress.advance(100));  // more than was planned
  progress.begin(2);
  EXPECT_TRUE(progress.advance(0));
  EXPECT_TRUE(progress.advance(1));
  EXPECT_TRUE(progress.advance(1));
  EXPECT_THAT(host.shares, ElementsAre(0, 0.25, 0.5, 0.5, 0.75, 1));
}

TEST(HostProgress, AsksNobodyAgainWhoWantedToStop) {
  Host host;
  host.stop_at = 1;
  HostProgress progress = host.progress();
  progress.begin(4);
  EXPECT_TRUE(progress.advance(1));
  EXPECT_FALSE(progress.advance(1));
  EXPECT_FALSE(progress.advance(1));
  EXPECT_EQ(host.shares.size(), 2U);
}

TEST(HostProgress, TellsNobodyIfThereIsNone) {
  HostProgress progress(nullptr, nullptr);
  progress.begin(0);
  EXPECT_TRUE(progress.advance(1));
}

}  // namespace
}  // namespace anicodec
