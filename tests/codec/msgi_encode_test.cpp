// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips whose frames are rebuilt from key-frames by multi-scale geometry interpolation.
#include "codec/encode.h"
#include "codec/keyframes/msgi_weights.h"
#include "codec/metrics/metrics.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "sdk/clip/clip.h"
#include "sdk/clip/memory_estimate.h"
#include "sdk/clip/sample.h"
#include "sdk/clip/sample_size.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

EncodeOptions keyframe_options(uint32_t count, InterpolationChoice interpolation) {
  EncodeOptions options;
  options.keyframes = count;
  options.basis = BasisChoice::kKeyframes;
  options.interpolation = interpolation;
  options.encoder = "test";
  return options;
}

void open(const EncodeResult& result, Clip& clip) {
  const Failure failure = clip.open({result.file.data(), result.file.size()});
  ASSERT_TRUE(failure.ok()) << status_string(failure.status) << " " << failure.detail;
}

TEST(MsgiEncode, PlaysWhatTheEncoderMeasured) {
  for (const char* name : {"helix", "limb", "soup", "nonmanifold", "leftovers", "polygons"}) {
    const MeshSequence source = corpus::make_clip(name);
    const EncodeResult result = encode(source, keyframe_options(4, InterpolationChoice::kMsgi));
    Clip clip;
    open(result, clip);
    ASSERT_EQ(clip.segments().size(), 1U);
    EXPECT_EQ(clip.segments()[0].reconstruction, Reconstruction::kMsgi);
    EXPECT_TRUE(clip.check_hashes().ok());
    MeshSequence played = source;
    for (uint32_t f = 0; f < source.frame_count; ++f)
      ASSERT_EQ(show_positions(clip, 0, f, played.frame(f).data()), Status::kOk);
    EXPECT_NEAR(compare(source, played, {false}).kg, result.kg, 1e-3 + 1e-3 * result.kg) << name;
  }
}

TEST(MsgiEncode, WindsUpAHelixFromFewerKeyframesThanStraightLines) {
  const MeshSequence helix = corpus::make_clip("helix");
  const double linear = encode(helix, keyframe_options(6, InterpolationChoice::kLinear)).kg;
  const double msgi = encode(helix, keyframe_options(6, InterpolationChoice::kMsgi)).kg;
  EXPECT_LT(msgi, 0.3 * linear);
}

TEST(MsgiEncode, AutoIsNeverWorseThanStraightLines) {
  for (const char* name : {"helix", "limb", "cloth", "waves"}) {
    const MeshSequence source = corpus::make_clip(name);
    const EncodeResult linear = encode(source, keyframe_options(5, InterpolationChoice::kLinear));
    const EncodeResult msgi = encode(source, keyframe_options(5, InterpolationChoice::kMsgi));
    const EncodeResult best = encode(source, keyframe_options(5, InterpolationChoice::kAuto));
    EXPECT_LE(best.kg, std::min(linear.kg, msgi.kg) * 1.000001) << name;
  }
}

TEST(MsgiEncode, ReachesAnErrorAndKeepsABound) {
  const MeshSequence helix = corpus::make_clip("helix");
  EncodeOptions options;
  options.basis = BasisChoice::kKeyframes;
  options.interpolation = InterpolationChoice::kMsgi;
  options.target = {ErrorMetric::kKg, 0.5, false};
  const EncodeResult msgi = encode(helix, options);
  EXPECT_LE(msgi.kg, 0.5);
  options.interpolation = InterpolationChoice::kLinear;
  EXPECT_LT(msgi.file.size(), encode(helix, options).file.size());
  options.interpolation = InterpolationChoice::kAuto;
  options.target = {ErrorMetric::kMaxError, 0.5, true};
  const EncodeResult bounded = encode(helix, options);
  EXPECT_LE(bounded.max_error, 0.005 * bounded.diagonal);
}

TEST(MsgiEncode, SamplesBetweenFrames) {
  const MeshSequence helix = corpus::make_clip("helix");
  const EncodeResult result = encode(helix, keyframe_options(6, InterpolationChoice::kMsgi));
  Clip clip;
  open(result, clip);
  std::vector<float> buffer(sample_size(clip, 0).buffer()),
      scratch(sample_size(clip, 0).scratch / sizeof(float)), whole(3 * size_t{helix.vertex_count}),
      x = whole, before = whole, after = whole;
  auto sample_at = [&](FrameMix mix, std::vector<float>& out) {
    const Sample sample = make_sample(clip, 0, mix, buffer.data(), scratch.data());
    VertexOutput output;
    output.data = out.data();
    sample.positions(0, helix.vertex_count, output);
    // Ranges of vertices have the same bits.
    std::vector<float> part(3 * 50);
    output.data = part.data();
    sample.positions(37, 50, output);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), out.begin() + 3 * 37));
  };
  FrameMix mix;
  mix.count = 1;
  mix.terms[0].frame = 20;
  mix.terms[0].weight = 1;
  sample_at(mix, before);
  ASSERT_EQ(show_positions(clip, 0, 20, whole.data()), Status::kOk);
  EXPECT_EQ(before, whole);
  mix.terms[0].frame = 21;
  sample_at(mix, after);
  mix.count = 2;
  mix.terms[0] = {20, 0.5};
  mix.terms[1] = {21, 0.5};
  sample_at(mix, x);
  double largest = 0, apart = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    largest =
        std::max(largest, std::abs(double{x[i]} - (double{before[i]} + double{after[i]}) / 2));
    apart = std::max(apart, std::abs(double{after[i]} - double{before[i]}));
  }
  EXPECT_LE(largest, 0.3 * apart);
  EXPECT_GE(largest, 0.0001 * apart);
}

TEST(MsgiEncode, KnowsItsMemory) {
  const EncodeResult result = encode(corpus::make_scaled("helix", 3000, 30),
                                     keyframe_options(5, InterpolationChoice::kMsgi));
  Clip clip;
  open(result, clip);
  const auto resident = static_cast<double>(clip.resident_bytes());
  const auto estimate = static_cast<double>(estimate_memory(clip.limits()).resident);
  EXPECT_LE(resident, estimate);
  EXPECT_LE(estimate, 4 * resident);
  OpenOptions small;
  small.limits.resident_bytes = clip.resident_bytes() / 2;
  EXPECT_EQ(Clip().open({result.file.data(), result.file.size()}, small).status, Status::kLimit);
}

TEST(MsgiEncode, IsTakenUnaskedWhereLimbsSwingFar) {
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 0.1, false};
  const MeshSequence helix = corpus::make_clip("helix");
  const EncodeResult msgi = encode(helix, options);
  options.interpolation = InterpolationChoice::kLinear;
  const EncodeResult linear = encode(helix, options);
  EXPECT_LT(static_cast<double>(msgi.file.size()), 0.9 * static_cast<double>(linear.file.size()));
  Clip clip, base;
  open(msgi, clip);
  open(linear, base);
  EXPECT_EQ(clip.limits().features(), kMsgiFeature);
  EXPECT_EQ(base.limits().features(), 0U);
  EXPECT_TRUE(msgi.search_notes.empty());
  EXPECT_TRUE(linear.search_notes.empty());
  // A size that is asked for is spent on the error.
  options.interpolation.reset();
  options.target = {ErrorMetric::kSize, 4000, false};
  const EncodeResult sized = encode(helix, options);
  EXPECT_LE(sized.file.size(), 4000U);
  EXPECT_EQ(sized.kind, BasisKind::kKeyframes);
}

TEST(MsgiEncode, IsNotTakenUnaskedElsewhere) {
  for (const char* name : {"limb", "noisy", "points"}) {
    EncodeOptions options;
    options.target = {ErrorMetric::kKg, 0.1, false};
    const MeshSequence source = corpus::make_clip(name);
    const EncodeResult best = encode(source, options);
    options.interpolation = InterpolationChoice::kLinear;
    EXPECT_EQ(best.file, encode(source, options).file) << name;
    EXPECT_EQ(best.search_notes.empty(), source.polygons.size() == 0) << name;
  }
}

TEST(MsgiEncode, NeedsKeyframes) {
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 1, false};
  options.interpolation = InterpolationChoice::kMsgi;
  EXPECT_THROW(encode(corpus::make_clip("limb"), options), Error);
}

}  // namespace
}  // namespace anicodec
