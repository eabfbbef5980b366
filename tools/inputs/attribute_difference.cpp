// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/attribute_difference.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec::tools {
namespace {

bool is_alike(const Attribute& a, const Attribute& b) {
  return a.kind == b.kind && a.name == b.name && a.domain == b.domain &&
         a.components == b.components && a.values.size() == b.values.size();
}

}  // namespace

std::vector<AttributeDifference> attribute_differences(const AttributeSource& a,
                                                       const AttributeSource& b, uint32_t frames,
                                                       bool corners) {
  std::vector<AttributeDifference> result;
  std::vector<std::pair<size_t, size_t>> pairs;
  for (uint32_t f = 0; f < frames; ++f) {
    const std::vector<Attribute> of_a = a(f), of_b = b(f);
    for (size_t i = 0; f == 0 && i < of_a.size(); ++i) {
      const auto found = std::ranges::find_if(
          of_b, [&](const Attribute& other) { return is_alike(of_a[i], other); });
      if (found == of_b.end() || (!of_a[i].per_vertex() && !corners))
        continue;
      pairs.emplace_back(i, static_cast<size_t>(found - of_b.begin()));
      result.push_back({of_a[i].kind, of_a[i].name});
    }
    for (size_t p = 0; p < pairs.size(); ++p) {
      const FrameArray &x = of_a[pairs[p].first].values, &y = of_b[pairs[p].second].values;
      for (size_t i = 0; i < x.size(); ++i) {
        const double d = std::abs(static_cast<double>(x[i]) - static_cast<double>(y[i]));
        result[p].max = std::max(result[p].max, d);
        result[p].rmse += d * d / static_cast<double>(x.size());
      }
    }
  }
  for (AttributeDifference& difference : result)
    difference.rmse = std::sqrt(difference.rmse / frames);
  return result;
}

}  // namespace anicodec::tools
