// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files of several clips, seen through the C interface.
#include "codec/sequence/clip_library.h"
#include "format/container.h"
#include "sdk/clip/sample.h"
#include "sdk/play/play.h"
#include "sdk/segment/keep_frames.h"
#include "tests/api/opened.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace anicodec {
namespace {

constexpr const char* kNames[] = {"walk", "run", "jump"};
constexpr uint32_t kFrameCounts[] = {20, 31, 9};
constexpr double kKg = 0.5;

/// Three clips of a limb: one calm, one wild, one of uneven times.
MeshSequence limbs() {
  std::vector<MeshSequence> clips;
  for (size_t c = 0; c < 3; ++c) {
    MeshSequence clip = corpus::make_scaled("limb", 300, 40);
    clip.name = kNames[c];
    clip.frame_count = kFrameCounts[c];
    clip.positions.resize(size_t{3} * clip.vertex_count * clip.frame_count);
    for (uint32_t f = 0; f < clip.frame_count; ++f) {
      for (size_t i = 0; i < clip.frame(f).size(); ++i)
        clip.frame(f)[i] += c == 1 ? 0.2F * std::sin(0.7F * static_cast<float>(f + i % 17)) : 0.F;
    }
    clip.rate = {c == 1 ? 60U : 30U, 1, false};
    clip.loop = c == 0;
    for (uint32_t f = 0; c == 2 && f < clip.frame_count; ++f)
      clip.times.push_back(0.01 * f * f);
    clips.push_back(std::move(clip));
  }
  return clip_library(std::move(clips));
}

const EncodeResult& encoded_limbs(BasisChoice basis) {
  static std::map<BasisChoice, EncodeResult> results;
  EncodeResult& result = results[basis];
  if (result.file.empty()) {
    EncodeOptions options;
    options.target = {ErrorMetric::kKg, kKg, false};
    options.basis = basis;
    options.effort = Effort::kNormal;
    result = encode(limbs(), options);
  }
  return result;
}

const BasisChoice kBases[] = {BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories,
                              BasisChoice::kKeyframes};

TEST(AnicClips, EachHasItsNameClockAndPromise) {
  for (BasisChoice basis : kBases) {
    const Asset asset = open(encoded_limbs(basis).file);
    ASSERT_EQ(anic_get_clip_count(asset.get()), 3U);
    EXPECT_EQ(info_of(asset).frame_count, 60U);
    EXPECT_STREQ(info_of(asset).name, "walk");
    uint32_t first = 0;
    for (uint32_t c = 0; c < 3; ++c) {
      anic_clip clip = ANIC_INIT(anic_clip);
      ASSERT_EQ(anic_get_clip(asset.get(), c, &clip), ANIC_OK);
      EXPECT_STREQ(clip.name, kNames[c]);
      EXPECT_EQ(clip.first_frame, first);
      EXPECT_EQ(clip.frame_count, kFrameCounts[c]);
      EXPECT_EQ(clip.rate_numerator, c == 1 ? 60U : 30U);
      EXPECT_EQ(clip.uneven, c == 2);
      EXPECT_EQ(clip.loop, c == 0);
      EXPECT_TRUE(clip.open);
      EXPECT_LE(clip.kg, kKg);
      EXPECT_GT(clip.kg, 0);
      EXPECT_NEAR(clip.duration, c == 2 ? 0.64 : (kFrameCounts[c] - 1) / (c == 1 ? 60.0 : 30.0),
                  1e-12);
      uint32_t found = 9;
      EXPECT_EQ(anic_find_clip(asset.get(), kNames[c], &found), ANIC_OK);
      EXPECT_EQ(found, c);
      EXPECT_EQ(anic_get_frame_time(asset.get(), first), 0);
      EXPECT_EQ(anic_get_frame_time(asset.get(), first + kFrameCounts[c] - 1), clip.duration);
      first += kFrameCounts[c];
    }
    uint32_t found = 0;
    EXPECT_EQ(anic_find_clip(asset.get(), "fly", &found), ANIC_E_ABSENT);
    anic_clip clip = ANIC_INIT(anic_clip);
    EXPECT_EQ(anic_get_clip(asset.get(), 3, &clip), ANIC_E_ARGUMENT);
    EXPECT_EQ(anic_get_clip_count(nullptr), 0U);
  }
}

TEST(AnicClips, ErrorsOfClipsAreNearTheTargetWhereTheyShareABasis) {
  const EncodeResult& result = encoded_limbs(BasisChoice::kEigenshapes);
  ASSERT_EQ(result.clips.size(), 3U);
  for (const ClipResult& clip : result.clips)
    EXPECT_LE(clip.kg, kKg) << clip.name;
  EXPECT_GT(std::max({result.clips[0].kg, result.clips[1].kg, result.clips[2].kg}), 0.9 * kKg);
}

TEST(AnicClips, TimesAreOfTheChosenClip) {
  for (BasisChoice basis : kBases) {
    const Asset asset = open(encoded_limbs(basis).file);
    const Context context = context_of(asset);
    const auto shown = [&](double time, anic_wrap wrap) {
      EXPECT_EQ(anic_seek_time(context.get(), time, ANIC_SAMPLE_CUBIC, wrap), ANIC_OK);
      return positions(asset, context);
    };
    const auto frame = [&](uint32_t f) {
      EXPECT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
      return positions(asset, context);
    };
    uint32_t first = 0;
    for (uint32_t c = 0; c < 3; ++c) {
      anic_clip clip = ANIC_INIT(anic_clip);
      anic_get_clip(asset.get(), c, &clip);
      ASSERT_EQ(anic_set_clip(context.get(), c), ANIC_OK);
      EXPECT_EQ(shown(0, ANIC_WRAP_CLAMP), frame(first));
      EXPECT_EQ(shown(-1, ANIC_WRAP_CLAMP), frame(first));
      // Nothing leads over to the next clip.
      EXPECT_EQ(shown(clip.duration + 1e-3, ANIC_WRAP_CLAMP), frame(first + kFrameCounts[c] - 1));
      EXPECT_EQ(shown(clip.loop_duration, ANIC_WRAP_LOOP), frame(first));
      first += kFrameCounts[c];
    }
    EXPECT_EQ(anic_set_clip(context.get(), 3), ANIC_E_ARGUMENT);
    EXPECT_EQ(anic_set_clip(nullptr, 0), ANIC_E_ARGUMENT);
  }
}

TEST(AnicClips, BlendFadesFromOneMomentToAnother) {
  for (BasisChoice basis : kBases) {
    const Asset asset = open(encoded_limbs(basis).file);
    const Context context = context_of(asset);
    const auto seek = [&](uint32_t clip, double time) {
      ASSERT_EQ(anic_set_clip(context.get(), clip), ANIC_OK);
      ASSERT_EQ(anic_seek_time(context.get(), time, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP), ANIC_OK);
    };
    const auto blend = [&](uint32_t clip, double time, double weight) {
      return anic_blend(context.get(), clip, time, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP, weight);
    };
    EXPECT_EQ(blend(0, 0, 0.5), ANIC_E_STATE);
    seek(1, 0.22);
    const std::vector<float> run = positions(asset, context);
    seek(0, 0.31);
    const std::vector<float> walk = positions(asset, context);
    EXPECT_EQ(blend(1, 0.22, 0), ANIC_OK);
    EXPECT_EQ(positions(asset, context), walk);
    EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), run);
    for (double weight : {0.1, 0.3, 0.77}) {
      EXPECT_EQ(blend(0, 0.31, weight), ANIC_OK);
      EXPECT_EQ(positions(asset, context), walk) << weight;
    }
    EXPECT_EQ(blend(1, 0.22, 0.25), ANIC_OK);
    const std::vector<float> between = positions(asset, context);
    for (size_t i = 0; i < walk.size() && basis != BasisChoice::kKeyframes; ++i)
      EXPECT_NEAR(between[i], 0.75F * walk[i] + 0.25F * run[i], 1e-3F);
    EXPECT_EQ(blend(1, 0.22, 1), ANIC_OK);
    EXPECT_EQ(positions(asset, context), run);
    EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), run);
    EXPECT_EQ(blend(2, 0.11, 0.5), ANIC_OK);  // more than two
    EXPECT_EQ(blend(0, 0.05, 0.5), ANIC_OK);
    EXPECT_EQ(blend(3, 0, 0.5), ANIC_E_ARGUMENT);
    EXPECT_EQ(blend(0, 0, 1.5), ANIC_E_ARGUMENT);
    EXPECT_EQ(blend(0, std::nan(""), 0.5), ANIC_E_ARGUMENT);
    // As many moments as fit, then no more; what is shown stays.
    anic_status status = ANIC_OK;
    for (int i = 0; i < 16 && status == ANIC_OK; ++i)
      status = blend(1, 0.02 * i + 0.005, 0.5);
    EXPECT_EQ(status, ANIC_E_LIMIT);
    EXPECT_EQ(anic_forget_previous(context.get()), ANIC_OK);
    EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), positions(asset, context));
  }
}

TEST(AnicClips, SomeCanBeOpenedAlone) {
  for (BasisChoice basis : kBases) {
    const Bytes& file = encoded_limbs(basis).file;
    const Asset all = open(file);
    const Context of_all = context_of(all);
    const char* names[] = {"jump", "run"};
    anic_options options = ANIC_INIT(anic_options);
    options.clips = names;
    for (uint32_t count : {1U, 2U}) {
      options.clip_count = count;
      const Asset some = open(file, &options);
      EXPECT_LT(info_of(some).resident_bytes, info_of(all).resident_bytes);
      EXPECT_LE(info_of(some).context_bytes, info_of(all).context_bytes);
      const Context context = context_of(some);
      EXPECT_EQ(anic_set_clip(context.get(), 0), ANIC_E_ABSENT);
      EXPECT_EQ(anic_set_clip(context.get(), 2), ANIC_OK);
      anic_clip clip = ANIC_INIT(anic_clip);
      anic_get_clip(some.get(), 0, &clip);
      EXPECT_FALSE(clip.open);
      for (uint32_t f = count == 1 ? 51 : 20; f < 60; ++f) {
        ASSERT_EQ(anic_seek_frame(of_all.get(), f), ANIC_OK);
        ASSERT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
        EXPECT_EQ(positions(some, context), positions(all, of_all));
      }
      ASSERT_EQ(anic_seek_frame(context.get(), 3), ANIC_OK);
      anic_box box;
      EXPECT_EQ(anic_compute_bounds(context.get(), 0, ANIC_WHEN_CURRENT, &box), ANIC_E_ABSENT);
      EXPECT_EQ(anic_verify_asset(some.get()), ANIC_OK);
    }
    names[1] = "fly";
    options.clip_count = 2;
    anic_asset* asset = nullptr;
    EXPECT_EQ(anic_open_asset(file.data(), file.size(), &options, &asset, nullptr), ANIC_E_ABSENT);
    names[1] = nullptr;
    EXPECT_EQ(anic_open_asset(file.data(), file.size(), &options, &asset, nullptr),
              ANIC_E_ARGUMENT);
  }
}

Asset share(const Asset& of, const anic_options* options = nullptr) {
  anic_asset* asset = nullptr;
  EXPECT_EQ(anic_share_asset(of.get(), options, &asset), ANIC_OK);
  return Asset(asset);
}

TEST(AnicShare, AssetsOfOneFileShareItsMemory) {
  const Bytes& file = encoded_limbs(BasisChoice::kEigentrajectories).file;
  CountingMemory memory;
  anic_options options = ANIC_INIT(anic_options);
  options.allocator = memory.allocator();
  options.flags = ANIC_OPEN_BOUNDS;
  Asset first = open(file, &options);
  const size_t opened = memory.held;
  const Context of_all = context_of(first);
  ASSERT_EQ(anic_seek_frame(of_all.get(), 55), ANIC_OK);
  const std::vector<float> expected = positions(first, of_all);

  const Asset same = share(first);
  const char* names[] = {"jump"};
  options.clips = names;
  options.clip_count = 1;
  const Asset some = share(first, &options);
  EXPECT_LT(memory.held, opened + 4096 + info_of(same).context_bytes);
  EXPECT_LT(info_of(same).resident_bytes, 1024U);
  anic_basis a = ANIC_INIT(anic_basis), b = ANIC_INIT(anic_basis);
  ASSERT_EQ(anic_get_basis(first.get(), 0, &a), ANIC_OK);
  ASSERT_EQ(anic_get_basis(some.get(), 0, &b), ANIC_OK);
  EXPECT_EQ(a.narrow, b.narrow);

  anic_clip clip = ANIC_INIT(anic_clip);
  uint32_t jump = 0;
  ASSERT_EQ(anic_find_clip(some.get(), "jump", &jump), ANIC_OK);
  for (uint32_t c = 0; c < anic_get_clip_count(some.get()); ++c) {
    ASSERT_EQ(anic_get_clip(some.get(), c, &clip), ANIC_OK);
    EXPECT_EQ(clip.open, c == jump) << c;
  }
  const Context context = context_of(some);
  const uint32_t other = jump == 0 ? 1 : 0;
  EXPECT_EQ(anic_set_clip(context.get(), other), ANIC_E_ABSENT);
  ASSERT_EQ(anic_get_clip(some.get(), other, &clip), ANIC_OK);
  anic_box box;
  ASSERT_EQ(anic_seek_frame(context.get(), clip.first_frame), ANIC_OK);
  EXPECT_EQ(anic_compute_bounds(context.get(), 0, ANIC_WHEN_CURRENT, &box), ANIC_E_ABSENT);
  EXPECT_EQ(anic_get_frame_bounds(some.get(), 0, clip.first_frame, &box), ANIC_E_ABSENT);
  EXPECT_EQ(anic_get_frame_bounds(same.get(), 0, clip.first_frame, &box), ANIC_OK);

  first.reset();  // and its context must not be used any more
  const Context again = context_of(same);
  ASSERT_EQ(anic_seek_frame(again.get(), 55), ANIC_OK);
  EXPECT_EQ(positions(same, again), expected);
  EXPECT_EQ(anic_verify_asset(same.get()), ANIC_OK);
  anic_asset* refused = nullptr;
  names[0] = clip.name;
  EXPECT_EQ(anic_share_asset(some.get(), &options, &refused), ANIC_E_ABSENT);
  names[0] = "fly";
  EXPECT_EQ(anic_share_asset(same.get(), &options, &refused), ANIC_E_ABSENT);
  options.clip_count = 0;
  options.flags = 0;
  EXPECT_EQ(anic_share_asset(same.get(), &options, &refused), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_share_asset(nullptr, nullptr, &refused), ANIC_E_ARGUMENT);
  EXPECT_EQ(refused, nullptr);
}

TEST(AnicShare, MemoryGoesWithTheLastAssetOnAnyThread) {
  const Bytes& file = encoded_limbs(BasisChoice::kEigentrajectories).file;
  Asset first = open(file);
  const Context context = context_of(first);
  ASSERT_EQ(anic_seek_frame(context.get(), 7), ANIC_OK);
  const std::vector<float> expected = positions(first, context);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([mine = share(first).release(), &expected, t] {
      Asset asset(mine);
      for (int i = 0; i < 50; ++i) {
        asset = share(asset);
        const Context own = context_of(asset);
        ASSERT_EQ(anic_seek_frame(own.get(), i % 2 ? 7 : static_cast<uint32_t>(t)), ANIC_OK);
        const std::vector<float> shown = positions(asset, own);
        if (i % 2) {
          ASSERT_EQ(shown, expected);
        }
      }
    });
  }
  first.reset();
  for (std::thread& thread : threads)
    thread.join();
}

TEST(AnicShare, FewerComponentsAreThoseOfAnAssetOpenedSo) {
  for (BasisChoice basis : kBases) {
    const Bytes& file = encoded_limbs(basis).file;
    const Asset whole = open(file);
    anic_options options = ANIC_INIT(anic_options);
    options.quality = 0.5;
    const Asset coarse = open(file, &options), shared = share(share(whole, &options));
    const Context context = context_of(shared), expected = context_of(coarse);
    for (uint32_t f : {0U, 19U, 59U}) {
      ASSERT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
      ASSERT_EQ(anic_seek_frame(expected.get(), f), ANIC_OK);
      const std::vector<float> p = positions(shared, context);
      EXPECT_EQ(p, positions(coarse, expected));
      std::vector<float> q(p.size());
      const anic_output output = floats(q);
      ASSERT_EQ(anic_write_frames(shared.get(), 0, &f, 1, 0, vertices_of(shared), &output),
                ANIC_OK);
      EXPECT_EQ(q, p);
    }
    EXPECT_EQ(anic_verify_asset(shared.get()), ANIC_OK) << "what the file holds";
  }
}

TEST(AnicClips, ComponentsThatRestAreGivenBack) {
  Clip clip;
  ASSERT_TRUE(clip.open(encoded_limbs(BasisChoice::kEigenshapes).file).ok());
  Segment segment = clip.segments()[0];
  ASSERT_GT(segment.components, 2U);
  const size_t row = size_t{segment.components} * segment.weight_channels();
  for (uint32_t f = 0; f < 5; ++f)
    segment.weights[f * row] = segment.weights[f * row + 2] = 0;
  const Segment before = segment;
  keep_frames(0, 5, &segment);
  EXPECT_EQ(segment.components, before.components - 2);
  EXPECT_EQ(segment.frames, 5U);
  std::vector<float> a(size_t{3} * segment.vertices), b(a.size());
  for (uint32_t f = 0; f < 5; ++f) {
    play(frame_state(before, f), 0, segment.vertices, a.data());
    play(frame_state(segment, f), 0, segment.vertices, b.data());
    EXPECT_EQ(a, b);
  }
}

TEST(AnicClips, AFileOfOneClipIsNoLargerForIt) {
  MeshSequence alone = corpus::make_scaled("limb", 300, 20), listed = alone;
  listed.clips = clips_of(listed);
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, kKg, false};
  options.effort = Effort::kFast;
  EXPECT_EQ(encode(alone, options).file, encode(listed, options).file);
}

}  // namespace
}  // namespace anicodec
