// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/obj.h"

#include "tools/io/base/file_format.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/base/text_output.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/formats/mtl.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace anicodec::tools {
namespace {

// Statements that carry neither vertices nor polygons, in alphabetical order.
constexpr std::string_view kSkipped[] = {
    "bevel",      "bmat", "bsp",    "bzp",      "c_interp", "cdc",       "cdp",  "con",    "cstype",
    "ctech",      "curv", "curv2",  "d_interp", "deg",      "end",       "g",    "hole",   "illum",
    "l",          "lod",  "maplib", "mg",       "p",        "parm",      "res",  "s",      "scrv",
    "shadow_obj", "sp",   "stech",  "step",     "surf",     "trace_obj", "trim", "usemap", "vp",
};

bool is_skipped(std::string_view keyword) {
  return std::find(std::begin(kSkipped), std::end(kSkipped), keyword) != std::end(kSkipped);
}

/// Stands for no material or object, as in files of other programs.
constexpr std::string_view kNoName = "(null)";

/// Numbers that corners refer to: texture coordinates or normals.
struct Pool {
  const char* what;
  uint32_t components;
  FrameArray values = {};             ///< as listed
  std::vector<int64_t> corners = {};  ///< number of each corner, or -1

  int64_t size() const { return static_cast<int64_t>(values.size() / components); }
};

/// Names that statements give to the polygons after them.
class NamedPolygons {
 public:
  explicit NamedPolygons(PolygonLabels& labels) : labels_(labels) { labels_ = {}; }

  void set(std::string_view name) {
    if (name.empty() || name == kNoName) {
      current_ = kNoLabel;
      return;
    }
    const auto [found, is_new] =
        numbers_.try_emplace(std::string(name), static_cast<uint32_t>(labels_.names.size()));
    if (is_new)
      labels_.names.emplace_back(name);
    current_ = found->second;
  }

  void add_polygon() { labels_.of_polygon.push_back(current_); }

  void finish() {
    if (labels_.names.empty())
      labels_.of_polygon.clear();
  }

 private:
  PolygonLabels& labels_;
  std::map<std::string, uint32_t> numbers_;
  uint32_t current_ = kNoLabel;
};

/// Collects what parse_obj() puts into MeshDetails.
class DetailsParser {
 public:
  explicit DetailsParser(MeshDetails& details)
      : details_(details), materials(details.materials), objects(details.parts) {
    details_.attributes.clear();
    details_.shared_normals.clear();
  }

  void finish(Mesh& mesh, std::string_view name) {
    materials.finish();
    objects.finish();
    add(uv, AttributeKind::kUv, mesh, name);
    add(normals, AttributeKind::kNormal, mesh, name);
    const auto is_normal = [](const Attribute& a) { return a.kind == AttributeKind::kNormal; };
    if (is_smoothed && std::ranges::none_of(details_.attributes, is_normal))
      mesh.left_out.add("'s'");  // which normals say better
    if (!colours.empty() && colours.size() == mesh.positions.size())
      details_.attributes.push_back({.kind = AttributeKind::kColour,
                                     .name = "colour",
                                     .components = 3,
                                     .values = std::move(colours)});
  }

 private:
  void add(Pool& pool, AttributeKind kind, const Mesh& mesh, std::string_view name) {
    if (std::ranges::all_of(pool.corners, [](int64_t i) { return i < 0; }))
      return;
    Attribute attribute;
    attribute.kind = kind;
    attribute.name = pool.what;
    attribute.domain = AttributeDomain::kCorner;
    attribute.components = pool.components;
    for (size_t p = 0; p < mesh.polygons.size(); ++p) {
      for (uint32_t c = mesh.polygons.offsets[p]; c < mesh.polygons.offsets[p + 1]; ++c) {
        const int64_t i = pool.corners[c];
        if (i >= pool.size())
          fail_input(name, "face " + std::to_string(p) + " uses " + pool.what + " " +
                               std::to_string(i + 1) + ", but there are " +
                               std::to_string(pool.size()));
        for (uint32_t k = 0; k < pool.components; ++k)
          attribute.values.push_back(
              i < 0 ? 0.0F : pool.values[static_cast<size_t>(i) * pool.components + k]);
      }
    }
    details_.attributes.push_back(std::move(attribute));
  }

  MeshDetails& details_;

 public:
  Pool uv{"uv", 2}, normals{"normal", 3};
  FrameArray colours;
  bool is_smoothed = false;  ///< there are smoothing groups
  std::vector<std::string> libraries;
  NamedPolygons materials, objects;
};

class ObjParser {
 public:
  ObjParser(std::string_view text, std::string_view name, uint64_t vertex_limit, Mesh& mesh,
            DetailsParser* details)
      : in_(text, name, {.comment = '#', .continuation = true}),
        vertex_limit_(vertex_limit),
        mesh_(mesh),
        details_(details) {}

  /// Returns one more than the largest vertex index used.
  uint64_t parse() {
    while (in_.next_line()) {
      std::string_view keyword = in_.word("keyword");
      if (keyword == "v") {
        vertex();
      } else if (keyword == "f" || keyword == "fo") {
        face();
      } else if (keyword == "vt" || keyword == "vn") {
        listed(keyword == "vt");
      } else if (keyword == "usemtl" || keyword == "o") {
        named(keyword == "o");
      } else if (keyword == "mtllib") {
        if (details_)
          details_->libraries.emplace_back(in_.rest_of_line());
        in_.skip_line();
      } else if (is_skipped(keyword)) {
        if (details_ && keyword == "s")
          details_->is_smoothed = true;
        else if (details_)
          mesh_.left_out.add("'" + std::string(keyword) + "'");
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
    for (size_t k = 0; k < 3; ++k)
      mesh_.positions.push_back(in_.coordinate(index, k, mesh_.origin));
    int extra = 0;
    float numbers[3];
    for (; !in_.at_line_end(); ++extra) {
      if (details_ && extra < 3)
        numbers[extra] = in_.coordinate(index);
      else
        in_.skip_number("number");
    }
    if (extra > 4 || extra == 2)
      in_.fail("vertex " + std::to_string(index) + " has " + std::to_string(3 + extra) +
               " numbers; 3, 4 (w), 6 or 7 (colour) are expected");
    if (details_ && extra >= 3)
      details_->colours.insert(details_->colours.end(), numbers, numbers + 3);
  }

  /// Texture coordinates, of which the first two count, or a normal.
  void listed(bool is_uv) {
    if (!details_)
      return in_.skip_line();
    Pool& pool = is_uv ? details_->uv : details_->normals;
    uint32_t k = 0;
    for (; k < pool.components && !in_.at_line_end(); ++k)
      pool.values.push_back(in_.coordinate(static_cast<size_t>(pool.size())));
    if (k == 0 || (k < pool.components && !is_uv))
      in_.fail(std::string(pool.what) + " of " + std::to_string(k) + " numbers");
    if (k < pool.components)
      pool.values.push_back(0);
    in_.skip_line();
  }

  void named(bool is_object) {
    if (details_)
      (is_object ? details_->objects : details_->materials).set(in_.rest_of_line());
    in_.skip_line();
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
    if (details_) {
      details_->materials.add_polygon();
      details_->objects.add_polygon();
    }
  }

  uint32_t corner() {
    int64_t index = in_.integer_prefix("vertex index"), uv = 0, normal = 0;
    if (in_.accept('/')) {
      if (in_.accept('/')) {
        normal = in_.integer_prefix("normal index");
      } else {
        uv = in_.integer_prefix("texture index");
        if (in_.accept('/'))
          normal = in_.integer_prefix("normal index");
      }
    }
    if (!in_.at_word_end())
      in_.fail("a face corner is not of the form v, v/t, v//n or v/t/n");
    if (details_) {
      refer(uv, details_->uv);
      refer(normal, details_->normals);
    }
    int64_t known = static_cast<int64_t>(mesh_.vertex_count());
    int64_t vertex = index > 0 ? index - 1 : index + known;
    if (index == 0 || vertex < 0 || static_cast<uint64_t>(vertex) >= vertex_limit_)
      in_.fail("vertex index " + std::to_string(index) + " is out of range; there are " +
               std::to_string(index > 0 ? vertex_limit_ : static_cast<uint64_t>(known)) +
               " vertices" + (index > 0 ? "" : " so far"));
    used_ = std::max(used_, static_cast<uint64_t>(vertex) + 1);
    return static_cast<uint32_t>(vertex);
  }

  /// Notes what a corner refers to; whether it is there is known at the end.
  void refer(int64_t index, Pool& pool) {
    if (index < -pool.size())
      in_.fail(std::string(pool.what) + " " + std::to_string(index) +
               " is out of range; there are " + std::to_string(pool.size()) + " so far");
    pool.corners.push_back(index >= 0 ? index - 1 : pool.size() + index);
  }

  TextCursor in_;
  uint64_t vertex_limit_;
  Mesh& mesh_;
  DetailsParser* details_;
  uint64_t used_ = 0;
};

}  // namespace

void parse_obj(std::string_view text, std::string_view name, Mesh& mesh, MeshDetails* details,
               std::vector<std::string>* libraries) {
  if (text.starts_with("\xEF\xBB\xBF"))
    text.remove_prefix(3);
  auto parse = [&](uint64_t vertex_limit) {
    mesh.clear();
    std::optional<DetailsParser> parser;
    if (details)
      parser.emplace(*details);
    const uint64_t used =
        ObjParser(text, name, vertex_limit, mesh, parser ? &*parser : nullptr).parse();
    if (parser)
      parser->finish(mesh, name);
    if (parser && libraries)
      *libraries = std::move(parser->libraries);
    return used;
  };
  const uint64_t used = parse(kMaxVertices);
  check_size(mesh, name);
  if (used > mesh.vertex_count())  // a face may come before its vertices: find the line
    parse(mesh.vertex_count());
}

ObjDetails::ObjDetails(const MeshSequence& clip, bool group_faces)
    : clip_(clip), objects_(names("o", clip.parts)), materials_(names("usemtl", clip.materials)) {
  if (!clip.shared_normals.empty())
    normals_.emplace(clip);
  set_attributes(clip.attributes);
  order_.resize(clip.polygons.size());
  std::iota(order_.begin(), order_.end(), 0U);
  if (group_faces)
    group_polygons();
}

/// Objects, and materials in each, come in the order in which they are met first.
void ObjDetails::group_polygons() {
  for (const Names* names : {&materials_, &objects_}) {
    if (names->of_polygon.empty())
      continue;
    std::map<uint32_t, uint32_t> rank;
    for (uint32_t label : names->of_polygon)
      rank.try_emplace(label, static_cast<uint32_t>(rank.size()));
    std::ranges::stable_sort(order_, {}, [&](uint32_t p) { return rank[names->of_polygon[p]]; });
  }
}

void ObjDetails::set_library(const std::string& file) {
  library_ = "mtllib " + file + "\n";
}

void ObjDetails::set_attributes(const std::vector<Attribute>& attributes) {
  texture_coordinates_.clear();
  uv_.clear();
  colours_.clear();
  const std::vector<uint32_t>& corners = clip_.polygons.corners;
  for (const Attribute& attribute : attributes) {
    const size_t n = attribute.components;
    if (attribute.kind == AttributeKind::kColour && attribute.per_vertex() && n >= 3 &&
        colours_.empty()) {
      for (size_t v = 0; v < clip_.vertex_count; ++v)
        colours_.insert(colours_.end(), attribute.values.begin() + static_cast<ptrdiff_t>(n * v),
                        attribute.values.begin() + static_cast<ptrdiff_t>(n * v + 3));
    }
    if (attribute.kind != AttributeKind::kUv || n != 2 || !uv_.empty() ||
        attribute.domain == AttributeDomain::kPolygon)
      continue;
    std::map<std::pair<float, float>, uint32_t> known;
    for (size_t c = 0; c < corners.size(); ++c) {
      const float* uv = attribute.values.data() + 2 * (attribute.per_corner() ? c : corners[c]);
      const auto [found, is_new] =
          known.try_emplace({uv[0], uv[1]}, static_cast<uint32_t>(known.size()));
      uv_.push_back(found->second);
      if (!is_new)
        continue;
      texture_coordinates_ += "vt ";
      append_floats({uv, 2}, texture_coordinates_);
      texture_coordinates_ += '\n';
    }
  }
}

ObjDetails::Names ObjDetails::names(const char* keyword, const PolygonLabels& labels) {
  Names result;
  for (const std::string& label : labels.names) {
    result.lines.push_back(std::string(keyword) + " " + statement_name(label) + "\n");
  }
  result.none = std::string(keyword) + " " + std::string(kNoName) + "\n";
  result.of_polygon = labels.of_polygon;
  return result;
}

void append_obj(const Polygons& polygons, std::span<const float> positions, std::string& out,
                const ObjDetails* details, const Point& origin) {
  if (details)
    out += details->library_;
  const bool has_uv = details && !details->uv_.empty();
  const bool has_normals = details && details->normals_.has_value();
  for (size_t i = 0; i + 2 < positions.size(); i += 3) {
    out += "v ";
    append_position(&positions[i], origin, out);
    if (details && !details->colours_.empty()) {
      out += ' ';
      append_floats({details->colours_.data() + i, 3}, out);
    }
    out += '\n';
  }
  if (has_uv)
    out += details->texture_coordinates_;
  if (has_normals) {
    const std::vector<float> normals = details->normals_->compute(positions);
    for (size_t i = 0; i < normals.size(); i += 3) {
      out += "vn ";
      append_floats({normals.data() + i, 3}, out);
      out += '\n';
    }
  }
  uint32_t object = kNoLabel, material = kNoLabel;
  auto name = [&](const ObjDetails::Names& names, size_t p, uint32_t& current) {
    if (names.of_polygon.empty() || names.of_polygon[p] == current)
      return;
    current = names.of_polygon[p];
    out += current == kNoLabel ? names.none : names.lines[current];
  };
  for (size_t i = 0; i < polygons.size(); ++i) {
    const size_t p = details ? details->order_[i] : i;
    if (details) {
      name(details->objects_, p, object);
      name(details->materials_, p, material);
    }
    out += 'f';
    for (uint32_t c = polygons.offsets[p]; c < polygons.offsets[p + 1]; ++c) {
      out += ' ';
      append_number(polygons.corners[c] + 1, out);
      if (has_uv || has_normals)
        out += '/';
      if (has_uv)
        append_number(details->uv_[c] + 1, out);
      if (has_normals) {
        out += '/';
        append_number(details->normals_->of_corner(c) + 1, out);
      }
    }
    out += '\n';
  }
}

void add_library(const std::string& mesh, const OutputClip& output, ObjDetails& details,
                 std::vector<AtomicFile>& files) {
  if (!has_looks(output.clip.materials))
    return;
  const std::filesystem::path library = std::filesystem::path(mesh).replace_extension(".mtl");
  details.set_library(library.filename().string());
  std::string text;
  append_mtl(output.clip.materials, text);
  files.emplace_back(library.string(), output.options.overwrite).write(text);
  files.back().close();
}

const FileFormat kObj = {.name = "OBJ",
                         .extensions = ".obj",
                         .mesh_parser = [](const LoadOptions&) -> MeshParser { return parse_obj; },
                         .frame_writer = [](const OutputClip& output, const std::string& first_path,
                                            const std::vector<Attribute>& attributes,
                                            std::vector<AtomicFile>& files) -> FrameWriter {
                           ObjDetails prepared(output.clip, output.options.group_faces);
                           add_library(first_path, output, prepared, files);
                           return [&clip = output.clip, details = std::move(prepared), &attributes,
                                   moves = bool(output.options.attributes)](
                                      std::span<const float> positions, std::string& out) mutable {
                             if (moves)
                               details.set_attributes(attributes);
                             append_obj(clip.polygons, positions, out, &details, clip.origin);
                           };
                         },
                         .frames_have_y_up = true,
                         .has_room_for_origin = true};

}  // namespace anicodec::tools
