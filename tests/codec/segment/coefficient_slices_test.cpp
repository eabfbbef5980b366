// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/coefficient_slices.h"

#include "codec/encode.h"
#include "corpus/clips.h"
#include "sdk/clip/clip.h"
#include "tests/sdk/threads.h"

#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Bytes encoded(BasisChoice basis, uint32_t vertices, uint32_t frames, uint32_t slices,
              OpeningChoice opening = OpeningChoice::kSmall) {
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 0.05, false};
  options.basis = basis;
  options.effort = 1;
  options.slices = slices;
  options.opening = opening;
  return encode(corpus::make_scaled("limb", vertices, frames), options).file;
}

struct Decoded {
  std::vector<float> frames;
  uint32_t slices = 0;
  uint64_t hash = 0;
};

Decoded decoded(const Bytes& file, const HostThreads& threads = {}, double quality = 1) {
  OpenOptions options;
  options.threads = threads;
  options.quality = quality;
  Clip clip;
  EXPECT_TRUE(clip.open(file, options).ok());
  EXPECT_TRUE(quality < 1 || clip.check_hashes().ok());
  Decoded result;
  for (uint32_t f = 0; f < clip.frame_count(); ++f) {
    std::vector<float> frame(size_t{3} * clip.vertex_count());
    EXPECT_EQ(clip.positions(0, f, frame.data()), Status::kOk);
    result.frames.insert(result.frames.end(), frame.begin(), frame.end());
  }
  result.slices = clip.segments()[0].slices;
  result.hash = clip.segments()[0].decoded_hash;
  return result;
}

TEST(CoefficientSlices, DecodeToTheSameOnAnyThreads) {
  for (const BasisChoice basis : {BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories}) {
    const Bytes one = encoded(basis, 1500, 20, 1);
    const Decoded whole = decoded(one), half = decoded(one, {}, 0.5);
    EXPECT_EQ(whole.slices, 1U);
    for (const uint32_t slices : {2U, 4U, 8U}) {
      const Bytes file = encoded(basis, 1500, 20, slices);
      EXPECT_NE(file, one);
      for (const HostThreads& threads : {HostThreads(), three_threads()}) {
        const Decoded sliced = decoded(file, threads);
        EXPECT_EQ(sliced.slices, slices);
        EXPECT_EQ(sliced.hash, whole.hash);
        EXPECT_EQ(sliced.frames, whole.frames);
        EXPECT_EQ(decoded(file, threads, 0.5).frames, half.frames);
      }
    }
  }
}

TEST(CoefficientSlices, GrowByTheShareOfTheFileThatIsAllowed) {
  const Bytes one = encoded(BasisChoice::kEigentrajectories, 6000, 40, 1);
  const Bytes chosen = encoded(BasisChoice::kEigentrajectories, 6000, 40, 0);
  EXPECT_LE(static_cast<double>(chosen.size()), 1.003 * static_cast<double>(one.size()));
  EXPECT_EQ(decoded(chosen).frames, decoded(one).frames);
  // Nothing to gain where there is little to read.
  EXPECT_EQ(encoded(BasisChoice::kEigentrajectories, 500, 12, 0),
            encoded(BasisChoice::kEigentrajectories, 500, 12, 1));
}

TEST(CoefficientSlices, AreNotForBatches) {
  const Bytes file =
      encoded(BasisChoice::kEigentrajectories, 500, 12, 4, OpeningChoice::kFast);
  EXPECT_EQ(decoded(file).slices, 1U);
}

}  // namespace
}  // namespace anicodec
