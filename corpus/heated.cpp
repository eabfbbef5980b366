// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/build.h"
#include "corpus/generators.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace anicodec::corpus {
namespace {

Vec3 swaying(const Vec3& rest, double time) {
  const double phase = 2 * std::numbers::pi * (0.7 * rest.x + 0.3 * rest.y - 0.4 * time);
  return {rest.x, rest.y, 0.08 * std::sin(phase) * rest.y};
}

/// Degrees at a point: a spot that circles and leaves a cooling edge.
double temperature(const Vec3& rest, double time) {
  const double angle = 2 * std::numbers::pi * 0.6 * time;
  const double dx = rest.x - 0.5 - 0.3 * std::cos(angle), dy = rest.y - 0.5 - 0.3 * std::sin(angle);
  return 20 + 400 * std::exp(-12 * (dx * dx + dy * dy)) + 60 * rest.x * std::min(time, 1.0);
}

float rounded(double x, double step) {
  return static_cast<float>(std::round(x / step) * step);
}

float byte_colour(double x) {
  return static_cast<float>(std::round(std::clamp(x, 0.0, 1.0) * 255)) / 255;
}

}  // namespace

MeshSequence heated(ClipSize size) {
  constexpr uint32_t kSide = 8;
  Mesh half = grid(kSide, 2 * kSide - 1), other;
  for (Vec3& p : half.vertices)
    p.x /= 2;
  other = half;
  for (Vec3& p : other.vertices)
    p.x += 0.5;
  half.append(other);  // the vertices of the seam are there twice
  MeshSequence clip = animate(half, size.frames, 2, [](uint32_t, const Vec3& rest, double time) {
    return swaying(rest, time);
  });
  Attribute uv{AttributeKind::kUv, "TEXCOORD_0", AttributeDomain::kVertex, 2, size.frames, {}};
  Attribute colour{AttributeKind::kColour, "COLOR_0", AttributeDomain::kVertex, 4, size.frames, {}};
  Attribute heat{
      AttributeKind::kCustom, "temperature", AttributeDomain::kVertex, 1, size.frames, {}};
  const auto first_of_other = static_cast<uint32_t>(half.vertices.size() / 2);
  for (uint32_t f = 0; f < size.frames; ++f) {
    const double time = f / 24.0;
    for (uint32_t v = 0; v < half.vertices.size(); ++v) {
      const Vec3& rest = half.vertices[v];
      const double degrees = temperature(rest, time), glow = (degrees - 20) / 440;
      heat.values.push_back(rounded(degrees, 1.0 / 64));
      for (double x : {0.2 + 0.8 * glow, 0.3 + 0.5 * glow * glow, 0.4 - 0.3 * glow})
        colour.values.push_back(byte_colour(x));
      colour.values.push_back(byte_colour(0.5 + 0.5 * rest.y));
      // Either half has a chart of its own, and the texture flows.
      const double chart = v < first_of_other ? 0 : 0.25;
      uv.values.push_back(rounded(rest.x + chart, 1.0 / 65536));
      uv.values.push_back(
          rounded(rest.y + 0.05 * time * (1 + 0.2 * std::sin(3 * time)), 1.0 / 65536));
    }
  }
  clip.attributes = {uv, colour, heat};
  return clip;
}

}  // namespace anicodec::corpus
