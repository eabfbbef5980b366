// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Live streams by the C interface.
#include "codec/encode_live.h"
#include "corpus/clips.h"

#include <anicodec/encode.h>

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

class AnicLive : public testing::Test {
 protected:
  AnicLive() {
    sequence_ = corpus::make_scaled("limb", 200, 20);
    EXPECT_EQ(anic_create_encoder(&encoder_), ANIC_OK);
    clip_.name = sequence_.name.c_str();
    clip_.rate_numerator = 24;
    mesh_.vertex_count = sequence_.vertex_count;
    mesh_.polygon_count = static_cast<uint32_t>(sequence_.polygons.size());
    mesh_.offsets = sequence_.polygons.offsets.data();
    mesh_.corners = sequence_.polygons.corners.data();
    options_.goal = ANIC_GOAL_MAX_ERROR;
    options_.goal_value = 1;
    options_.flags = ANIC_ENCODE_PERCENT;
    options_.effort = ANIC_EFFORT_FAST;
    live_options_.piece_seconds = 8.0 / 24;
  }

  ~AnicLive() override {
    anic_destroy_live(live_);
    anic_destroy_encoder(encoder_);
  }

  void add() {
    ASSERT_EQ(anic_set_source_clip(encoder_, &clip_), ANIC_OK) << text();
    ASSERT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_OK) << text();
  }

  anic_status begin() { return anic_begin_live(encoder_, &options_, &live_options_, &live_); }

  anic_status push(uint32_t f) {
    anic_live_frame frame = ANIC_INIT(anic_live_frame);
    frame.positions = sequence_.frame(f).data();
    return anic_push_live_frame(live_, &frame, 0);
  }

  std::vector<Bytes> rest() {
    std::vector<Bytes> files;
    anic_live_piece piece = ANIC_INIT(anic_live_piece);
    while (anic_take_live_piece(live_, INFINITY, &piece) == ANIC_OK) {
      const auto* file = static_cast<const uint8_t*>(piece.file);
      files.emplace_back(file, file + piece.size);
    }
    return files;
  }

  anic_live_info info() const {
    anic_live_info info = ANIC_INIT(anic_live_info);
    EXPECT_EQ(anic_get_live_info(live_, &info), ANIC_OK);
    return info;
  }

  std::string text() const { return anic_get_encoder_text(encoder_); }

  MeshSequence sequence_;
  anic_encoder* encoder_ = nullptr;
  anic_live* live_ = nullptr;
  anic_source_clip clip_ = ANIC_INIT(anic_source_clip);
  anic_source_mesh mesh_ = ANIC_INIT(anic_source_mesh);
  anic_encode_options options_ = ANIC_INIT(anic_encode_options);
  anic_live_options live_options_ = ANIC_INIT(anic_live_options);
};

TEST_F(AnicLive, MakesTheFilesOfTheEncoder) {
  add();
  ASSERT_EQ(begin(), ANIC_OK) << text();
  EXPECT_EQ(info().piece_frames, 8U);
  anic_live_piece piece = ANIC_INIT(anic_live_piece);
  EXPECT_EQ(anic_take_live_piece(live_, 0, &piece), ANIC_E_ABSENT);
  for (uint32_t f = 0; f < 20; ++f)
    ASSERT_EQ(push(f), ANIC_OK) << anic_get_live_text();
  ASSERT_EQ(anic_end_live(live_), ANIC_OK);
  EXPECT_EQ(push(0), ANIC_E_ARGUMENT);
  EXPECT_NE(std::string(anic_get_live_text()), "");
  const std::vector<Bytes> files = rest();
  EXPECT_TRUE(info().ended);
  EXPECT_EQ(info().pushed_frames, 20U);

  MeshSequence mesh;
  mesh.name = sequence_.name;
  mesh.polygons = sequence_.polygons;
  mesh.vertex_count = sequence_.vertex_count;
  mesh.rate = {24, 1, false};
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  options.effort = Effort::kFast;
  options.encoder = "anicodec 1.0.0";
  LiveEncoder encoder(mesh, options);
  std::vector<Bytes> expected;
  for (uint32_t f = 0; f < 20; f += 8) {
    const auto begin = sequence_.positions.begin() + ptrdiff_t{3} * mesh.vertex_count * f;
    expected.push_back(
        encoder.encode({begin, begin + ptrdiff_t{3} * mesh.vertex_count * std::min(8U, 20 - f)})
            .file);
  }
  EXPECT_EQ(files, expected);
}

TEST_F(AnicLive, TakesDoublesAndAttributesThatMove) {
  add();
  anic_source_attribute heat = ANIC_INIT(anic_source_attribute);
  heat.kind = ANIC_ATTRIBUTE_CUSTOM;
  heat.name = "heat";
  heat.components = 1;
  ASSERT_EQ(anic_add_source_attribute(encoder_, 0, &heat), ANIC_OK) << text();
  heat.kind = ANIC_ATTRIBUTE_NORMAL;
  heat.components = 3;
  EXPECT_EQ(anic_add_source_attribute(encoder_, 0, &heat), ANIC_E_ARGUMENT);
  ASSERT_EQ(begin(), ANIC_OK) << text();
  std::vector<double> positions(size_t{4} * sequence_.vertex_count);
  std::vector<float> values(sequence_.vertex_count);
  anic_live_frame frame = ANIC_INIT(anic_live_frame);
  frame.positions = positions.data();
  frame.scalar = ANIC_SCALAR_FLOAT64;
  frame.vertex_stride = 4 * sizeof(double);
  EXPECT_EQ(anic_push_live_frame(live_, &frame, 0), ANIC_E_ARGUMENT);  // no heat
  const float* of_attributes[] = {values.data()};
  frame.values = of_attributes;
  frame.value_count = 1;
  for (uint32_t f = 0; f < 16; ++f) {
    for (size_t v = 0; v < values.size(); ++v) {
      values[v] = std::sin(0.1F * static_cast<float>(v) + 0.2F * static_cast<float>(f));
      for (size_t c = 0; c < 3; ++c)
        positions[4 * v + c] = static_cast<double>(sequence_.frame(f)[3 * v + c]);
    }
    ASSERT_EQ(anic_push_live_frame(live_, &frame, 0), ANIC_OK) << anic_get_live_text();
  }
  ASSERT_EQ(anic_end_live(live_), ANIC_OK);
  anic_stream* stream = nullptr;
  ASSERT_EQ(anic_create_stream(nullptr, &stream), ANIC_OK);
  uint32_t files = 0;
  for (const Bytes& file : rest()) {
    if (files > 0) {
      ASSERT_EQ(anic_advance_stream(stream), ANIC_OK);
    }
    ASSERT_EQ(anic_push_bytes(stream, file.data(), file.size()), ANIC_OK);
    anic_asset* asset = nullptr;
    ASSERT_EQ(anic_open_asset_from_stream(stream, &asset, nullptr), ANIC_OK);
    anic_attribute attribute = ANIC_INIT(anic_attribute);
    ASSERT_EQ(anic_get_attribute(asset, 0, 0, &attribute), ANIC_OK);
    EXPECT_STREQ(attribute.name, "heat");
    anic_close_asset(asset);
    ++files;
  }
  EXPECT_EQ(files, 2U);
  anic_destroy_stream(stream);
}

TEST_F(AnicLive, SaysThatItIsBehind) {
  add();
  live_options_.most_waiting_frames = 8;
  ASSERT_EQ(begin(), ANIC_OK) << text();
  anic_status status = ANIC_OK;
  for (uint32_t f = 0; f < 20 && status == ANIC_OK; ++f)
    status = push(f);
  EXPECT_TRUE(status == ANIC_OK || status == ANIC_E_LIMIT);
  EXPECT_LE(info().waiting_frames, 8U);
  EXPECT_LE(info().late_frames, info().waiting_frames);
}

TEST_F(AnicLive, RefusesWhatIsNoStream) {
  add();
  mesh_.positions = sequence_.positions.data();
  EXPECT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_E_ARGUMENT);
  anic_encoding encoding = ANIC_INIT(anic_encoding);
  EXPECT_EQ(anic_encode(encoder_, nullptr, &encoding), ANIC_E_STATE);
  EXPECT_EQ(anic_add_source_clip(encoder_, &clip_), ANIC_E_STATE);
  options_.massage = ANIC_MASSAGE_ON;
  EXPECT_EQ(begin(), ANIC_E_ARGUMENT);
  options_.massage = ANIC_MASSAGE_OFF;
  options_.flags |= ANIC_ENCODE_LOSSLESS;
  EXPECT_EQ(begin(), ANIC_E_ARGUMENT);
  options_.flags = ANIC_ENCODE_PERCENT;
  live_options_.piece_seconds = -1;
  EXPECT_EQ(begin(), ANIC_E_ARGUMENT);
  live_options_.piece_seconds = 0;
  EXPECT_EQ(anic_begin_live(encoder_, nullptr, nullptr, nullptr), ANIC_E_ARGUMENT);
  mesh_.positions = nullptr;
  ASSERT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_OK) << text();
  EXPECT_EQ(begin(), ANIC_E_STATE);  // two meshes
  clip_.loop = 1;
  EXPECT_EQ(anic_set_source_clip(encoder_, &clip_), ANIC_E_ARGUMENT);
  clip_.loop = 0;
  clip_.frame_count = 20;
  ASSERT_EQ(anic_set_source_clip(encoder_, &clip_), ANIC_OK);
  mesh_.positions = sequence_.positions.data();
  ASSERT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_OK);
  EXPECT_EQ(begin(), ANIC_E_STATE);  // it has frames
  EXPECT_EQ(anic_push_live_frame(nullptr, nullptr, 0), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_end_live(nullptr), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_get_live_info(nullptr, nullptr), ANIC_E_ARGUMENT);
  anic_destroy_live(nullptr);
}

TEST_F(AnicLive, BeginsAnewAsOftenAsAskedFor) {
  add();
  live_options_.key_seconds = -1;
  ASSERT_EQ(begin(), ANIC_OK) << text();
  for (uint32_t f = 0; f < 16; ++f)
    ASSERT_EQ(push(f), ANIC_OK);
  ASSERT_EQ(anic_end_live(live_), ANIC_OK);
  anic_live_piece piece = ANIC_INIT(anic_live_piece);
  for (uint32_t i = 0; i < 2; ++i) {
    ASSERT_EQ(anic_take_live_piece(live_, INFINITY, &piece), ANIC_OK);
    EXPECT_TRUE(piece.key);
    EXPECT_EQ(piece.has_mesh, i == 0);
    EXPECT_EQ(piece.first_frame, 8 * i);
    EXPECT_GT(piece.max_error, 0);
  }
}

}  // namespace
}  // namespace anicodec
