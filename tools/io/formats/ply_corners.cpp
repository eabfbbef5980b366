// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/ply_corners.h"

#include "tools/io/base/printable.h"
#include "tools/io/formats/ply_attributes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace anicodec::tools {
namespace {

constexpr const char* kFaceColour[] = {"red", "green", "blue", "alpha"};

bool is_polygon(const PlyProperty& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

}  // namespace

PlyCorners::PlyCorners(const PlyElement& faces) : track_of_(faces.properties.size()) {
  const auto index_of = [&](const char* name, bool list) {
    const auto found = std::ranges::find_if(
        faces.properties, [&](const PlyProperty& p) { return p.name == name && p.list == list; });
    return static_cast<size_t>(found - faces.properties.begin());
  };
  const size_t none = faces.properties.size();
  const auto take = [&](size_t property, uint32_t component, bool is_colour) {
    track_of_[property] = {static_cast<uint32_t>(tracks_.size() - 1), component,
                           is_colour ? ply_range(faces.properties[property].type) : 1};
  };
  if (const size_t uv = index_of("texcoord", true); uv != none) {
    tracks_.push_back(
        {.name = "wedge_uv", .kind = AttributeKind::kUv, .of_face = false, .components = 2});
    take(uv, 0, false);
  }
  if (const size_t colour = index_of("color", true); colour != none) {
    tracks_.push_back({.name = "wedge_colour",
                       .kind = AttributeKind::kColour,
                       .of_face = false,
                       .components = 0});
    take(colour, 0, true);
  }
  uint32_t channels = 0;
  while (channels < std::size(kFaceColour) && index_of(kFaceColour[channels], false) != none)
    ++channels;
  if (channels < 3)
    return;
  tracks_.push_back({.name = "face_colour",
                     .kind = AttributeKind::kColour,
                     .of_face = true,
                     .components = channels});
  for (uint32_t c = 0; c < channels; ++c)
    take(index_of(kFaceColour[c], false), c, true);
}

void PlyCorners::add(size_t property, double value) {
  const Place& place = track_of_[property];
  Track& track = tracks_[place.track];
  if (track.of_face) {
    track.face.resize(track.components);
    track.face[place.component] = value / place.scale;
  } else {
    track.face.push_back(value / place.scale);
  }
}

void PlyCorners::end_face(size_t corners) {
  constexpr double kMost = std::numeric_limits<float>::max();
  for (Track& track : tracks_) {
    const size_t elements = track.of_face ? 1 : corners;
    if (track.components == 0 &&
        (track.face.size() == 3 * corners || track.face.size() == 4 * corners))
      track.components = static_cast<uint32_t>(track.face.size() / corners);
    if (track.face.empty()) {
      track.corners_before += track.components == 0 ? corners : 0;
      track.values.resize(track.values.size() + track.components * corners);
      continue;
    }
    track.fits &= track.components > 0 && track.face.size() == elements * track.components &&
                  std::ranges::all_of(track.face, [](double x) { return std::abs(x) <= kMost; });
    if (track.fits) {
      track.values.resize(track.values.size() + track.corners_before * track.components);
      track.corners_before = 0;
      for (size_t c = 0; c < corners; ++c) {
        const size_t first = track.of_face ? 0 : c * track.components;
        for (size_t k = first; k < first + track.components; ++k)
          track.values.push_back(static_cast<float>(track.face[k]));
      }
    }
    track.face.clear();
  }
}

std::vector<Attribute> PlyCorners::finish(const PlyElement& faces, LeftKinds* left_out) {
  std::vector<Attribute> out;
  for (Track& track : tracks_) {
    if (track.fits && track.components > 0)
      out.push_back({.kind = track.kind,
                     .name = track.name,
                     .domain = AttributeDomain::kCorner,
                     .components = track.components,
                     .values = std::move(track.values)});
  }
  for (size_t i = 0; i < faces.properties.size(); ++i) {
    const bool taken =
        takes(i) && tracks_[track_of_[i].track].fits && tracks_[track_of_[i].track].components > 0;
    if (!taken && !is_polygon(faces.properties[i]))
      left_out->add("'" + printable(faces.properties[i].name) + "' of faces");
  }
  return out;
}

}  // namespace anicodec::tools
