// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/frame_textures.h"

#include <array>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

using Json = nlohmann::ordered_json;
using Vector = std::array<double, 3>;

/// The contents of the textures for a vertex in a frame.
struct Shown {
  Vector offset{}, normal{};
};

Vector three(std::span<const float> values, uint32_t v) {
  return {values[size_t{3} * v], values[size_t{3} * v + 1], values[size_t{3} * v + 2]};
}

Vector unit(const Vector& x) {
  const double length = std::hypot(x[0], x[1], x[2]);
  return length > 0 ? Vector{x[0] / length, x[1] / length, x[2] / length} : Vector{0, 0, 1};
}

/// Axes as a tool has them, from those of glTF and back.
struct Axes {
  Vector (*to)(const Vector&);
  Vector (*from)(const Vector&);
};

constexpr Axes kBlender = {[](const Vector& x) {
                             return Vector{x[0], -x[2], x[1]};
                           },
                           [](const Vector& x) {
                             return Vector{x[0], x[2], -x[1]};
                           }};
constexpr Axes kUnity = {[](const Vector& x) {
                           return Vector{-x[0], x[1], x[2]};
                         },
                         [](const Vector& x) {
                           return Vector{-x[0], x[1], x[2]};
                         }};

struct Range {
  std::array<float, 3> least, largest;

  /// From 0 to 1, and back.
  double share(double x, size_t c) const {
    const double width = double{largest[c]} - double{least[c]};
    return width > 0 ? std::clamp((x - double{least[c]}) / width, 0.0, 1.0) : 0;
  }

  double value(double share, size_t c) const {
    return double{least[c]} + share * (double{largest[c]} - double{least[c]});
  }
};

/// The frames of a source at its texels.
class Frames {
 public:
  Frames(const VatSource& source, const VatOptions& options)
      : source_(source), options_(options), rest_(frame(0)), at_rest_(mesh().positions(rest_)) {}

  const TexelMesh& mesh() const { return source_.mesh; }

  bool has_normals() const { return options_.normals && mesh().has_normals(); }

  /// Calls visit(frame, offsets, normals) for all frames.
  template <class Visit>
  void visit(std::string_view stage, const Visit& visit) const {
    for (uint32_t f = 0; f < source_.frame_count; ++f) {
      if (options_.progress)
        options_.progress(stage, static_cast<double>(f) / source_.frame_count);
      const std::span<const float> frame = source_.frames(f);
      const std::vector<float> positions = mesh().positions(frame);
      visit(f, positions, has_normals() ? mesh().normals(frame) : std::vector<float>());
    }
  }

  Vector offset(std::span<const float> positions, uint32_t v) const {
    const Vector a = three(positions, v), b = three(at_rest_, v);
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }

  /// The range of the offsets in other axes; 0 is among them.
  Range range(const Axes& axes) const {
    Range range{{0, 0, 0}, {0, 0, 0}};
    visit("looking", [&](uint32_t, std::span<const float> positions, std::span<const float>) {
      for (uint32_t v = 0; v < mesh().vertex_count(); ++v) {
        const Vector x = axes.to(offset(positions, v));
        for (size_t c = 0; c < 3; ++c) {
          range.least[c] = std::min(range.least[c], static_cast<float>(x[c]));
          range.largest[c] = std::max(range.largest[c], static_cast<float>(x[c]));
        }
      }
    });
    return range;
  }

  /// Compares all frames with what shown(frame, vertex) tells of the files.
  template <class Tell>
  void measure(VatError* error, const Tell& shown) const {
    visit("measuring",
          [&](uint32_t f, std::span<const float> positions, std::span<const float> normals) {
            std::vector<double> x(positions.size()), n(normals.size());
            for (uint32_t v = 0; v < mesh().vertex_count(); ++v) {
              const Shown s = shown(f, v);
              const Vector rest = three(at_rest_, v), normal = unit(s.normal);
              for (size_t c = 0; c < 3; ++c) {
                x[3 * v + c] = rest[c] + s.offset[c];
                if (!n.empty())
                  n[3 * v + c] = normal[c];
              }
            }
            error->add(positions, x, normals, n);
          });
  }

  std::string glb(const std::vector<TexelPlace>& places) const { return mesh().glb(rest_, places); }

 private:
  std::vector<float> frame(uint32_t f) const {
    const std::span<const float> positions = source_.frames(f);
    return {positions.begin(), positions.end()};
  }

  const VatSource& source_;
  const VatOptions& options_;
  const std::vector<float> rest_, at_rest_;
};

void set(float* texel, const Vector& x, double alpha = 1) {
  for (size_t c = 0; c < 3; ++c)
    texel[c] = static_cast<float>(x[c]);
  texel[3] = static_cast<float>(alpha);
}

Json openvat_json(const VatSource& source, const Range& range) {
  Json animations = Json::object();
  for (const VatClip& clip : source.clips)
    animations[clip.name.empty() ? source.name : clip.name] = {
        {"startFrame", clip.first_frame},
        {"endFrame", clip.first_frame + clip.frame_count - 1},
        {"framerate", clip.rate},
        {"looping", clip.loop}};
  return {
      {"os-remap", {{"Min", range.least}, {"Max", range.largest}, {"Frames", source.frame_count}}},
      {"animations", animations}};
}

/// The rotation from y to a unit vector: x, y, z, w.
std::array<double, 4> rotation_to(const Vector& n) {
  const double w = 1 + n[1], length = std::sqrt(n[2] * n[2] + n[0] * n[0] + w * w);
  if (length < 1e-9)
    return {1, 0, 0, 0};
  return {n[2] / length, 0, -n[0] / length, w / length};
}

Vector turned_y(const std::array<double, 4>& q) {
  return {2 * (q[0] * q[1] - q[3] * q[2]), q[3] * q[3] - q[0] * q[0] + q[1] * q[1] - q[2] * q[2],
          2 * (q[1] * q[2] + q[3] * q[0])};
}

/// So many tenths, as a float whose ten-fold is there or just towards `side`.
float tenths(double count, float side) {
  auto result = static_cast<float>(count / 10);
  const auto whole = static_cast<float>(count);
  while (side < whole ? result * 10 > whole : result * 10 < whole)
    result = std::nextafter(result, side);
  return result;
}

/// Bounds around a range in whose tenths the shaders find what else they need: no part of the textures is padding, no
/// data are in alpha, and numbers are as they are or between the bounds.
Range houdini_bounds(Range range, bool as_they_are) {
  constexpr float kUp = std::numeric_limits<float>::max(), kDown = -kUp;
  auto above = [](float x) { return std::ceil(double{x} * 10); };
  range.least[2] = tenths(std::floor(double{range.least[2]} * 10), kDown);
  range.largest[0] = tenths(above(range.largest[0]), kDown);
  range.largest[1] = tenths(above(range.largest[1]), kUp);
  range.largest[2] = tenths(above(range.largest[2]), kUp) + (as_they_are ? 0.075F : 0.0F);
  return range;
}

Json houdini_json(const VatSource& source, const Range& range) {
  const auto& [least, largest] = range;
  return Json::array({{{"Name", "VAT"},
                       {"Axis System", "Y-Z-X Clockwise (Left-Handed Y-Up)"},
                       {"Bound Max X", largest[0]},
                       {"Bound Max Y", largest[1]},
                       {"Bound Max Z", largest[2]},
                       {"Bound Min X", least[0]},
                       {"Bound Min Y", least[1]},
                       {"Bound Min Z", least[2]},
                       {"Frame Count", source.frame_count},
                       {"Houdini FPS", source.clips[0].rate},
                       {"Two Position Textures", 0}}});
}

}  // namespace

VatResult make_openvat(const VatSource& source, const VatOptions& options) {
  const uint32_t vertices = source.mesh.vertex_count(), frames = source.frame_count;
  const TexelGrid grid(vertices, options.max_size);
  const Frames all(source, options);
  const uint64_t half = uint64_t{grid.rows} * frames, height = half * (all.has_normals() ? 2 : 1);
  check_rows(source, height, options);
  const Range range = all.range(kBlender);
  DataTexture texture(grid.width, static_cast<uint32_t>(height));
  auto row = [&](uint32_t f, uint32_t v) { return grid.y(v) * frames + f; };
  all.visit("filling",
            [&](uint32_t f, std::span<const float> positions, std::span<const float> normals) {
              for (uint32_t v = 0; v < vertices; ++v) {
                Vector x = kBlender.to(all.offset(positions, v));
                for (size_t c = 0; c < 3; ++c)
                  x[c] = range.share(x[c], c);
                set(texture.at(grid.x(v), row(f, v)), x);
                if (normals.empty())
                  continue;
                Vector n = kBlender.to(three(normals, v));
                for (double& coordinate : n)
                  coordinate = std::clamp((coordinate + 1) / 2, 0.0, 1.0);
                set(texture.at(grid.x(v), row(f, v) + static_cast<uint32_t>(half)), n);
              }
            });
  VatResult result;
  texture = result.add_texture(source.name + "_vat", texture,
                               options.png ? TexelKind::kPng16 : TexelKind::kExrHalf);
  all.measure(&result.error, [&](uint32_t f, uint32_t v) {
    const float* texel = texture.at(grid.x(v), row(f, v));
    Vector x, n{};
    for (size_t c = 0; c < 3; ++c)
      x[c] = range.value(texel[c], c);
    if (all.has_normals()) {
      texel = texture.at(grid.x(v), row(f, v) + static_cast<uint32_t>(half));
      for (size_t c = 0; c < 3; ++c)
        n[c] = 2 * double{texel[c]} - 1;
    }
    return Shown{kBlender.from(x), kBlender.from(n)};
  });
  result.files.push_back(
      {source.name + "-remap_info.json", openvat_json(source, range).dump(2) + "\n"});
  result.files.push_back({source.name + ".glb", all.glb(grid.places(vertices, frames, height))});
  return result;
}

VatResult make_houdini(const VatSource& source, const VatOptions& options) {
  const uint32_t vertices = source.mesh.vertex_count(), frames = source.frame_count;
  const TexelGrid grid(vertices, options.max_size);
  const uint64_t height = uint64_t{grid.rows} * frames;
  check_rows(source, height, options);
  const Frames all(source, options);
  const Range bounds = houdini_bounds(all.range(kUnity), !options.png);
  DataTexture offsets(grid.width, static_cast<uint32_t>(height)), rotations;
  if (all.has_normals())
    rotations = offsets;
  auto row = [&](uint32_t f, uint32_t v) { return f * grid.rows + grid.y(v); };
  all.visit(
      "filling", [&](uint32_t f, std::span<const float> positions, std::span<const float> normals) {
        for (uint32_t v = 0; v < vertices; ++v) {
          Vector x = kUnity.to(all.offset(positions, v));
          for (size_t c = 0; options.png && c < 3; ++c)
            x[c] = bounds.share(x[c], c);
          set(offsets.at(grid.x(v), row(f, v)), x);
          if (normals.empty())
            continue;
          float* texel = rotations.at(grid.x(v), row(f, v));
          for (double q : rotation_to(kUnity.to(unit(three(normals, v)))))
            *texel++ = static_cast<float>(options.png ? std::clamp((q + 1) / 2, 0.0, 1.0) : q);
        }
      });
  VatResult result;
  const TexelKind kind = options.png ? TexelKind::kPng16 : TexelKind::kExrHalf;
  offsets = result.add_texture(source.name + "_pos", offsets, kind);
  if (all.has_normals())
    rotations = result.add_texture(source.name + "_rot", rotations, kind);
  all.measure(&result.error, [&](uint32_t f, uint32_t v) {
    const float* texel = offsets.at(grid.x(v), row(f, v));
    Shown shown;
    for (size_t c = 0; c < 3; ++c)
      shown.offset[c] = options.png ? bounds.value(texel[c], c) : double{texel[c]};
    shown.offset = kUnity.from(shown.offset);
    if (all.has_normals()) {
      texel = rotations.at(grid.x(v), row(f, v));
      std::array<double, 4> q;
      for (size_t c = 0; c < 4; ++c)
        q[c] = options.png ? 2 * double{texel[c]} - 1 : double{texel[c]};
      shown.normal = kUnity.from(turned_y(q));
    }
    return shown;
  });
  result.files.push_back({source.name + "_data.json", houdini_json(source, bounds).dump(2) + "\n"});
  result.files.push_back({source.name + "_mesh.glb", all.glb(grid.places(vertices, 1, height))});
  return result;
}

}  // namespace anicodec::tools
