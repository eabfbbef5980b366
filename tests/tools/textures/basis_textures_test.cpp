// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/basis_textures.h"

#include "codec/sequence/error.h"
#include "tests/tools/textures/shown_textures.h"

#include <numeric>

#include <gmock/gmock.h>

namespace anicodec::tools {
namespace {

/// Frames, as the shaders of bindings/shaders read them; the error must be what the result says.
VatResult expect_basis(const MeshSequence& clip, const VatOptions& options, double rmse) {
  const TexelMesh mesh(clip);
  const VatSource source = source_of(clip, mesh);
  BasisBounds bounds;
  bounds.rmse = {rmse};
  bounds.rms_angle = 2;
  VatResult result = make_basis(source, options, bounds);
  const auto json = nlohmann::json::parse(file_of(result, "clip_basis.json").bytes);
  auto number = [&](const char* name) { return json[name].get<uint32_t>(); };
  const TexelKind kind = options.png ? TexelKind::kPng16 : TexelKind::kExrHalf;
  const DataTexture basis = read_texture(file_of(result, json["basis"]).bytes, kind);
  const DataTexture weights = read_texture(file_of(result, json["weights"]).bytes, kind);
  EXPECT_LE(std::max({basis.width, basis.height, weights.width, weights.height}), options.max_size);
  const uint32_t rows = number("rows"), layers = number("position_layers"),
                 normal_layers = number("normal_layers"),
                 columns = 2 + 4 * (layers + normal_layers);
  const GlbSurface surface(file_of(result, "clip.glb").bytes);
  auto weight = [&](uint32_t f, uint32_t column, size_t c) {
    const float* w = weights.at(column + f / weights.height * columns, f % weights.height);
    return double{w[c]} * json["weight_scale"].get<double>() + json["weight_bias"].get<double>();
  };
  auto add = [&](V3 x, uint32_t f, uint32_t v, uint32_t first, uint32_t count, uint32_t column) {
    const auto px = static_cast<uint32_t>(surface.u(v) * basis.width);
    const auto py = static_cast<uint32_t>(surface.v(v) * rows);
    for (uint32_t i = 0; i < 4 * count; ++i) {
      const double b = double{basis.at(px, py + (first + i / 4) * rows)[i % 4]} *
                           json["basis_scale"].get<double>() +
                       json["basis_bias"].get<double>();
      for (size_t c = 0; c < 3; ++c)
        x[c] += b * weight(f, column + i, c);
    }
    return x;
  };
  // The mean of the frames.
  std::vector<float> rest(mesh.positions(clip.frame(0)).size());
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    const std::vector<float> frame = mesh.positions(clip.frame(f));
    for (size_t i = 0; i < rest.size(); ++i)
      rest[i] += frame[i] / static_cast<float>(clip.frame_count);
  }
  expect_shown(
      source, surface, result.error.largest() * (1 + 1e-6) + 1e-9,
      result.error.largest_angle() + 0.01, [&](uint32_t v) { return GlbSurface::at(rest, v); },
      [&](uint32_t v) {
        return static_cast<uint32_t>(surface.u(v) * basis.width) +
               static_cast<uint32_t>(surface.v(v) * rows) * basis.width;
      },
      [&](uint32_t f, uint32_t v) {
        V3 x = surface.rest(v);
        for (size_t c = 0; c < 3; ++c)
          x[c] += weight(f, 0, c) + weight(f, 1, c);
        return ShownVertex{add(x, f, v, 0, layers, 2),
                           add({}, f, v, layers, normal_layers, 2 + 4 * layers)};
      });
  return result;
}

TEST(BasisTextures, KeepTheirBounds) {
  const double bound = diagonal(limb()) / 500;
  for (bool png : {false, true}) {
    const VatResult result = expect_basis(limb(), {.png = png}, bound);
    EXPECT_LE(result.error.rmse(), bound);
    EXPECT_GT(result.error.rmse(), 0.1 * bound) << "components that nobody needs";
    EXPECT_LE(result.error.rms_angle(), 2);
    EXPECT_TRUE(result.left_out.empty());
  }
  expect_basis(limb(true), {}, bound);
}

TEST(BasisTextures, WrapFramesAndVertices) {
  MeshSequence clip = corpus::make_scaled("limb", 120, 40);
  clip.attributes.clear();
  clip.shared_normals.clear();
  expect_basis(clip, {.max_size = 36}, diagonal(clip) / 20);
}

TEST(BasisTextures, TakeLongClips) {
  const MeshSequence clip = corpus::make_wave_grid(64, 300, 7);  // 900 coordinates
  const double bound = diagonal(clip) / 1e4;
  const VatResult result = expect_basis(clip, {}, bound);
  EXPECT_LE(result.error.rmse(), bound);
  const auto json = nlohmann::json::parse(file_of(result, "clip_basis.json").bytes);
  EXPECT_LE(json["position_layers"], 2);
}

TEST(BasisTextures, TravelOfTheWholeCostsNoPrecision) {
  MeshSequence clip = limb();
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    for (size_t i = 0; i < clip.frame(f).size(); i += 3)
      clip.frame(f)[i] += 50.0F * static_cast<float>(f);
  }
  EXPECT_LE(expect_basis(clip, {}, diagonal(limb()) / 500).error.rmse(), diagonal(limb()) / 500);
}

TEST(BasisTextures, NothingMoves) {
  MeshSequence clip = limb();
  for (uint32_t f = 1; f < clip.frame_count; ++f)
    std::ranges::copy(clip.frame(0), clip.frame(f).begin());
  const VatResult result = expect_basis(clip, {.png = true}, 1e-3);
  EXPECT_LE(result.error.largest(), 1e-6);
}

TEST(BasisTextures, SaysThatRoundedNumbersPassABound) {
  const MeshSequence clip = limb();
  const TexelMesh mesh(clip);
  BasisBounds bounds;
  bounds.rmse = {1e-7, true};
  const VatResult result = make_basis(source_of(clip, mesh), {}, bounds);
  ASSERT_EQ(result.left_out.size(), 1U);
  EXPECT_THAT(result.left_out[0], testing::HasSubstr("--rmse"));
}

TEST(BasisTextures, SaysThatABoundIsOutOfReach) {
  const MeshSequence clip = corpus::make_wave_grid(100, 30, 20);
  const TexelMesh mesh(clip);
  BasisBounds bounds;
  bounds.rmse = {1e-5, true};
  bounds.most = 8;
  try {
    make_basis(source_of(clip, mesh), {}, bounds);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("more than 8 components"));
    EXPECT_THAT(error.what(), testing::HasSubstr("--rmse"));
  }
}

}  // namespace
}  // namespace anicodec::tools
