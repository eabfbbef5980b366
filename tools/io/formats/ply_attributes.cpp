// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/ply_attributes.h"

#include "format/records.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/base/printable.h"
#include "tools/io/base/text_output.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace anicodec::tools {
namespace {

constexpr const char* kColour[] = {"red", "green", "blue", "alpha"};
constexpr const char* kNormal[] = {"nx", "ny", "nz"};
constexpr const char* kUvNames[][2] = {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}};
constexpr float kByte = 255;

bool is_byte(float x) {
  constexpr float kClose = 0.02F;
  const float k = std::round(x * kByte);
  return k >= 0 && k <= kByte && std::abs(x * kByte - k) < kClose;
}

}  // namespace

double ply_range(PlyType type) {
  return is_integer(type) ? std::exp2(8.0 * static_cast<double>(size_of(type))) - 1 : 1;
}

PlyAttributes::PlyAttributes(const PlyElement& vertices) : places_(vertices.properties.size()) {
  group(vertices, AttributeKind::kColour, "colour", kColour, 3);
  for (const auto& names : kUvNames)
    group(vertices, AttributeKind::kUv, "uv", names, 2);
  group(vertices, AttributeKind::kNormal, "normal", kNormal, 3);
  for (uint32_t i = 0; i < places_.size(); ++i) {
    const PlyProperty& p = vertices.properties[i];
    const bool is_axis = p.name == "x" || p.name == "y" || p.name == "z";
    if (p.list || is_axis || takes(i) || attributes_.size() == kMaxAttributes / 2)
      continue;
    places_[i].attribute = static_cast<uint32_t>(attributes_.size());
    attributes_.push_back(
        {.kind = AttributeKind::kCustom, .name = p.name, .components = 1, .values = {}});
  }
  for (Attribute& a : attributes_)
    a.values.reserve(std::min<size_t>(vertices.count, 1 << 20) * a.components);
}

/// An attribute of properties of these names, of which the first `least` must be there.
void PlyAttributes::group(const PlyElement& vertices, AttributeKind kind, const char* name,
                          std::span<const char* const> names, size_t least) {
  std::vector<size_t> found;
  for (const char* wanted : names) {
    for (size_t i = 0; i < vertices.properties.size(); ++i) {
      if (vertices.properties[i].name == wanted && !vertices.properties[i].list)
        found.push_back(i);
    }
  }
  const bool complete = found.size() == names.size() ||
                        (found.size() == least && vertices.properties[found.back()].name ==
                                                      std::string_view(names[least - 1]));
  const bool known =
      std::ranges::any_of(attributes_, [&](const Attribute& a) { return a.kind == kind; });
  if (!complete || known)
    return;
  for (uint32_t c = 0; c < found.size(); ++c) {
    Place& place = places_[found[c]];
    place.attribute = static_cast<uint32_t>(attributes_.size());
    place.component = c;
    if (kind == AttributeKind::kColour)
      place.scale = ply_range(vertices.properties[found[c]].type);
  }
  attributes_.push_back({.kind = kind,
                         .name = name,
                         .components = static_cast<uint32_t>(found.size()),
                         .values = {}});
}

void PlyAttributes::add(size_t vertex, size_t property, double value) {
  const Place& place = places_[property];
  Attribute& a = attributes_[place.attribute];
  a.values.resize((vertex + 1) * a.components);
  const double scaled = value / place.scale;
  const bool fits = std::abs(scaled) <= static_cast<double>(std::numeric_limits<float>::max());
  a.values[vertex * a.components + place.component] =
      fits ? static_cast<float>(scaled) : std::numeric_limits<float>::quiet_NaN();
}

std::vector<Attribute> PlyAttributes::finish(const PlyElement& vertices, LeftKinds* left_out) {
  const auto is_finite = [](const Attribute& a) {
    return std::ranges::all_of(a.values, [](float x) { return std::isfinite(x); });
  };
  for (size_t i = 0; i < places_.size(); ++i) {
    const std::string& name = vertices.properties[i].name;
    const bool is_kept = takes(i) ? is_finite(attributes_[places_[i].attribute])
                                  : name == "x" || name == "y" || name == "z";
    if (!is_kept)
      left_out->add("'" + printable(name) + "' of vertices");
  }
  std::erase_if(attributes_, [&](const Attribute& a) { return !is_finite(a); });
  return std::move(attributes_);
}

PlyProperties::PlyProperties(const std::vector<Attribute>& attributes) {
  std::set<std::string> taken{"x", "y", "z"};
  auto declare = [&](const char* type, std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == 0x7F; }, '_');
    if (name.empty())
      name = "value";
    while (!taken.insert(name).second)
      name += '_';
    declarations_ += std::string("property ") + type + " " + name + "\n";
  };
  std::set<AttributeKind> kinds;
  for (const Attribute& a : attributes) {
    const bool is_colour =
        a.kind == AttributeKind::kColour && a.components >= 3 && a.components <= std::size(kColour);
    const bool is_uv = a.kind == AttributeKind::kUv && a.components == 2;
    if (!a.per_vertex() || !(is_colour || is_uv || a.kind == AttributeKind::kCustom) ||
        (a.kind != AttributeKind::kCustom && !kinds.insert(a.kind).second))
      continue;
    const bool bytes = is_colour && std::ranges::all_of(a.values, is_byte);
    for (uint32_t c = 0; c < a.components; ++c) {
      if (is_colour)
        declare(bytes ? "uchar" : "float", kColour[c]);
      else if (is_uv)
        declare("float", kUvNames[0][c]);
      else
        declare("float", a.components == 1 ? a.name : a.name + "_" + std::to_string(c));
    }
    written_.push_back({&a, bytes});
  }
}

void PlyProperties::append(size_t vertex, bool ascii, std::string& out) const {
  for (const Written& w : written_) {
    const size_t n = w.attribute->components;
    for (size_t c = 0; c < n; ++c) {
      const float x = w.attribute->values[vertex * n + c];
      const auto byte =
          static_cast<uint8_t>(std::lround(std::clamp(w.bytes ? x : 0.0F, 0.0F, 1.0F) * kByte));
      if (ascii) {
        out += ' ';
        if (w.bytes)
          append_number(static_cast<unsigned>(byte), out);
        else
          append_number(x, out);
      } else if (w.bytes) {
        out += static_cast<char>(byte);
      } else {
        tools::append(x, std::endian::little, out);
      }
    }
  }
}

}  // namespace anicodec::tools
