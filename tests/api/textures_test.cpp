// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Textures and states, and positions that a shader makes of them.
#include "tests/api/conformance_file.h"
#include "tests/api/opened.h"

#include <array>
#include <cstring>

namespace anicodec {
namespace {

using Texel = std::array<double, 4>;

/// A texture as a graphics interface would get it, with rows that are longer than their texels.
class Texture {
 public:
  Texture(const Asset& asset, uint32_t segment, anic_texture kind,
          const anic_texture_layout& layout, uint32_t height)
      : kind_(kind), layout_(layout) {
    texel_ = kind == ANIC_TEXTURE_NARROW ? 8 : 16;
    stride_ = (layout.width * texel_ + 255) / 256 * 256 + 256;
    const size_t size = height == 0 ? 0 : stride_ * (height - 1) + texel_ * layout.width;
    bytes_.assign(size + 16, 0xA5);
    EXPECT_EQ(anic_write_texture(asset.get(), segment, kind, &layout, stride_, bytes_.data(), size),
              ANIC_OK);
    EXPECT_EQ(bytes_[size], 0xA5);
    if (size > 0) {
      EXPECT_EQ(
          anic_write_texture(asset.get(), segment, kind, &layout, stride_, bytes_.data(), size - 1),
          ANIC_E_BUFFER_SIZE);
      if (height > 1) {
        EXPECT_EQ(bytes_[layout.width * texel_], 0xA5) << "between rows";
      }
    }
  }

  Texel at(uint32_t v, uint32_t layer) const {
    const size_t row = layer * layout_.rows + v / layout_.width;
    const unsigned char* from = bytes_.data() + row * stride_ + v % layout_.width * texel_;
    Texel out;
    for (size_t i = 0; i < 4; ++i) {
      if (kind_ == ANIC_TEXTURE_POSE)
        out[i] = static_cast<double>(number<float>(from, i));
      else
        out[i] = kind_ == ANIC_TEXTURE_WIDE ? number<int32_t>(from, i) : number<int16_t>(from, i);
    }
    return out;
  }

 private:
  template <class T>
  static T number(const unsigned char* from, size_t i) {
    T result;
    std::memcpy(&result, from + i * sizeof(T), sizeof(T));
    return result;
  }

  anic_texture kind_;
  anic_texture_layout layout_;
  size_t texel_ = 0, stride_ = 0;
  std::vector<unsigned char> bytes_;
};

/// x += the groups of a texture, as the header writes them down.
void add_groups(const Texture& texture, uint32_t v, uint32_t groups, bool vectors,
                const float* weights, double (&x)[3]) {
  for (uint32_t g = 0; g < groups; ++g) {
    for (uint32_t j = 0; j < 4; ++j) {
      for (uint32_t c = 0; c < 3; ++c) {
        const uint32_t k = 3 * j + c;
        if (vectors)
          x[c] += static_cast<double>(weights[4 * g + j]) * texture.at(v, 3 * g + k / 4)[k % 4];
        else
          x[c] += static_cast<double>(weights[12 * g + k]) * texture.at(v, g)[j];
      }
    }
  }
}

void transform(const float* map, double (&x)[3]) {
  const double in[3] = {x[0], x[1], x[2]};
  for (int r = 0; r < 3; ++r) {
    x[r] = static_cast<double>(map[4 * r + 3]);
    for (int c = 0; c < 3; ++c)
      x[r] += static_cast<double>(map[4 * r + c]) * in[c];
  }
}

/// Positions of all vertices by what anic_write_texture() and anic_write_state() give.
std::vector<double> shaded(const Asset& asset, const Context& context, uint32_t max_size) {
  const uint32_t n = vertices_of(asset);
  std::vector<double> out(size_t{3} * n);
  anic_parts shown = ANIC_INIT(anic_parts);
  EXPECT_EQ(anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &shown), ANIC_OK);
  for (uint32_t p = 0; p < shown.count; ++p) {
    const anic_part& part = shown.parts[p];
    anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
    anic_basis basis = ANIC_INIT(anic_basis);
    EXPECT_EQ(anic_get_basis(asset.get(), part.segment, &basis), ANIC_OK);
    EXPECT_EQ(anic_get_texture_layout(asset.get(), part.segment, max_size, &layout), ANIC_OK);
    EXPECT_LE(
        std::max({layout.width, layout.pose_height, layout.wide_height, layout.narrow_height}),
        max_size);
    EXPECT_GE(layout.width * layout.rows, n);
    EXPECT_LT(layout.width * (layout.rows - 1), std::max(n, 1U));
    const Texture pose(asset, part.segment, ANIC_TEXTURE_POSE, layout, layout.pose_height);
    const Texture wide(asset, part.segment, ANIC_TEXTURE_WIDE, layout, layout.wide_height);
    const Texture narrow(asset, part.segment, ANIC_TEXTURE_NARROW, layout, layout.narrow_height);
    std::vector<float> state(layout.state_floats + 1, 77);
    EXPECT_EQ(anic_write_state(context.get(), 0, ANIC_WHEN_CURRENT, p, state.data(),
                               sizeof(float) * layout.state_floats),
              ANIC_OK);
    EXPECT_EQ(state.back(), 77);
    const bool vectors = basis.channels == 3;
    EXPECT_EQ(layout.regions, basis.regions);
    for (uint32_t v = 0; v < n; ++v) {
      double x[3] = {0, 0, 0};
      const float* of_region = state.data();
      if (layout.pose_height > 0) {
        const Texel still = pose.at(v, 0);
        std::copy_n(still.begin(), 3, x);
        of_region += static_cast<size_t>(still[3]) * (layout.state_floats / layout.regions);
      }
      EXPECT_EQ(static_cast<uint32_t>(of_region[27]), part.correction_count);
      const float* narrow_weights =
          of_region + ANIC_STATE_FLOATS + (vectors ? 4 : 12) * ((basis.wide_components + 3) / 4);
      transform(of_region, x);
      add_groups(wide, v, static_cast<uint32_t>(of_region[24]), vectors,
                 of_region + ANIC_STATE_FLOATS, x);
      add_groups(narrow, v, static_cast<uint32_t>(of_region[25]), vectors, narrow_weights, x);
      transform(of_region + 12, x);
      for (size_t c = 0; c < 3; ++c)
        out[3 * v + c] += static_cast<double>(of_region[26]) * x[c];
    }
    for (uint32_t k = 0; k < part.correction_count; ++k) {
      for (size_t c = 0; c < 3; ++c)
        out[3 * part.corrections[k].vertex + c] +=
            static_cast<double>(part.share) * static_cast<double>(part.corrections[k].delta[c]);
    }
  }
  return out;
}

void expect_shaded(const Asset& asset, const Context& context, uint32_t max_size) {
  const std::vector<float> expected = positions(asset, context);
  const std::vector<double> made = shaded(asset, context, max_size);
  double largest = 0, size = 0;
  for (size_t i = 0; i < made.size(); ++i) {
    largest = std::max(largest, std::abs(made[i] - static_cast<double>(expected[i])));
    size = std::max(size, std::abs(made[i]));
  }
  EXPECT_LE(largest, 2e-5 * size);
}

TEST(AnicTextures, HoldWhatAShaderNeeds) {
  for (const char* name :
       {"limb_effort9", "heated", "other_parents", "quad_box_corrected", "regions", "saturated",
        "schedules", "vertex_order", "weights_in_time"}) {
    SCOPED_TRACE(name);
    const Asset asset = open(conformance_file(name));
    const Context context = context_of(asset);
    for (double quality : {1.0, 0.3}) {
      ASSERT_EQ(anic_set_quality(context.get(), quality), ANIC_OK);
      for (double t : {0.0, 0.13}) {
        ASSERT_EQ(anic_seek_time(context.get(), t, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP), ANIC_OK);
        expect_shaded(asset, context, 16384);
        // Several rows to a layer.
        expect_shaded(asset, context, std::max(256U, vertices_of(asset) / 3));
      }
    }
  }
}

TEST(AnicTextures, RefuseWhatDoesNotFit) {
  const Asset asset = open(conformance_file("vertex_order"));
  const Context context = context_of(asset);
  anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
  EXPECT_EQ(anic_get_texture_layout(asset.get(), 0, 4, &layout), ANIC_E_LIMIT);
  EXPECT_EQ(anic_get_texture_layout(asset.get(), 0, 0, &layout), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_get_texture_layout(asset.get(), 99, 4096, &layout), ANIC_E_ARGUMENT);
  ASSERT_EQ(anic_get_texture_layout(asset.get(), 0, 4096, &layout), ANIC_OK);
  std::vector<unsigned char> bytes(size_t{8} * layout.width * layout.narrow_height);
  const auto write = [&](const anic_texture_layout& to, anic_texture texture, size_t row_bytes) {
    return anic_write_texture(asset.get(), 0, texture, &to, row_bytes, bytes.data(), bytes.size());
  };
  EXPECT_EQ(write(layout, ANIC_TEXTURE_NARROW, 0), ANIC_OK);
  EXPECT_EQ(write(layout, ANIC_TEXTURE_NARROW, 8), ANIC_E_ARGUMENT) << "rows overlap";
  EXPECT_EQ(write(layout, static_cast<anic_texture>(3), 0), ANIC_E_ARGUMENT);
  anic_texture_layout other = layout;
  other.rows += 1;
  EXPECT_EQ(write(other, ANIC_TEXTURE_NARROW, 0), ANIC_E_ARGUMENT);
  other = layout;
  other.width = 0;
  EXPECT_EQ(write(other, ANIC_TEXTURE_NARROW, 0), ANIC_E_ARGUMENT);

  std::vector<float> state(layout.state_floats);
  const auto write_state = [&](uint32_t part, size_t size) {
    return anic_write_state(context.get(), 0, ANIC_WHEN_CURRENT, part, state.data(), size);
  };
  EXPECT_EQ(write_state(0, sizeof(float) * state.size()), ANIC_E_STATE);
  ASSERT_EQ(anic_seek_frame(context.get(), 0), ANIC_OK);
  EXPECT_EQ(write_state(0, sizeof(float) * state.size()), ANIC_OK);
  EXPECT_EQ(write_state(0, sizeof(float) * state.size() - 1), ANIC_E_BUFFER_SIZE);
  EXPECT_EQ(write_state(1, sizeof(float) * state.size()), ANIC_E_ARGUMENT);
}

TEST(AnicTextures, AreNoneOfGeometryInterpolation) {
  const Asset asset = open(conformance_file("nonmanifold_interpolated"));
  const Context context = context_of(asset);
  anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
  EXPECT_EQ(anic_get_texture_layout(asset.get(), 0, 4096, &layout), ANIC_E_STATE);
  ASSERT_EQ(anic_seek_frame(context.get(), 0), ANIC_OK);
  std::vector<float> state(1000);
  EXPECT_EQ(anic_write_state(context.get(), 0, ANIC_WHEN_CURRENT, 0, state.data(),
                             sizeof(float) * state.size()),
            ANIC_E_STATE);
}

}  // namespace
}  // namespace anicodec
