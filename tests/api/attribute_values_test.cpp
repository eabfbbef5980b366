// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/api/opened.h"

#include <anicodec/anicodec.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr uint32_t kUv = 0, kColour = 1, kHeat = 2;

const MeshSequence& attributed_source() {
  static const MeshSequence clip = corpus::make_clip("heated");
  return clip;
}

const Bytes& heated() {
  return encoded_clip("heated", BasisChoice::kEigentrajectories);
}

std::vector<float> values(const Asset& asset, const Context& context, uint32_t attribute,
                          anic_when when = ANIC_WHEN_CURRENT) {
  anic_attribute about = ANIC_INIT(anic_attribute);
  EXPECT_EQ(anic_get_attribute(asset.get(), 0, attribute, &about), ANIC_OK);
  std::vector<float> out(size_t{about.components} * about.count);
  const anic_value_output to = anic::value_output(out);
  EXPECT_EQ(anic_write_attribute(context.get(), 0, attribute, when, 0, about.count, &to), ANIC_OK);
  return out;
}

double error_at(const std::vector<float>& values, const Attribute& attribute, uint32_t frame) {
  double largest = 0;
  for (size_t i = 0; i < values.size(); ++i)
    largest = std::max(
        largest, std::abs(double{values[i]} - double{attribute.values[frame * values.size() + i]}));
  return largest;
}

TEST(AnicAttributeValues, AreThoseOfTheFrameChosen) {
  const Asset asset = open(heated());
  const Context context = context_of(asset);
  const double bounds[] = {0.0015, 0.5 / 255, 0.46};
  for (uint32_t frame : {0U, 23U, 7U, 20U, 7U}) {
    ASSERT_EQ(anic_seek_frame(context.get(), frame), ANIC_OK);
    for (uint32_t a : {kUv, kColour, kHeat})
      EXPECT_LE(error_at(values(asset, context, a), attributed_source().attributes[a], frame),
                bounds[a])
          << "attribute " << a << ", frame " << frame;
  }
  // The frame shown before.
  EXPECT_LE(error_at(values(asset, context, kHeat, ANIC_WHEN_PREVIOUS),
                     attributed_source().attributes[kHeat], 20),
            bounds[kHeat]);
  ASSERT_EQ(anic_forget_previous(context.get()), ANIC_OK);
  EXPECT_EQ(values(asset, context, kHeat, ANIC_WHEN_PREVIOUS), values(asset, context, kHeat));
}

TEST(AnicAttributeValues, AreInterpolatedAsTheSeekSays) {
  const Asset asset = open(heated());
  const Context context = context_of(asset);
  auto at = [&](double frame, anic_sampling interpolation) {
    EXPECT_EQ(anic_seek_time(context.get(), frame / 24, interpolation, ANIC_WRAP_CLAMP), ANIC_OK);
    return values(asset, context, kHeat);
  };
  const std::vector<float> a = at(9, ANIC_SAMPLE_LINEAR), b = at(10, ANIC_SAMPLE_LINEAR);
  const std::vector<float> middle = at(9.25, ANIC_SAMPLE_LINEAR);
  for (size_t i = 0; i < a.size(); ++i)
    ASSERT_NEAR(middle[i], 0.75F * a[i] + 0.25F * b[i], 1);  // corrections are of whole frames
  EXPECT_EQ(at(9.25, ANIC_SAMPLE_STEP), a);
}

TEST(AnicAttributeValues, OfOthersStandStillAndSayWhetherTheyMove) {
  const Asset asset = open(heated());
  for (uint32_t a : {kUv, kColour, kHeat}) {
    anic_attribute about = ANIC_INIT(anic_attribute);
    ASSERT_EQ(anic_get_attribute(asset.get(), 0, a, &about), ANIC_OK);
    EXPECT_EQ(about.moves, 1);
  }
  const Asset box = open(encoded_clip("painted_box", BasisChoice::kKeyframes));
  const Context context = context_of(box);
  ASSERT_EQ(anic_seek_frame(context.get(), 3), ANIC_OK);
  anic_attribute paint = ANIC_INIT(anic_attribute);
  ASSERT_EQ(anic_get_attribute(box.get(), 0, 1, &paint), ANIC_OK);
  EXPECT_EQ(paint.moves, 0);
  const std::vector<float> shown = values(box, context, 1);
  EXPECT_TRUE(std::equal(shown.begin(), shown.end(), paint.values));
  anic_attribute map = ANIC_INIT(anic_attribute);
  ASSERT_EQ(anic_get_attribute(box.get(), 0, 0, &map), ANIC_OK);
  ASSERT_EQ(map.domain, ANIC_DOMAIN_CORNERS);
  std::vector<float> of_corners(size_t{map.count} * map.components);
  anic_value_output to = ANIC_INIT(anic_value_output);
  to.data = of_corners.data();
  to.size = of_corners.size() * sizeof(float);
  EXPECT_EQ(anic_write_attribute(context.get(), 0, 0, ANIC_WHEN_CURRENT, 0, map.count, &to),
            ANIC_OK);
  EXPECT_TRUE(std::equal(of_corners.begin(), of_corners.end(), map.values));
}

TEST(AnicAttributeValues, ComeInAnyFormatStrideAndRange) {
  const Asset asset = open(heated());
  const Context context = context_of(asset);
  ASSERT_EQ(anic_seek_frame(context.get(), 17), ANIC_OK);
  const std::vector<float> colours = values(asset, context, kColour);
  const std::vector<float> heat = values(asset, context, kHeat);
  constexpr uint32_t kFirst = 70, kCount = 160;
  std::vector<unsigned char> bytes(size_t{kCount} * 7, 0xEE);
  anic_value_output out = ANIC_INIT(anic_value_output);
  out.data = bytes.data();
  out.size = bytes.size();
  out.stride = 7;
  out.format = ANIC_VALUE_UNORM8;
  out.components = 3;
  ASSERT_EQ(
      anic_write_attribute(context.get(), 0, kColour, ANIC_WHEN_CURRENT, kFirst, kCount, &out),
      ANIC_OK);
  for (uint32_t v = 0; v < kCount; ++v) {
    for (uint32_t c = 0; c < 3; ++c) {
      const float x = std::clamp(colours[size_t{4} * (v + kFirst) + c], 0.0F, 1.0F);
      ASSERT_EQ(bytes[size_t{7} * v + c], static_cast<int>(x * 255 + 0.5F));
    }
    ASSERT_EQ(bytes[size_t{7} * v + 3], 0xEE);
  }
  // Missing components are 0, the fourth 1.
  std::vector<float> wide(size_t{kCount} * 4);
  out = anic::value_output(wide);
  out.components = 4;
  ASSERT_EQ(anic_write_attribute(context.get(), 0, kHeat, ANIC_WHEN_CURRENT, kFirst, kCount, &out),
            ANIC_OK);
  EXPECT_EQ(wide[40], heat[kFirst + 10]);
  EXPECT_EQ(wide[41], 0);
  EXPECT_EQ(wide[43], 1);
  std::vector<uint16_t> halves(size_t{kCount} * 4);
  out.data = halves.data();
  out.size = halves.size() * 2;
  out.format = ANIC_VALUE_FLOAT16;
  out.components = 0;
  ASSERT_EQ(
      anic_write_attribute(context.get(), 0, kColour, ANIC_WHEN_CURRENT, kFirst, kCount, &out),
      ANIC_OK);
  const float alpha = colours[size_t{4} * kFirst + 3];  // between a half and one: exponent -1
  EXPECT_NEAR((0x400 + (halves[3] & 0x3FF)) / 2048.0F, alpha, 1e-3);
  out.format = ANIC_VALUE_UNORM16;
  ASSERT_EQ(
      anic_write_attribute(context.get(), 0, kColour, ANIC_WHEN_CURRENT, kFirst, kCount, &out),
      ANIC_OK);
  EXPECT_EQ(halves[3], static_cast<int>(alpha * 65535 + 0.5F));
}

TEST(AnicAttributeValues, RefuseWhatMakesNoSense) {
  const Asset asset = open(heated());
  const Context context = context_of(asset);
  std::vector<float> room(vertices_of(asset));
  anic_value_output out = anic::value_output(room);
  auto status = [&](uint32_t mesh, uint32_t attribute, uint32_t first, uint32_t count) {
    return anic_write_attribute(context.get(), mesh, attribute, ANIC_WHEN_CURRENT, first, count,
                                &out);
  };
  EXPECT_EQ(status(0, kHeat, 0, 1), ANIC_E_STATE);
  ASSERT_EQ(anic_seek_frame(context.get(), 0), ANIC_OK);
  EXPECT_EQ(status(0, kHeat, 0, vertices_of(asset)), ANIC_OK);
  EXPECT_EQ(status(0, kColour, 0, vertices_of(asset)), ANIC_E_BUFFER_SIZE);
  EXPECT_EQ(status(1, kHeat, 0, 1), ANIC_E_ARGUMENT);
  EXPECT_EQ(status(0, 3, 0, 1), ANIC_E_ARGUMENT);
  EXPECT_EQ(status(0, kHeat, 1, vertices_of(asset)), ANIC_E_ARGUMENT);
  out.stride = 2;
  EXPECT_EQ(status(0, kHeat, 0, 1), ANIC_E_ARGUMENT);
  out.stride = 0;
  out.components = 17;
  EXPECT_EQ(status(0, kHeat, 0, 1), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_write_attribute(context.get(), 0, kHeat, ANIC_WHEN_CURRENT, 0, 1, nullptr),
            ANIC_E_ARGUMENT);
}

// The sum that a shader forms with the basis of an attribute.
TEST(AnicAttributeValues, ComeFromTheBasisAsPositionsDo) {
  const Asset asset = open(heated());
  const Context context = context_of(asset);
  ASSERT_EQ(anic_seek_time(context.get(), 0.77, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP), ANIC_OK);
  const std::vector<float> shown = values(asset, context, kColour);
  anic_attribute about = ANIC_INIT(anic_attribute);
  ASSERT_EQ(anic_get_attribute(asset.get(), 0, kColour, &about), ANIC_OK);
  std::vector<float> made(about.values, about.values + shown.size());
  anic_parts parts = ANIC_INIT(anic_parts);
  // Alpha rests.
  ASSERT_EQ(anic_get_attribute_parts(context.get(), 0, kColour, 3, ANIC_WHEN_CURRENT, &parts),
            ANIC_OK);
  EXPECT_EQ(parts.count, 0U);
  EXPECT_EQ(anic_get_attribute_parts(context.get(), 0, kColour, 1, ANIC_WHEN_CURRENT, &parts),
            ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_get_attribute_parts(context.get(), 0, kColour, 6, ANIC_WHEN_CURRENT, &parts),
            ANIC_E_ARGUMENT);
  ASSERT_EQ(anic_get_attribute_parts(context.get(), 0, kColour, 0, ANIC_WHEN_CURRENT, &parts),
            ANIC_OK);
  ASSERT_GT(parts.count, 0U);
  for (uint32_t p = 0; p < parts.count; ++p) {
    anic_basis basis = ANIC_INIT(anic_basis);
    ASSERT_EQ(anic_get_basis(asset.get(), parts.parts[p].segment, &basis), ANIC_OK);
    EXPECT_EQ(basis.target, ANIC_TARGET_ATTRIBUTE);
    EXPECT_EQ(basis.attribute, kColour);
    EXPECT_EQ(basis.first_component, 0U);
    ASSERT_EQ(basis.channels, 1U);
    for (uint32_t v = 0; v < basis.vertex_count; ++v) {
      const uint32_t b = v / ANIC_BLOCK_VERTICES, i = v % ANIC_BLOCK_VERTICES;
      for (uint32_t c = 0; c < 3; ++c) {
        const float* m = parts.parts[p].pose_map + size_t{4} * c;
        double x = double{m[3]};
        for (uint32_t d = 0; d < 3; ++d)
          x += double{m[d]} * double{basis.pose[(size_t{b} * 3 + d) * ANIC_BLOCK_VERTICES + i]};
        for (uint32_t j = 0; j < basis.components; ++j) {
          const double r =
              j < basis.wide_components
                  ? double{static_cast<float>(
                        basis.wide[(size_t{b} * basis.wide_components + j) * ANIC_BLOCK_VERTICES +
                                   i])}
                  : double{static_cast<float>(
                        basis.narrow[(size_t{b} * (basis.components - basis.wide_components) + j -
                                      basis.wide_components) *
                                         ANIC_BLOCK_VERTICES +
                                     i])};
          x += double{parts.parts[p].weights[3 * j + c]} * r;
        }
        made[size_t{4} * v + c] += static_cast<float>(double{parts.parts[p].share} * x);
      }
    }
    EXPECT_EQ(parts.parts[p].correction_count, 0U);
  }
  EXPECT_LE(largest_difference(shown, made), 1e-5);
  for (uint32_t s = 0, of_positions = 0; s < info_of(asset).segment_count; ++s) {
    anic_basis basis = ANIC_INIT(anic_basis);
    ASSERT_EQ(anic_get_basis(asset.get(), s, &basis), ANIC_OK);
    of_positions += basis.target == ANIC_TARGET_POSITIONS;
    EXPECT_EQ(of_positions, 1U);
  }
}

TEST(AnicAttributeValues, AreCoarserAtLowerQualityAndOfTheFirstFrameUntilTheyArrive) {
  anic_options options = ANIC_INIT(anic_options);
  options.quality = 0.5;
  const Asset coarse = open(heated(), &options);
  const Context context = context_of(coarse);
  ASSERT_EQ(anic_seek_frame(context.get(), 20), ANIC_OK);
  const double error =
      error_at(values(coarse, context, kHeat), attributed_source().attributes[kHeat], 20);
  EXPECT_GT(error, 0.46);
  EXPECT_LT(error, 200);

  anic::Stream stream;
  ASSERT_TRUE(stream.create());
  anic::Asset early;
  for (size_t at = 0; at < heated().size() && !early; ++at) {
    ASSERT_TRUE(stream.push({heated().data() + at, 1}));
    if (stream.info().playable) {
      ASSERT_TRUE(early.open(stream));
    }
  }
  ASSERT_TRUE(bool(early));
  EXPECT_EQ(early.info().partial, 1);
  anic::Context player;
  ASSERT_TRUE(player.create(early));
  ASSERT_TRUE(player.seek_frame(20));
  const anic_attribute about = early.attribute(kHeat);
  std::vector<float> shown(about.count);
  ASSERT_TRUE(player.write_attribute(kHeat, anic::value_output(shown), 0, about.count));
  EXPECT_TRUE(std::equal(shown.begin(), shown.end(), about.values));
}

}  // namespace
}  // namespace anicodec
