// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/fbx/fbx_take.h"

#include "codec/sequence/scene.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"
#include "tools/io/fbx/fbx_material.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <utility>

namespace anicodec::tools {
namespace {

constexpr double kTolerance = 1e-3;  // of a frame

bool changes(const ufbx_anim_curve& curve) {
  return curve.min_value != curve.max_value;
}

template <typename Use>
void for_each_changing_curve(const ufbx_anim& anim, const Use& use) {
  for (const ufbx_anim_layer* layer : std::span(anim.layers.data, anim.layers.count)) {
    for (const ufbx_anim_value* value :
         std::span(layer->anim_values.data, layer->anim_values.count)) {
      for (const ufbx_anim_curve* curve : value->curves) {
        if (curve != nullptr && changes(*curve))
          use(*curve);
      }
    }
  }
}

/// The rate that a file states as a number.
FrameRate rate_of(double frames_per_second) {
  if (!(frames_per_second >= 1e-3 && frames_per_second <= 1e6))
    return {};
  const double times[] = {0, 1 / frames_per_second, 2 / frames_per_second};
  return timing_of(times, 0, "").rate;
}

const ufbx_matrix& matrix_of(const ufbx_node& node) {
  const ufbx_skin_deformer_list& skins = node.mesh->skin_deformers;
  const bool skinned = skins.count > 0 && skins.data[0]->clusters.count > 0;
  return skinned ? skins.data[0]->clusters.data[0]->geometry_to_world : node.geometry_to_world;
}

bool mirrors(const ufbx_node& node) {
  return ufbx_matrix_determinant(&matrix_of(node)) < 0;
}

bool is_visible(const ufbx_node& node) {
  for (const ufbx_node* n = &node; n != nullptr; n = n->parent) {
    if (!n->visible)
      return false;
    if (!ufbx_find_bool(&n->props, "Visibility Inheritance", true))
      return true;
  }
  return true;
}

/// A normal of a surface that a matrix moves.
ufbx_vec3 moved_normal(const ufbx_matrix& m, ufbx_vec3 n) {
  const ufbx_matrix turn = ufbx_matrix_for_normals(&m);
  return ufbx_vec3_normalize(ufbx_transform_direction(&turn, n));
}

bool is_hole(const ufbx_mesh& mesh, size_t face) {
  return face < mesh.face_hole.count && mesh.face_hole.data[face];
}

std::string or_else(ufbx_string name, const char* otherwise) {
  return name.length > 0 ? text_of(name) : otherwise;
}

}  // namespace

bool may_move(const FbxScene& scene, const ufbx_anim& anim) {
  bool found = scene.has_caches();
  for_each_changing_curve(anim, [&](const ufbx_anim_curve&) { found = true; });
  return found;
}

FbxTake::FbxTake(const FbxScene& scene, const ufbx_anim* anim, const GltfOptions& options,
                 const FbxNote& note)
    : scene_(scene), anim_(anim), options_(options), note_(note) {
  set_timing();
  watch();
}

std::vector<double> FbxTake::key_times() const {
  std::set<double> times;
  for_each_changing_curve(*anim_, [&](const ufbx_anim_curve& curve) {
    for (const ufbx_keyframe& key : std::span(curve.keyframes.data, curve.keyframes.count))
      times.insert(key.time);
  });
  return {times.begin(), times.end()};
}

/// The take lasts as long as it says, else as its keys and caches do.
void FbxTake::set_timing() {
  if (anim_ == nullptr)
    return;
  std::vector<double> times = key_times();
  begin_ = anim_->time_begin;
  end_ = anim_->time_end;
  if (!(end_ > begin_)) {
    std::vector<double> all = times;
    for (const ufbx_node* node : scene_.nodes()) {
      for (const ufbx_cache_deformer* cache :
           std::span(node->mesh->cache_deformers.data, node->mesh->cache_deformers.count)) {
        if (cache->external_channel != nullptr) {
          for (const ufbx_cache_frame& frame : std::span(cache->external_channel->frames.data,
                                                         cache->external_channel->frames.count))
            all.push_back(frame.time);
        }
      }
    }
    if (all.empty())
      return;
    begin_ = *std::ranges::min_element(all);
    end_ = *std::ranges::max_element(all);
  }
  if (!std::isfinite(begin_) || !std::isfinite(end_))
    fail_input(scene_.path(), "the take has no finite begin and end");
  std::erase_if(times, [&](double t) { return t < begin_ || t > end_; });
  rate_ = rate_of(scene_.scene().settings.frames_per_second);
  const bool on_frames = std::ranges::all_of(times, [&](double t) {
    const double frame = (t - begin_) * rate_.value();
    return std::abs(frame - std::round(frame)) <= 10 * kTolerance;
  });
  if (options_.rate) {
    rate_ = *options_.rate;
  } else if (!on_frames) {
    times.insert(times.begin(), begin_);
    const std::optional<FrameRate> grid = grid_rate(times, 1e-6);
    if (grid && grid->value() > rate_.value())
      rate_ = *grid;
    else
      note_(scene_.path() + ": keys stand between the " + std::to_string(rate_.value()) +
            " frames per second of the file; --fps samples it at others");
  }
  rate_.assumed = false;
  const double length = (end_ - begin_) * rate_.value(),
               frames = std::floor(length + kTolerance) + 1;
  if (!(frames <= static_cast<double>(kMaxFrames)))
    fail_input(scene_.path(), "from " + std::to_string(begin_) + " to " + std::to_string(end_) +
                                  " s there are more than 2^24 - 1 frames");
  if (length - (frames - 1) > kTolerance)
    note_(scene_.path() + ": the last " + std::to_string((length - (frames - 1)) / rate_.value()) +
          " s of the take lie behind the last frame");
  frames_ = static_cast<uint32_t>(frames);
}

/// A quarter of a tick behind the tick of the frame, so that a step at the frame has been taken.
double FbxTake::time_of(uint32_t frame) const {
  const double time = begin_ + frame / rate_.value();
  const auto ticks =
      static_cast<double>(std::max<int64_t>(scene_.scene().metadata.ktime_second, 1));
  return (std::round(time * ticks) + 0.25) / ticks;
}

void FbxTake::watch() {
  states_.assign(scene_.nodes().size(), std::vector<State>(frames_));
  for (uint32_t f = 0; f < frames_; ++f) {
    const UfbxScene now = scene_.at(anim_, time_of(f));
    for (size_t n = 0; n < states_.size(); ++n) {
      const ufbx_node& node = *now->nodes.data[scene_.nodes()[n]->typed_id];
      const bool shown = is_visible(node) || !options_.mesh.empty();
      states_[n][f] = !shown ? State::kHidden : mirrors(node) ? State::kMirrored : State::kPlain;
    }
  }
}

void FbxTake::add_facings(std::vector<Facings>* facings) const {
  facings->resize(states_.size());
  for (size_t n = 0; n < states_.size(); ++n) {
    (*facings)[n].plain |= std::ranges::count(states_[n], State::kPlain) > 0;
    (*facings)[n].mirrored |= std::ranges::count(states_[n], State::kMirrored) > 0;
  }
}

void FbxTake::add_pieces(const std::vector<Facings>& facings) {
  const UfbxScene first = scene_.at(anim_, time_of(0));
  std::vector<MeshSequence> meshes;
  uint64_t vertices = 0;
  for (size_t n = 0; n < states_.size(); ++n) {
    const ufbx_node& node = *scene_.nodes()[n];
    const std::string name = text_of(node.name);
    const auto [plain, mirrored] = facings[n];
    if (!plain && !mirrored)
      note_(scene_.path() + ": mesh '" + printable(name) +
            "' is left out: no frame shows it; --mesh takes it");
    for (const bool mirror : {false, true}) {
      if (!(mirror ? mirrored : plain))
        continue;
      Piece& piece = pieces_.emplace_back();
      piece.node = n;
      piece.mirrored = mirror;
      piece.name = name + (mirror && plain ? " mirrored" : "");
      piece.first_vertex = static_cast<uint32_t>(vertices);
      vertices += node.mesh->num_vertices;
      if (vertices > kMaxVertices || 12.0 * static_cast<double>(vertices) * frames_ >
                                         static_cast<double>(options_.memory_limit))
        fail_input(scene_.path(), std::to_string(vertices) + " vertices x " +
                                      std::to_string(frames_) +
                                      " frames take more memory than is allowed");
      meshes.push_back(describe(piece, *first));
    }
  }
  if (pieces_.empty())
    fail_input(scene_.path(), "no frame shows a mesh; --mesh takes a hidden one by its name");
  still_ = merge_meshes(meshes);
  still_.rate = rate_;
  still_.start_time = begin_;
  still_.up = scene_.up();
  still_.metres_per_unit = scene_.metres_per_unit();
}

MeshSequence FbxTake::describe(Piece& piece, const ufbx_scene& scene) const {
  const ufbx_node& node = *scene.nodes.data[scene_.nodes()[piece.node]->typed_id];
  const ufbx_mesh& mesh = *node.mesh;
  MeshSequence out;
  out.mesh_name = piece.name;
  out.vertex_count = static_cast<uint32_t>(mesh.num_vertices);
  size_t left_out = 0;
  for (size_t f = 0; f < mesh.num_faces; ++f) {
    const ufbx_face face = mesh.faces.data[f];
    if (face.num_indices < 3 || is_hole(mesh, f)) {
      ++left_out;
      continue;
    }
    std::vector<uint32_t> corners(face.num_indices);
    std::iota(corners.begin(), corners.end(), face.index_begin);
    if (piece.mirrored)
      std::reverse(corners.begin(), corners.end());
    piece.order.insert(piece.order.end(), corners.begin(), corners.end());
    for (uint32_t& corner : corners)
      corner = mesh.vertex_indices.data[corner];
    out.polygons.add(corners);
    const uint32_t material = f < mesh.face_material.count ? mesh.face_material.data[f] : kNoLabel;
    out.materials.of_polygon.push_back(material < node.materials.count ? material : kNoLabel);
  }
  if (left_out > 0)
    note_(scene_.path() + ": mesh '" + printable(piece.name) + "': " + std::to_string(left_out) +
          " points, lines or holes among its faces are left out");
  for (const ufbx_material* material : std::span(node.materials.data, node.materials.count)) {
    out.materials.names.push_back(text_of(material->name));
    out.materials.looks.push_back(look_of(*material));
  }
  if (out.materials.names.empty())
    out.materials.of_polygon.clear();
  add_attributes(piece, scene, out);
  return out;
}

void FbxTake::add_attributes(const Piece& piece, const ufbx_scene& scene, MeshSequence& out) const {
  const ufbx_node& node = *scene.nodes.data[scene_.nodes()[piece.node]->typed_id];
  const ufbx_mesh& mesh = *node.mesh;
  const auto add = [&](AttributeKind kind, const std::string& name, uint32_t components,
                       const auto& value_of) {
    Attribute attribute{.kind = kind,
                        .name = name,
                        .domain = AttributeDomain::kCorner,
                        .components = components,
                        .values = {}};
    attribute.values.reserve(piece.order.size() * components);
    for (const uint32_t corner : piece.order) {
      const ufbx_vec4 value = value_of(corner);
      for (uint32_t k = 0; k < components; ++k)
        attribute.values.push_back(static_cast<float>(value.v[k]));
    }
    if (std::ranges::all_of(attribute.values, [](float x) { return std::isfinite(x); }))
      out.attributes.push_back(std::move(attribute));
    else
      note_(scene_.path() + ": mesh '" + printable(piece.name) + "': '" + printable(name) +
            "' is left out: a value is not finite");
  };
  for (const ufbx_uv_set& set : std::span(mesh.uv_sets.data, mesh.uv_sets.count))
    add(AttributeKind::kUv, or_else(set.name, "uv"), 2, [&](uint32_t corner) {
      const ufbx_vec2 uv = ufbx_get_vertex_vec2(&set.vertex_uv, corner);
      return ufbx_vec4{uv.x, uv.y, 0, 0};
    });
  for (const ufbx_color_set& set : std::span(mesh.color_sets.data, mesh.color_sets.count))
    add(AttributeKind::kColour, or_else(set.name, "colour"), 4,
        [&](uint32_t corner) { return ufbx_get_vertex_vec4(&set.vertex_color, corner); });
  if (!mesh.vertex_normal.exists)
    return;
  const ufbx_skin_deformer* skin =
      mesh.skin_deformers.count > 0 ? mesh.skin_deformers.data[0] : nullptr;
  add(AttributeKind::kNormal, "normal", 3, [&](uint32_t corner) {
    const ufbx_matrix m = skin ? ufbx_get_skin_vertex_matrix(skin, mesh.vertex_indices.data[corner],
                                                             &node.geometry_to_world)
                               : node.geometry_to_world;
    const ufbx_vec3 n = moved_normal(m, ufbx_get_vertex_vec3(&mesh.vertex_normal, corner));
    return ufbx_vec4{n.x, n.y, n.z, 0};
  });
}

void FbxTake::move(const Piece& piece, const ufbx_scene& scene, uint32_t frame, float* out) const {
  const ufbx_node& node = *scene.nodes.data[scene_.nodes()[piece.node]->typed_id];
  const ufbx_mesh& mesh = *node.mesh;
  const auto put = [&](size_t vertex, const ufbx_vec3& p) {
    for (size_t k = 0; k < 3; ++k)
      out[3 * vertex + k] = static_cast<float>(p.v[k] - options_.origin[k]);
  };
  const State own = piece.mirrored ? State::kMirrored : State::kPlain;
  if (states_[piece.node][frame] != own) {
    for (size_t v = 0; v < mesh.num_vertices; ++v)
      put(v, node.node_to_world.cols[3]);
    return;
  }
  std::vector<ufbx_vec3> positions(mesh.vertices.data, mesh.vertices.data + mesh.num_vertices);
  bool cached = false;
  ufbx_geometry_cache_data_opts cache_options = {};
  cache_options.open_file_cb = scene_.files();
  for (const ufbx_cache_deformer* cache :
       std::span(mesh.cache_deformers.data, mesh.cache_deformers.count)) {
    const ufbx_cache_channel* channel = cache->external_channel;
    if (channel == nullptr || cached ||
        (channel->interpretation != UFBX_CACHE_INTERPRETATION_VERTEX_POSITION &&
         channel->interpretation != UFBX_CACHE_INTERPRETATION_POINTS))
      continue;
    const size_t read = ufbx_sample_geometry_cache_vec3(channel, time_of(frame), positions.data(),
                                                        positions.size(), &cache_options);
    if (read != positions.size())
      fail_input(scene_.path(), "the cache of mesh '" + printable(piece.name) + "' has " +
                                    std::to_string(read) + " points, but the mesh " +
                                    std::to_string(positions.size()));
    cached = true;
  }
  for (const ufbx_blend_deformer* blend :
       std::span(mesh.blend_deformers.data, mesh.blend_deformers.count)) {
    if (!cached)
      ufbx_add_blend_vertex_offsets(blend, positions.data(), positions.size(), 1);
  }
  const ufbx_skin_deformer* skin =
      !cached && mesh.skin_deformers.count > 0 ? mesh.skin_deformers.data[0] : nullptr;
  for (size_t v = 0; v < positions.size(); ++v) {
    const ufbx_matrix m = skin ? ufbx_get_skin_vertex_matrix(skin, v, &node.geometry_to_world)
                               : node.geometry_to_world;
    put(v, ufbx_transform_position(&m, positions[v]));
  }
}

void FbxTake::bake(const std::string& name, const std::vector<Facings>& facings,
                   FbxMessage& message) {
  add_pieces(facings);
  MeshSequence still = still_;
  still.name = name;
  message.begin_clip(still);
  std::vector<float> positions(size_t{3} * still_.vertex_count);
  for (uint32_t f = 0; f < frames_; ++f) {
    const UfbxScene now = scene_.at(anim_, time_of(f));
    for (const Piece& piece : pieces_)
      move(piece, *now, f, positions.data() + size_t{3} * piece.first_vertex);
    const auto bad = std::ranges::find_if(positions, [](float x) { return !std::isfinite(x); });
    if (bad != positions.end())
      fail_input(scene_.path(), "frame " + std::to_string(f) + ", vertex " +
                                    std::to_string((bad - positions.begin()) / 3) +
                                    ": the position is not finite");
    message.add_frame(positions);
  }
}

}  // namespace anicodec::tools
