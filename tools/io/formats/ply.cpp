// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/ply.h"

#include "tools/io/base/byte_order.h"
#include "tools/io/base/file_format.h"
#include "tools/io/base/printable.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/base/text_output.h"
#include "tools/io/formats/ply_header.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace anicodec::tools {
namespace {

/// Values of an ascii body: one element per line.
class AsciiBody {
 public:
  AsciiBody(std::string_view text, std::string_view name, size_t line)
      : in_(text, name, {}, line) {}

  void begin_element(const PlyElement& element, uint64_t index) {
    if (element.properties.empty())
      return;
    if (!in_.next_line())
      in_.fail("the file ends after " + std::to_string(index) + " of " +
               std::to_string(element.count) + " elements '" + shown(element.name) + "'");
  }

  void end_element() { in_.end_line(); }

  float coordinate(PlyType, size_t vertex, size_t axis, LocalOrigin& origin) {
    return in_.coordinate(vertex, axis, origin);
  }

  int64_t integer(PlyType, const char* what) { return in_.integer(what); }

  double value(PlyType) { return in_.number("number"); }

  void skip(PlyType) { in_.skip_number("number"); }

  /// Refuses counts that the rest of the file cannot hold: every value takes at least one byte.
  void expect(uint64_t count, PlyType) const {
    if (count > in_.bytes_left())
      in_.fail(std::to_string(count) + " values do not fit the rest of the file");
  }

  void end() {
    if (in_.next_line())
      in_.fail("unexpected '" + shown(in_.word("word")) + "' after the last element");
  }

  [[noreturn]] void fail(const std::string& reason) const { in_.fail(reason); }

 private:
  TextCursor in_;
};

/// Values of a binary body.
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, std::string_view name, size_t offset, std::endian order)
      : bytes_(bytes), name_(name), offset_(offset), order_(order) {}

  void begin_element(const PlyElement& element, uint64_t index) {
    element_ = &element;
    index_ = index;
  }

  void end_element() {}

  float coordinate(PlyType type, size_t vertex, size_t axis, LocalOrigin& origin) {
    double x = type == PlyType::kFloat32   ? static_cast<double>(take<float>())
               : type == PlyType::kFloat64 ? take<double>()
                                           : static_cast<double>(integer(type, "coordinate"));
    float rounded =
        std::abs(x - origin.at[axis]) <= static_cast<double>(std::numeric_limits<float>::max())
            ? origin.rounded(x, axis)
            : std::numeric_limits<float>::quiet_NaN();
    if (!std::isfinite(rounded))
      fail_input(name_, "a coordinate of vertex " + std::to_string(vertex) +
                            (std::isfinite(x) ? " exceeds the range of 32-bit numbers"
                                              : " is not finite"));
    return rounded;
  }

  int64_t integer(PlyType type, const char*) {
    switch (type) {
      case PlyType::kInt8:
        return take<int8_t>();
      case PlyType::kUint8:
        return take<uint8_t>();
      case PlyType::kInt16:
        return take<int16_t>();
      case PlyType::kUint16:
        return take<uint16_t>();
      case PlyType::kInt32:
        return take<int32_t>();
      case PlyType::kUint32:
        return take<uint32_t>();
      default:
        fail("has no integer where one is expected");
    }
  }

  double value(PlyType type) {
    return type == PlyType::kFloat32   ? static_cast<double>(take<float>())
           : type == PlyType::kFloat64 ? take<double>()
                                       : static_cast<double>(integer(type, "number"));
  }

  void skip(PlyType type) {
    need(size_of(type));
    offset_ += size_of(type);
  }

  void expect(uint64_t count, PlyType type) const { need(count * size_of(type)); }

  void end() {
    if (offset_ != bytes_.size())
      fail_input(name_, "the elements end at byte " + std::to_string(offset_) +
                            ", but the file has " + std::to_string(bytes_.size()) + " bytes");
  }

  [[noreturn]] void fail(const std::string& reason) const {
    fail_input(name_, shown(element_->name) + " " + std::to_string(index_) + ": " + reason);
  }

 private:
  void need(uint64_t size) const {
    if (bytes_.size() - offset_ < size)
      fail_input(name_, "truncated: " + shown(element_->name) + " " + std::to_string(index_) +
                            " of " + std::to_string(element_->count) + " needs at least " +
                            std::to_string(offset_ + size) + " bytes, the file has " +
                            std::to_string(bytes_.size()));
  }

  template <typename T>
  T take() {
    need(sizeof(T));
    T x = load<T>(bytes_.data() + offset_, order_);
    offset_ += sizeof(T);
    return x;
  }

  std::string_view bytes_;
  std::string_view name_;
  size_t offset_;
  std::endian order_;
  const PlyElement* element_ = nullptr;
  uint64_t index_ = 0;
};

template <typename Body>
void skip_property(const PlyProperty& property, Body& body) {
  int64_t count = property.list ? body.integer(property.count_type, "list count") : 1;
  if (count < 0)
    body.fail("a list of " + std::to_string(count) + " values");
  body.expect(static_cast<uint64_t>(count), property.type);
  for (int64_t i = 0; i < count; ++i)
    body.skip(property.type);
}

constexpr size_t kNone = std::numeric_limits<size_t>::max();

template <typename Body>
void read_vertices(const PlyElement& element, std::string_view name, Body& body, Mesh& mesh,
                   MeshDetails* details) {
  constexpr std::string_view kAxes[] = {"x", "y", "z"};
  std::vector<size_t> axis_of(element.properties.size(), kNone);
  for (size_t k = 0; k < 3; ++k) {
    auto found = std::find_if(element.properties.begin(), element.properties.end(),
                              [&](const PlyProperty& p) { return p.name == kAxes[k]; });
    if (found == element.properties.end() || found->list)
      fail_input(name, "the vertices have no coordinate " + std::string(kAxes[k]));
    axis_of[static_cast<size_t>(found - element.properties.begin())] = k;
  }
  if (element.count > kMaxVertices)
    fail_input(name, std::to_string(element.count) + " vertices; at most 2^31 - 1 are possible");
  if (element.count > 0) {
    body.begin_element(element, 0);
    // A list has at least its count.
    body.expect(element.count * element.properties.size(), PlyType::kInt8);
  }

  mesh.positions.resize(element.count * 3);
  PlyAttributes attributes = details ? PlyAttributes(element) : PlyAttributes();
  for (size_t v = 0; v < element.count; ++v) {
    body.begin_element(element, v);
    for (size_t i = 0; i < axis_of.size(); ++i) {
      if (axis_of[i] != kNone)
        mesh.positions[v * 3 + axis_of[i]] =
            body.coordinate(element.properties[i].type, v, axis_of[i], mesh.origin);
      else if (attributes.takes(i))
        attributes.add(v, i, body.value(element.properties[i].type));
      else
        skip_property(element.properties[i], body);
    }
    body.end_element();
  }
  if (details)
    details->attributes = attributes.finish(element, &mesh.left_out);
}

template <typename Body>
void read_polygon(const PlyProperty& property, uint64_t vertices, Body& body, Mesh& mesh) {
  int64_t corners = body.integer(property.count_type, "count of corners");
  if (corners < 3)
    body.fail("a face of " + std::to_string(corners) + " corners; at least 3 are expected");
  body.expect(static_cast<uint64_t>(corners), property.type);
  for (int64_t i = 0; i < corners; ++i) {
    int64_t v = body.integer(property.type, "vertex index");
    if (v < 0 || static_cast<uint64_t>(v) >= vertices)
      body.fail("vertex index " + std::to_string(v) + " is out of range; there are " +
                std::to_string(vertices) + " vertices");
    mesh.polygons.corners.push_back(static_cast<uint32_t>(v));
  }
  if (mesh.polygons.corners.size() > kMaxCorners)
    body.fail("more than 2^32 - 1 face corners");
  mesh.polygons.offsets.push_back(static_cast<uint32_t>(mesh.polygons.corners.size()));
}

/// Takes the values of a property of a face, of which each becomes a number of a corner.
template <typename Body>
void take_property(const PlyProperty& property, size_t index, Body& body, PlyCorners& corners) {
  const int64_t count = property.list ? body.integer(property.count_type, "list count") : 1;
  if (count < 0)
    body.fail("a list of " + std::to_string(count) + " values");
  body.expect(static_cast<uint64_t>(count), property.type);
  for (int64_t i = 0; i < count; ++i)
    corners.add(index, body.value(property.type));
}

template <typename Body>
void read_faces(const PlyElement& element, std::string_view name, uint64_t vertices, Body& body,
                Mesh& mesh, PlyCorners& corners) {
  auto is_polygon = [](const PlyProperty& p) {
    return p.name == "vertex_indices" || p.name == "vertex_index";
  };
  const auto& properties = element.properties;
  auto polygon = std::find_if(properties.begin(), properties.end(), is_polygon);
  if (polygon == properties.end() || !polygon->list || !is_integer(polygon->type))
    fail_input(name, "the faces have no list vertex_indices or vertex_index of integers");
  if (std::count_if(properties.begin(), properties.end(), is_polygon) != 1)
    fail_input(name, "the faces have both vertex_indices and vertex_index");
  for (uint64_t f = 0; f < element.count; ++f) {
    body.begin_element(element, f);
    for (size_t i = 0; i < properties.size(); ++i) {
      if (&properties[i] == &*polygon)
        read_polygon(properties[i], vertices, body, mesh);
      else if (corners.takes(i))
        take_property(properties[i], i, body, corners);
      else
        skip_property(properties[i], body);
    }
    body.end_element();
    corners.end_face(mesh.polygons[mesh.polygons.size() - 1].size());
  }
}

template <typename Body>
void read_body(const PlyHeader& header, uint64_t vertices, std::string_view name, Body& body,
               Mesh& mesh, MeshDetails* details) {
  std::vector<Attribute> of_corners;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(element, name, body, mesh, details);
    } else if (element.name == "face") {
      PlyCorners corners = details ? PlyCorners(element) : PlyCorners();
      read_faces(element, name, vertices, body, mesh, corners);
      if (details)
        of_corners = corners.finish(element, &mesh.left_out);
    } else if (element.name == "tristrips" && element.count > 0) {
      fail_input(name, "triangle strips (element tristrips) are not read; save it with faces");
    } else if (!element.properties.empty()) {
      if (details && element.count > 0)
        mesh.left_out.add("'" + printable(element.name) + "'");
      for (uint64_t i = 0; i < element.count; ++i) {
        body.begin_element(element, i);
        for (const PlyProperty& property : element.properties)
          skip_property(property, body);
        body.end_element();
      }
    }
  }
  body.end();
  if (details)
    std::ranges::move(of_corners, std::back_inserter(details->attributes));
}

}  // namespace

void parse_ply(std::string_view bytes, std::string_view name, Mesh& mesh, MeshDetails* details) {
  mesh.clear();
  PlyHeader header = parse_ply_header(bytes, name);
  uint64_t vertices = 0;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex")
      vertices = element.count;
  }
  if (header.encoding == PlyEncoding::kAscii) {
    AsciiBody body(bytes.substr(header.body), name, header.body_line);
    read_body(header, vertices, name, body, mesh, details);
  } else {
    bool big = header.encoding == PlyEncoding::kBigEndian;
    BinaryBody body(bytes, name, header.body, big ? std::endian::big : std::endian::little);
    read_body(header, vertices, name, body, mesh, details);
  }
  check_size(mesh, name);
}

void append_ply(const Polygons& polygons, std::span<const float> positions, bool ascii,
                std::string& out, const PlyProperties* properties, const Point& origin) {
  size_t largest = 0;
  for (size_t p = 0; p < polygons.size(); ++p)
    largest = std::max(largest, polygons[p].size());
  bool narrow = largest <= 255;
  out += std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") + " 1.0\n";
  out += "element vertex " + std::to_string(positions.size() / 3) + "\n";
  const bool wide = origin != Point();
  for (const char* axis : {"x", "y", "z"})
    out += std::string("property ") + (wide ? "double " : "float ") + axis + "\n";
  if (properties)
    out += properties->declarations();
  out += "element face " + std::to_string(polygons.size()) + "\nproperty list " +
         (narrow ? "uchar" : "uint") + " int vertex_indices\nend_header\n";
  if (ascii) {
    for (size_t i = 0; i + 2 < positions.size(); i += 3) {
      append_position(&positions[i], origin, out);
      if (properties)
        properties->append(i / 3, ascii, out);
      out += '\n';
    }
    for (size_t p = 0; p < polygons.size(); ++p) {
      append_number(polygons[p].size(), out);
      for (uint32_t v : polygons[p]) {
        out += ' ';
        append_number(v, out);
      }
      out += '\n';
    }
    return;
  }
  for (size_t i = 0; i + 2 < positions.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      if (wide)
        append(origin[k] + static_cast<double>(positions[i + k]), std::endian::little, out);
      else
        append(positions[i + k], std::endian::little, out);
    }
    if (properties)
      properties->append(i / 3, ascii, out);
  }
  for (size_t p = 0; p < polygons.size(); ++p) {
    if (narrow)
      append(static_cast<uint8_t>(polygons[p].size()), std::endian::little, out);
    else
      append(static_cast<uint32_t>(polygons[p].size()), std::endian::little, out);
    for (uint32_t v : polygons[p])
      append(v, std::endian::little, out);
  }
}

const FileFormat kPly = {
    .name = "PLY",
    .extensions = ".ply",
    .find_mark = [](std::string_view bytes) { return bytes.starts_with("ply") ? 0 : bytes.npos; },
    .mesh_parser = [](const LoadOptions&) -> MeshParser {
      return [](std::string_view bytes, const std::string& name, Mesh& mesh, MeshDetails* details,
                std::vector<std::string>*) { parse_ply(bytes, name, mesh, details); };
    },
    .frame_writer = [](const OutputClip& output, const std::string&,
                       const std::vector<Attribute>& attributes,
                       std::vector<AtomicFile>&) -> FrameWriter {
      return [&clip = output.clip, ascii = output.options.ascii,
              properties = PlyProperties(attributes)](std::span<const float> positions,
                                                      std::string& out) {
        append_ply(clip.polygons, positions, ascii, out, &properties, clip.origin);
      };
    },
    .has_room_for_origin = true};

}  // namespace anicodec::tools
