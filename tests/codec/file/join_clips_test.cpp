// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/join_clips.h"

#include "codec/encode.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "sdk/clip/sample.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::HasSubstr;

EncodeOptions options_of(ErrorMetric metric, double value) {
  EncodeOptions options;
  options.target = {metric, value, metric == ErrorMetric::kMaxError};
  options.effort = Effort::kFast;
  return options;
}

std::vector<Bytes> parts_of(const MeshSequence& clip, std::vector<uint32_t> cuts,
                            EncodeOptions options) {
  std::vector<Bytes> files;
  cuts.push_back(clip.frame_count);
  uint32_t first = 0;
  for (uint32_t end : cuts) {
    options.part = FrameRun{first, end - first};
    files.push_back(encode(clip, options).file);
    first = end;
  }
  return files;
}

Bytes joined(const std::vector<Bytes>& files) {
  std::vector<ClipPart> parts;
  for (size_t i = 0; i < files.size(); ++i)
    parts.push_back({"part " + std::to_string(i), files[i]});
  return join_clips(parts);
}

std::string fault_of(const std::vector<Bytes>& files) {
  try {
    joined(files);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(JoinClips, MakesOneClipThatKeepsThePromiseOfItsParts) {
  for (const char* name : {"limb", "cuts", "leftovers", "soup", "quad_box"}) {
    SCOPED_TRACE(name);
    const MeshSequence source = corpus::make_clip(name);
    const EncodeOptions options = options_of(ErrorMetric::kMaxError, 0.1);
    const std::vector<Bytes> files = parts_of(source, {7, 12}, options);
    const Bytes file = joined(files);
    Clip clip;
    ASSERT_TRUE(clip.open(file).ok());
    ASSERT_EQ(clip.frame_count(), source.frame_count);
    ASSERT_EQ(clip.vertex_count(), source.vertex_count);
    std::vector<float> frame(size_t{3} * source.vertex_count);
    double largest = 0, squared = 0;
    for (uint32_t f = 0; f < source.frame_count; ++f) {
      ASSERT_EQ(show_positions(clip, 0, f, frame.data()), Status::kOk);
      for (size_t v = 0; v < source.vertex_count; ++v) {
        double d = 0;
        for (size_t c = 3 * v; c < 3 * v + 3; ++c)
          d += std::pow(static_cast<double>(frame[c]) - static_cast<double>(source.frame(f)[c]), 2);
        largest = std::max(largest, std::sqrt(d));
        squared += d;
      }
    }
    EXPECT_LE(largest, 0.001 * diagonal(source));
    EXPECT_NEAR(clip.clips()[0].max_error, largest, 1e-6 * largest);
    EXPECT_NEAR(clip.clips()[0].rmse, std::sqrt(squared / source.vertex_count / source.frame_count),
                1e-6 * largest);
    size_t together = 0;
    for (const Bytes& part : files)
      together += part.size();
    EXPECT_LT(file.size(), together) << "the mesh is stored once";
  }
}

TEST(JoinClips, KeepsTimesAndErrorsOfTheWhole) {
  const MeshSequence source = corpus::make_clip("uneven");
  const EncodeOptions options = options_of(ErrorMetric::kKg, 0.5);
  Clip clip;
  const Bytes file = joined(parts_of(source, {10}, options));
  ASSERT_TRUE(clip.open(file).ok());
  ASSERT_EQ(clip.clips()[0].times.size(), source.times.size());
  for (size_t f = 0; f < source.times.size(); ++f)
    EXPECT_NEAR(clip.clips()[0].times[f], source.times[f], 1e-9);
  EXPECT_LE(clip.clips()[0].kg, 0.5);
  EXPECT_GT(clip.clips()[0].kg, 0.1);
}

TEST(JoinClips, TakesPartsInAnyOrder) {
  const std::vector<Bytes> files =
      parts_of(corpus::make_clip("limb"), {8, 16}, options_of(ErrorMetric::kMaxError, 0.5));
  EXPECT_EQ(joined({files[2], files[0], files[1]}), joined(files));
}

TEST(JoinClips, RefusesPartsThatDoNotFit) {
  const EncodeOptions options = options_of(ErrorMetric::kMaxError, 0.5);
  const MeshSequence limb = corpus::make_clip("limb");
  std::vector<Bytes> files = parts_of(limb, {8, 16}, options);
  EXPECT_THAT(fault_of({files[0], files[2]}), HasSubstr("part 1: starts at"));
  EXPECT_THAT(fault_of({files[1], files[0], files[1]}), HasSubstr("does not follow part 0"));

  const MeshSequence box = corpus::make_clip("quad_box");
  EXPECT_THAT(fault_of({files[0], encode(box, options).file}), HasSubstr("part 1: has "));
  EXPECT_THAT(fault_of({files[0], encode(limb, options).file}),
              HasSubstr("part 1: does not have the connectivity, welds and reference pose"));
  files[1][files[1].size() / 2] ^= 1;
  EXPECT_THAT(fault_of(files), HasSubstr("part 1: "));
}

TEST(JoinClips, PartsAreOfTheClipAndWithoutKeyframes) {
  EncodeOptions options = options_of(ErrorMetric::kMaxError, 0.5);
  const MeshSequence limb = corpus::make_clip("limb");
  options.part = FrameRun{0, limb.frame_count + 1};
  EXPECT_THROW(encode(limb, options), Error);
  options.part = FrameRun{0, 5};
  options.basis = BasisChoice::kKeyframes;
  EXPECT_THROW(encode(limb, options), Error);
}

}  // namespace
}  // namespace anicodec
