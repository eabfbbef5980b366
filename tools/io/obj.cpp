// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/obj.h"

#include "tools/io/text_cursor.h"
#include "tools/io/text_output.h"

#include <algorithm>
#include <iterator>

namespace anicodec::tools {
namespace {

// Statements that carry neither vertices nor polygons, in alphabetical order.
constexpr std::string_view kSkipped[] = {
    "bevel",  "bmat",  "bsp",       "bzp",   "c_interp", "cdc",        "cdp",    "con",
    "cstype", "ctech", "curv",      "curv2", "d_interp", "deg",        "end",    "g",
    "hole",   "illum", "l",         "lod",   "maplib",   "mg",         "mtllib", "o",
    "p",      "parm",  "res",       "s",     "scrv",     "shadow_obj", "sp",     "stech",
    "step",   "surf",  "trace_obj", "trim",  "usemap",   "usemtl",     "vp",
};

bool is_skipped(std::string_view keyword) {
  return std::find(std::begin(kSkipped), std::end(kSkipped), keyword) != std::end(kSkipped);
}

class ObjParser {
 public:
  ObjParser(std::string_view text, std::string_view name, uint64_t vertex_limit, Mesh& mesh)
      : in_(text, name, {.comment = '#', .continuation = true}),
        vertex_limit_(vertex_limit),
        mesh_(mesh) {}

  /// Returns one more than the largest vertex index used.
  uint64_t parse() {
    while (in_.next_line()) {
      std::string_view keyword = in_.word("keyword");
      if (keyword == "v") {
        vertex();
      } else if (keyword == "f" || keyword == "fo") {
        face();
      } else if (keyword == "vn" || keyword == "vt" || is_skipped(keyword)) {
        in_.skip_line();
      } else {
        in_.fail("unknown statement '" + shown(keyword) + "'");
      }
    }
    return used_;
  }

 private:
  void vertex() {
    size_t index = mesh_.vertex_count();
    for (int k = 0; k < 3; ++k)
      mesh_.positions.push_back(in_.coordinate(index));
    int extra = 0;
    for (; !in_.at_line_end(); ++extra)
      in_.skip_number("number");
    if (extra > 4 || extra == 2)
      in_.fail("vertex " + std::to_string(index) + " has " + std::to_string(3 + extra) +
               " numbers; 3, 4 (w), 6 or 7 (colour) are expected");
  }

  void face() {
    size_t before = mesh_.polygons.corners.size();
    while (!in_.at_line_end())
      mesh_.polygons.corners.push_back(corner());
    size_t corners = mesh_.polygons.corners.size() - before;
    if (corners < 3)
      in_.fail("a face of " + std::to_string(corners) + " corners; at least 3 are expected");
    if (mesh_.polygons.corners.size() > kMaxCorners)
      in_.fail("more than 2^32 - 1 face corners");
    mesh_.polygons.offsets.push_back(static_cast<uint32_t>(mesh_.polygons.corners.size()));
  }

  uint32_t corner() {
    int64_t index = in_.integer_prefix("vertex index");
    if (in_.accept('/')) {
      if (in_.accept('/')) {
        in_.integer_prefix("normal index");
      } else {
        in_.integer_prefix("texture index");
        if (in_.accept('/'))
          in_.integer_prefix("normal index");
      }
    }
    if (!in_.at_word_end())
      in_.fail("a face corner is not of the form v, v/t, v//n or v/t/n");
    int64_t known = static_cast<int64_t>(mesh_.vertex_count());
    int64_t vertex = index > 0 ? index - 1 : index + known;
    if (index == 0 || vertex < 0 || static_cast<uint64_t>(vertex) >= vertex_limit_)
      in_.fail("vertex index " + std::to_string(index) + " is out of range; there are " +
               std::to_string(index > 0 ? vertex_limit_ : static_cast<uint64_t>(known)) +
               " vertices" + (index > 0 ? "" : " so far"));
    used_ = std::max(used_, static_cast<uint64_t>(vertex) + 1);
    return static_cast<uint32_t>(vertex);
  }

  TextCursor in_;
  uint64_t vertex_limit_;
  Mesh& mesh_;
  uint64_t used_ = 0;
};

}  // namespace

void parse_obj(std::string_view text, std::string_view name, Mesh& mesh) {
  if (text.starts_with("\xEF\xBB\xBF"))
    text.remove_prefix(3);
  mesh.clear();
  uint64_t used = ObjParser(text, name, kMaxVertices, mesh).parse();
  check_size(mesh, name);
  if (used > mesh.vertex_count()) {
    // A face may come before its vertices, so only now is the limit known: parse again to find the
    // line.
    uint64_t limit = mesh.vertex_count();
    mesh.clear();
    ObjParser(text, name, limit, mesh).parse();
  }
}

void append_obj(const Polygons& polygons, std::span<const float> positions, std::string& out) {
  for (size_t i = 0; i + 2 < positions.size(); i += 3) {
    out += "v ";
    append_floats(positions.subspan(i, 3), out);
    out += '\n';
  }
  for (size_t p = 0; p < polygons.size(); ++p) {
    out += 'f';
    for (uint32_t v : polygons[p]) {
      out += ' ';
      append_number(v + 1, out);
    }
    out += '\n';
  }
}

}  // namespace anicodec::tools
