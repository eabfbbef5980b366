// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_bake.h"

#include "codec/parallel/parallel.h"
#include "codec/sequence/error.h"
#include "codec/sequence/shared_normals.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/gltf/gltf_accessor.h"
#include "tools/io/gltf/gltf_facing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace anicodec::tools {
namespace {

constexpr uint32_t kFirstTriangleMode = 4;

using Transform = Eigen::Matrix<double, 3, 4>;

/// The upper rows of a column-major 4x4 matrix.
template <typename Number>
Transform affine(const Number* matrix) {
  return Eigen::Map<const Eigen::Matrix<Number, 4, 4>>(matrix)
      .template topRows<3>()
      .template cast<double>();
}

Transform after(const Transform& outer, const Transform& inner) {
  Transform out;
  out.leftCols<3>() = outer.leftCols<3>() * inner.leftCols<3>();
  out.col(3) = outer.leftCols<3>() * inner.col(3) + outer.col(3);
  return out;
}

Transform transform_of(const std::array<double, 3>& translation,
                       const std::array<double, 4>& rotation, const std::array<double, 3>& scale) {
  const Eigen::Quaterniond turn(Eigen::Map<const Eigen::Quaterniond>(rotation.data()));
  Transform out;
  out.leftCols<3>() = turn.normalized().toRotationMatrix() *
                      Eigen::Map<const Eigen::Vector3d>(scale.data()).asDiagonal();
  out.col(3) = Eigen::Map<const Eigen::Vector3d>(translation.data());
  return out;
}

Transform local_transform(const GltfNode& node, const GltfPose& pose, uint32_t n) {
  if (node.matrix)
    return affine(node.matrix->data());
  return transform_of(pose.translations[n], pose.rotations[n], pose.scales[n]);
}

/// The matrix for normals in the direction of the inverse transpose, from the cofactors, which
/// flattened parts have too.
Eigen::Matrix3d normal_matrix(const Transform& m, bool mirrors) {
  Eigen::Matrix3d out;
  out << m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0)), m.col(0).cross(m.col(1));
  return mirrors ? Eigen::Matrix3d(-out) : out;
}

/// Nodes that are hidden whatever is played.
std::vector<bool> never_shown(const GltfDocument& document) {
  std::vector<bool> hidden;
  for (const GltfNode& node : document.nodes)
    hidden.push_back(!node.visible);
  for (const GltfAnimation& animation : document.animations) {
    for (const GltfChannel& channel : animation.channels) {
      if (channel.path == GltfPath::kVisibility)
        hidden[channel.node] = false;
    }
  }
  return hidden;
}

/// A place of a mesh in the space of its node.
struct Placement {
  std::optional<Transform> transform;
  bool mirrors = false;
};

/// The instances of a node.
std::vector<Placement> placements_of(const GltfDocument& document, uint32_t n) {
  const GltfInstances& instances = *document.nodes[n].instances;
  const auto read = [&](uint32_t accessor, const char* name) {
    return accessor == kGltfNone ? std::vector<float>()
                                 : read_floats(document, accessor,
                                               "/nodes/" + std::to_string(n) + "/extensions/" +
                                                   kInstancingExtension + "/attributes/" + name);
  };
  const std::vector<float> translations = read(instances.translations, "TRANSLATION"),
                           rotations = read(instances.rotations, "ROTATION"),
                           scales = read(instances.scales, "SCALE");
  const auto take = [](const std::vector<float>& values, uint32_t i, auto otherwise) {
    for (size_t k = 0; k < otherwise.size() && !values.empty(); ++k)
      otherwise[k] = static_cast<double>(values[otherwise.size() * i + k]);
    return otherwise;
  };
  std::vector<Placement> out;
  for (uint32_t i = 0; i < instances.count; ++i) {
    const auto scale = take(scales, i, std::array<double, 3>{1, 1, 1});
    out.push_back({transform_of(take(translations, i, std::array<double, 3>{0, 0, 0}),
                                take(rotations, i, std::array<double, 4>{0, 0, 0, 1}), scale),
                   mirrors(scale)});
  }
  return out;
}

/// Bytes of a primitive in a clip, but for its frames.
uint64_t bytes_of(const GltfGeometry& geometry, bool with_vertices) {
  constexpr uint64_t kOfTriangle = 3 * 4 + 4 + 4 + 4;       // corners, offset, material, part
  constexpr uint64_t kUv = 8, kColour = 16, kNormals = 28;  // of a vertex, with tangents
  const GltfVertices& v = geometry.vertices;
  const uint64_t of_vertex = kUv * v.uvs.size() + kColour * v.colours.size() + kNormals;
  return geometry.triangles.size() / 3 * kOfTriangle + (with_vertices ? of_vertex * v.count : 0);
}

}  // namespace

/// A primitive shown by a node.
struct GltfBake::Piece {
  uint32_t node = 0, mesh = 0;
  size_t primitive = 0;
  std::shared_ptr<const GltfGeometry> geometry;
  uint32_t first_vertex = 0;
  bool owns_vertices = true;        ///< false: those of an earlier primitive of the node
  std::optional<Transform> placed;  ///< in the space of the node: an instance
  bool turned = false;              ///< the faces are turned over
  /// Shown while the node mirrors, or while it does not, so that the two of them show it at all times.
  bool in_turn = false, shown_while_mirrored = false;
};

struct GltfBake::Worlds {
  std::vector<Transform> nodes;
  std::vector<bool> visible;                   ///< of each node
  std::vector<bool> mirrored;                  ///< the same
  std::vector<std::vector<Transform>> joints;  ///< of each skin in use: world x inverse bind

  /// The transform of a piece that is not skinned.
  Transform of(const Piece& piece) const {
    return piece.placed ? after(nodes[piece.node], *piece.placed) : nodes[piece.node];
  }
};

GltfBake::~GltfBake() = default;

GltfBake::GltfBake(const GltfDocument& document, const GltfOptions& options)
    : document_(document), options_(options), memory_left_(options.memory_limit) {
  const std::string& mesh = options.mesh;
  std::vector<uint32_t> open(document.roots.rbegin(), document.roots.rend());
  const std::vector<bool> hidden = never_shown(document);
  std::set<std::string> names;
  while (!open.empty()) {
    const uint32_t n = open.back();
    open.pop_back();
    if (hidden[n])
      continue;
    const GltfNode& node = document.nodes[n];
    open.insert(open.end(), node.children.rbegin(), node.children.rend());
    if (node.mesh == kGltfNone)
      continue;
    const std::string& mesh_name = document.meshes[node.mesh].name;
    names.insert({mesh_name, node.name});
    if (mesh.empty() || mesh == mesh_name || mesh == node.name)
      add_node(n);
  }
  if (pieces_.empty() && !mesh.empty()) {
    std::string list;
    for (const std::string& name : names)
      list += (list.empty() ? "'" : ", '") + shown(name) + "'";
    throw Error(ErrorKind::kUsage, document.name + ": there is no mesh '" + shown(mesh) +
                                       "' of triangles; the meshes and nodes are: " + list);
  }
  if (pieces_.empty())
    fail_input(document.name, "the scene has no mesh of triangles");
  name_parts();
  if (vertex_count_ > kMaxVertices)
    fail_input(document.name, "the scene has more than 2^31 - 1 vertices");

  // Joints may stand outside the scene.
  for (uint32_t n = 0; n < document.nodes.size(); ++n) {
    if (document.nodes[n].parent == kGltfNone)
      order_.push_back(n);
  }
  for (size_t i = 0; i < order_.size(); ++i) {
    const std::vector<uint32_t>& children = document.nodes[order_[i]].children;
    order_.insert(order_.end(), children.begin(), children.end());
  }
  inverse_binds_.resize(document.skins.size());
  for (const Piece& piece : pieces_) {
    if (!is_skinned(piece))
      continue;
    const uint32_t s = document.nodes[piece.node].skin;
    const GltfSkin& skin = document.skins[s];
    const GltfVertices& vertices = piece.geometry->vertices;
    for (size_t i = 0; i < vertices.joints.size(); ++i) {
      if (vertices.joints[i] >= skin.joints.size() && vertices.weights[i] > 0)
        fail_gltf(document,
                  primitive_path(piece.mesh, piece.primitive) + "/attributes/JOINTS_" +
                      std::to_string(i % vertices.influences / 4),
                  "joint " + std::to_string(vertices.joints[i]) + " of vertex " +
                      std::to_string(i / vertices.influences) + " is out of bounds; /skins/" +
                      std::to_string(s) + " has " + std::to_string(skin.joints.size()));
    }
    if (inverse_binds_[s].empty() && skin.inverse_binds != kGltfNone)
      inverse_binds_[s] = read_floats(document, skin.inverse_binds,
                                      "/skins/" + std::to_string(s) + "/inverseBindMatrices");
  }
}

void GltfBake::take_memory(uint64_t bytes, const std::string& path) {
  if (bytes > memory_left_)
    fail_gltf(document_, path,
              "the geometry takes " + std::to_string(bytes) + " bytes of memory; " +
                  std::to_string(memory_left_) + " are left of the " +
                  std::to_string(options_.memory_limit) + " that are allowed");
  memory_left_ -= bytes;
}

std::shared_ptr<const GltfGeometry> GltfBake::geometry_of(uint32_t mesh, size_t p) {
  std::shared_ptr<const GltfGeometry>& geometry = geometries_[{mesh, p}];
  if (geometry)
    return geometry;
  const GltfPrimitive& primitive = document_.meshes[mesh].primitives[p];
  uint64_t bytes = 0;
  auto add = [&](const std::map<std::string, uint32_t>& attributes) {
    for (const auto& [name, accessor] : attributes)
      bytes += bytes_as_floats(document_, accessor);
  };
  add(primitive.attributes);
  for (const auto& target : primitive.targets)
    add(target);
  // Strips and fans become lists.
  if (primitive.indices != kGltfNone)
    bytes += 3 * bytes_as_floats(document_, primitive.indices);
  take_memory(bytes, primitive_path(mesh, p));
  geometry = std::make_shared<const GltfGeometry>(read_geometry(document_, mesh, p, options_));
  return geometry;
}

void GltfBake::add_node(uint32_t n) {
  const GltfNode& node = document_.nodes[n];
  const GltfMesh& mesh = document_.meshes[node.mesh];
  std::vector<Placement> places(1);
  if (node.instances && node.skin == kGltfNone)
    places = placements_of(document_, n);
  const std::string& name = node.name.empty() ? mesh.name : node.name;
  const auto add = [&](bool in_turn, bool mirrored, const std::string& suffix) {
    uint64_t polygons = 0;
    for (const Placement& place : places) {
      Piece piece;
      piece.node = n;
      piece.mesh = node.mesh;
      piece.placed = place.transform;
      piece.turned = place.mirrors != mirrored;
      piece.in_turn = in_turn;
      piece.shown_while_mirrored = mirrored;
      polygons += add_pieces(piece);
    }
    if (polygons == 0)
      return;
    const auto label = static_cast<uint32_t>(parts_.names.size());
    parts_.of_polygon.insert(parts_.of_polygon.end(), polygons, label);
    parts_.names.push_back(name.empty() ? "" : name + suffix);
    node_of_part_.push_back(n);
  };
  if (node.facing == GltfFacing::kChanging) {
    add(true, false, "");
    add(true, true, " mirrored");
  } else {
    add(false, node.facing == GltfFacing::kTurned, "");
  }
}

/// Several nodes without a name are parts by their numbers; a single one is in no part.
void GltfBake::name_parts() {
  if (std::ranges::count(parts_.names, "") == 1) {
    const auto nameless = std::ranges::find(parts_.names, "");
    const auto label = static_cast<uint32_t>(nameless - parts_.names.begin());
    for (uint32_t& of : parts_.of_polygon)
      of = of == label ? kNoLabel : of > label ? of - 1 : of;
    parts_.names.erase(nameless);
  }
  for (size_t i = 0; i < parts_.names.size(); ++i) {
    std::string& name = parts_.names[i];
    if (name.empty())
      name = "node " + std::to_string(node_of_part_[i]) +
             (i > 0 && node_of_part_[i - 1] == node_of_part_[i] ? " mirrored" : "");
  }
}

/// Adds the primitives of a mesh at one place; returns how many polygons they have.
uint64_t GltfBake::add_pieces(const Piece& like) {
  const GltfMesh& mesh = document_.meshes[like.mesh];
  uint64_t polygons = 0;
  // Primitives with the same accessors share their vertices, where materials move texture coordinates alike.
  using Accessors = std::map<std::string, uint32_t>;
  using Transforms = std::map<uint32_t, TextureTransform>;
  std::map<std::tuple<Accessors, std::vector<Accessors>, Transforms>, uint32_t> vertices_of;
  for (size_t p = 0; p < mesh.primitives.size(); ++p) {
    const GltfPrimitive& primitive = mesh.primitives[p];
    if (primitive.mode < kFirstTriangleMode || !primitive.attributes.contains("POSITION"))
      continue;
    Piece piece = like;
    piece.primitive = p;
    piece.geometry = geometry_of(like.mesh, p);
    piece.first_vertex = static_cast<uint32_t>(vertex_count_);
    if (!primitive.draco) {
      const bool moved = primitive.material != kGltfNone && !options_.scene_stays;
      const auto [same, is_new] = vertices_of.try_emplace(
          {primitive.attributes, primitive.targets,
           moved ? document_.materials[primitive.material].transforms : Transforms()},
          piece.first_vertex);
      piece.first_vertex = same->second;
      piece.owns_vertices = is_new;
    }
    if (piece.owns_vertices)
      vertex_count_ += piece.geometry->vertices.count;
    take_memory(sizeof(Piece) + bytes_of(*piece.geometry, piece.owns_vertices),
                primitive_path(like.mesh, p));
    polygons += piece.geometry->triangles.size() / 3;
    pieces_.push_back(std::move(piece));
  }
  return polygons;
}

bool GltfBake::is_skinned(const Piece& piece) const {
  return document_.nodes[piece.node].skin != kGltfNone && piece.geometry->vertices.influences > 0;
}

std::vector<GltfBaked> GltfBake::primitives() const {
  std::vector<GltfBaked> out;
  for (const Piece& piece : pieces_)
    out.push_back({piece.node, piece.mesh, piece.primitive, piece.geometry.get(),
                   piece.first_vertex, piece.turned, piece.owns_vertices});
  return out;
}

std::vector<bool> GltfBake::moving_nodes() const {
  std::vector<bool> moving(document_.nodes.size());
  auto add = [&](uint32_t node) {
    for (uint32_t n = node; n != kGltfNone && !moving[n]; n = document_.nodes[n].parent)
      moving[n] = true;
  };
  for (const Piece& piece : pieces_) {
    if (!is_skinned(piece)) {
      add(piece.node);
      continue;
    }
    for (uint32_t joint : document_.skins[document_.nodes[piece.node].skin].joints)
      add(joint);
    if (!piece.geometry->vertices.targets.empty())
      moving[piece.node] = true;
  }
  return moving;
}

MeshSequence GltfBake::still() const {
  MeshSequence out;
  out.vertex_count = static_cast<uint32_t>(vertex_count_);
  out.up = UpAxis::kY;
  out.metres_per_unit = 1;
  out.parts = parts_;
  if (out.parts.names.empty())
    out.parts.of_polygon.clear();
  for (const GltfMaterial& material : document_.materials) {
    out.materials.names.push_back(material.name);
    out.materials.looks.push_back(material.look);
  }

  std::map<std::string, Attribute> attributes;
  for (const Piece& piece : pieces_) {
    const GltfVertices& vertices = piece.geometry->vertices;
    const std::vector<uint32_t>& triangles = piece.geometry->triangles;
    for (size_t i = 0; i < triangles.size(); i += 3) {
      uint32_t corners[] = {triangles[i] + piece.first_vertex,
                            triangles[i + 1] + piece.first_vertex,
                            triangles[i + 2] + piece.first_vertex};
      if (piece.turned)
        std::swap(corners[1], corners[2]);
      out.polygons.add(corners);
    }
    static_assert(kNoLabel == kGltfNone);
    std::vector<uint32_t>& materials = out.materials.of_polygon;
    materials.insert(materials.end(), triangles.size() / 3,
                     document_.meshes[piece.mesh].primitives[piece.primitive].material);
    auto add = [&](const auto& sets, AttributeKind kind, uint32_t components) {
      for (const auto& [name, values] : sets) {
        Attribute& attribute = attributes[name];
        attribute.kind = kind;
        attribute.name = name;
        attribute.components = components;
        attribute.values.resize(size_t{out.vertex_count} * components,
                                kind == AttributeKind::kColour ? 1.0F : 0.0F);
        std::copy(values.begin(), values.end(),
                  attribute.values.begin() +
                      static_cast<std::ptrdiff_t>(size_t{piece.first_vertex} * components));
        if (kind == AttributeKind::kUv) {  // glTF's v points down
          for (size_t v = 0; v < vertices.count; ++v) {
            float& value = attribute.values[2 * (piece.first_vertex + v) + 1];
            value = 1 - value;
          }
        }
      }
    };
    add(vertices.uvs, AttributeKind::kUv, 2);
    add(vertices.colours, AttributeKind::kColour, 4);
  }
  for (auto& [name, attribute] : attributes)
    out.attributes.push_back(std::move(attribute));
  if (out.materials.names.empty())
    out.materials.of_polygon.clear();
  return out;
}

GltfBake::Worlds GltfBake::worlds_of(const GltfPose& pose) const {
  Worlds worlds;
  worlds.nodes.resize(document_.nodes.size());
  worlds.visible.resize(document_.nodes.size());
  worlds.mirrored.resize(document_.nodes.size());
  for (uint32_t n : order_) {
    const GltfNode& node = document_.nodes[n];
    const Transform local = local_transform(node, pose, n);
    const bool is_root = node.parent == kGltfNone;
    worlds.nodes[n] = is_root ? local : after(worlds.nodes[node.parent], local);
    worlds.visible[n] = pose.visible[n] != 0 && (is_root || worlds.visible[node.parent]);
    const bool mirrored = node.matrix ? mirrors(*node.matrix) : mirrors(pose.scales[n]);
    worlds.mirrored[n] = mirrored != (!is_root && worlds.mirrored[node.parent]);
  }
  worlds.joints.resize(document_.skins.size());
  for (const Piece& piece : pieces_) {
    if (!is_skinned(piece))
      continue;
    const uint32_t s = document_.nodes[piece.node].skin;
    const GltfSkin& skin = document_.skins[s];
    if (!worlds.joints[s].empty())
      continue;
    for (size_t j = 0; j < skin.joints.size(); ++j) {
      const Transform& world = worlds.nodes[skin.joints[j]];
      worlds.joints[s].push_back(inverse_binds_[s].empty()
                                     ? world
                                     : after(world, affine(inverse_binds_[s].data() + 16 * j)));
    }
  }
  return worlds;
}

namespace {

/// Base plus weighted targets, of positions or normals.
std::vector<double> morphed(const GltfVertices& vertices, const std::vector<double>& weights,
                            std::vector<float> GltfVectors::*what) {
  const std::vector<float>& base = vertices.base.*what;
  std::vector<double> out(base.begin(), base.end());
  for (size_t t = 0; t < vertices.targets.size(); ++t) {
    const std::vector<float>& added = vertices.targets[t].*what;
    if (weights[t] == 0 || added.empty() || out.empty())
      continue;
    for (size_t i = 0; i < out.size(); ++i)
      out[i] += weights[t] * static_cast<double>(added[i]);
  }
  return out;
}

/// The transform of a vertex: of its node, or blended from its joints.
Transform blended(const GltfVertices& vertices, const std::vector<Transform>& joints, size_t v) {
  Transform out = Transform::Zero();
  for (size_t i = v * vertices.influences; i < (v + 1) * vertices.influences; ++i) {
    if (vertices.weights[i] > 0)
      out += static_cast<double>(vertices.weights[i]) * joints[vertices.joints[i]];
  }
  return out;
}

}  // namespace

void GltfBake::move(const Piece& piece, const GltfPose& pose, const Worlds& worlds,
                    float* positions) const {
  const GltfVertices& vertices = piece.geometry->vertices;
  const Eigen::Map<const Eigen::Vector3d> origin(options_.origin.data());
  if (!worlds.visible[piece.node] ||
      (piece.in_turn && worlds.mirrored[piece.node] != piece.shown_while_mirrored)) {
    Eigen::Map<Eigen::Matrix3Xf>(positions, 3, vertices.count).colwise() =
        (worlds.nodes[piece.node].col(3) - origin).cast<float>();
    return;
  }
  const std::vector<double> base =
      morphed(vertices, pose.weights[piece.node], &GltfVectors::positions);
  const bool skinned = is_skinned(piece);
  const Transform world = worlds.of(piece);
  for (size_t v = 0; v < vertices.count; ++v) {
    const Transform m =
        skinned ? blended(vertices, worlds.joints[document_.nodes[piece.node].skin], v) : world;
    const Eigen::Vector3d p =
        m.leftCols<3>() * Eigen::Map<const Eigen::Vector3d>(base.data() + 3 * v) + m.col(3);
    Eigen::Map<Eigen::Vector3f>(positions + 3 * v) = (p - origin).cast<float>();
  }
}

void GltfBake::add_normals(const GltfPose& pose, const Worlds& worlds, MeshSequence& out) const {
  Attribute normals{
      .kind = AttributeKind::kNormal, .name = "NORMAL", .components = 3, .values = {}};
  Attribute tangents{
      .kind = AttributeKind::kTangent, .name = "TANGENT", .components = 4, .values = {}};
  for (const Piece& piece : pieces_) {
    const GltfVertices& vertices = piece.geometry->vertices;
    if (!piece.owns_vertices || vertices.base.normals.empty())
      continue;
    normals.values.resize(size_t{out.vertex_count} * 3);
    if (!vertices.tangents.empty())
      tangents.values.resize(size_t{out.vertex_count} * 4);
    const std::vector<double> base =
        morphed(vertices, pose.weights[piece.node], &GltfVectors::normals);
    const bool skinned = is_skinned(piece);
    const Transform world = worlds.of(piece);
    for (size_t v = 0; v < vertices.count; ++v) {
      const Transform m =
          skinned ? blended(vertices, worlds.joints[document_.nodes[piece.node].skin], v) : world;
      const bool mirrored = skinned ? m.leftCols<3>().determinant() < 0 : piece.turned;
      const size_t to = piece.first_vertex + v;
      const Eigen::Vector3d n =
          normal_matrix(m, mirrored) * Eigen::Map<const Eigen::Vector3d>(base.data() + 3 * v);
      Eigen::Map<Eigen::Vector3f>(normals.values.data() + 3 * to) = n.normalized().cast<float>();
      if (vertices.tangents.empty())
        continue;
      const Eigen::Vector3d t =
          m.leftCols<3>() *
          Eigen::Map<const Eigen::Vector3f>(vertices.tangents.data() + 4 * v).cast<double>();
      Eigen::Map<Eigen::Vector3f>(tangents.values.data() + 4 * to) = t.normalized().cast<float>();
      // The bitangent is normal x tangent of before the transform.
      tangents.values[4 * to + 3] = vertices.tangents[4 * v + 3] * (mirrored ? -1.0F : 1.0F);
    }
  }
  for (Attribute* attribute : {&normals, &tangents}) {
    if (!attribute->values.empty())
      out.attributes.push_back(std::move(*attribute));
  }
}

void GltfBake::move_attributes(uint32_t frames, const std::function<GltfPose(uint32_t)>& pose_of,
                               uint64_t memory_left, MeshSequence& out) const {
  for (Attribute& attribute : out.attributes) {
    auto added = [&](const GltfVectors& target) -> const std::vector<float>* {
      const auto found = target.sets.find(attribute.name);
      return found == target.sets.end() ? nullptr : &found->second;
    };
    const bool moves = std::ranges::any_of(pieces_, [&](const Piece& piece) {
      return std::ranges::any_of(piece.geometry->vertices.targets, added);
    });
    if (!moves)
      continue;
    const size_t n = attribute.components, row = attribute.values.size();
    if (row > memory_left / sizeof(float) / frames)
      fail_input(document_.name, shown(attribute.name) + " in " + std::to_string(frames) +
                                     " frames takes more than the " + std::to_string(memory_left) +
                                     " bytes of memory that are left of the " +
                                     std::to_string(options_.memory_limit) + " that are allowed");
    memory_left -= sizeof(float) * row * frames;
    const FrameArray base = attribute.values;
    attribute.values.resize(row * frames);
    attribute.frames = frames;
    for (uint32_t f = 0; f < frames; ++f) {
      const GltfPose pose = pose_of(f);
      float* values = attribute.values.data() + row * f;
      std::ranges::copy(base, values);
      for (const Piece& piece : pieces_) {
        const std::vector<GltfVectors>& targets = piece.geometry->vertices.targets;
        for (size_t t = 0; t < targets.size() && piece.owns_vertices; ++t) {
          const std::vector<float>* more = added(targets[t]);
          const double weight = pose.weights[piece.node][t];
          for (size_t i = 0; more && i < more->size(); ++i) {
            const bool turned =
                attribute.kind == AttributeKind::kUv && i % 2 == 1;  // v points down
            values[n * piece.first_vertex + i] +=
                static_cast<float>((turned ? -weight : weight) * static_cast<double>((*more)[i]));
          }
        }
      }
    }
  }
}

/// All vertices x 3 in a pose.
std::vector<float> GltfBake::positions_in(const GltfPose& pose) const {
  std::vector<float> positions(size_t{3} * vertex_count_);
  const Worlds worlds = worlds_of(pose);
  for (const Piece& piece : pieces_) {
    if (piece.owns_vertices)
      move(piece, pose, worlds, positions.data() + size_t{3} * piece.first_vertex);
  }
  return positions;
}

std::vector<uint32_t> GltfBake::needed_ticks(const GltfClip& clip, uint32_t ticks,
                                             double rate) const {
  constexpr double kLongGap = 10;  // seconds: shorter ones cost few frames
  constexpr double kTolerance = 1e-5, kRounding = 1e-3;
  std::vector<uint32_t> needed{0, ticks - 1};
  for (const double time : clip.key_times()) {
    const double tick = (time - clip.first_time()) * rate;
    for (const double at : {std::floor(tick + kRounding), std::ceil(tick - kRounding)})
      needed.push_back(static_cast<uint32_t>(std::clamp(at, 0.0, static_cast<double>(ticks - 1))));
  }
  std::ranges::sort(needed);
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());

  struct Sample {
    uint32_t tick;
    std::vector<float> positions;
    std::vector<std::vector<double>> weights;
  };

  const GltfPose rest = pose_at_rest(document_);
  const auto sample = [&](uint32_t tick) {
    GltfPose pose = rest;
    clip.apply(clip.first_time() + tick / rate, kRounding / rate, pose);
    return Sample{tick, positions_in(pose), std::move(pose.weights)};
  };
  const auto extent = [](const std::vector<float>& positions) {
    float most = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      float least_here = positions[axis], most_here = least_here;
      for (size_t i = axis; i < positions.size(); i += 3) {
        least_here = std::min(least_here, positions[i]);
        most_here = std::max(most_here, positions[i]);
      }
      most = std::max(most, most_here - least_here);
    }
    return static_cast<double>(most);
  };
  const auto is_between = [&](const Sample& at, const Sample& a, const Sample& b) {
    const double s = static_cast<double>(at.tick - a.tick) / (b.tick - a.tick);
    const double tolerance =
        kTolerance * std::max({extent(at.positions), extent(a.positions), extent(b.positions)});
    for (size_t i = 0; i < at.positions.size(); ++i) {
      const auto x = static_cast<double>(a.positions[i]), y = static_cast<double>(b.positions[i]);
      const double rounding = 4e-7 * std::max(std::abs(x), std::abs(y));
      if (!(std::abs(x + s * (y - x) - static_cast<double>(at.positions[i])) <=
            tolerance + rounding))
        return false;
    }
    for (size_t n = 0; n < at.weights.size(); ++n) {
      for (size_t t = 0; t < at.weights[n].size(); ++t) {
        const double x = a.weights[n][t], y = b.weights[n][t];
        if (!(std::abs(x + s * (y - x) - at.weights[n][t]) <= kTolerance))
          return false;
      }
    }
    return true;
  };
  std::vector<uint32_t> more;
  // Straight at a quarter, a half and three quarters is straight all the way: no curve between two keys
  // bends more often.
  const std::function<void(const Sample&, const Sample&)> add_between = [&](const Sample& a,
                                                                            const Sample& b) {
    const uint32_t length = b.tick - a.tick;
    if (length < 2)
      return;
    const Sample middle = sample(a.tick + length / 2);
    bool straight = is_between(middle, a, b);
    for (const uint32_t tick : {a.tick + length / 4, b.tick - length / 4}) {
      if (straight && tick != a.tick && tick != b.tick)
        straight = is_between(sample(tick), a, b);
    }
    if (straight)
      return;
    more.push_back(middle.tick);
    add_between(a, middle);
    add_between(middle, b);
  };
  for (size_t i = 1; i < needed.size(); ++i) {
    const uint32_t from = needed[i - 1], to = needed[i];
    if ((to - from) / rate > kLongGap) {
      add_between(sample(from), sample(to));
    } else {
      for (uint32_t tick = from + 1; tick < to; ++tick)
        more.push_back(tick);
    }
  }
  needed.insert(needed.end(), more.begin(), more.end());
  std::ranges::sort(needed);
  return needed;
}

/// A primitive without normals has flat faces (glTF 2.0, section 3.7.2.1).
void GltfBake::add_hard_edges(MeshSequence& out) const {
  std::vector<bool> flat;
  for (const Piece& piece : pieces_)
    flat.insert(flat.end(), piece.geometry->triangles.size() / 3,
                piece.geometry->vertices.base.normals.empty());
  if (options_.flat_without_normals && std::ranges::find(flat, true) != flat.end())
    out.shared_normals = known_shared_normals(out, flat);
}

void GltfBake::add_frames(const GltfClip* clip, const std::vector<uint32_t>& ticks,
                          const GltfOptions& options, MeshSequence& out) const {
  const auto frames = static_cast<uint32_t>(ticks.size());
  const uint64_t bytes = uint64_t{12} * out.vertex_count * frames;
  const std::string size =
      std::to_string(out.vertex_count) + " vertices x " + std::to_string(frames) + " frames";
  if (bytes > options.memory_limit)
    fail_input(document_.name, size + " take " + std::to_string(bytes) +
                                   " bytes of memory, more than the " +
                                   std::to_string(options.memory_limit) + " that are allowed");
  try {
    out.positions.resize(bytes / sizeof(float));
  } catch (const std::exception&) {
    fail_input(document_.name, "not enough memory for " + size);
  }
  out.frame_count = frames;
  const GltfPose rest = pose_at_rest(document_);
  constexpr double kTolerance = 1e-3;  // of a frame
  const double gap = 1 / out.rate.value();
  auto pose_of = [&](uint32_t f) {
    GltfPose pose = rest;
    if (clip)
      clip->apply(clip->first_time() + ticks[f] * gap, kTolerance * gap, pose);
    return pose;
  };
  parallel_for(uint32_t{0}, frames, [&](uint32_t f) {
    const GltfPose pose = pose_of(f);
    const Worlds worlds = worlds_of(pose);
    for (const Piece& piece : pieces_) {
      if (piece.owns_vertices)
        move(piece, pose, worlds, out.frame(f).data() + size_t{3} * piece.first_vertex);
    }
  });
  for (size_t i = 0; i < out.positions.size(); ++i) {
    if (!std::isfinite(out.positions[i]))
      fail_input(document_.name, "frame " + std::to_string(i / 3 / out.vertex_count) + ", vertex " +
                                     std::to_string(i / 3 % out.vertex_count) +
                                     ": the position is not finite");
  }
  move_attributes(frames, pose_of, options.memory_limit - bytes, out);
  const GltfPose pose = pose_of(0);
  add_normals(pose, worlds_of(pose), out);
  add_hard_edges(out);
  if (options.progress)
    options.progress("reading", 1);
}

}  // namespace anicodec::tools
