// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Every playing kernel on clips that went through the codec.
#include "codec/encode.h"
#include "corpus/clips.h"
#include "sdk/clip/clip.h"
#include "sdk/play/play.h"
#include "sdk/play/play_job.h"
#include "tests/codec/real_clip.h"
#include "tests/sdk/position_tolerance.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

std::vector<float> played(const PlayKernels& kernels, const std::vector<FrameState>& states,
                          size_t which) {
  const uint32_t vertices = states[0].segment->vertices;
  std::vector<std::vector<float>> out(states.size(), std::vector<float>(size_t{3} * vertices));
  std::vector<VertexOutput> outputs(states.size());
  for (size_t f = 0; f < states.size(); ++f)
    outputs[f].data = out[f].data();
  play_with(kernels, states.data(), static_cast<uint32_t>(states.size()), 0, vertices,
            outputs.data());
  return out[which];
}

void expect_all_kernels_within_tolerance(const MeshSequence& sequence, BasisChoice basis) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.05, true};
  options.basis = basis;
  options.effort = Effort::kFast;
  Clip clip;
  ASSERT_TRUE(clip.open(encode(sequence, options).file).ok());
  const PlayKernels* all[kMaxPlayKernels];
  const size_t count = all_play_kernels(all);
  for (const Segment& segment : clip.segments()) {
    const uint32_t frames = std::min(4U, segment.frames);
    std::vector<FrameState> states;
    for (uint32_t f = 0; f < frames; ++f)
      states.push_back(frame_state(segment, segment.frames - 1 - f));
    for (size_t k = 0; k < count; ++k) {
      const PlayKernels& kernels = *all[k];
      std::vector<float> together = played(kernels, states, frames - 1);
      EXPECT_LE(tolerance_used(segment, segment.frames - frames, together), 1) << kernels.name;
      EXPECT_EQ(together, played(kernels, {states.back()}, 0)) << kernels.name;
      if (!kernels.fused) {
        EXPECT_EQ(together, played(kPlayKernelsScalar, states, frames - 1)) << kernels.name;
      }
    }
  }
}

class CombineClips : public testing::TestWithParam<BasisChoice> {};

TEST_P(CombineClips, KeepToTheToleranceWithEveryKernel) {
  for (const char* name : {"waves", "one_triangle"}) {
    SCOPED_TRACE(name);
    expect_all_kernels_within_tolerance(corpus::make_clip(name), GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, CombineClips,
                         testing::Values(BasisChoice::kKeyframes, BasisChoice::kEigenshapes,
                                         BasisChoice::kEigentrajectories));

TEST(RealDataCombine, KeepsToTheToleranceWithEveryKernel) {
  RealClip real = read_real_clip("classic/dance.pc2");
  if (real.frame_count == 0)
    GTEST_SKIP() << "classic/dance.pc2 is absent; ANICODEC_DATA names the folder of real clips";
  MeshSequence sequence;  // points only: the kernels do not look at faces
  sequence.vertex_count = static_cast<uint32_t>(real.vertex_count);
  sequence.frame_count = std::min<uint32_t>(12, static_cast<uint32_t>(real.frame_count));
  sequence.positions.assign(real.positions.begin(),
                            real.positions.begin() + static_cast<ptrdiff_t>(3 * real.vertex_count) *
                                                         sequence.frame_count);
  for (BasisChoice basis : {BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories})
    expect_all_kernels_within_tolerance(sequence, basis);
}

}  // namespace
}  // namespace anicodec
