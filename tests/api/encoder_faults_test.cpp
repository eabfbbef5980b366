// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// No memory and impossible coordinates end an encoding with a status, whatever the threads were at.
#include "corpus/clips.h"
#include "tests/heap_count.h"

#include <anicodec/encode.h>

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr int kRuns = 100;

class Encoding {
 public:
  Encoding(const MeshSequence& sequence, uint32_t threads) {
    EXPECT_EQ(anic_create_encoder(&encoder_), ANIC_OK);
    anic_source_clip clip = ANIC_INIT(anic_source_clip);
    clip.frame_count = sequence.frame_count;
    EXPECT_EQ(anic_set_source_clip(encoder_, &clip), ANIC_OK);
    anic_source_mesh mesh = ANIC_INIT(anic_source_mesh);
    mesh.vertex_count = sequence.vertex_count;
    mesh.polygon_count = static_cast<uint32_t>(sequence.polygons.size());
    mesh.offsets = sequence.polygons.offsets.data();
    mesh.corners = sequence.polygons.corners.data();
    mesh.positions = sequence.positions.data();
    added_ = anic_add_source_mesh(encoder_, &mesh, nullptr);
    options_.goal = ANIC_GOAL_MAX_ERROR;
    options_.goal_value = 0.05;
    options_.flags = ANIC_ENCODE_PERCENT;
    options_.effort = ANIC_EFFORT_NORMAL;
    options_.threads = threads;
  }

  Encoding(const Encoding&) = delete;
  Encoding& operator=(const Encoding&) = delete;

  ~Encoding() { anic_destroy_encoder(encoder_); }

  anic_status run() {
    return added_ != ANIC_OK ? added_ : anic_encode(encoder_, &options_, &result_);
  }

  std::string text() const { return anic_get_encoder_text(encoder_); }

 private:
  anic_encoder* encoder_ = nullptr;
  anic_status added_ = ANIC_OK;
  anic_encode_options options_ = ANIC_INIT(anic_encode_options);
  anic_encoding result_ = ANIC_INIT(anic_encoding);
};

TEST(EncoderFaults, NoMemoryIsAStatusWhateverTheThreadsAreAt) {
  const MeshSequence sequence = corpus::make_scaled("limb", 100, 6);
  for (const uint32_t threads : {1U, 2U, 4U}) {
    uint64_t calls = 0;
    {
      Encoding whole(sequence, threads);
      const HeapFailure none(UINT64_MAX);
      ASSERT_EQ(whole.run(), ANIC_OK) << whole.text();
      calls = none.calls();
    }
    int failed = 0;
    for (int run = 0; run < kRuns; ++run) {
      Encoding encoding(sequence, threads);
      anic_status status = ANIC_OK;
      {
        const HeapFailure failure(1 + calls * static_cast<uint64_t>(run) / kRuns, run % 2 == 0);
        status = encoding.run();
      }
      EXPECT_TRUE(status == ANIC_OK || status == ANIC_E_MEMORY)
          << run << " of " << threads << " threads: " << status << " " << encoding.text();
      failed += status == ANIC_E_MEMORY;
      // The encoder is whole: it encodes when there is memory again.
      if (run % 20 == 0) {
        EXPECT_EQ(encoding.run(), ANIC_OK) << encoding.text();
      }
    }
    if (calls > 0) {
      EXPECT_GT(failed, kRuns / 2);
    }
  }
}

TEST(EncoderFaults, CoordinatesOfAnySizeAreEncodedOrRefused) {
  const MeshSequence sequence = corpus::make_scaled("limb", 100, 3);
  using Float = std::numeric_limits<float>;
  for (const float scale : {Float::denorm_min(), 1e-40F, 1e-20F, 1e12F, 1e20F, 1e30F, Float::max(),
                            Float::infinity(), Float::quiet_NaN()}) {
    MeshSequence scaled = sequence;
    for (float& x : scaled.positions)
      x *= scale;
    for (const uint32_t threads : {1U, 2U, 4U}) {
      for (int run = 0; run < kRuns / 10; ++run) {
        Encoding encoding(scaled, threads);
        const anic_status status = encoding.run();
        EXPECT_TRUE(status == ANIC_OK || status == ANIC_E_ARGUMENT || status == ANIC_E_NON_FINITE)
            << scale << ": " << encoding.text();
        EXPECT_EQ(encoding.text().empty(), status == ANIC_OK) << scale;
      }
    }
  }
}

}  // namespace
}  // namespace anicodec
