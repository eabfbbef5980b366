// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/off.h"

#include "tools/io/base/file_format.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/base/text_output.h"

namespace anicodec::tools {
namespace {

/// How many numbers may follow the coordinates of a vertex.
struct Extras {
  int least = 0;
  int most = 0;
};

Extras parse_header(TextCursor& in, LeftKinds& left_out) {
  if (!in.next_line())
    in.fail("the file is empty");
  std::string_view keyword = in.word("header");
  std::string_view rest = keyword;
  auto take = [&rest](std::string_view prefix) {
    bool found = rest.starts_with(prefix);
    if (found)
      rest.remove_prefix(prefix.size());
    return found;
  };
  Extras extras;
  if (take("ST")) {
    left_out.add("texture coordinates");
    extras = {2, 2};
  }
  if (take("C")) {
    left_out.add("colours of vertices");
    // An index into a colour map, RGB or RGBA.
    extras.least += 1;
    extras.most += 4;
  }
  if (take("N")) {
    left_out.add("normals");
    extras.least += 3;
    extras.most += 3;
  }
  if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF")
    in.fail("'" + shown(keyword) + "' has vertices of other than three coordinates");
  if (rest != "OFF")
    in.fail("'" + shown(keyword) + "' is not an OFF header");
  return extras;
}

uint64_t parse_count(TextCursor& in, const char* what, uint64_t limit) {
  int64_t count = in.integer(what);
  if (count < 0 || static_cast<uint64_t>(count) > limit)
    in.fail(std::to_string(count) + " is an impossible " + what);
  return static_cast<uint64_t>(count);
}

void next_line(TextCursor& in, const char* what, uint64_t index, uint64_t count) {
  if (!in.next_line())
    in.fail("the file ends after " + std::to_string(index) + " of " + std::to_string(count) + " " +
            what);
}

/// Reads numbers to the end of the line, returns how many.
int skip_numbers(TextCursor& in) {
  int count = 0;
  for (; !in.at_line_end(); ++count)
    in.skip_number("number");
  return count;
}

void parse_vertex(TextCursor& in, size_t index, Extras extras, Mesh& mesh) {
  for (size_t k = 0; k < 3; ++k)
    mesh.positions.push_back(in.coordinate(index, k, mesh.origin));
  int extra = skip_numbers(in);
  if (extra < extras.least || extra > extras.most)
    in.fail("vertex " + std::to_string(index) + " has " + std::to_string(3 + extra) +
            " numbers, which does not fit the header");
}

void parse_face(TextCursor& in, uint64_t vertices, Mesh& mesh) {
  int64_t corners = in.integer("count of corners");
  if (corners < 3)
    in.fail("a face of " + std::to_string(corners) + " corners; at least 3 are expected");
  for (int64_t i = 0; i < corners; ++i) {
    int64_t v = in.integer("vertex index");
    if (v < 0 || static_cast<uint64_t>(v) >= vertices)
      in.fail("vertex index " + std::to_string(v) + " is out of range; there are " +
              std::to_string(vertices) + " vertices");
    mesh.polygons.corners.push_back(static_cast<uint32_t>(v));
  }
  if (mesh.polygons.corners.size() > kMaxCorners)
    in.fail("more than 2^32 - 1 face corners");
  mesh.polygons.offsets.push_back(static_cast<uint32_t>(mesh.polygons.corners.size()));
  const int numbers = skip_numbers(in);
  if (numbers > 4)
    in.fail("more numbers after a face than a colour has");
  if (numbers > 0)
    mesh.left_out.add("colours of faces");
}

}  // namespace

void parse_off(std::string_view text, std::string_view name, Mesh& mesh) {
  mesh.clear();
  TextCursor in(text, name, {.comment = '#'});
  Extras extras = parse_header(in, mesh.left_out);
  if (in.at_line_end())
    next_line(in, "count", 0, 3);
  else if (TextCursor ahead = in; ahead.word("word") == "BINARY")
    in.fail("binary OFF is not read; save it as ascii");
  uint64_t vertices = parse_count(in, "count of vertices", kMaxVertices);
  uint64_t faces = parse_count(in, "count of faces", kMaxCorners / 3);
  if (!in.at_line_end())
    in.integer("count of edges");
  in.end_line();

  for (uint64_t v = 0; v < vertices; ++v) {
    next_line(in, "vertices", v, vertices);
    parse_vertex(in, v, extras, mesh);
  }
  for (uint64_t f = 0; f < faces; ++f) {
    next_line(in, "faces", f, faces);
    parse_face(in, vertices, mesh);
  }
  if (in.next_line())
    in.fail("unexpected '" + shown(in.word("word")) + "' after the last face");
  check_size(mesh, name);
}

void append_off(const Polygons& polygons, std::span<const float> positions, std::string& out,
                const Point& origin) {
  out += "OFF\n" + std::to_string(positions.size() / 3) + " " + std::to_string(polygons.size()) +
         " 0\n";
  for (size_t i = 0; i + 2 < positions.size(); i += 3) {
    append_position(&positions[i], origin, out);
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
}

const FileFormat kOff = {
    .name = "OFF",
    .extensions = ".off",
    .find_mark = [](std::string_view bytes) { return bytes.substr(0, 16).find("OFF"); },
    .mesh_parser = [](const LoadOptions&) -> MeshParser {
      return [](std::string_view bytes, const std::string& name, Mesh& mesh, MeshDetails*,
                std::vector<std::string>*) { parse_off(bytes, name, mesh); };
    },
    .frame_writer = [](const OutputClip& output, const std::string&, const std::vector<Attribute>&,
                       std::vector<AtomicFile>&) -> FrameWriter {
      return [&clip = output.clip](std::span<const float> positions, std::string& out) {
        append_off(clip.polygons, positions, out, clip.origin);
      };
    },
    .has_room_for_origin = true};

}  // namespace anicodec::tools
