// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files that give the source's positions back bit for bit.
#include "codec/encode.h"
#include "codec/file/edit_clips.h"
#include "codec/file/join_clips.h"
#include "codec/sequence/clip_library.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "sdk/clip/memory_estimate.h"
#include "sdk/clip/sample.h"

#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

EncodeOptions lossless(BasisChoice basis = BasisChoice::kAuto) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0, false};
  options.basis = basis;
  options.effort = Effort::kFast;
  return options;
}

Clip opened(const Bytes& file, const OpenOptions& options = {}) {
  Clip clip;
  const Failure failure = clip.open(file, options);
  EXPECT_TRUE(failure.ok()) << status_string(failure.status) << ": " << failure.detail;
  return clip;
}

bool same_bits(const Clip& clip, uint32_t mesh, uint32_t frame, std::span<const float> source) {
  std::vector<float> shown(source.size());
  return show_positions(clip, mesh, frame, shown.data()) == Status::kOk &&
         std::memcmp(shown.data(), source.data(), source.size_bytes()) == 0;
}

void expect_source(const Bytes& file, const MeshSequence& source) {
  const Clip clip = opened(file);
  EXPECT_TRUE(clip.check_hashes().ok());
  for (uint32_t f = 0; f < source.frame_count; ++f)
    ASSERT_TRUE(same_bits(clip, 0, f, source.frame(f))) << "frame " << f;
  for (const ClipRecord& record : clip.clips()) {
    EXPECT_EQ(record.asked, ErrorMetric::kMaxError);
    EXPECT_EQ(record.asked_value, 0);
    EXPECT_EQ(record.max_error, 0);
    EXPECT_EQ(record.kg, 0);
  }
  EXPECT_LE(clip.resident_bytes(), estimate_memory(clip.limits()).resident);
}

TEST(Lossless, GivesEveryClipOfTheCorpusBackBitForBit) {
  for (const char* name : {"limb", "soup", "static", "one_frame", "one_vertex", "points", "tiny",
                           "large", "repeats", "leftovers", "uneven", "polygons"}) {
    SCOPED_TRACE(name);
    const MeshSequence source = corpus::make_clip(name);
    expect_source(encode(source, lossless()).file, source);
  }
}

TEST(Lossless, GoesWithEveryBasisAndOrder) {
  MeshSequence source = corpus::make_scaled("limb", 200, 12);
  source.positions[7] = -0.0F;
  for (BasisChoice basis :
       {BasisChoice::kKeyframes, BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories}) {
    for (OrderMode order : {OrderMode::kVertices, OrderMode::kAll}) {
      EncodeOptions options = lossless(basis);
      options.order = order;
      expect_source(encode(source, options).file, source);
    }
  }
  EncodeOptions msgi = lossless(BasisChoice::kKeyframes);
  msgi.keyframes = 4;
  msgi.interpolation = InterpolationChoice::kMsgi;
  expect_source(encode(source, msgi).file, source);
  EncodeOptions free = lossless();
  free.order = OrderMode::kFree;
  EXPECT_EQ(encode(source, free).max_error, 0);
}

TEST(Lossless, IsOfOneMeshBesideOthers) {
  Scene scene;
  for (const char* name : {"limb", "cloth"}) {
    SceneMesh& mesh = scene.meshes.emplace_back();
    mesh.sequence = corpus::make_scaled(name, 200, 10);
    mesh.sequence.mesh_name = name;
    mesh.present_in = {{0, 10}};
  }
  scene.meshes[1].present_in = {{0, 4}, {6, 6}};
  scene.clip.frame_count = 12;
  scene.meshes[0].present_in = {{2, 10}};
  const Bytes file = encode(scene, lossless()).file;
  const Clip clip = opened(file);
  EXPECT_TRUE(clip.check_hashes().ok());
  for (uint32_t f = 0; f < 10; ++f) {
    EXPECT_TRUE(same_bits(clip, 0, f + 2, scene.meshes[0].sequence.frame(f)));
    EXPECT_TRUE(same_bits(clip, 1, f < 4 ? f : f + 2, scene.meshes[1].sequence.frame(f)));
  }
  EXPECT_EQ(clip.clips()[0].max_error, 0);
}

TEST(Lossless, SeveralClipsAndTheirMotionOfTheWholeApart) {
  std::vector<MeshSequence> clips;
  for (const char* name : {"walk", "stand", "run"}) {
    MeshSequence& clip = clips.emplace_back(corpus::make_scaled("limb", 150, 10));
    clip.name = name;
    clip.up = UpAxis::kY;
    for (uint32_t f = 0; f < 10 && clip.name != "stand"; ++f) {
      for (size_t v = 0; v < clip.frame(f).size(); v += 3)
        clip.frame(f)[v] += 0.2F * static_cast<float>(f);
    }
  }
  const MeshSequence source = clip_library(std::move(clips));
  EncodeOptions options = lossless();
  expect_source(encode(source, options).file, source);
  options.root_motion = true;
  const Bytes file = encode(source, options).file;
  expect_source(file, source);
  OpenOptions in_place;
  in_place.in_place = true;
  const Clip still = opened(file, in_place);
  EXPECT_FALSE(same_bits(still, 0, 5, source.frame(5)));
  EXPECT_EQ(same_bits(still, 0, 15, source.frame(15)), still.root().holds(1) == 0);

  OpenOptions one;
  const char* names[] = {"run"};
  one.clips = {names, 1};
  const Clip run = opened(file, one);
  for (uint32_t f = 20; f < 30; ++f)
    EXPECT_TRUE(same_bits(run, 0, f, source.frame(f)));
}

TEST(Lossless, PartsAreJoinedAndClipsAddedAndRemoved) {
  const MeshSequence source = corpus::make_scaled("limb", 150, 20);
  std::vector<Bytes> files;
  for (uint32_t first : {0U, 8U}) {
    EncodeOptions options = lossless(BasisChoice::kEigenshapes);
    options.part = FrameRun{first, first == 0 ? 8U : 12U};
    files.push_back(encode(source, options).file);
  }
  const Bytes joined = join_clips({{"a", files[0]}, {"b", files[1]}});
  expect_source(joined, source);

  MeshSequence other = corpus::make_scaled("limb", 150, 7);
  other.name = "other";
  const Bytes two = add_clips({"joined", joined},
                              {"other", encode(other, lossless(BasisChoice::kEigenshapes)).file});
  const Clip clip = opened(two);
  EXPECT_TRUE(same_bits(clip, 0, 3, source.frame(3)));
  EXPECT_TRUE(same_bits(clip, 0, 23, other.frame(3)));
  expect_source(remove_clips({"two", two}, {"other"}), source);
}

TEST(Lossless, IsLeftClosedAtLowerQualityOrWhenAsked) {
  const MeshSequence source = corpus::make_scaled("limb", 200, 12);
  const Bytes file = encode(source, lossless()).file;
  OpenOptions closed, coarse;
  closed.inexact = true;
  coarse.quality = 0.5;
  for (const OpenOptions& options : {closed, coarse}) {
    const Clip clip = opened(file, options);
    EXPECT_FALSE(same_bits(clip, 0, 5, source.frame(5)));
    EXPECT_LE(clip.resident_bytes(),
              estimate_memory(clip.limits(), options.quality, false).resident);
  }
  EXPECT_LT(estimate_memory(opened(file).limits(), 1, false).resident + 12 * 200 * 12 - 1,
            estimate_memory(opened(file).limits()).resident);
}

TEST(Lossless, EveryPrefixPlaysOrIsRefusedAndTheWholeIsExact) {
  const MeshSequence source = corpus::make_scaled("limb", 100, 6);
  const Bytes file = encode(source, lossless(BasisChoice::kEigenshapes)).file;
  OpenOptions options;
  options.prefix = true;
  bool played = false;
  for (size_t size = 0; size < file.size(); size += 7) {
    Clip clip;
    if (!clip.open({file.data(), size}, options).ok() || !clip.segments()[0].frames)
      continue;
    played = true;
    EXPECT_TRUE(clip.is_partial());
    EXPECT_FALSE(same_bits(clip, 0, 3, source.frame(3)));
  }
  EXPECT_TRUE(played);
}

TEST(Lossless, GoesWithoutMassage) {
  EncodeOptions options = lossless();
  options.massage.mode = MassageMode::kOn;
  try {
    encode(corpus::make_scaled("limb", 100, 6), options);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    EXPECT_THAT(e.what(), testing::HasSubstr("massage"));
  }
}

}  // namespace
}  // namespace anicodec
