// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/stl.h"

#include "codec/sequence/triangulate.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/base/file_format.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/base/text_output.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace anicodec::tools {
namespace {

constexpr size_t kHeaderSize = 84;
constexpr size_t kTriangleSize = 50;

/// Words of an ascii STL; line ends separate them like blanks, letters have no case.
class StlText {
 public:
  StlText(std::string_view text, std::string_view name) : in_(text, name, {}) {}

  bool at_end() { return !in_.next_line(); }

  std::string word(const char* what) {
    in_.next_line();
    std::string word(in_.word(what));
    std::transform(word.begin(), word.end(), word.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return word;
  }

  void expect(const char* keyword) {
    std::string found = word(keyword);
    if (found != keyword)
      in_.fail("'" + shown(found) + "' stands where '" + keyword + "' is expected");
  }

  TextCursor& in() { return in_; }

 private:
  TextCursor in_;
};

void parse_facet(StlText& text, std::vector<float>& soup, LocalOrigin& origin) {
  text.expect("normal");
  // Exporters write all kinds of "not a number" as the normal of a degenerate triangle.
  for (int k = 0; k < 3; ++k)
    text.word("number");
  text.expect("outer");
  text.expect("loop");
  for (int corner = 0; corner < 3; ++corner) {
    text.expect("vertex");
    for (size_t k = 0; k < 3; ++k) {
      text.in().next_line();
      soup.push_back(text.in().coordinate(soup.size() / 3, k, origin));
    }
  }
  text.expect("endloop");
  text.expect("endfacet");
}

void parse_ascii(std::string_view bytes, std::string_view name, std::vector<float>& soup,
                 LocalOrigin& origin, LeftKinds& left_out) {
  StlText text(bytes, name);
  while (!text.at_end()) {
    if (!soup.empty())
      left_out.add("names of solids");
    text.expect("solid");
    text.in().skip_line();
    for (;;) {
      std::string keyword = text.word("facet or endsolid");
      if (keyword == "endsolid")
        break;
      if (keyword != "facet")
        text.in().fail("'" + shown(keyword) + "' stands where facet or endsolid is expected");
      parse_facet(text, soup, origin);
    }
    text.in().skip_line();
  }
}

void parse_binary(std::string_view bytes, std::string_view name, std::vector<float>& soup,
                  LocalOrigin& origin, LeftKinds& left_out) {
  size_t triangles = (bytes.size() - kHeaderSize) / kTriangleSize;
  soup.reserve(triangles * 9);
  for (size_t t = 0; t < triangles; ++t) {
    const char* triangle = bytes.data() + kHeaderSize + t * kTriangleSize;
    for (size_t i = 0; i < 9; ++i) {
      float x = load<float>(triangle + 12 + 4 * i, std::endian::little);
      if (!std::isfinite(x))
        fail_input(name, "corner " + std::to_string(i / 3) + " of triangle " + std::to_string(t) +
                             ": the position is not finite");
      soup.push_back(origin.rounded(static_cast<double>(x), i % 3));
    }
    if (load<uint16_t>(triangle + 48, std::endian::little) != 0)
      left_out.add("attribute bytes of triangles");
  }
}

bool same_place(std::span<const float> soup, size_t a, size_t b) {
  return std::equal(soup.data() + a * 3, soup.data() + a * 3 + 3, soup.data() + b * 3);
}

std::array<float, 3> unit_normal(std::span<const float> positions,
                                 std::array<uint32_t, 3> corners) {
  double edge[2][3];
  for (size_t k = 0; k < 3; ++k) {
    double origin = static_cast<double>(positions[corners[0] * size_t{3} + k]);
    for (size_t e = 0; e < 2; ++e)
      edge[e][k] = static_cast<double>(positions[corners[e + 1] * size_t{3} + k]) - origin;
  }
  double normal[3];
  for (size_t k = 0; k < 3; ++k)
    normal[k] =
        edge[0][(k + 1) % 3] * edge[1][(k + 2) % 3] - edge[0][(k + 2) % 3] * edge[1][(k + 1) % 3];
  double length = std::hypot(normal[0], normal[1], normal[2]);
  std::array<float, 3> unit{};
  for (size_t k = 0; k < 3 && length > 0; ++k)
    unit[k] = static_cast<float>(normal[k] / length);
  return unit;
}

void append_triangle(std::span<const float> positions, std::array<uint32_t, 3> corners, bool ascii,
                     const Point& origin, std::string& out) {
  std::array<float, 3> normal = unit_normal(positions, corners);
  if (ascii) {
    out += "facet normal ";
    append_floats(normal, out);
    out += "\nouter loop\n";
    for (uint32_t v : corners) {
      out += "vertex ";
      append_position(&positions[v * size_t{3}], origin, out);
      out += '\n';
    }
    out += "endloop\nendfacet\n";
    return;
  }
  for (float x : normal)
    append(x, std::endian::little, out);
  for (uint32_t v : corners) {
    for (float x : positions.subspan(v * size_t{3}, 3))
      append(x, std::endian::little, out);
  }
  append(uint16_t{0}, std::endian::little, out);
}

}  // namespace

void parse_stl(std::string_view bytes, std::string_view name, std::vector<float>& soup,
               LocalOrigin& origin, LeftKinds& left_out) {
  soup.clear();
  if (bytes.empty())
    fail_input(name, "the file is empty");
  uint64_t expected = 0;
  if (bytes.size() >= kHeaderSize)
    expected = kHeaderSize +
               uint64_t{kTriangleSize} * load<uint32_t>(bytes.data() + 80, std::endian::little);
  size_t first = bytes.find_first_not_of(" \t\r\n");
  std::string_view start = bytes.substr(std::min(first, bytes.size()), 5);
  bool text = (start == "solid" || start == "SOLID" || start == "Solid") &&
              bytes.substr(0, kHeaderSize).find('\0') == std::string_view::npos;
  if (expected == bytes.size())
    parse_binary(bytes, name, soup, origin, left_out);
  else if (text)
    parse_ascii(bytes, name, soup, origin, left_out);
  else if (expected == 0)
    fail_input(name, "is not an STL file: neither text nor a binary header of 84 bytes");
  else
    fail_input(name, "a binary STL of " + std::to_string((expected - kHeaderSize) / kTriangleSize) +
                         " triangles has " + std::to_string(expected) +
                         " bytes, but the file has " + std::to_string(bytes.size()));
  if (soup.empty())
    fail_input(name, "the mesh has no triangle");
  if (soup.size() / 3 > kMaxVertices)
    fail_input(name, "the mesh is too large: at most 2^31 - 1 corners");
}

void append_stl(const Polygons& polygons, std::span<const float> positions, bool ascii,
                std::string& out, const Point& origin) {
  size_t triangles = 0;
  for (size_t p = 0; p < polygons.size(); ++p)
    triangles += std::max<size_t>(polygons[p].size(), 2) - 2;
  if (ascii) {
    out += "solid anicodec\n";
  } else {
    out.append(80, '\0');
    append(static_cast<uint32_t>(triangles), std::endian::little, out);
  }
  for (size_t p = 0; p < polygons.size(); ++p) {
    std::span<const uint32_t> polygon = polygons[p];
    for (size_t i = 2; i < polygon.size(); ++i)
      append_triangle(positions, {polygon[0], polygon[i - 1], polygon[i]}, ascii, origin, out);
  }
  if (ascii)
    out += "endsolid anicodec\n";
}

StlWeld::StlWeld(std::span<const float> first_soup, std::string first_name, bool weld)
    : first_name_(std::move(first_name)), vertex_of_corner_(first_soup.size() / 3) {
  size_t corners = vertex_of_corner_.size();
  std::vector<uint32_t> order(corners);
  for (size_t c = 0; c < corners; ++c)
    order[c] = static_cast<uint32_t>(c);
  if (weld) {
    auto place = [&](uint32_t c) {
      const float* p = first_soup.data() + size_t{c} * 3;
      return std::array<float, 3>{p[0], p[1], p[2]};
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      auto x = place(a), y = place(b);
      return x == y ? a < b : x < y;
    });
  }
  // vertex_of_corner_ first holds the first corner at the same place, then its number among those.
  for (size_t i = 0; i < corners; ++i) {
    bool joins = weld && i > 0 && same_place(first_soup, order[i], order[i - 1]);
    vertex_of_corner_[order[i]] = joins ? vertex_of_corner_[order[i - 1]] : order[i];
  }
  for (uint32_t c = 0; c < corners; ++c) {
    uint32_t first = vertex_of_corner_[c];
    if (first == c) {
      vertex_of_corner_[c] = vertex_count();
      corner_of_vertex_.push_back(c);
    } else {
      vertex_of_corner_[c] = vertex_of_corner_[first];
    }
  }
}

Polygons StlWeld::polygons() const {
  Polygons polygons;
  polygons.corners = vertex_of_corner_;
  polygons.offsets.resize(vertex_of_corner_.size() / 3 + 1);
  for (size_t t = 0; t < polygons.offsets.size(); ++t)
    polygons.offsets[t] = static_cast<uint32_t>(3 * t);
  return polygons;
}

void StlWeld::append_vertices(std::span<const float> soup, std::string_view name,
                              FrameArray& positions) const {
  if (soup.size() != vertex_of_corner_.size() * 3)
    fail_input(name, std::to_string(soup.size() / 9) + " triangles, but " + first_name_ + " has " +
                         std::to_string(vertex_of_corner_.size() / 3));
  for (size_t c = 0; c < vertex_of_corner_.size(); ++c) {
    uint32_t first = corner_of_vertex_[vertex_of_corner_[c]];
    if (!same_place(soup, c, first))
      fail_input(name, "corner " + std::to_string(c % 3) + " of triangle " + std::to_string(c / 3) +
                           " and corner " + std::to_string(first % 3) + " of triangle " +
                           std::to_string(first / 3) + " lie apart, but are one vertex in " +
                           first_name_ + "; --no-weld takes every corner as a vertex");
  }
  for (uint32_t c : corner_of_vertex_)
    positions.insert(positions.end(), soup.begin() + size_t{c} * 3,
                     soup.begin() + size_t{c} * 3 + 3);
}

const FileFormat kStl = {
    .name = "STL",
    .extensions = ".stl",
    .mesh_parser = [](const LoadOptions& options) -> MeshParser {
      return [soup = std::vector<float>(), weld = std::optional<StlWeld>(),
              welds = options.weld_stl](std::string_view bytes, const std::string& name, Mesh& mesh,
                                        MeshDetails*, std::vector<std::string>*) mutable {
        parse_stl(bytes, name, soup, mesh.origin, mesh.left_out);
        if (!weld) {
          weld.emplace(soup, name, welds);
          mesh.polygons = weld->polygons();
        }
        mesh.positions.clear();
        weld->append_vertices(soup, name, mesh.positions);
      };
    },
    .frame_writer = [](const OutputClip& output, const std::string&, const std::vector<Attribute>&,
                       std::vector<AtomicFile>&) -> FrameWriter {
      // The triangles of all frames are those of the first, so that they correspond.
      return [&clip = output.clip, ascii = output.options.ascii,
              triangles = std::optional<Polygons>()](std::span<const float> positions,
                                                     std::string& out) mutable {
        if (!triangles)
          triangles = triangulated(clip.polygons, positions);
        append_stl(*triangles, positions, ascii, out, clip.origin);
      };
    },
    .is_soup = true,
    .text_has_room_for_origin = true};

}  // namespace anicodec::tools
