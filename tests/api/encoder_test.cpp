// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface of the encoder.
#include "build_paths.h"
#include "codec/encode.h"
#include "codec/sequence/clip_library.h"
#include "corpus/clips.h"

#include <anicodec/encode.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// An encoder with a clip of the corpus, by address.
class AnicEncoder : public testing::Test {
 protected:
  AnicEncoder() {
    sequence_ = corpus::make_scaled("limb", 300, 12);
    EXPECT_EQ(anic_create_encoder(&encoder_), ANIC_OK);
    clip_.name = sequence_.name.c_str();
    clip_.frame_count = sequence_.frame_count;
    clip_.rate_numerator = sequence_.rate.numerator;
    clip_.rate_denominator = sequence_.rate.denominator;
    mesh_.vertex_count = sequence_.vertex_count;
    mesh_.polygon_count = static_cast<uint32_t>(sequence_.polygons.size());
    mesh_.offsets = sequence_.polygons.offsets.data();
    mesh_.corners = sequence_.polygons.corners.data();
    mesh_.positions = sequence_.positions.data();
    options_.goal = ANIC_GOAL_MAX_ERROR;
    options_.goal_value = 1;
    options_.flags = ANIC_ENCODE_PERCENT;
    options_.effort = ANIC_EFFORT_FAST;
  }

  ~AnicEncoder() override { anic_destroy_encoder(encoder_); }

  void add() {
    ASSERT_EQ(anic_set_source_clip(encoder_, &clip_), ANIC_OK) << text();
    ASSERT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_OK) << text();
  }

  anic_status encode() { return anic_encode(encoder_, &options_, &result_); }

  std::string text() const { return anic_get_encoder_text(encoder_); }

  /// The file, by value.
  std::string file() const { return {static_cast<const char*>(result_.file), result_.size}; }

  /// The file that codec/ makes of the same clip, without attributes.
  std::string expected(const Point& origin = {}) const {
    MeshSequence plain;
    plain.origin = origin;
    plain.name = sequence_.name;
    plain.polygons = sequence_.polygons;
    plain.vertex_count = sequence_.vertex_count;
    plain.frame_count = sequence_.frame_count;
    plain.positions = sequence_.positions;
    plain.rate = sequence_.rate;
    plain.rate.assumed = false;
    EncodeOptions options;
    options.target = {ErrorMetric::kMaxError, 1, true};
    options.effort = Effort::kFast;
    options.encoder = "anicodec 1.0.0";
    const Bytes bytes = anicodec::encode(plain, options).file;
    return {bytes.begin(), bytes.end()};
  }

  MeshSequence sequence_;
  anic_encoder* encoder_ = nullptr;
  anic_source_clip clip_ = ANIC_INIT(anic_source_clip);
  anic_source_mesh mesh_ = ANIC_INIT(anic_source_mesh);
  anic_encode_options options_ = ANIC_INIT(anic_encode_options);
  anic_encoding result_ = ANIC_INIT(anic_encoding);
};

TEST_F(AnicEncoder, MakesTheBytesOfTheEncoder) {
  add();
  ASSERT_EQ(encode(), ANIC_OK) << text();
  EXPECT_EQ(file(), expected());
  EXPECT_EQ(text(), "");
  EXPECT_GT(result_.max_error, 0);
  EXPECT_LE(result_.max_error, 0.01 * result_.diagonal);
}

TEST_F(AnicEncoder, TakesAnyStrideScalarAndCallback) {
  const std::string plain = expected();
  const size_t vertices = sequence_.vertex_count;
  std::vector<double> wide(vertices * sequence_.frame_count * 4, 7);  // frames from the back
  for (size_t f = 0; f < sequence_.frame_count; ++f) {
    for (size_t i = 0; i < vertices * 3; ++i)
      wide[((sequence_.frame_count - 1 - f) * vertices + i / 3) * 4 + i % 3] =
          static_cast<double>(sequence_.frame(f)[i]);
  }
  mesh_.scalar = ANIC_SCALAR_FLOAT64;
  mesh_.vertex_stride = 4 * sizeof(double);
  mesh_.frame_stride = -static_cast<ptrdiff_t>(vertices * 4 * sizeof(double));
  mesh_.positions = wide.data() + (sequence_.frame_count - 1) * vertices * 4;
  add();
  ASSERT_EQ(encode(), ANIC_OK) << text();
  EXPECT_EQ(file(), plain);

  mesh_.positions = nullptr;
  mesh_.user = &sequence_;
  mesh_.read = [](void* user, uint32_t frame, float* positions) {
    const auto from = static_cast<MeshSequence*>(user)->frame(frame);
    std::copy(from.begin(), from.end(), positions);
    return 0;
  };
  options_.threads = 1;
  add();
  ASSERT_EQ(encode(), ANIC_OK) << text();
  EXPECT_EQ(file(), plain);
}

TEST_F(AnicEncoder, ReportsAndStops) {
  struct Seen {
    int calls = 0, stop_at = 1 << 30;
  } seen;

  options_.threads = 1;  // trials on other threads are not reported
  options_.progress.user = &seen;
  options_.progress.report = [](void* user, const char* stage, double done) {
    auto* s = static_cast<Seen*>(user);
    EXPECT_NE(std::string(stage), "");
    EXPECT_GE(done, 0);
    EXPECT_LE(done, 1);
    return ++s->calls > s->stop_at ? 1 : 0;
  };
  add();
  ASSERT_EQ(encode(), ANIC_OK) << text();
  const int all = seen.calls;
  EXPECT_GT(all, static_cast<int>(sequence_.frame_count));
  for (int stop_at : {0, 5, all - 1}) {
    seen = {0, stop_at};
    EXPECT_EQ(encode(), ANIC_E_CANCELLED);
    EXPECT_EQ(seen.calls, stop_at + 1);
    EXPECT_EQ(result_.file, nullptr);
  }
  seen = {};
  ASSERT_EQ(encode(), ANIC_OK) << "usable after being stopped";
  EXPECT_EQ(file(), expected());
}

TEST_F(AnicEncoder, WritesToACallback) {
  std::string written;
  options_.writer.user = &written;
  options_.writer.write = [](void* user, const void* bytes, size_t size) {
    static_cast<std::string*>(user)->append(static_cast<const char*>(bytes), size);
    return 0;
  };
  add();
  ASSERT_EQ(encode(), ANIC_OK) << text();
  EXPECT_EQ(written, expected());
  EXPECT_EQ(result_.file, nullptr);
  options_.writer.write = [](void*, const void*, size_t) { return 1; };
  EXPECT_EQ(encode(), ANIC_E_READ);
}

TEST_F(AnicEncoder, KeepsAttributesAndLabels) {
  const std::vector<float> uv(size_t{sequence_.vertex_count} * 2, 0.25F);
  anic_source_attribute attribute = ANIC_INIT(anic_source_attribute);
  attribute.name = "map";
  attribute.kind = ANIC_ATTRIBUTE_UV;
  attribute.components = 2;
  attribute.values = uv.data();
  add();
  ASSERT_EQ(anic_add_source_attribute(encoder_, 0, &attribute), ANIC_OK) << text();
  std::vector<uint32_t> labels(sequence_.polygons.size(), 1);
  labels[0] = 0;
  const char* name = "skin";
  anic_source_attribute material = ANIC_INIT(anic_source_attribute);
  material.kind = ANIC_ATTRIBUTE_MATERIAL;
  material.domain = ANIC_DOMAIN_POLYGONS;
  material.labels = labels.data();
  material.label_names = &name;
  material.label_count = 1;
  anic_material look = ANIC_INIT(anic_material);
  look.base_colour[0] = 0.5F;
  look.roughness = 0.25F;
  look.normal_texture = "n.png";
  const anic_material* looks[] = {&look};
  material.materials = looks;
  look.roughness = -1;
  ASSERT_EQ(anic_add_source_attribute(encoder_, 0, &material), ANIC_E_ARGUMENT);
  EXPECT_EQ(text(), "a number of a material is not finite or below 0");
  look.roughness = 0.25F;
  ASSERT_EQ(anic_add_source_attribute(encoder_, 0, &material), ANIC_OK) << text();
  ASSERT_EQ(encode(), ANIC_OK) << text();

  anic_asset* asset;
  ASSERT_EQ(anic_open_asset(result_.file, result_.size, nullptr, &asset, nullptr), ANIC_OK);
  anic_attribute read = ANIC_INIT(anic_attribute);
  ASSERT_EQ(anic_get_attribute(asset, 0, 0, &read), ANIC_OK);
  EXPECT_STREQ(read.name, "map");
  EXPECT_FLOAT_EQ(read.values[1], 0.25F);
  ASSERT_EQ(anic_get_attribute(asset, 0, 1, &read), ANIC_OK);
  EXPECT_STREQ(anic_get_label_name(asset, 0, 1, 0), "skin");
  anic_material kept = ANIC_INIT(anic_material);
  ASSERT_EQ(anic_get_material(asset, 0, 1, 0, &kept), ANIC_OK);
  EXPECT_EQ(kept.base_colour[0], 0.5F);
  EXPECT_EQ(kept.roughness, 0.25F);
  EXPECT_STREQ(kept.normal_texture, "n.png");
  EXPECT_EQ(std::count(read.labels, read.labels + read.count, 0U), 1) << "in any order";
  anic_close_asset(asset);

  labels[2] = 2;
  EXPECT_EQ(anic_add_source_attribute(encoder_, 0, &material), ANIC_E_ARGUMENT);
  EXPECT_EQ(text(), "polygon 2 has label 2 of 1");
}

TEST_F(AnicEncoder, KeepsBoundsAndUnitsOfAttributes) {
  std::vector<float> heat(size_t{sequence_.vertex_count} * sequence_.frame_count);
  for (size_t i = 0; i < heat.size(); ++i)
    heat[i] = static_cast<float>(i % 97);
  anic_source_attribute attribute = ANIC_INIT(anic_source_attribute);
  attribute.name = "heat";
  attribute.kind = ANIC_ATTRIBUTE_CUSTOM;
  attribute.components = 1;
  attribute.frames = sequence_.frame_count;
  attribute.values = heat.data();
  attribute.unit = "K";
  add();
  for (const double error : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    attribute.error = error;
    for (const anic_bound bound : {ANIC_BOUND_UNITS, ANIC_BOUND_PERCENT}) {
      attribute.bound = bound;
      ASSERT_EQ(anic_add_source_attribute(encoder_, 0, &attribute), ANIC_E_ARGUMENT) << error;
    }
  }
  attribute.bound = static_cast<anic_bound>(4);
  ASSERT_EQ(anic_add_source_attribute(encoder_, 0, &attribute), ANIC_E_ARGUMENT);
  EXPECT_EQ(text(), "heat: the bound is none of ANIC_BOUND");
  attribute.bound = ANIC_BOUND_EXACT;
  ASSERT_EQ(anic_add_source_attribute(encoder_, 0, &attribute), ANIC_OK) << text();
  ASSERT_EQ(encode(), ANIC_OK) << text();
  const char* metadata;
  size_t metadata_bytes;
  ASSERT_EQ(anic_read_metadata(result_.file, result_.size, &metadata, &metadata_bytes), ANIC_OK);
  EXPECT_EQ(std::string(metadata, metadata_bytes),
            R"({"fields":{"heat":{"unit":"K","whole":true}}})");
}

TEST_F(AnicEncoder, EncodesSeveralMeshesSomeForSomeFrames) {
  const anic_frame_run runs[] = {{2, 4}, {8, 2}};
  add();
  mesh_.name = "guest";
  mesh_.runs = runs;
  mesh_.run_count = 2;
  uint32_t number = 0;
  ASSERT_EQ(anic_add_source_mesh(encoder_, &mesh_, &number), ANIC_OK) << text();
  EXPECT_EQ(number, 1U);
  ASSERT_EQ(encode(), ANIC_OK) << text();
  anic_asset* asset;
  ASSERT_EQ(anic_open_asset(result_.file, result_.size, nullptr, &asset, nullptr), ANIC_OK);
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_get_asset_info(asset, &info);
  EXPECT_EQ(info.mesh_count, 2U);
  EXPECT_EQ(info.frame_count, 12U);
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  anic_get_mesh(asset, 1, &mesh);
  EXPECT_STREQ(mesh.name, "guest");
  anic_close_asset(asset);

  options_.goal = ANIC_GOAL_SIZE;
  options_.flags = 0;
  options_.goal_value = 10000;
  EXPECT_EQ(encode(), ANIC_E_ARGUMENT);
  EXPECT_EQ(text(), "a target size cannot be shared out among meshes");
}

TEST_F(AnicEncoder, EncodesSeveralClipsOfAMesh) {
  MeshSequence walk = sequence_;
  walk.attributes.clear();
  walk.materials = walk.parts = {};
  walk.shared_normals.clear();
  walk.rate.assumed = false;
  MeshSequence run = walk;
  walk.name = "Walk";
  walk.loop = true;
  run.name = "Run";
  run.rate = {60, 1, false};
  run.frame_count = 5;
  run.positions.resize(size_t{5} * 3 * run.vertex_count);
  MeshSequence both = clip_library({walk, run});
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  options.effort = Effort::kFast;
  options.encoder = "anicodec 1.0.0";
  const Bytes bytes = anicodec::encode(both, options).file;

  anic_source_clip next = ANIC_INIT(anic_source_clip);
  next.name = "Run";
  next.frame_count = 5;
  next.rate_numerator = 60;
  EXPECT_EQ(anic_add_source_clip(encoder_, &next), ANIC_E_STATE);
  clip_.name = "Walk";
  clip_.loop = 1;
  clip_.up = static_cast<anic_up_axis>(walk.up);
  clip_.metres_per_unit = walk.metres_per_unit;
  ASSERT_EQ(anic_set_source_clip(encoder_, &clip_), ANIC_OK) << text();
  next.up = clip_.up == ANIC_UP_Z ? ANIC_UP_Y : ANIC_UP_Z;
  EXPECT_EQ(anic_add_source_clip(encoder_, &next), ANIC_E_ARGUMENT);
  EXPECT_EQ(text(), "a clip has another up axis, unit or origin than the first");
  next.up = clip_.up;
  next.metres_per_unit = clip_.metres_per_unit;
  ASSERT_EQ(anic_add_source_clip(encoder_, &next), ANIC_OK) << text();
  mesh_.positions = both.positions.data();
  ASSERT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_OK) << text();
  EXPECT_EQ(anic_add_source_clip(encoder_, &next), ANIC_E_STATE) << "meshes were added";
  ASSERT_EQ(encode(), ANIC_OK) << text();
  EXPECT_EQ(file(), (std::string{bytes.begin(), bytes.end()}));
}

TEST_F(AnicEncoder, CountsPositionsFromAnOriginThatIsGivenOrFound) {
  const Point place{0x1p30, -0x1p22, 0};
  std::vector<double> far(sequence_.positions.begin(), sequence_.positions.end());
  for (size_t i = 0; i < far.size(); ++i)
    far[i] += place[i % 3];
  mesh_.scalar = ANIC_SCALAR_FLOAT64;
  mesh_.positions = far.data();
  std::copy_n(place.begin(), 3, clip_.origin);
  add();
  ASSERT_EQ(encode(), ANIC_OK) << text();
  EXPECT_EQ(file(), expected(place));

  clip_.find_origin = 1;
  EXPECT_EQ(anic_set_source_clip(encoder_, &clip_), ANIC_E_ARGUMENT);
  std::fill_n(clip_.origin, 3, 0.0);
  add();
  ASSERT_EQ(encode(), ANIC_OK) << text();
  anic_asset* asset = nullptr;
  ASSERT_EQ(anic_open_asset(file().data(), file().size(), nullptr, &asset, nullptr), ANIC_OK);
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  ASSERT_EQ(anic_get_asset_info(asset, &info), ANIC_OK);
  anic_close_asset(asset);
  for (size_t k = 0; k < 3; ++k)
    EXPECT_LE(std::abs(info.origin[k] - place[k]), 2 * info.diagonal + 10);
  EXPECT_NEAR(info.diagonal, diagonal(sequence_), 1e-4 * info.diagonal);
  EXPECT_LE(info.max_error, 0.01 * info.diagonal);
}

TEST_F(AnicEncoder, TellsWhatIsWrong) {
  EXPECT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_E_STATE);
  EXPECT_EQ(anic_set_source_clip(encoder_, nullptr), ANIC_E_ARGUMENT);
  ASSERT_EQ(anic_set_source_clip(encoder_, &clip_), ANIC_OK);
  EXPECT_EQ(encode(), ANIC_E_STATE);
  mesh_.struct_size = 0;
  EXPECT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_E_ARGUMENT);
  mesh_.struct_size = sizeof mesh_;

  sequence_.polygons.corners[4] = sequence_.vertex_count;
  EXPECT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_E_INDEX_RANGE);
  EXPECT_NE(text().find("uses vertex"), std::string::npos) << text();
  sequence_.polygons.corners[4] = 0;
  ++sequence_.polygons.offsets[0];
  EXPECT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_E_ARGUMENT);
  --sequence_.polygons.offsets[0];
  ASSERT_EQ(anic_add_source_mesh(encoder_, &mesh_, nullptr), ANIC_OK) << text();

  const float before = sequence_.frame(3)[3];
  sequence_.frame(3)[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(encode(), ANIC_E_NON_FINITE);
  EXPECT_EQ(text(), "frame 3, vertex 1: the position is not finite");
  sequence_.frame(3)[3] = before;

  for (auto spoil : std::initializer_list<void (*)(anic_encode_options&)>{
           [](auto& o) { o.goal_value = -1; }, [](auto& o) { o.goal = static_cast<anic_goal>(8); },
           [](auto& o) { o.effort = static_cast<anic_effort>(3); },
           [](auto& o) { o.flags = uint64_t{1} << 40; },
           [](auto& o) { o.max_error = std::numeric_limits<double>::infinity(); },
           [](auto& o) { o.keyframes = 13; }, [](auto& o) { o.threads = 5000; },
           [](auto& o) { o.interpolation = ANIC_INTERPOLATE_MSGI; }}) {
    const anic_encode_options good = options_;
    spoil(options_);
    EXPECT_EQ(encode(), ANIC_E_ARGUMENT) << text();
    EXPECT_NE(text(), "");
    options_ = good;
  }
  options_.max_bytes = 1000;
  EXPECT_EQ(encode(), ANIC_E_LIMIT);
  options_.max_bytes = 0;
  EXPECT_EQ(encode(), ANIC_OK) << text();
  EXPECT_EQ(anic_encode(nullptr, &options_, &result_), ANIC_E_ARGUMENT);
  EXPECT_STREQ(anic_get_encoder_text(nullptr), "there is no encoder");
}

TEST_F(AnicEncoder, ExampleInCEncodes) {
  const std::string path = testing::TempDir() + "anicodec_example_encode.anic";
  EXPECT_EQ(std::system(
                (std::string(ANICODEC_ENCODE_EXAMPLE) + " '" + path + "' >/dev/null 2>&1").c_str()),
            0);
  EXPECT_EQ(std::remove(path.c_str()), 0);
}

}  // namespace
}  // namespace anicodec
