// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_facing.h"

#include "tools/io/gltf/gltf_accessor.h"

#include <algorithm>
#include <string>
#include <vector>

namespace anicodec::tools {
namespace {

using Scale = std::array<double, 3>;

/// The facings that a node has without its ancestors.
struct Seen {
  bool kept = false, turned = false;

  /// Flat scales have no front.
  void add(const Scale& scale) {
    if (mirrors(scale))
      turned = true;
    else if (std::ranges::find(scale, 0.0) == scale.end())
      kept = true;
  }

  /// The scales between two keys, each factor linear.
  void add_between(const Scale& a, const Scale& b) {
    std::vector<double> zeros{0, 1};
    for (size_t i = 0; i < 3; ++i) {
      if ((a[i] < 0) != (b[i] < 0) && a[i] != b[i])
        zeros.push_back(a[i] / (a[i] - b[i]));
    }
    std::ranges::sort(zeros);
    for (size_t z = 1; z < zeros.size(); ++z) {
      if (zeros[z] == zeros[z - 1])
        continue;
      const double middle = (zeros[z] + zeros[z - 1]) / 2;
      add({a[0] + middle * (b[0] - a[0]), a[1] + middle * (b[1] - a[1]),
           a[2] + middle * (b[2] - a[2])});
    }
  }

  /// A cubic between two keys lies within the control points of its Bezier form.
  void add_cubic(const Scale& a, const Scale& leave, const Scale& arrive, const Scale& b,
                 double length) {
    for (size_t i = 0; i < 3; ++i) {
      const auto [least, most] =
          std::minmax({a[i], a[i] + leave[i] * length / 3, b[i] - arrive[i] * length / 3, b[i]});
      if (least < 0 && most > 0)
        kept = turned = true;
    }
    add(a);
    add(b);
  }
};

Scale scale_at(const std::vector<float>& values, size_t element) {
  const float* at = values.data() + 3 * element;
  return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
}

void add_keys(const GltfDocument& document, const GltfSampler& sampler, const std::string& path,
              Seen* seen) {
  const std::vector<float> times = read_floats(document, sampler.input, path + "/input");
  const std::vector<float> values = read_floats(document, sampler.output, path + "/output");
  const bool cubic = sampler.interpolation == GltfInterpolation::kCubicSpline;
  for (size_t k = 0; k < times.size(); ++k) {
    const Scale at = scale_at(values, cubic ? 3 * k + 1 : k);
    if (k + 1 == times.size() || sampler.interpolation == GltfInterpolation::kStep)
      seen->add(at);
    else if (cubic)
      seen->add_cubic(at, scale_at(values, 3 * k + 2), scale_at(values, 3 * k + 3),
                      scale_at(values, 3 * k + 4),
                      static_cast<double>(times[k + 1]) - static_cast<double>(times[k]));
    else
      seen->add_between(at, scale_at(values, k + 1));
  }
}

GltfFacing with_parent(GltfFacing parent, const Seen& own) {
  if (parent == GltfFacing::kChanging || (own.kept && own.turned))
    return GltfFacing::kChanging;
  return own.turned == (parent == GltfFacing::kTurned) ? GltfFacing::kKept : GltfFacing::kTurned;
}

}  // namespace

bool mirrors(const Scale& scale) {
  return (scale[0] < 0) != ((scale[1] < 0) != (scale[2] < 0)) &&
         std::ranges::find(scale, 0.0) == scale.end();
}

bool mirrors(const std::array<double, 16>& matrix) {
  const double *a = matrix.data(), *b = a + 4, *c = a + 8;  // columns
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]) <
         0;
}

void find_facings(GltfDocument* document) {
  std::vector<Seen> seen(document->nodes.size());
  for (size_t n = 0; n < seen.size(); ++n) {
    const GltfNode& node = document->nodes[n];
    if (node.matrix)
      seen[n].turned = mirrors(*node.matrix);
    else
      seen[n].add(node.scale);
  }
  for (size_t a = 0; a < document->animations.size(); ++a) {
    const GltfAnimation& animation = document->animations[a];
    for (const GltfChannel& channel : animation.channels) {
      if (channel.path == GltfPath::kScale)
        add_keys(
            *document, animation.samplers[channel.sampler],
            "/animations/" + std::to_string(a) + "/samplers/" + std::to_string(channel.sampler),
            &seen[channel.node]);
    }
  }
  std::vector<uint32_t> open;
  for (uint32_t n = 0; n < document->nodes.size(); ++n) {
    if (document->nodes[n].parent == kGltfNone)
      open.push_back(n);
  }
  while (!open.empty()) {
    const uint32_t n = open.back();
    open.pop_back();
    GltfNode& node = document->nodes[n];
    node.facing = with_parent(
        node.parent == kGltfNone ? GltfFacing::kKept : document->nodes[node.parent].facing,
        seen[n]);
    open.insert(open.end(), node.children.begin(), node.children.end());
  }
}

}  // namespace anicodec::tools
