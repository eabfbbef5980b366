// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/sample.h"
#include "tests/api/all_files.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <thread>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// A frame as the kernel alone makes it, past samples and contexts.
std::vector<float> played(const Clip& clip, uint32_t frame) {
  const Segment& segment = *clip.segment_at(0, frame);
  FrameState state = clip.state_of(segment, frame - segment.first_frame);
  std::vector<float> shape(shape_size(segment)), scratch(shape_scratch_size(segment));
  make_shape(&state, shape.data(), scratch.data());
  std::vector<float> positions(size_t{3} * segment.vertices);
  play(state, 0, segment.vertices, positions.data());
  return positions;
}

void seek(const Context& context, double seconds, anic_sampling interpolation,
          anic_wrap wrap = ANIC_WRAP_CLAMP) {
  ASSERT_EQ(anic_seek_time(context.get(), seconds, interpolation, wrap), ANIC_OK);
}

TEST(AnicSampling, GivesThePositionsOfTheClip) {
  for (const auto& [name, basis] : cases()) {
    SCOPED_TRACE(name);
    const Bytes& file = encoded_clip(name, basis);
    Clip clip;
    ASSERT_TRUE(clip.open(file).ok());
    const Asset asset = open(file);
    const Context context = context_of(asset);
    std::vector<float> shown(size_t{3} * clip.vertex_count());
    for (uint32_t f = 0; f < clip.frame_count(); ++f) {
      const std::vector<float> expected = played(clip, f);
      ASSERT_EQ(show_positions(clip, 0, f, shown.data()), Status::kOk);
      EXPECT_EQ(shown, expected);
      ASSERT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
      EXPECT_EQ(positions(asset, context), expected);
      // The same at the frame's time, whatever the interpolation.
      for (anic_sampling i : {ANIC_SAMPLE_STEP, ANIC_SAMPLE_LINEAR, ANIC_SAMPLE_CUBIC}) {
        seek(context, anic_get_frame_time(asset.get(), f), i);
        EXPECT_EQ(positions(asset, context), expected);
      }
    }
  }
}

TEST(AnicSampling, AnyOrderGivesTheSameBits) {
  for (const auto& [name, basis] : cases()) {
    SCOPED_TRACE(name);
    const Asset asset = open(encoded_clip(name, basis));
    const anic_asset_info info = info_of(asset);

    struct Step {
      double time;
      int interpolation, wrap;
    };

    std::vector<Step> steps;
    std::mt19937 random(3);
    for (int i = 0; i < 40; ++i)
      steps.push_back({(random() % 4000 / 1000.0 - 1) * info.loop_duration,
                       static_cast<int>(random() % 3), static_cast<int>(random() % 3)});
    auto sample = [&](const Context& context, const Step& s) {
      seek(context, s.time, static_cast<anic_sampling>(s.interpolation),
           static_cast<anic_wrap>(s.wrap));
      return positions(asset, context);
    };
    const Context one = context_of(asset);
    std::vector<std::vector<float>> forwards;
    for (const Step& s : steps)
      forwards.push_back(sample(one, s));
    std::vector<size_t> order(steps.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    for (size_t i : order)
      EXPECT_EQ(sample(one, steps[i]), forwards[i]);
    EXPECT_EQ(sample(context_of(asset), steps[7]), forwards[7]);
  }
}

TEST(AnicSampling, RangesAndThreadsGiveTheSameBits) {
  const Bytes cut = cut_clip();
  for (const Bytes* file : {&cut, &encoded_clip("limb", BasisChoice::kEigentrajectories)}) {
    const Asset asset = open(*file);
    const Context context = context_of(asset);
    const uint32_t n = vertices_of(asset);
    seek(context, 23.4 / 24, ANIC_SAMPLE_LINEAR);
    const std::vector<float> whole = positions(asset, context);
    for (uint32_t first : {0U, 1U, 15U, 16U, 257U}) {
      for (uint32_t count : {0U, 1U, 31U, n - 257}) {
        std::vector<float> part(size_t{3} * count);
        const anic_output output = floats(part);
        ASSERT_EQ(anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, first, count, &output),
                  ANIC_OK);
        EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin() + ptrdiff_t{3} * first));
      }
    }
    std::vector<float> together(whole.size());
    std::vector<std::thread> threads;
    for (uint32_t t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        const uint32_t first = n * t / 4, end = n * (t + 1) / 4;
        anic_output output = ANIC_INIT(anic_output);
        output.data = together.data() + size_t{3} * first;
        output.size = size_t{12} * (end - first);
        anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, first, end - first, &output);
      });
    }
    for (std::thread& t : threads)
      t.join();
    EXPECT_EQ(together, whole);
  }
}

TEST(AnicSampling, WritesAnyFormatAndStrideAndNothingElse) {
  const Asset asset = open(encoded_clip("cloth", BasisChoice::kEigenshapes));
  const Context context = context_of(asset);
  const uint32_t n = vertices_of(asset);
  seek(context, 0.2, ANIC_SAMPLE_LINEAR);
  const std::vector<float> p = positions(asset, context);
  std::vector<unsigned char> bytes(size_t{n} * 20, 0xAB);
  anic_output output = ANIC_INIT(anic_output);
  output.data = bytes.data() + 1;
  output.stride = 20;
  output.size = size_t{20} * (n - 1) + 8;
  output.format = ANIC_FORMAT_UNORM16X4;
  const float low = -100, scale = 200;
  std::fill_n(output.offset, 3, low);
  std::fill_n(output.scale, 3, scale);
  ASSERT_EQ(anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0, n, &output), ANIC_OK);
  for (uint32_t v = 0; v < n; ++v) {
    uint16_t q[4];
    std::memcpy(q, bytes.data() + 1 + size_t{20} * v, 8);
    EXPECT_EQ(q[3], 65535);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(low + scale * q[c] / 65535.0F, p[3 * v + c], scale / 65535);
    for (size_t b = 9; b < 20; ++b)
      EXPECT_EQ(bytes[size_t{20} * v + b], 0xAB);
  }
  --output.size;
  EXPECT_EQ(anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0, n, &output),
            ANIC_E_BUFFER_SIZE);
  output.stride = 7;
  EXPECT_EQ(anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0, n, &output),
            ANIC_E_ARGUMENT);
}

TEST(AnicSampling, MakesSeveralFramesAtOnce) {
  const Asset asset = open(cut_clip());
  const uint32_t n = vertices_of(asset);
  const uint32_t frames[7] = {22, 23, 24, 25, 3, 47, 3};
  std::vector<float> out[7];
  anic_output outputs[7];
  for (int i = 0; i < 7; ++i) {
    out[i].resize(size_t{3} * n);
    outputs[i] = floats(out[i]);
  }
  ASSERT_EQ(anic_write_frames(asset.get(), 0, frames, 7, 0, n, outputs), ANIC_OK);
  for (int i = 0; i < 7; ++i)
    EXPECT_EQ(out[i], frame(asset, frames[i]));
  const uint32_t behind = 48;
  EXPECT_EQ(anic_write_frames(asset.get(), 0, &behind, 1, 0, n, outputs), ANIC_E_FRAME_RANGE);
}

/// a (1 - t) + b t.
std::vector<float> mixed(const std::vector<float>& a, const std::vector<float>& b, double t) {
  std::vector<float> result(a.size());
  for (size_t i = 0; i < a.size(); ++i)
    result[i] =
        static_cast<float>((1 - t) * static_cast<double>(a[i]) + t * static_cast<double>(b[i]));
  return result;
}

// Weights are linear in the positions, where there are neither motions nor corrections.
TEST(AnicSampling, LinearInterpolationIsThatOfPositions) {
  for (BasisChoice basis : {BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories}) {
    const Asset asset = open(encoded_clip("cloth", basis));
    const Context context = context_of(asset);
    for (uint32_t f : {0U, 7U, 20U}) {
      for (double t : {0.25, 0.5, 0.9}) {
        seek(context, (f + t) / 24, ANIC_SAMPLE_LINEAR);
        anic_parts shown = ANIC_INIT(anic_parts);
        ASSERT_EQ(anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &shown), ANIC_OK);
        EXPECT_EQ(shown.count, 1U);
        EXPECT_EQ(shown.parts[0].correction_count, 0U);
        const std::vector<float> a = frame(asset, f), b = frame(asset, f + 1);
        const double correction = 2 * info_of(asset).max_error;  // corrections are left out
        EXPECT_LE(largest_difference(positions(asset, context), mixed(a, b, t)), correction);
      }
    }
    seek(context, 7.99 / 24, ANIC_SAMPLE_STEP);
    EXPECT_EQ(positions(asset, context), frame(asset, 7));
  }
}

TEST(AnicSampling, FramesOfTwoSegmentsAreBothMade) {
  const Asset asset = open(cut_clip());
  const Context context = context_of(asset);
  ASSERT_EQ(info_of(asset).segment_count, 2U);
  anic_parts shown = ANIC_INIT(anic_parts);
  for (double t : {0.1, 0.5, 0.8}) {
    seek(context, (23 + t) / 24, ANIC_SAMPLE_LINEAR);
    ASSERT_EQ(anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &shown), ANIC_OK);
    ASSERT_EQ(shown.count, 2U);
    EXPECT_FLOAT_EQ(shown.parts[0].share, static_cast<float>(1 - t));
    const std::vector<float> expected = mixed(frame(asset, 23), frame(asset, 24), t);
    EXPECT_LE(largest_difference(positions(asset, context), expected),
              1e-5 * diagonal(corpus::make_scaled("limb", 300, 48)) + 2e-2);
    // A smooth curve passes close by, and has two frames in each.
    seek(context, (23 + t) / 24, ANIC_SAMPLE_CUBIC);
    ASSERT_EQ(anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &shown), ANIC_OK);
    EXPECT_EQ(shown.count, 2U);
    EXPECT_FLOAT_EQ(shown.parts[0].share + shown.parts[1].share, 1);
    EXPECT_LE(largest_difference(positions(asset, context), expected),
              largest_difference(frame(asset, 22), frame(asset, 25)));
  }
}

/// A sheet that moves along a curve of time, which every interpolation of order three keeps.
MeshSequence moving_sheet(uint32_t frames, std::vector<double> times, double (*curve)(double)) {
  MeshSequence clip = corpus::make_scaled("cloth", 100, frames);
  for (uint32_t f = 0; f < frames; ++f) {
    const double t = times.empty() ? f / 24.0 : times[f];
    std::span<float> frame = clip.frame(f);
    for (size_t i = 0; i < frame.size(); ++i)
      frame[i] = clip.frame(0)[i] + (i % 3 == 0 ? static_cast<float>(curve(t)) : 0);
  }
  clip.times = std::move(times);
  return clip;
}

Asset opened(const MeshSequence& clip) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1e-4, true};
  options.basis = BasisChoice::kEigenshapes;
  options.effort = Effort::kFast;
  return open(encode(clip, options).file);
}

TEST(AnicSampling, CubicInterpolationFollowsAParabola) {
  auto parabola = [](double t) { return 20 * t * t - 3 * t; };
  std::vector<double> uneven(12);
  for (size_t f = 0; f < uneven.size(); ++f)
    uneven[f] = 0.04 * static_cast<double>(f) + (f % 3 == 1 ? 0.012 : 0);
  for (const std::vector<double>& times : {std::vector<double>{}, uneven}) {
    const MeshSequence clip = moving_sheet(12, times, parabola);
    const Asset asset = opened(clip);
    const Context context = context_of(asset);
    EXPECT_EQ(info_of(asset).uneven, !times.empty());
    const double tolerance = 2e-3 * diagonal(clip);
    double worst_linear = 0;
    for (double t = 0.09; t < 0.35; t += 0.0077) {
      seek(context, t, ANIC_SAMPLE_CUBIC);
      const double moved = static_cast<double>(positions(asset, context)[0] - clip.frame(0)[0]);
      // At uneven times the tangents are exact to first order only.
      EXPECT_NEAR(moved, parabola(t) - (times.empty() ? 0 : parabola(0)),
                  times.empty() ? tolerance : 5e-3);
      seek(context, t, ANIC_SAMPLE_LINEAR);
      worst_linear =
          std::max(worst_linear,
                   std::abs(static_cast<double>(positions(asset, context)[0] - clip.frame(0)[0]) -
                            parabola(t)));
    }
    EXPECT_GT(worst_linear, 0.004);
  }
}

TEST(AnicSampling, WrapsTime) {
  auto line = [](double t) { return 10 * t; };
  MeshSequence clip = moving_sheet(9, {}, line);
  clip.start_time = 2;
  const Asset asset = opened(clip);
  const Context context = context_of(asset);
  const anic_asset_info info = info_of(asset);
  EXPECT_EQ(info.start_time, 2);
  EXPECT_DOUBLE_EQ(info.duration, 8 / 24.0);
  EXPECT_EQ(anic_get_frame_time(asset.get(), 0), 0);
  EXPECT_DOUBLE_EQ(info.loop_duration, 9 / 24.0);
  auto x = [&](double frames, anic_wrap wrap) {
    seek(context, frames / 24, ANIC_SAMPLE_LINEAR, wrap);
    return 24 * static_cast<double>(positions(asset, context)[0] - clip.frame(0)[0]) / 10;
  };
  const double e = 0.02;  // frames
  EXPECT_NEAR(x(-3, ANIC_WRAP_CLAMP), 0, e);
  EXPECT_NEAR(x(3.5, ANIC_WRAP_CLAMP), 3.5, e);
  EXPECT_NEAR(x(100, ANIC_WRAP_CLAMP), 8, e);
  EXPECT_NEAR(x(8.5, ANIC_WRAP_LOOP), 4, e);  // between the last frame and the first
  EXPECT_NEAR(x(9 + 2.5, ANIC_WRAP_LOOP), 2.5, e);
  EXPECT_NEAR(x(-1, ANIC_WRAP_LOOP), 8, e);
  EXPECT_NEAR(x(-9e6 - 7, ANIC_WRAP_LOOP), 2, e);
  EXPECT_NEAR(x(8 + 3.5, ANIC_WRAP_PING_PONG), 4.5, e);
  EXPECT_NEAR(x(16 + 3.5, ANIC_WRAP_PING_PONG), 3.5, e);
  EXPECT_NEAR(x(-3.5, ANIC_WRAP_PING_PONG), 3.5, e);
  EXPECT_EQ(anic_seek_time(context.get(), NAN, ANIC_SAMPLE_STEP, ANIC_WRAP_LOOP), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_seek_time(context.get(), INFINITY, ANIC_SAMPLE_STEP, ANIC_WRAP_LOOP),
            ANIC_E_ARGUMENT);
}

TEST(AnicSampling, AClosedLoopLeavesOutTheRepeatedFrame) {
  auto wave = [](double t) { return std::sin(2 * 3.14159265358979 * t * 24 / 8); };
  const MeshSequence clip = moving_sheet(9, {}, wave);
  MeshSequence closed = clip;
  std::copy_n(clip.frame(0).begin(), clip.frame(0).size(), closed.frame(8).begin());
  const Asset asset = opened(closed);
  const Context context = context_of(asset);
  ASSERT_TRUE(info_of(asset).closed);
  EXPECT_DOUBLE_EQ(info_of(asset).loop_duration, 8 / 24.0);
  for (double f = 0; f < 8; f += 0.3) {
    seek(context, f / 24, ANIC_SAMPLE_CUBIC, ANIC_WRAP_LOOP);
    const std::vector<float> a = positions(asset, context);
    seek(context, (f + 16) / 24, ANIC_SAMPLE_CUBIC, ANIC_WRAP_LOOP);
    EXPECT_LE(largest_difference(positions(asset, context), a), 1e-4);
    EXPECT_NEAR(static_cast<double>(a[0] - clip.frame(0)[0]), wave(f / 24), 0.03);
  }
}

TEST(AnicSampling, RigidMotionsTurnTheShorterWay) {
  // A key-frame and a rigid motion for each frame: a box that turns.
  MeshSequence clip = corpus::make_scaled("far", 300, 24);
  EncodeOptions options;
  options.keyframes = 1;
  options.basis = BasisChoice::kKeyframes;
  const Bytes file = encode(clip, options).file;
  Clip inside;
  ASSERT_TRUE(inside.open(file).ok());
  ASSERT_FALSE(inside.segments()[0].motions.empty());
  const Asset asset = open(file);
  const Context context = context_of(asset);
  for (double f = 0.5; f < 23; f += 1) {
    seek(context, f / 24, ANIC_SAMPLE_LINEAR);
    anic_parts shown = ANIC_INIT(anic_parts);
    ASSERT_EQ(anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &shown), ANIC_OK);
    // Half of the turn: the same angle, and less than a quarter, from either side.
    double cosine[2] = {0, 0};
    for (int side = 0; side < 2; ++side) {
      const float* m = inside.segments()[0].motions[static_cast<size_t>(f) + side].m;
      for (int i = 0; i < 12; ++i)
        cosine[side] += i % 4 == 3 ? 0
                                   : static_cast<double>(m[i]) *
                                         static_cast<double>(shown.parts[0].motion[i]) / 2;
      cosine[side] -= 0.5;
    }
    EXPECT_NEAR(cosine[0], cosine[1], 1e-5);
    EXPECT_GT(cosine[0], 0);
    for (int r = 0; r < 3; ++r) {  // it stays a rotation
      for (int s = 0; s < 3; ++s) {
        double dot = 0;
        for (int i = 0; i < 3; ++i)
          dot += static_cast<double>(shown.parts[0].motion[4 * r + i]) *
                 static_cast<double>(shown.parts[0].motion[4 * s + i]);
        EXPECT_NEAR(dot, r == s ? 1 : 0, 1e-5);
      }
    }
  }
}

TEST(AnicSampling, RemembersWhatWasShownBefore) {
  const Asset asset = open(cut_clip());
  const Context context = context_of(asset);
  std::vector<float> out(size_t{3} * vertices_of(asset));
  const anic_output output = floats(out);
  EXPECT_EQ(anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0, 1, &output), ANIC_E_STATE);
  EXPECT_EQ(anic_forget_previous(context.get()), ANIC_E_STATE);
  seek(context, 5.3 / 24, ANIC_SAMPLE_CUBIC);
  const std::vector<float> a = positions(asset, context);
  EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), a);
  seek(context, 23.6 / 24, ANIC_SAMPLE_LINEAR);
  const std::vector<float> b = positions(asset, context);
  EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), a);
  ASSERT_EQ(anic_seek_frame(context.get(), 40), ANIC_OK);
  EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), b);
  seek(context, 23.6 / 24, ANIC_SAMPLE_LINEAR);
  ASSERT_EQ(anic_forget_previous(context.get()), ANIC_OK);
  EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), b);
  seek(context, 1.5 / 24, ANIC_SAMPLE_LINEAR);  // overwrites what was copied from
  EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), b);
  EXPECT_EQ(anic_seek_frame(context.get(), 48), ANIC_E_FRAME_RANGE);
}

TEST(AnicSampling, FindsBoxes) {
  anic_options options = ANIC_INIT(anic_options);
  options.flags = ANIC_OPEN_BOUNDS;
  for (const Bytes& file : {cut_clip(), encoded_clip("points", BasisChoice::kEigenshapes)}) {
    const Asset asset = open(file, &options);
    const Context context = context_of(asset);
    anic_box clip, box, table, around = {{1e9F, 1e9F, 1e9F}, {-1e9F, -1e9F, -1e9F}};
    ASSERT_EQ(anic_get_clip_bounds(asset.get(), 0, &clip), ANIC_OK);
    for (uint32_t f = 0; f < info_of(asset).frame_count; ++f) {
      anic_box expected = {{1e9F, 1e9F, 1e9F}, {-1e9F, -1e9F, -1e9F}};
      const std::vector<float> p = frame(asset, f);
      for (size_t i = 0; i < p.size(); ++i) {
        expected.min[i % 3] = std::min(expected.min[i % 3], p[i]);
        expected.max[i % 3] = std::max(expected.max[i % 3], p[i]);
      }
      ASSERT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
      ASSERT_EQ(anic_compute_bounds(context.get(), 0, ANIC_WHEN_CURRENT, &box), ANIC_OK);
      ASSERT_EQ(anic_get_frame_bounds(asset.get(), 0, f, &table), ANIC_OK);
      EXPECT_EQ(std::memcmp(&box, &expected, sizeof box), 0);
      EXPECT_EQ(std::memcmp(&table, &expected, sizeof box), 0);
      for (int c = 0; c < 3; ++c) {
        around.min[c] = std::min(around.min[c], expected.min[c]);
        around.max[c] = std::max(around.max[c], expected.max[c]);
      }
    }
    EXPECT_EQ(std::memcmp(&clip, &around, sizeof clip), 0);
    EXPECT_EQ(anic_get_frame_bounds(asset.get(), 0, info_of(asset).frame_count, &box),
              ANIC_E_FRAME_RANGE);
    EXPECT_EQ(anic_get_clip_bounds(open(file).get(), 0, &box), ANIC_E_STATE);
  }
}

/// One vertex, computed as a shader does it.
void shade(const anic_basis& basis, const anic_part& part, const float* pose_maps, uint32_t v,
           double (&out)[3]) {
  const size_t b = v / ANIC_BLOCK_VERTICES, i = v % ANIC_BLOCK_VERTICES;
  const size_t region = basis.vertex_region ? basis.vertex_region[v] : 0;
  const float* weights = part.weights + region * basis.components * basis.weight_channels;
  double x[3] = {0, 0, 0};
  if (basis.pose) {
    for (int r = 0; r < 3; ++r) {
      const float* row = pose_maps + 12 * region + size_t{4} * static_cast<size_t>(r);
      x[r] = static_cast<double>(row[3]);
      for (size_t c = 0; c < 3; ++c)
        x[r] += static_cast<double>(row[c]) *
                static_cast<double>(basis.pose[(b * 3 + c) * ANIC_BLOCK_VERTICES + i]);
    }
  }
  const uint32_t wide = basis.wide_components, narrow = basis.components - wide;
  for (uint32_t j = 0; j < basis.components; ++j) {
    for (size_t c = 0; c < 3; ++c) {
      const size_t channel = basis.channels == 3 ? c : 0;
      const double value =
          j < wide
              ? basis.wide[((b * wide + j) * basis.channels + channel) * ANIC_BLOCK_VERTICES + i]
              : basis.narrow[((b * narrow + j - wide) * basis.channels + channel) *
                                 ANIC_BLOCK_VERTICES +
                             i];
      const size_t weight = basis.weight_channels == 3 ? 3 * size_t{j} + c : j;
      x[c] += static_cast<double>(weights[weight]) * value;
    }
  }
  for (size_t r = 0; r < 3; ++r) {
    double moved = static_cast<double>(part.motion[4 * r + 3]);
    for (size_t c = 0; c < 3; ++c)
      moved += static_cast<double>(part.motion[4 * r + c]) *
               (x[c] + static_cast<double>(basis.origin[c]));
    out[r] += static_cast<double>(part.share) * moved;
  }
  for (uint32_t k = 0; k < part.correction_count; ++k) {
    if (part.corrections[k].vertex == v) {
      for (size_t c = 0; c < 3; ++c)
        out[c] +=
            static_cast<double>(part.share) * static_cast<double>(part.corrections[k].delta[c]);
    }
  }
}

TEST(AnicSampling, BasisAndWeightsMakeTheSameFrame) {
  std::vector<Bytes> files = {cut_clip()};
  for (const auto& [name, basis] : cases())
    files.push_back(encoded_clip(name, basis));
  for (const Bytes& file : files) {
    const Asset asset = open(file);
    const Context context = context_of(asset);
    for (double f : {0.0, 3.0, 4.5, 23.4}) {
      seek(context, f / 24, ANIC_SAMPLE_LINEAR);
      anic_parts shown = ANIC_INIT(anic_parts);
      ASSERT_EQ(anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &shown), ANIC_OK);
      const std::vector<float> expected = positions(asset, context);
      double largest = 0, size = 0;
      for (uint32_t v = 0; v < vertices_of(asset); ++v) {
        double x[3] = {0, 0, 0};
        for (uint32_t p = 0; p < shown.count; ++p) {
          anic_basis basis = ANIC_INIT(anic_basis);
          ASSERT_EQ(anic_get_basis(asset.get(), shown.parts[p].segment, &basis), ANIC_OK);
          shade(basis, shown.parts[p], shown.pose_maps[p], v, x);
        }
        for (size_t c = 0; c < 3; ++c) {
          largest = std::max(largest, std::abs(x[c] - static_cast<double>(expected[3 * v + c])));
          size = std::max(size, std::abs(x[c]));
        }
      }
      EXPECT_LE(largest, 2e-5 * size);
    }
  }
}

}  // namespace
}  // namespace anicodec
