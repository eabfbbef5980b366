// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/alembic_bake.h"

#include "codec/sequence/error.h"
#include "tools/io/base/frame_attributes.h"
#include "tools/io/base/left_kinds.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace anicodec::tools {
namespace {

bool is_mesh(AbcSchema schema) {
  return schema == AbcSchema::kPolyMesh || schema == AbcSchema::kSubD;
}

std::string last_name(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

/// Whether a mesh is the one asked for, stands below it, or has its name, as its own or as that of
/// the object that holds it.
bool is_asked_for(const std::string& path, const std::string& mesh) {
  const std::string asked = mesh.starts_with('/') ? mesh : "/" + mesh;
  if (path == asked || path.starts_with(asked + "/"))
    return true;
  return last_name(path) == mesh || last_name(path.substr(0, path.rfind('/'))) == mesh;
}

std::string count_text(const std::vector<AbcNode>& nodes) {
  return nodes.size() == 1 ? "it has no object"
                           : "none of its " + std::to_string(nodes.size() - 1) + " objects is one";
}

/// Values of corners in another order.
void reorder(const std::vector<uint32_t>& order, size_t components, FrameArray& values) {
  FrameArray out;
  out.reserve(values.size());
  for (uint32_t c : order)
    out.insert(out.end(), &values[c * components], &values[c * components] + components);
  values = std::move(out);
}

/// The matrix for normals: the cofactors, which keep them upright in flattened parts.
Eigen::Matrix3d normal_matrix(const AbcTransform& m) {
  Eigen::Matrix3d out;
  out << m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0)), m.col(0).cross(m.col(1));
  return m.leftCols<3>().determinant() < 0 ? Eigen::Matrix3d(-out) : out;
}

void turn_normals(const AbcTransform& world, FrameArray& values) {
  const Eigen::Matrix3d turn = normal_matrix(world);
  for (size_t i = 0; i < values.size(); i += 3) {
    Eigen::Map<Eigen::Vector3f> normal(&values[i]);
    const Eigen::Vector3d turned = (turn * normal.cast<double>()).normalized();
    normal = turned.allFinite() ? Eigen::Vector3f(turned.cast<float>()) : Eigen::Vector3f::UnitZ();
  }
}

bool moves(const AbcGeomParam& param) {
  return param.kind != AttributeKind::kNormal && !param.values.property().is_constant();
}

}  // namespace

uint32_t AbcShown::first_frame() const {
  const auto found = std::ranges::find_if(topology, [](uint32_t t) { return t != kAbcNone; });
  return static_cast<uint32_t>(found - topology.begin());
}

uint32_t AbcShown::first_frame(uint32_t which) const {
  return static_cast<uint32_t>(std::ranges::find(topology, which) - topology.begin());
}

AbcNote AlembicBake::note_once(const AlembicOptions& options) {
  auto told = std::make_shared<std::set<std::string>>();
  return [told, note = options.note](const std::string& text) {
    if (note && told->insert(text).second)
      note(printable(text));
  };
}

AlembicBake::AlembicBake(const ByteSource& source, const AlembicOptions& options)
    : name_(source.name),
      memory_left_(static_cast<double>(options.memory_limit)),
      origin_(options.origin.data()),
      note_(note_once(options)),
      archive_(source),
      scene_(archive_, note_) {
  select(options.mesh);
  std::vector<uint32_t> nodes;
  std::vector<const AbcProperty*> timed;
  for (const AbcShown& shown : shown_) {
    nodes.push_back(shown.node);
    const std::vector<const AbcProperty*> own = shown.mesh->timed();
    timed.insert(timed.end(), own.begin(), own.end());
  }
  for (const AbcProperty* property : scene_.timed(nodes))
    timed.push_back(property);
  clock_ = clock_of(archive_, timed, options.rate);
  check_memory(static_cast<double>(shown_.size()), static_cast<double>(frame_count()));
  watch(false);
  if (shown_.empty() && !options.mesh.empty()) {  // what is asked for comes, hidden or not
    select(options.mesh);
    watch(true);
  }
  if (shown_.empty())
    fail_input(name_, "no frame shows a mesh; --mesh takes a hidden one by its path");
  note_left_out();
}

void AlembicBake::select(const std::string& mesh) {
  std::string list;
  size_t meshes = 0;
  constexpr size_t kMaxListed = 20;
  for (uint32_t n = 0; n < scene_.nodes().size(); ++n) {
    const AbcNode& node = scene_.nodes()[n];
    if (!is_mesh(scene_.object(node).schema))
      continue;
    if (meshes++ < kMaxListed)
      list += (list.empty() ? "" : ", ") + node.path;
    if (!mesh.empty() && !is_asked_for(node.path, mesh))
      continue;
    std::unique_ptr<AbcMesh>& own = meshes_[node.object];
    if (!own)
      own = std::make_unique<AbcMesh>(archive_, scene_.object(node), note_);
    shown_.push_back({.node = n, .mesh = own.get(), .topology = {}, .sides = {}});
  }
  if (meshes == 0)
    fail_input(name_, "has no mesh: " + count_text(scene_.nodes()));
  if (shown_.empty())
    throw Error(ErrorKind::kUsage, name_ + ": there is no mesh " + mesh + "; the meshes are: " +
                                       printable(list) + (meshes > kMaxListed ? ", ..." : ""));
}

/// Notes what each mesh shows in each frame, and forgets those that never show anything.
void AlembicBake::watch(bool hidden_too) {
  for (size_t f = 0; f < frame_count(); ++f) {
    const std::vector<AbcPlace> now = places(f);
    for (AbcShown& shown : shown_) {
      uint32_t topology = kAbcNone;
      if (hidden_too || now[shown.node].visible) {
        topology = shown.mesh->topology_at(clock_.times[f]);
        if (shown.mesh->topologies()[topology].is_empty())
          topology = kAbcNone;
      }
      shown.topology.push_back(topology);
      const double volume = now[shown.node].world.leftCols<3>().determinant();
      shown.sides.push_back(static_cast<int8_t>(volume < 0 ? -1 : volume > 0 ? 1 : 0));
    }
  }
  std::erase_if(shown_, [&](const AbcShown& shown) {
    const bool never = shown.first_frame() == shown.topology.size();
    if (never && !hidden_too)
      note_(path(shown) + ": is left out: no frame shows it");
    return never;
  });
  part_mirrored();
}

/// Finds the meshes that transforms mirror. One that is so in some frames only becomes two, which take turns; a frame
/// without extent may be of either.
void AlembicBake::part_mirrored() {
  std::vector<AbcShown> parts;
  for (const AbcShown& shown : shown_) {
    AbcShown parted[2] = {shown, shown};
    const auto first = std::ranges::find_if(shown.sides, [](int side) { return side != 0; });
    bool mirrored = first != shown.sides.end() && *first < 0;
    for (size_t f = 0; f < frame_count(); ++f) {
      mirrored = shown.sides[f] == 0 ? mirrored : shown.sides[f] < 0;
      parted[mirrored ? 0 : 1].topology[f] = kAbcNone;
    }
    const bool is_plain = parted[0].first_frame() < frame_count();
    parted[1].mirrored = true;
    parted[1].is_second = is_plain;
    if (is_plain)
      parts.push_back(std::move(parted[0]));
    if (parted[1].first_frame() < frame_count())
      parts.push_back(std::move(parted[1]));
  }
  shown_ = std::move(parts);
}

/// Names objects and properties that no one asks for.
void AlembicBake::note_left_out() const {
  constexpr std::string_view kOfObjects[] = {".geom", ".xform", ".faceset", "visible",
                                             ".childBnds"};
  constexpr std::string_view kOfMeshes[] = {"P",           ".faceCounts", ".faceIndices",
                                            "uv",          "N",           ".arbGeomParams",
                                            ".velocities", ".selfBnds",   ".childBnds"};
  constexpr std::string_view kOfSurfaces[] = {// noted where they are met
                                              ".creaseIndices",
                                              ".creaseLengths",
                                              ".creaseSharpnesses",
                                              ".cornerIndices",
                                              ".cornerSharpnesses",
                                              ".holes",
                                              ".subdivScheme",
                                              ".interpolateBoundary",
                                              ".faceVaryingInterpolateBoundary",
                                              ".faceVaryingPropagateCorners"};
  constexpr std::string_view kOfXforms[] = {
      ".inherits",  ".ops",       ".vals",    "isNotConstantIdentity",
      ".animChans", ".childBnds", ".selfBnds"};
  LeftKinds kinds;
  const auto look = [&](const AbcCompound& compound, std::span<const std::string_view> known,
                        const char* of, std::span<const std::string_view> more = {}) {
    for (const AbcProperty& property : compound.properties) {
      const bool is_empty =
          property.shape == AbcShape::kCompound && archive_.properties(property).properties.empty();
      if (!is_empty && std::ranges::find(known, property.name) == known.end() &&
          std::ranges::find(more, property.name) == more.end())
        kinds.add("'" + property.name + "' of " + of);
    }
  };
  std::map<std::string, size_t> others;
  for (const AbcObject& object : archive_.objects) {
    const std::string schema(metadata_value(object.metadata, "schema"));
    if (object.schema == AbcSchema::kOther) {
      if (!schema.empty())
        ++others[schema];
      continue;
    }
    const AbcCompound properties = archive_.properties(object);
    look(properties, kOfObjects, "objects");
    for (const char* name : {".geom", ".xform"}) {
      const AbcProperty* own = properties.find(name);
      if (own == nullptr || own->shape != AbcShape::kCompound)
        continue;
      if (object.schema == AbcSchema::kXform)
        look(archive_.properties(*own), kOfXforms, "Xforms");
      else
        look(archive_.properties(*own), kOfMeshes, "meshes", kOfSurfaces);
    }
  }
  for (const auto& [schema, count] : others)
    kinds.add(std::to_string(count) + " " + schema);
  if (!kinds.text().empty())
    note_("not kept: " + kinds.text());
}

void AlembicBake::set_timing(MeshSequence& out) const {
  out.frame_count = static_cast<uint32_t>(frame_count());
  out.rate = clock_.timing.rate;
  out.start_time = clock_.timing.start_time;
  out.times = clock_.timing.times;
  out.up = UpAxis::kY;
}

void AlembicBake::check_memory(double vertices, double frames) const {
  if (12 * vertices * frames > memory_left_)
    fail_input(name_, std::to_string(static_cast<uint64_t>(vertices)) + " vertices x " +
                          std::to_string(static_cast<uint64_t>(frames)) +
                          " frames take more memory than is allowed");
}

void AlembicBake::take_memory(double vertices, double frames) {
  check_memory(vertices, frames);
  memory_left_ -= 12 * vertices * frames;
}

double AlembicBake::take_memory(const std::vector<Attribute>& attributes, double before) {
  double now = 0;
  for (const Attribute& attribute : attributes)
    now += static_cast<double>(attribute.values.size());
  memory_left_ -= sizeof(float) * (now - before);
  if (memory_left_ < 0)
    fail_input(name_, "attributes that move take more memory than is allowed");
  return now;
}

std::optional<Attribute> AlembicBake::attribute(const AbcShown& shown, const AbcGeomParam& param,
                                                size_t frame) const {
  const AbcTopology& topology = shown.mesh->topologies()[shown.topology[frame]];
  return shown.mesh->params().attribute_at(param, clock_.times[frame], topology.polygons,
                                           topology.vertex_count);
}

MeshSequence AlembicBake::describe(const AbcShown& shown, size_t frame) {
  const AbcTopology& topology = shown.mesh->topologies()[shown.topology[frame]];
  MeshSequence out;
  out.mesh_name = name(shown);
  out.vertex_count = topology.vertex_count;
  out.polygons = topology.polygons;
  const std::vector<uint32_t> order = reversed_corners(topology.polygons);
  if (!shown.mirrored) {
    for (size_t c = 0; c < order.size(); ++c)
      out.polygons.corners[c] = topology.polygons.corners[order[c]];
  }
  out.materials = shown.mesh->face_sets(clock_.times[frame], out.polygons.size(), note_);
  const AbcPlace now = place(shown, frame);
  for (const AbcGeomParam& param : shown.mesh->params().all()) {
    std::optional<Attribute> found = attribute(shown, param, frame);
    if (!found) {
      note_(out.mesh_name + ": '" + param.name + "' is left out: it has no finite value for each " +
            (param.kind == AttributeKind::kCustom ? "vertex" : "vertex or corner"));
      continue;
    }
    if (found->per_corner() && !shown.mirrored)
      reorder(order, found->components, found->values);
    if (found->kind == AttributeKind::kNormal)
      turn_normals(now.world, found->values);
    out.attributes.push_back(std::move(*found));
  }
  return out;
}

bool AlembicBake::has_moving_attributes(const AbcShown& shown) {
  return std::ranges::any_of(shown.mesh->params().all(), moves);
}

std::vector<Attribute> AlembicBake::moving_attributes(const AbcShown& shown, size_t frame) const {
  std::vector<Attribute> out;
  for (const AbcGeomParam& param : shown.mesh->params().all()) {
    if (!moves(param))
      continue;
    std::optional<Attribute> found = attribute(shown, param, frame);
    if (!found || !can_move(*found))
      continue;
    if (found->per_corner() && !shown.mirrored)
      reorder(reversed_corners(shown.mesh->topologies()[shown.topology[frame]].polygons),
              found->components, found->values);
    out.push_back(std::move(*found));
  }
  return out;
}

void AlembicBake::read_positions(const AbcShown& shown, const AbcPlace& place, size_t frame,
                                 std::span<float> out) const {
  shown.mesh->read_positions(clock_.times[frame], out);
  bool finite = true;
  for (float x : out)
    finite &= std::isfinite(x);
  if (finite && (place.world != identity_transform() || !origin_.isZero(0))) {
    for (size_t i = 0; i < out.size(); i += 3) {
      Eigen::Map<Eigen::Vector3f> p(&out[i]);
      p = (place.world.leftCols<3>() * p.cast<double>() + place.world.col(3) - origin_)
              .cast<float>();
      finite &= p.allFinite();
    }
  }
  if (finite)
    return;
  const auto bad = std::ranges::find_if(out, [](float x) { return !std::isfinite(x); });
  fail_input(name_, printable(path(shown)) + ": frame " + std::to_string(frame) + ", vertex " +
                        std::to_string((bad - out.begin()) / 3) + ": the position is not finite");
}

}  // namespace anicodec::tools
