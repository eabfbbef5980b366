// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_mesh.h"

#include "codec/encode.h"
#include "corpus/clips.h"
#include "format/bounds_record.h"
#include "format/container.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

EncodeOptions coarse() {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.5, true};
  options.effort = Effort::kFast;
  return options;
}

EncodedMesh encoded(const MeshSequence& clip, const EncodeOptions& options = coarse()) {
  return encode_mesh(clip, plan_mesh(clip, options), {});
}

TEST(EncodeMesh, ByItselfMakesTheFileOfEncode) {
  const MeshSequence clip = corpus::make_scaled("limb", 200, 12);
  const EncodedMesh mesh = encoded(clip);
  EXPECT_EQ(mesh.file(), encode(clip, coarse()).file);
  EXPECT_TRUE(mesh.result.file.empty());
  EXPECT_EQ(mesh.record.clips[0].max_error, mesh.result.max_error);
}

/// A clip and the same a hundred times as large, each with a basis of its own, and values that move.
MeshSequence small_and_large() {
  MeshSequence clip = corpus::make_clip("heated");
  const uint32_t half = clip.frame_count / 2;
  for (size_t i = size_t{3} * clip.vertex_count * half; i < clip.positions.size(); ++i)
    clip.positions[i] *= 100;
  for (const uint32_t frames : {half, clip.frame_count - half}) {
    ClipTiming& timing = clip.clips.emplace_back();
    timing.name = std::to_string(frames) + (clip.clips.size() == 1 ? " small" : " large");
    timing.frame_count = frames;
  }
  return clip;
}

TEST(EncodeMesh, EverySegmentOfPositionsHasItsBoxes) {
  const MeshSequence clip = small_and_large();
  EncodeOptions options = coarse();
  options.target = {ErrorMetric::kKg, 0.05, false};
  const EncodedMesh mesh = encoded(clip, options);
  size_t of_positions = 0, of_attributes = 0;
  for (const EncodedSegment& segment : mesh.segments) {
    if (segment.sizes.attribute != kPositions) {
      ++of_attributes;
      continue;
    }
    ++of_positions;
    for (uint32_t f = 0; f < segment.sizes.frames; ++f) {
      const Box box = segment.bounds.of_frame(f);
      const std::span<const float> shown = clip.frame(segment.sizes.first_frame + f);
      const double error = mesh.result.max_error;
      for (size_t i = 0; i < shown.size(); ++i) {
        ASSERT_GE(shown[i], box.low[i % 3] - error);
        ASSERT_LE(shown[i], box.high[i % 3] + error);
      }
    }
  }
  EXPECT_GE(of_positions, 2U);
  EXPECT_GE(of_attributes, 1U);
}

TEST(EncodeMesh, ARunHasTheMeshOfTheWhole) {
  const MeshSequence clip = corpus::make_scaled("limb", 200, 12);
  EncodeOptions options = coarse();
  std::vector<EncodedMesh> runs;
  for (const FrameRun& run : {FrameRun{0, 5}, FrameRun{5, 7}}) {
    options.part = run;
    runs.push_back(encode_mesh(clip, plan_mesh(clip, options), {}));
    EXPECT_EQ(runs.back().result.frames, run.count);
  }
  EXPECT_EQ(runs[0].layout.faces, runs[1].layout.faces);
  EXPECT_EQ(runs[0].result.diagonal, runs[1].result.diagonal);
  ASSERT_TRUE(runs[0].segments[0].reference && runs[1].segments[0].reference);
  EXPECT_EQ(runs[0].segments[0].reference->stream, runs[1].segments[0].reference->stream);
}

}  // namespace
}  // namespace anicodec
