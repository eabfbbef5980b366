// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/frame_textures.h"

#include "codec/sequence/error.h"
#include "tests/tools/textures/shown_textures.h"

#include <gmock/gmock.h>

namespace anicodec::tools {
namespace {

/// Frames, as a shader for OpenVAT reads them: a step down for each.
void expect_openvat(const MeshSequence& clip, const VatOptions& options, double distance,
                    double angle) {
  const TexelMesh mesh(clip);
  const VatSource source = source_of(clip, mesh);
  const VatResult result = make_openvat(source, options);
  const VatFile& file = file_of(result, options.png ? "clip_vat.png" : "clip_vat.exr");
  const DataTexture texture =
      read_texture(file.bytes, options.png ? TexelKind::kPng16 : TexelKind::kExrHalf);
  EXPECT_LE(std::max(texture.width, texture.height), options.max_size);
  const auto json = nlohmann::json::parse(file_of(result, "clip-remap_info.json").bytes);
  const auto& remap = json["os-remap"];
  EXPECT_EQ(remap["Frames"], clip.frame_count);
  EXPECT_EQ(json["animations"]["turn"]["endFrame"], clip.frame_count - 1);
  const GlbSurface surface(file_of(result, "clip.glb").bytes);
  const std::vector<float> rest = mesh.positions(clip.frame(0));
  const uint32_t rows = texture.height / 2 / clip.frame_count;
  expect_shown(
      source, surface, distance, angle, [&](uint32_t v) { return GlbSurface::at(rest, v); },
      [&](uint32_t v) {
        const auto x = static_cast<uint32_t>(surface.u(v) * texture.width);
        return x + static_cast<uint32_t>(surface.v(v) * 2 * rows) * texture.width;
      },
      [&](uint32_t f, uint32_t v) {
        const double down = surface.v(v) + static_cast<double>(f) / texture.height;
        const float* t = sample(texture, surface.u(v), down);
        const float* n = sample(texture, surface.u(v), down + 0.5);
        V3 x;
        for (size_t c = 0; c < 3; ++c)
          x[c] = double{t[c]} * (remap["Max"][c].get<double>() - remap["Min"][c].get<double>()) +
                 remap["Min"][c].get<double>();
        const V3 at = surface.rest(v);
        return ShownVertex{{at[0] + x[0], at[1] + x[2], at[2] - x[1]},
                           {2.0 * n[0] - 1, 2.0 * n[2] - 1, 1 - 2.0 * n[1]}};
      });
  EXPECT_LE(result.error.largest(), distance);
  EXPECT_LE(result.error.rmse(), result.error.largest());
  EXPECT_LE(result.error.largest_angle(), angle);
}

TEST(FrameTextures, OpenVatShowsEveryFrame) {
  const double size = diagonal(limb());
  expect_openvat(limb(), {.png = true}, size / 20000, 0.01);
  expect_openvat(limb(), {.png = false}, size / 1000, 0.1);
  expect_openvat(limb(true), {.png = true}, size / 20000, 0.01);
}

TEST(FrameTextures, OpenVatWrapsRows) {
  expect_openvat(limb(), {.png = true, .max_size = 100}, diagonal(limb()) / 20000, 0.01);
}

/// Frames, as the shader graph of SideFX Labs for soft bodies reads them.
void expect_houdini(const MeshSequence& clip, const VatOptions& options, double distance,
                    double angle) {
  const TexelMesh mesh(clip);
  const VatSource source = source_of(clip, mesh);
  const VatResult result = make_houdini(source, options);
  const TexelKind kind = options.png ? TexelKind::kPng16 : TexelKind::kExrHalf;
  const std::string end = options.png ? ".png" : ".exr";
  const DataTexture offsets = read_texture(file_of(result, "clip_pos" + end).bytes, kind);
  const DataTexture rotations = read_texture(file_of(result, "clip_rot" + end).bytes, kind);
  const auto data = nlohmann::json::parse(file_of(result, "clip_data.json").bytes)[0];
  auto bound = [&](const char* side, const char* axis) {
    return data[std::string("Bound ") + side + " " + axis].get<float>();
  };
  const float least_z = bound("Min", "Z") * 10, most_x = bound("Max", "X") * 10;
  const float across = 1 - (std::ceil(least_z) - least_z);
  const float down = 1 - (-most_x - std::floor(-most_x));
  EXPECT_NEAR(across, 1, 1e-4);
  EXPECT_NEAR(down, 1, 1e-4);
  const float most_z = bound("Max", "Z") * 10;
  EXPECT_EQ(most_z - std::floor(most_z) >= 0.5F, !options.png);
  const GlbSurface surface(file_of(result, "clip_mesh.glb").bytes);
  const std::vector<float> rest = mesh.positions(clip.frame(0));
  expect_shown(
      source, surface, distance, angle, [&](uint32_t v) { return GlbSurface::at(rest, v); },
      [&](uint32_t v) {
        return static_cast<uint32_t>(surface.u(v) * offsets.width) +
               static_cast<uint32_t>(surface.v(v) * offsets.height) * offsets.width;
      },
      [&](uint32_t f, uint32_t v) {
        const double u = surface.u(v) * double{across};
        const double y = surface.v(v) * double{down} + double{down} * f / clip.frame_count;
        const float* t = sample(offsets, u, y);
        const float* r = sample(rotations, u, y);
        V3 x{t[0], t[1], t[2]};
        double q[4] = {r[0], r[1], r[2], r[3]};
        if (options.png) {
          const char* axes[] = {"X", "Y", "Z"};
          for (size_t c = 0; c < 3; ++c)
            x[c] = x[c] * double{bound("Max", axes[c]) - bound("Min", axes[c])} +
                   double{bound("Min", axes[c])};
          for (double& k : q)
            k = 2 * (k - 0.5);
        }
        // y + 2 q x (q x y + w y)
        const V3 a{-q[2], q[3], q[0]};
        const V3 n{2 * (q[1] * a[2] - q[2] * a[1]), 1 + 2 * (q[2] * a[0] - q[0] * a[2]),
                   2 * (q[0] * a[1] - q[1] * a[0])};
        const V3 at = surface.rest(v);
        return ShownVertex{{at[0] - x[0], at[1] + x[1], at[2] + x[2]}, {-n[0], n[1], n[2]}};
      });
  EXPECT_LE(result.error.largest(), distance);
  EXPECT_LE(result.error.largest_angle(), angle);
}

TEST(FrameTextures, HoudiniShowsEveryFrame) {
  const double size = diagonal(limb());
  expect_houdini(limb(), {.png = true}, size / 10000, 0.02);
  expect_houdini(limb(), {.png = false}, size / 1000, 0.1);
  expect_houdini(limb(true), {.png = false}, size / 1000, 0.1);
}

TEST(FrameTextures, HoudiniWrapsRows) {
  expect_houdini(limb(), {.png = true, .max_size = 50}, diagonal(limb()) / 10000, 0.02);
}

TEST(FrameTextures, SaysThatATextureWouldBeTooLarge) {
  const MeshSequence clip = limb();
  const TexelMesh mesh(clip);
  for (auto make : {make_openvat, make_houdini}) {
    try {
      make(source_of(clip, mesh), {.max_size = 16});
      FAIL();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("and 16 are the most"));
      EXPECT_THAT(error.what(), testing::HasSubstr("12 frames"));
    }
  }
}

TEST(FrameTextures, PositionsAlone) {
  const MeshSequence clip = limb();
  const TexelMesh mesh(clip);
  const VatResult openvat = make_openvat(source_of(clip, mesh), {.normals = false});
  EXPECT_EQ(openvat.files[0].height, clip.frame_count);
  EXPECT_FALSE(openvat.error.has_normals());
  EXPECT_EQ(make_houdini(source_of(clip, mesh), {.normals = false}).files.size(), 3U);
}

}  // namespace
}  // namespace anicodec::tools
