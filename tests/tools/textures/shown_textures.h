// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips for tests of textures, and the surface beside the textures as an engine gets it.
#ifndef ANICODEC_TESTS_TOOLS_TEXTURES_SHOWN_TEXTURES_H_
#define ANICODEC_TESTS_TOOLS_TEXTURES_SHOWN_TEXTURES_H_

#include "corpus/clips.h"
#include "tools/io/gltf/gltf.h"
#include "tools/textures/vat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// A vector, and its axes.
using V3 = std::array<double, 3>;

/// A limb; `split`: each face has a normal and texture coordinates of its own.
inline MeshSequence limb(bool split = false) {
  MeshSequence clip = corpus::make_scaled("limb", 120, 12);
  clip.shared_normals.clear();
  clip.attributes.clear();
  if (!split)
    return clip;
  Attribute uv;
  uv.domain = AttributeDomain::kCorner;
  for (uint32_t p = 0; p < clip.polygons.size(); ++p) {
    for (size_t k = 0; k < clip.polygons[p].size(); ++k) {
      clip.shared_normals.push_back(p);
      uv.values.push_back(static_cast<float>(p % 3) / 2);
      uv.values.push_back(static_cast<float>(p % 5) / 4);
    }
  }
  clip.attributes.push_back(std::move(uv));
  return clip;
}

inline VatSource source_of(const MeshSequence& clip, const TexelMesh& mesh) {
  return {"clip",
          mesh,
          frames_of(clip),
          clip.frame_count,
          {{"turn", 0, clip.frame_count, clip.rate.value(), clip.loop}}};
}

inline const VatFile& file_of(const VatResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.files, name, &VatFile::name);
  EXPECT_NE(found, result.files.end()) << name;
  return *found;
}

/// The GLB of a result: rest positions, and the second texture coordinates, v from the top.
class GlbSurface {
 public:
  explicit GlbSurface(const std::string& bytes)
      : mesh_(parse_gltf(bytes, "clip.glb", [](const auto&) { return std::string(); })) {
    EXPECT_EQ(std::ranges::count(mesh_.attributes, AttributeKind::kUv, &Attribute::kind), 2);
    uvs_ = &*std::find_if(mesh_.attributes.rbegin(), mesh_.attributes.rend(),
                          [](const Attribute& a) { return a.kind == AttributeKind::kUv; });
  }

  uint32_t size() const { return mesh_.vertex_count; }

  V3 rest(uint32_t v) const { return at(mesh_.frame(0), v); }

  double u(uint32_t v) const { return double{uvs_->values[size_t{2} * v]}; }

  double v(uint32_t v) const { return 1 - double{uvs_->values[size_t{2} * v + 1]}; }

  static V3 at(std::span<const float> values, uint32_t v) {
    return {double{values[size_t{3} * v]}, double{values[size_t{3} * v + 1]},
            double{values[size_t{3} * v + 2]}};
  }

 private:
  MeshSequence mesh_;
  const Attribute* uvs_;
};

/// The texel at a place from 0 to 1, without a filter.
inline const float* sample(const DataTexture& texture, double u, double v) {
  return texture.at(static_cast<uint32_t>(u * texture.width),
                    static_cast<uint32_t>(v * texture.height));
}

struct ShownVertex {
  V3 position, normal;
};

/// Compares what a shader makes of each vertex of a GLB in each frame with the clip, whose vertex stands where the rest
/// does: within a distance, and an angle in degrees.
inline void expect_shown(const VatSource& source, const GlbSurface& surface, double distance,
                         double angle, const std::function<V3(uint32_t texel)>& rest_of,
                         const std::function<uint32_t(uint32_t v)>& texel_of,
                         const std::function<ShownVertex(uint32_t f, uint32_t v)>& shown) {
  const TexelMesh& mesh = source.mesh;
  ASSERT_EQ(surface.size(), mesh.vertex_count());
  for (uint32_t f = 0; f < source.frame_count; ++f) {
    const std::span<const float> frame = source.frames(f);
    const std::vector<float> positions = mesh.positions(frame), normals = mesh.normals(frame);
    for (uint32_t v = 0; v < surface.size(); ++v) {
      const uint32_t texel = texel_of(v);
      ASSERT_LT(texel, mesh.vertex_count());
      const auto [x, n] = shown(f, v);
      const V3 wanted = GlbSurface::at(positions, texel), normal = GlbSurface::at(normals, texel);
      double off = 0, dot = 0, cross = 0;
      for (size_t c = 0; c < 3; ++c) {
        const size_t j = (c + 1) % 3, k = (c + 2) % 3;
        EXPECT_NEAR(surface.rest(v)[c], rest_of(texel)[c],
                    1e-6 * (1 + std::abs(rest_of(texel)[c])));
        off += std::pow(x[c] - wanted[c], 2);
        dot += n[c] * normal[c];
        cross += std::pow(n[j] * normal[k] - n[k] * normal[j], 2);
      }
      ASSERT_LE(std::sqrt(off), distance) << "frame " << f << " vertex " << v;
      ASSERT_LE(std::atan2(std::sqrt(cross), dot) * 180 / 3.14159265, angle) << f << " " << v;
    }
  }
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TESTS_TOOLS_TEXTURES_SHOWN_TEXTURES_H_
