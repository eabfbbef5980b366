// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The motion of the whole and events, seen through the C interface.
#include "codec/sequence/clip_library.h"
#include "tests/api/opened.h"

#include <cmath>
#include <cstring>
#include <span>
#include <vector>

namespace anicodec {
namespace {

constexpr uint32_t kWalkFrames = 24;
constexpr double kMaxError = 0.01, kTurnOfFrame = 0.08, kMoveOfFrame = 0.2;

/// A limb that walks in a curve, or stands.
MeshSequence limb(const char* name, UpAxis up, double turn, double move) {
  MeshSequence clip = corpus::make_scaled("limb", 200, kWalkFrames);
  clip.name = name;
  clip.up = up;
  clip.rate = {10, 1, false};
  const size_t a = up == UpAxis::kZ ? 0 : 2, b = up == UpAxis::kZ ? 1 : 0;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    const double c = std::cos(turn * f), s = std::sin(turn * f);
    std::span<float> frame = clip.frame(f);
    for (size_t v = 0; v < frame.size(); v += 3) {
      const double x = frame[v + a], y = frame[v + b];
      frame[v + a] = static_cast<float>(c * x - s * y + move * f);
      frame[v + b] = static_cast<float>(s * x + c * y - move * f / 2);
    }
  }
  return clip;
}

MeshSequence walks(UpAxis up) {
  std::vector<MeshSequence> clips;
  clips.push_back(limb("curve", up, kTurnOfFrame, kMoveOfFrame));
  clips.push_back(limb("stand", up, 0, 0));
  clips.push_back(limb("back", up, -kTurnOfFrame, -kMoveOfFrame));
  clips[0].events = {{"left", 0.2}, {"right", 0.7}};
  return clip_library(std::move(clips));
}

Bytes encoded(UpAxis up, BasisChoice basis) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, kMaxError, false};
  options.basis = basis;
  options.effort = Effort::kFast;
  options.root_motion = true;
  return encode(walks(up), options).file;
}

Asset in_place(const Bytes& file) {
  anic_options options = ANIC_INIT(anic_options);
  options.flags = ANIC_OPEN_IN_PLACE;
  return open(file, &options);
}

/// Positions after a map.
std::vector<float> moved(const float (&m)[12], std::vector<float> points) {
  for (size_t v = 0; v < points.size(); v += 3) {
    const float p[3] = {points[v], points[v + 1], points[v + 2]};
    for (size_t c = 0; c < 3; ++c)
      points[v + c] = m[4 * c] * p[0] + m[4 * c + 1] * p[1] + m[4 * c + 2] * p[2] + m[4 * c + 3];
  }
  return points;
}

void expect_near(const std::vector<float>& a, const std::vector<float>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i)
    ASSERT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(AnicRootMotion, PositionsHaveItAndThePromiseIsOfThem) {
  for (UpAxis up : {UpAxis::kUnknown, UpAxis::kY, UpAxis::kZ}) {
    for (BasisChoice basis :
         {BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories, BasisChoice::kKeyframes}) {
      const MeshSequence source = walks(up);
      const Bytes file = encoded(up, basis);
      const Asset whole = open(file);
      for (uint32_t f = 0; f < source.frame_count; ++f) {
        const std::span<const float> expected = source.frame(f);
        expect_near(frame(whole, f), {expected.begin(), expected.end()}, kMaxError);
      }
      EXPECT_EQ(anic_verify_asset(whole.get()), ANIC_OK);
    }
  }
}

TEST(AnicRootMotion, TakesPositionsWithoutItToThoseWithIt) {
  for (UpAxis up : {UpAxis::kY, UpAxis::kZ}) {
    for (BasisChoice basis : {BasisChoice::kEigenshapes, BasisChoice::kKeyframes}) {
      const Bytes file = encoded(up, basis);
      const Asset whole = open(file), still = in_place(file);
      const Context a = context_of(whole), b = context_of(still);
      for (double time : {0.0, 0.3, 1.234, 2.3, 9.0}) {
        for (uint32_t clip : {0U, 1U, 2U}) {
          for (const Context* context : {&a, &b}) {
            ASSERT_EQ(anic_set_clip(context->get(), clip), ANIC_OK);
            ASSERT_EQ(anic_seek_time(context->get(), time, ANIC_SAMPLE_CUBIC, ANIC_WRAP_LOOP),
                      ANIC_OK);
          }
          anic_root_motion motion = ANIC_INIT(anic_root_motion), shown = motion;
          ASSERT_EQ(anic_get_root_motion(still.get(), clip, time, ANIC_SAMPLE_CUBIC, ANIC_WRAP_LOOP,
                                         &motion),
                    ANIC_OK);
          ASSERT_EQ(anic_get_shown_root_motion(b.get(), ANIC_WHEN_CURRENT, &shown), ANIC_OK);
          EXPECT_EQ(std::memcmp(motion.matrix, shown.matrix, sizeof shown.matrix), 0);
          expect_near(positions(whole, a), moved(motion.matrix, positions(still, b)), 1e-4);
        }
        for (const Context* context : {&a, &b})
          ASSERT_EQ(anic_blend(context->get(), 0, 0.77, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, 0.4),
                    ANIC_OK);
        anic_root_motion blended = ANIC_INIT(anic_root_motion);
        ASSERT_EQ(anic_get_shown_root_motion(a.get(), ANIC_WHEN_CURRENT, &blended), ANIC_OK);
        expect_near(positions(whole, a), moved(blended.matrix, positions(still, b)), 1e-4);
      }
    }
  }
}

TEST(AnicRootMotion, IsThatOfTheSource) {
  const Asset asset = open(encoded(UpAxis::kZ, BasisChoice::kEigenshapes));
  anic_root_motion motion = ANIC_INIT(anic_root_motion);
  ASSERT_EQ(anic_get_root_motion(asset.get(), 0, 1.0, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, &motion),
            ANIC_OK);
  EXPECT_TRUE(motion.moves);
  EXPECT_TRUE(motion.turns);
  anic_root_motion still = ANIC_INIT(anic_root_motion);  // the limb bends by itself
  ASSERT_EQ(anic_get_root_motion(asset.get(), 1, 1.0, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, &still),
            ANIC_OK);
  EXPECT_NEAR(motion.turn - still.turn, 10 * kTurnOfFrame, 1e-3);
  EXPECT_EQ(motion.move[2], 0);
  ASSERT_EQ(anic_get_root_motion(asset.get(), 0, 0, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, &motion),
            ANIC_OK);
  EXPECT_EQ(motion.turn, 0);
  EXPECT_EQ(motion.move[0], 0);
  EXPECT_EQ(anic_get_root_motion(asset.get(), 3, 0, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, &motion),
            ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_get_root_motion(nullptr, 0, 0, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, &motion),
            ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_get_root_motion(asset.get(), 0, std::nan(""), ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP,
                                 &motion),
            ANIC_E_ARGUMENT);
  const Context context = context_of(asset);
  EXPECT_EQ(anic_get_shown_root_motion(context.get(), ANIC_WHEN_CURRENT, &motion), ANIC_E_STATE);
}

TEST(AnicRootMotion, IsNoneInFilesWithout) {
  const Asset asset = open(encoded_clip("limb", BasisChoice::kEigenshapes));
  anic_root_motion motion = ANIC_INIT(anic_root_motion);
  ASSERT_EQ(anic_get_root_motion(asset.get(), 0, 0.5, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, &motion),
            ANIC_OK);
  EXPECT_FALSE(motion.moves || motion.turns);
  for (size_t i = 0; i < 12; ++i)
    EXPECT_EQ(motion.matrix[i], i % 5 == 0 ? 1.F : 0.F);
}

TEST(AnicRootMotion, ABlendOfEqualMomentsIsThatMoment) {
  const Asset asset = open(encoded(UpAxis::kY, BasisChoice::kEigentrajectories));
  const Context context = context_of(asset);
  ASSERT_EQ(anic_seek_time(context.get(), 0.55, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP), ANIC_OK);
  const std::vector<float> before = positions(asset, context);
  ASSERT_EQ(anic_blend(context.get(), 0, 0.55, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, 0.3), ANIC_OK);
  EXPECT_EQ(positions(asset, context), before);
}

TEST(AnicRootMotion, LeavesNoMemoryBehind) {
  expect_no_leak_whichever_allocation_fails(encoded(UpAxis::kY, BasisChoice::kEigenshapes));
}

using Matrix = std::vector<double>;  ///< 3 x 4

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result(12);
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 4; ++c) {
      result[4 * r + c] = c == 3 ? a[4 * r + 3] : 0;
      for (size_t k = 0; k < 3; ++k)
        result[4 * r + c] += a[4 * r + k] * b[4 * k + c];
    }
  }
  return result;
}

double distance(const Matrix& a, const Matrix& b) {
  double most = 0;
  for (size_t i = 0; i < 12; ++i)
    most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

Matrix step(const Asset& asset, double from, double to, anic_wrap wrap = ANIC_WRAP_LOOP) {
  anic_root_motion motion = ANIC_INIT(anic_root_motion);
  EXPECT_EQ(anic_get_root_step(asset.get(), 0, from, to, ANIC_SAMPLE_LINEAR, wrap, &motion),
            ANIC_OK);
  EXPECT_EQ(motion.pivot[0], 0);
  EXPECT_NEAR(motion.move[0], motion.matrix[3], 1e-5);
  return {std::begin(motion.matrix), std::end(motion.matrix)};
}

Matrix motion_at(const Asset& asset, double seconds) {
  anic_root_motion motion = ANIC_INIT(anic_root_motion);
  EXPECT_EQ(
      anic_get_root_motion(asset.get(), 0, seconds, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP, &motion),
      ANIC_OK);
  return {std::begin(motion.matrix), std::end(motion.matrix)};
}

TEST(AnicRootStep, GoesFromOneTimeToAnotherAndOnThroughLoops) {
  for (UpAxis up : {UpAxis::kY, UpAxis::kZ}) {
    const Asset asset = in_place(encoded(up, BasisChoice::kEigentrajectories));
    const double duration = (kWalkFrames - 1) / 10.0, loop = kWalkFrames / 10.0;
    const Matrix still = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    for (anic_wrap wrap : {ANIC_WRAP_CLAMP, ANIC_WRAP_LOOP}) {
      const Matrix s = step(asset, 0.31, 1.87, wrap);
      EXPECT_LT(distance(product(motion_at(asset, 0.31), s), motion_at(asset, 1.87)), 1e-4);
      EXPECT_LT(distance(product(s, step(asset, 1.87, 0.31, wrap)), still), 1e-4);
    }
    EXPECT_LT(distance(step(asset, 7, 9, ANIC_WRAP_CLAMP), still), 1e-9);
    Matrix whole = still;
    for (double t = 0; t < 3.6 * loop - 1e-9; t += loop / 7)
      whole = product(whole, step(asset, t, std::min(t + loop / 7, 3.6 * loop)));
    EXPECT_LT(distance(whole, step(asset, 0, 3.6 * loop)), 1e-3);
    EXPECT_LT(distance(step(asset, -1.1 * loop, 0.4 * loop), step(asset, 3.9 * loop, 5.4 * loop)),
              1e-4);
    // Its pace goes on where the last frame leads to the first.
    EXPECT_LT(distance(step(asset, duration, loop), step(asset, duration - 0.1, duration)), 1e-5);
    anic_root_motion motion = ANIC_INIT(anic_root_motion);
    EXPECT_EQ(
        anic_get_root_step(asset.get(), 0, 0, 1e200, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP, &motion),
        ANIC_E_ARGUMENT);
    EXPECT_EQ(anic_get_root_step(asset.get(), 9, 0, 1, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP, &motion),
              ANIC_E_ARGUMENT);
  }
}

TEST(AnicEvents, AreListedByTime) {
  const Asset asset = open(encoded(UpAxis::kY, BasisChoice::kEigenshapes));
  ASSERT_EQ(anic_get_event_count(asset.get(), 0), 2U);
  EXPECT_EQ(anic_get_event_count(asset.get(), 1), 0U);
  EXPECT_EQ(anic_get_event_count(asset.get(), 9), 0U);
  EXPECT_EQ(anic_get_event_count(nullptr, 0), 0U);
  anic_event event = ANIC_INIT(anic_event);
  ASSERT_EQ(anic_get_event(asset.get(), 0, 1, &event), ANIC_OK);
  EXPECT_STREQ(event.name, "right");
  EXPECT_EQ(event.seconds, 0.7);
  EXPECT_EQ(anic_get_event(asset.get(), 0, 2, &event), ANIC_E_ARGUMENT);
}

}  // namespace
}  // namespace anicodec
