// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/edit_clips.h"

#include "codec/encode.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/container.h"
#include "sdk/clip/sample.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::HasSubstr;

Bytes encoded(const char* name,
              const std::function<void(EncodeOptions&, MeshSequence&)>& change = {}) {
  MeshSequence clip = corpus::make_scaled("limb", 200, 12);
  clip.name = name;
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 0.5, false};
  options.effort = Effort::kFast;
  options.basis = BasisChoice::kEigenshapes;
  if (change)
    change(options, clip);
  return encode(clip, options).file;
}

/// The chunks SEGM, BASI and CORR of a file.
std::multiset<std::string> segments_of(const Bytes& file) {
  ContainerReader reader;
  EXPECT_TRUE(reader.open(file).ok());
  std::multiset<std::string> all;
  for (const Chunk& chunk : reader.chunks()) {
    ByteView view;
    if (chunk.segment != kNoSegment && reader.payload(chunk, &view).ok())
      all.emplace(reinterpret_cast<const char*>(view.data), view.size);
  }
  return all;
}

std::vector<float> frame_of(const Bytes& file, uint32_t frame) {
  Clip clip;
  EXPECT_TRUE(clip.open(file).ok());
  std::vector<float> out(size_t{3} * clip.vertex_count());
  EXPECT_EQ(show_positions(clip, 0, frame, out.data()), Status::kOk);
  return out;
}

std::string fault_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(EditClips, AddsAndRemovesWithoutTouchingTheOthers) {
  const Bytes walk = encoded("walk"),
              run = encoded("run", [&](EncodeOptions&options, MeshSequence&clip) {
                options.root_motion = true;
                options.pose = clip_home({"walk", walk}).pose;
                for (uint32_t f = 0; f < clip.frame_count; ++f) {
                  for (size_t i = 0; i < clip.frame(f).size(); i += 3)
                    clip.frame(f)[i] += static_cast<float>(f);
                }
              });
  const Bytes both = add_clips({"walk", walk}, {"run", run});
  EXPECT_LT(both.size(), walk.size() + run.size() - 300);  // one mesh and pose
  std::multiset<std::string> expected = segments_of(walk);
  expected.merge(segments_of(run));
  EXPECT_EQ(segments_of(both), expected);
  for (uint32_t f : {0U, 5U, 11U}) {
    EXPECT_EQ(frame_of(both, f), frame_of(walk, f));
    EXPECT_EQ(frame_of(both, 12 + f), frame_of(run, f));
  }
  EXPECT_EQ(remove_clips({"both", both}, {"run"}), walk);
  const Bytes only = remove_clips({"both", both}, {"walk"});
  EXPECT_EQ(segments_of(only), segments_of(run));
  for (uint32_t f : {0U, 5U, 11U})
    EXPECT_EQ(frame_of(only, f), frame_of(run, f));
}

TEST(EditClips, AClipMayBringItsPose) {
  const Bytes walk = encoded("walk"),
              run = encoded(
                  "run", [](EncodeOptions&options, MeshSequence&) { options.target.value = 0.2; });
  const Bytes both = add_clips({"walk", walk}, {"run", run});
  for (uint32_t f : {0U, 11U})
    EXPECT_EQ(frame_of(both, 12 + f), frame_of(run, f));
}

TEST(EditClips, RefusesInOneLine) {
  const Bytes walk = encoded("walk"), run = encoded("run");
  const Bytes both = add_clips({"walk", walk}, {"run", run});
  EXPECT_THAT(fault_of([&] {
                add_clips({"a", both}, {"b", run});
              }),
              HasSubstr("has a clip 'run' already"));
  EXPECT_THAT(fault_of([&] {
                remove_clips({"a", both}, {"fly"});
              }),
              HasSubstr("has no clip 'fly'"));
  EXPECT_THAT(fault_of([&] {
                remove_clips({"a", both}, {"run", "walk"});
              }),
              HasSubstr("the last clip"));
  const Bytes other = encoded("other", [](EncodeOptions&, MeshSequence& clip) {
    clip.polygons = Polygons();
    clip.polygons.add(std::vector<uint32_t>{0, 1, 2});
  });
  EXPECT_THAT(fault_of([&] {
                add_clips({"a", walk}, {"b", other});
              }),
              HasSubstr("another connectivity"));
  Bytes damaged = walk;
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_THAT(fault_of([&] { add_clips({"a", damaged}, {"b", run}); }), HasSubstr("a: "));
}

}  // namespace
}  // namespace anicodec
