// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Lossless files through the C interface.
#include "tests/api/opened.h"

#include <anicodec/encode.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

namespace anicodec {
namespace {

constexpr uint32_t kExactFrames = 12;

MeshSequence exact_source() {
  MeshSequence clip = corpus::make_scaled("limb", 200, kExactFrames);
  clip.positions[3] = -0.0F;
  return clip;
}

struct EncoderDestroyer {
  void operator()(anic_encoder* encoder) const { anic_destroy_encoder(encoder); }
};

using Encoder = std::unique_ptr<anic_encoder, EncoderDestroyer>;

anic_status encode_with(const MeshSequence& clip, const anic_encode_options& options, Bytes* file) {
  anic_encoder* made = nullptr;
  EXPECT_EQ(anic_create_encoder(&made), ANIC_OK);
  const Encoder encoder(made);
  anic_source_clip timing = ANIC_INIT(anic_source_clip);
  timing.frame_count = clip.frame_count;
  EXPECT_EQ(anic_set_source_clip(made, &timing), ANIC_OK);
  anic_source_mesh mesh = ANIC_INIT(anic_source_mesh);
  mesh.vertex_count = clip.vertex_count;
  mesh.polygon_count = static_cast<uint32_t>(clip.polygons.size());
  mesh.offsets = clip.polygons.offsets.data();
  mesh.corners = clip.polygons.corners.data();
  mesh.positions = clip.positions.data();
  EXPECT_EQ(anic_add_source_mesh(made, &mesh, nullptr), ANIC_OK);
  anic_encoding result = ANIC_INIT(anic_encoding);
  const anic_status status = anic_encode(made, &options, &result);
  if (status == ANIC_OK) {
    const auto* bytes = static_cast<const uint8_t*>(result.file);
    file->assign(bytes, bytes + result.size);
    EXPECT_EQ(result.max_error, 0);
  }
  return status;
}

Bytes encoded() {
  anic_encode_options options = ANIC_INIT(anic_encode_options);
  options.flags = ANIC_ENCODE_LOSSLESS;
  options.effort = ANIC_EFFORT_FAST;
  Bytes file;
  EXPECT_EQ(encode_with(exact_source(), options, &file), ANIC_OK);
  return file;
}

/// Bits of the vertices first .. first + count - 1 in what a context shows.
bool has_source(const Context& context, const MeshSequence& clip, uint32_t frame, uint32_t first,
                uint32_t count, anic_when when = ANIC_WHEN_CURRENT) {
  std::vector<float> shown(size_t{4} * count, 7);
  anic_output out = ANIC_INIT(anic_output);
  out.data = shown.data();
  out.size = 4 * shown.size();
  out.format = ANIC_FORMAT_FLOAT32X4;
  EXPECT_EQ(anic_write_positions(context.get(), 0, when, first, count, &out), ANIC_OK);
  for (uint32_t i = 0; i < count; ++i) {
    if (shown[4 * i + 3] != 1 ||
        std::memcmp(&shown[4 * i], clip.frame(frame).data() + size_t{3} * (first + i), 12) != 0)
      return false;
  }
  return true;
}

TEST(AnicLossless, RangesOfAnyFrameHaveTheBitsOfTheSource) {
  const MeshSequence clip = exact_source();
  const Asset asset = open(encoded());
  EXPECT_EQ(anic_verify_asset(asset.get()), ANIC_OK);
  const Context context = context_of(asset);
  for (uint32_t f : {7U, 0U, 11U, 3U}) {
    ASSERT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
    for (uint32_t first : {0U, 1U, 15U, 16U, 100U}) {
      EXPECT_TRUE(has_source(context, clip, f, first, clip.vertex_count - first));
      EXPECT_TRUE(has_source(context, clip, f, first, 3));
    }
  }
  EXPECT_TRUE(has_source(context, clip, 11, 0, clip.vertex_count, ANIC_WHEN_PREVIOUS));
  for (uint32_t f = 0; f < kExactFrames; ++f)
    EXPECT_EQ(std::memcmp(frame(asset, f).data(), clip.frame(f).data(), clip.frame(f).size_bytes()),
              0);
}

TEST(AnicLossless, PlaysTheBasisBetweenFramesAndWhereLeftClosed) {
  const MeshSequence clip = exact_source();
  const Bytes file = encoded();
  anic_options closed = ANIC_INIT(anic_options);
  closed.flags = ANIC_OPEN_INEXACT;
  const Asset exact = open(file), basis = open(file, &closed);
  const Context a = context_of(exact), b = context_of(basis);
  for (double seconds : {0.02, 0.1, 0.3}) {
    std::vector<float> shown[2];
    for (const Context* context : {&a, &b}) {
      ASSERT_EQ(anic_seek_time(context->get(), seconds, ANIC_SAMPLE_CUBIC, ANIC_WRAP_CLAMP),
                ANIC_OK);
      std::vector<float>& to = shown[context == &b];
      to.resize(size_t{3} * clip.vertex_count);
      anic_output out = ANIC_INIT(anic_output);
      out.data = to.data();
      out.size = 4 * to.size();
      ASSERT_EQ(
          anic_write_positions(context->get(), 0, ANIC_WHEN_CURRENT, 0, clip.vertex_count, &out),
          ANIC_OK);
    }
    EXPECT_EQ(shown[0], shown[1]) << seconds;
  }
  ASSERT_EQ(anic_seek_frame(b.get(), 5), ANIC_OK);
  EXPECT_FALSE(has_source(b, clip, 5, 0, clip.vertex_count));
  ASSERT_EQ(anic_seek_frame(a.get(), 5), ANIC_OK);
  ASSERT_EQ(anic_set_quality(a.get(), 0.5), ANIC_OK);
  ASSERT_EQ(anic_seek_frame(a.get(), 6), ANIC_OK);
  EXPECT_FALSE(has_source(a, clip, 6, 0, clip.vertex_count));
}

TEST(AnicLossless, MemoryIsAnnounced) {
  const Bytes file = encoded();
  for (uint64_t flags : {uint64_t{0}, uint64_t{ANIC_OPEN_INEXACT}}) {
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    options.flags = flags;
    anic_requirements needs = ANIC_INIT(anic_requirements);
    ASSERT_EQ(anic_get_requirements(file.data(), file.size(), &options, &needs), ANIC_OK);
    memory.peak = 0;
    const Asset asset = open(file, &options);
    EXPECT_LE(memory.peak, needs.opening_bytes);
    EXPECT_LE(memory.held, needs.resident_bytes);
    EXPECT_GE(1.05 * static_cast<double>(memory.held) + 4096,
              static_cast<double>(needs.resident_bytes));
    options.max_bytes = needs.opening_bytes / 2;
    anic_asset* refused = nullptr;
    EXPECT_EQ(anic_open_asset(file.data(), file.size(), &options, &refused, nullptr), ANIC_E_LIMIT);
  }
}

TEST(AnicLossless, AStreamPlaysBeforeItIsExact) {
  const MeshSequence clip = exact_source();
  const Bytes file = encoded();
  anic_stream* stream = nullptr;
  ASSERT_EQ(anic_create_stream(nullptr, &stream), ANIC_OK);
  bool played = false;
  for (size_t at = 0; at < file.size(); at += 100) {
    anic_stream_info info = ANIC_INIT(anic_stream_info);
    const size_t size = std::min<size_t>(100, file.size() - at);
    ASSERT_EQ(anic_push_bytes(stream, file.data() + at, size), ANIC_OK);
    ASSERT_EQ(anic_get_stream_info(stream, &info), ANIC_OK);
    if (!info.playable)
      continue;
    played |= at + size < file.size() / 2;
    anic_asset* asset = nullptr;
    ASSERT_EQ(anic_open_asset_from_stream(stream, &asset, nullptr), ANIC_OK);
    const Asset owned(asset);
    const Context context = context_of(owned);
    ASSERT_EQ(anic_seek_frame(context.get(), 4), ANIC_OK);
    EXPECT_EQ(has_source(context, clip, 4, 0, clip.vertex_count), at + size == file.size());
  }
  EXPECT_TRUE(played);
  anic_destroy_stream(stream);
}

TEST(AnicLossless, GoesWithoutAGoalOfItsOwn) {
  anic_encode_options options = ANIC_INIT(anic_encode_options);
  options.flags = ANIC_ENCODE_LOSSLESS;
  options.goal = ANIC_GOAL_KG;
  options.goal_value = 1;
  Bytes file;
  EXPECT_EQ(encode_with(exact_source(), options, &file), ANIC_E_ARGUMENT);
  options.goal = ANIC_GOAL_DEFAULT;
  options.max_error = 1;
  EXPECT_EQ(encode_with(exact_source(), options, &file), ANIC_E_ARGUMENT);
  options.max_error = 0;
  options.massage = ANIC_MASSAGE_ON;
  EXPECT_EQ(encode_with(exact_source(), options, &file), ANIC_E_ARGUMENT);
}

}  // namespace
}  // namespace anicodec
