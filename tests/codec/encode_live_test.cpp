// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_live.h"

#include "codec/file/live_stream.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/continuation.h"
#include "sdk/clip/sample.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

EncodeOptions options_of(double max_error_percent) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, max_error_percent, true};
  options.effort = Effort::kFast;
  return options;
}

FrameArray frames_of(const MeshSequence& clip, uint32_t first, uint32_t count) {
  const auto begin = clip.positions.begin() + ptrdiff_t{3} * clip.vertex_count * first;
  return {begin, begin + ptrdiff_t{3} * clip.vertex_count * count};
}

/// The stream of a clip, so many frames a file.
std::vector<Bytes> streamed(const MeshSequence& clip, uint32_t frames,
                            const EncodeOptions& options) {
  MeshSequence mesh = clip;
  mesh.positions = {};
  LiveEncoder encoder(mesh, options);
  std::vector<Bytes> files;
  for (uint32_t f = 0; f < clip.frame_count; f += frames)
    files.push_back(
        encoder.encode(frames_of(clip, f, std::min(frames, clip.frame_count - f))).file);
  return files;
}

Bytes joined(const std::vector<Bytes>& files) {
  Bytes stream;
  for (const Bytes& file : files)
    stream.insert(stream.end(), file.begin(), file.end());
  EXPECT_EQ(is_live_stream(stream), files.size() > 1);
  const LiveStream read = read_live_stream({"stream", stream});
  EXPECT_EQ(read.files.size(), files.size());
  EXPECT_EQ(read.incomplete, 0U);
  std::vector<ClipPart> parts;
  for (const Bytes& file : read.files)
    parts.push_back({"file", file});
  return join_clips(parts);
}

double largest_error(const Bytes& file, const MeshSequence& clip) {
  Clip opened;
  EXPECT_TRUE(opened.open(file).ok());
  EXPECT_EQ(opened.frame_count(), clip.frame_count);
  std::vector<float> frame(size_t{3} * clip.vertex_count);
  double largest = 0;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    EXPECT_EQ(show_positions(opened, 0, f, frame.data()), Status::kOk);
    for (size_t i = 0; i < frame.size(); i += 3) {
      double squared = 0;
      for (size_t c = 0; c < 3; ++c) {
        const double d = double{frame[i + c]} - double{clip.frame(f)[i + c]};
        squared += d * d;
      }
      largest = std::max(largest, squared);
    }
  }
  return std::sqrt(largest);
}

TEST(LiveEncoder, KeepsTheErrorInFilesThatMakeOneClip) {
  for (const char* name : {"limb", "painted_box", "polygons"}) {
    SCOPED_TRACE(name);
    MeshSequence clip = corpus::make_clip(name);
    for (Attribute& attribute : clip.attributes) {
      attribute.values.resize(attribute.values.size() / attribute.frames);
      attribute.frames = 1;
    }
    const uint32_t frames = std::max(1U, clip.frame_count / 3);
    MeshSequence first = clip;
    first.frame_count = frames;
    first.positions = frames_of(clip, 0, frames);
    const double bound = 0.2 / 100 * diagonal(first);
    const std::vector<Bytes> files = streamed(clip, frames, options_of(0.2));
    for (size_t i = 0; i < files.size(); ++i) {
      ContainerReader reader;
      ASSERT_TRUE(reader.open_of_stream(files[i]).ok());
      EXPECT_EQ(reader.is_continuation(), i > 0);
    }
    const Bytes whole = joined(files);
    EXPECT_LE(largest_error(whole, clip), bound * 1.000001);
    Clip opened;
    ASSERT_TRUE(opened.open(whole).ok());
    EXPECT_EQ(opened.meshes()[0].attributes.empty(), clip.attributes.empty());
    EXPECT_LE(opened.clips()[0].max_error, bound);
  }
}

TEST(LiveEncoder, BeginsAnewEverySoManySeconds) {
  const MeshSequence clip = corpus::make_scaled("limb", 300, 48);
  MeshSequence mesh = clip;
  mesh.positions = {};
  LiveEncoder encoder(mesh, options_of(0.1), 1);
  std::vector<Bytes> files;
  for (uint32_t f = 0; f < clip.frame_count; f += 8)
    files.push_back(encoder.encode(frames_of(clip, f, 8)).file);
  for (size_t i = 0; i < files.size(); ++i) {
    ContainerReader reader;
    ASSERT_TRUE(reader.open_of_stream(files[i]).ok());
    EXPECT_TRUE(reader.features() & kLearningFeature);
    SegmentRecord record;
    ASSERT_EQ(SegmentRecord::read(reader.unchecked(*reader.find("SEGM", 0, 0)), &record),
              Status::kOk);
    EXPECT_EQ(record.continued == 0, i % 3 == 0) << i;  // of 24 frames a second
  }
  const Bytes whole = joined(files);
  MeshSequence first = clip;
  first.frame_count = 8;
  first.positions = frames_of(clip, 0, 8);
  EXPECT_LE(largest_error(whole, clip), 0.1 / 100 * diagonal(first) * 1.000001);
}

// Two vertices that move as one for a while are two.
TEST(LiveEncoder, DoesNotWeldWhatMayPart) {
  MeshSequence clip = corpus::make_clip("limb");
  clip.frame_count = 12;
  clip.positions = frames_of(clip, 0, 12);
  const size_t stride = size_t{3} * clip.vertex_count;
  for (size_t f = 0; f < 6; ++f)
    std::copy_n(&clip.positions[f * stride], 3, &clip.positions[f * stride + 3]);
  MeshSequence first = clip;
  first.frame_count = 6;
  first.positions = frames_of(clip, 0, 6);
  const double bound = 0.1 / 100 * diagonal(first);
  EXPECT_LE(largest_error(joined(streamed(clip, 6, options_of(0.1))), clip), bound * 1.000001);
}

/// Colours of corners that all shine alike, but for those of one from a frame on.
std::vector<float> shine(const MeshSequence& clip, uint32_t frame, uint32_t parts_at) {
  std::vector<float> values;
  for (size_t c = 0; c < clip.polygons.corners.size(); ++c) {
    const auto v =
        static_cast<float>(clip.polygons.corners[c]) / static_cast<float>(clip.vertex_count);
    const float own = c == 5 && frame >= parts_at ? 0.5F : 0.0F;
    for (const float phase : {0.0F, 1.0F, 2.0F})
      values.push_back(0.25F + 0.2F * std::sin(v * 9 + phase + 0.1F * static_cast<float>(frame)) +
                       own);
  }
  return values;
}

TEST(LiveEncoder, CodesAttributesThatMove) {
  MeshSequence clip = corpus::make_scaled("limb", 200, 24);
  for (const uint32_t parts_at : {100U, 14U}) {
    SCOPED_TRACE(parts_at);
    MeshSequence mesh = clip;
    mesh.positions = {};
    Attribute& colour = mesh.attributes.emplace_back();
    colour.kind = AttributeKind::kColour;
    colour.domain = AttributeDomain::kCorner;
    colour.components = 3;
    colour.frames = 0;
    LiveEncoder encoder(mesh, options_of(0.2));
    Bytes stream;
    std::vector<bool> has_mesh;
    for (uint32_t f = 0; f < clip.frame_count; f += 6) {
      std::vector<FrameArray> values(1);
      for (uint32_t g = f; g < f + 6; ++g) {
        const std::vector<float> frame = shine(clip, g, parts_at);
        values[0].insert(values[0].end(), frame.begin(), frame.end());
      }
      const LivePiece piece = encoder.encode(frames_of(clip, f, 6), std::move(values));
      has_mesh.push_back(piece.has_mesh);
      stream.insert(stream.end(), piece.file.begin(), piece.file.end());
    }
    // A new mesh begins when corners part that moved as one.
    EXPECT_EQ(has_mesh, (std::vector<bool>{true, false, parts_at < 100, false}));
    uint32_t first = 0;
    for (const Bytes& file : read_live_stream({"stream", stream}).files) {
      Clip opened;
      static KeptLearning learning;
      OpenOptions options;
      options.learning = &learning;
      ASSERT_TRUE(opened.open(file, options).ok());
      const Topology& topology = opened.meshes()[0].topology;
      for (uint32_t f = 0; f < 6; ++f) {
        const std::vector<float> wanted = shine(clip, first + f, parts_at);
        std::vector<float> values(wanted.size());
        ASSERT_EQ(show_attribute(opened, 0, 0, f, values.data()), Status::kOk);
        double worst = 0;
        // Polygons come in the order of the coder, each from any corner on: compare the mean colour of each vertex.
        std::vector<double> ours(size_t{3} * clip.vertex_count), theirs(ours.size());
        std::vector<double> corners(clip.vertex_count);
        for (size_t c = 0; c < wanted.size() / 3; ++c) {
          ++corners[clip.polygons.corners[c]];
          for (size_t i = 0; i < 3; ++i) {
            theirs[size_t{3} * clip.polygons.corners[c] + i] += double{wanted[3 * c + i]};
            ours[size_t{3} * topology.polygon_corners[c] + i] += double{values[3 * c + i]};
          }
        }
        for (size_t i = 0; i < ours.size(); ++i)
          worst = std::max(worst, std::abs(ours[i] - theirs[i]) / corners[i / 3]);
        EXPECT_LE(worst, 0.5 / 255 + 1e-6) << first + f;
      }
      first += 6;
    }
    EXPECT_EQ(first, clip.frame_count);
  }
  MeshSequence mesh = clip;
  mesh.attributes.emplace_back().frames = 0;
  LiveEncoder encoder(mesh, options_of(0.2));
  EXPECT_THROW(encoder.encode(frames_of(clip, 0, 6)), Error);
  EXPECT_THROW(encoder.encode(frames_of(clip, 0, 6), std::vector<FrameArray>(2)), Error);
}

TEST(LiveEncoder, StaysAsItIsWhereNothingMoves) {
  MeshSequence clip = corpus::make_clip("limb");
  for (uint32_t f = 1; f < clip.frame_count; ++f)
    std::copy_n(clip.positions.begin(), size_t{3} * clip.vertex_count,
                clip.positions.begin() + ptrdiff_t{3} * clip.vertex_count * f);
  const std::vector<Bytes> files = streamed(clip, 1, options_of(0.1));
  for (size_t i = 1; i < files.size(); ++i)
    EXPECT_LT(files[i].size(), 400U);
  joined(files);
}

TEST(LiveEncoder, RefusesWhatNeedsAllFrames) {
  const MeshSequence clip = corpus::make_clip("limb");
  EncodeOptions options;
  options.target = {ErrorMetric::kSize, 1000, false};
  EXPECT_THROW(LiveEncoder(clip, options), Error);
  options = options_of(0.1);
  options.keyframes = 3;
  EXPECT_THROW(LiveEncoder(clip, options), Error);
  options = options_of(0.1);
  options.root_motion = true;
  EXPECT_THROW(LiveEncoder(clip, options), Error);
  LiveEncoder encoder(clip, options_of(0.1));
  EXPECT_THROW(encoder.encode({}), Error);
  FrameArray bad = frames_of(clip, 0, 2);
  bad[7] = NAN;
  EXPECT_THROW(encoder.encode(bad), Error);
  EXPECT_GT(encoder.encode(frames_of(clip, 0, 2)).file.size(), 0U);
}

}  // namespace
}  // namespace anicodec
