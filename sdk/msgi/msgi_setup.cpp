// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The part of Msgi that is computed once for its inputs.
#include "sdk/msgi/msgi.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

/// Edges shorter than this share of the mean length count as that long.
constexpr double kShortestEdge = 1e-3;

double square(double x) {
  return x * x;
}

}  // namespace

struct Msgi::Build {
  FaceGraph graph;
  PatchHierarchy hierarchy;
  Vector<double> edge_weight;
};

/// Turns every component of every input onto the first one.
void Msgi::align_inputs(const FaceGraph& graph, const float* const* inputs) {
  const size_t parts = graph.component_count, coordinates = 3 * size_t{vertex_count_};
  part_ = graph.vertex_component;
  part_size_.assign(parts, 0);
  for (uint32_t c : part_) {
    if (c != kNoIndex)
      ++part_size_[c];
  }
  placement_.assign(parts * input_count_, {});
  aligned_.resize(coordinates * input_count_);
  Vector<Matrix3> back(parts);
  for (size_t i = 0; i < input_count_; ++i) {
    Placement* placement = placement_.data() + parts * i;
    for (size_t v = 0; v < vertex_count_; ++v) {
      if (part_[v] != kNoIndex)
        placement[part_[v]].centroid += vector_at(inputs[i] + 3 * v);
    }
    for (size_t c = 0; c < parts; ++c)
      placement[c].centroid = (1 / static_cast<double>(part_size_[c])) * placement[c].centroid;
    std::fill(back.begin(), back.end(), Matrix3{});
    for (size_t v = 0; v < vertex_count_; ++v) {
      if (part_[v] != kNoIndex)
        back[part_[v]].add_product(vector_at(inputs[i] + 3 * v) - placement[part_[v]].centroid,
                                   vector_at(inputs[0] + 3 * v) - placement_[part_[v]].centroid);
    }
    for (size_t c = 0; c < parts; ++c) {
      UnitQuaternion turn;
      if (i > 0)
        turn = votes_for(back[c]).leading();
      back[c] = to_matrix(turn);
      placement[c].turn = log_rotation(turn.conjugate());
    }
    for (size_t v = 0; v < vertex_count_; ++v) {
      Vector3 x = vector_at(inputs[i] + 3 * v);
      if (part_[v] != kNoIndex)
        x = back[part_[v]] * (x - placement[part_[v]].centroid);
      for (size_t axis = 0; axis < 3; ++axis)
        aligned_[coordinates * i + 3 * v + axis] = static_cast<float>(x[axis]);
    }
  }
}

/// Aligns every patch of every input with the first one's: its forces and the turns between
/// neighbours.
void Msgi::set_up_patches(const Build& build) {
  const PatchHierarchy& h = build.hierarchy;
  const size_t slots = h.slot_vertex.size(), links = h.links.size(), leaves = h.leaf_count();
  const size_t coordinates = 3 * size_t{vertex_count_};
  forces_.resize(3 * slots * input_count_);
  turns_.resize(3 * links * input_count_);
  slot_share_.assign(slots, 0);
  for (size_t leaf = 0; leaf < leaves; ++leaf) {
    double sum = 0;
    for (size_t k = h.edge_begin[leaf]; k < h.edge_begin[leaf + 1]; ++k)
      sum += 2 * build.edge_weight[h.patch_edges[k].edge];
    for (size_t k = h.edge_begin[leaf]; k < h.edge_begin[leaf + 1]; ++k) {
      const PatchHierarchy::PatchEdge& e = h.patch_edges[k];
      for (uint32_t slot : {e.slot_a, e.slot_b})
        slot_share_[slot] += static_cast<float>(build.edge_weight[e.edge] / sum);
    }
  }
  Vector<double> own(3 * slots), first(3 * slots);
  Vector<UnitQuaternion> rotations(leaves);
  for (size_t i = 0; i < input_count_; ++i) {
    const float* input = aligned_.data() + coordinates * i;
    std::fill(own.begin(), own.end(), 0.0);
    for (size_t leaf = 0; leaf < leaves; ++leaf) {
      for (size_t k = h.edge_begin[leaf]; k < h.edge_begin[leaf + 1]; ++k) {
        const PatchHierarchy::PatchEdge& e = h.patch_edges[k];
        Vector3 force =
            build.edge_weight[e.edge] * (vector_at(input + 3 * size_t{h.slot_vertex[e.slot_a]}) -
                                         vector_at(input + 3 * size_t{h.slot_vertex[e.slot_b]}));
        for (size_t axis = 0; axis < 3; ++axis) {
          own[3 * size_t{e.slot_a} + axis] += force[axis];
          own[3 * size_t{e.slot_b} + axis] -= force[axis];
        }
      }
    }
    if (i == 0)
      first = own;
    for (size_t leaf = 0; leaf < leaves; ++leaf) {
      const size_t begin = h.slot_begin[leaf], end = h.slot_begin[leaf + 1];
      const float* origin = input + 3 * size_t{h.slot_vertex[begin]};
      // The sum of w (y_a - y_b)(x_a - x_b)^T over the edges, by vertices; y this input, x the
      // first.
      Matrix3 products;
      for (size_t s = begin; s < end; ++s)
        products.add_product(vector_at(input + 3 * size_t{h.slot_vertex[s]}) - vector_at(origin),
                             {{first[3 * s], first[3 * s + 1], first[3 * s + 2]}});
      UnitQuaternion turn;
      if (i > 0)
        turn = votes_for(products).leading();
      rotations[leaf] = turn.conjugate();
      Matrix3 matrix = to_matrix(turn);
      for (size_t s = begin; s < end; ++s) {
        Vector3 turned = matrix * Vector3{{own[3 * s], own[3 * s + 1], own[3 * s + 2]}};
        std::copy(turned.x, turned.x + 3, &own[3 * s]);
      }
    }
    for (size_t k = 0; k < own.size(); ++k)
      forces_[3 * slots * i + k] = static_cast<float>(own[k]);
    for (size_t j = 0; j < links; ++j) {
      Vector3 turn = log_rotation(rotations[h.links[j].p].conjugate() * rotations[h.links[j].q]);
      largest_turn_ = std::max(largest_turn_, length(turn));
      for (size_t axis = 0; axis < 3; ++axis)
        turns_[3 * (links * i + j) + axis] = turn[axis];
    }
  }
}

Status Msgi::set_up_systems(const Build& build, const Options& options) {
  const PatchHierarchy& h = build.hierarchy;
  const FaceGraph& graph = build.graph;
  // An edge counts once for every patch it is in.
  Vector<SparseLdlt::Edge> edges(graph.edges.size());
  for (size_t e = 0; e < edges.size(); ++e)
    edges[e] = {graph.edges[e].a, graph.edges[e].b, 0};
  for (const PatchHierarchy::PatchEdge& e : h.patch_edges)
    edges[e.edge].weight += build.edge_weight[e.edge];

  // The first vertex of each component stays at the origin.
  Vector<uint32_t> group = h.vertex_node;
  Vector<char> started(part_size_.size());
  for (uint32_t v = 0; v < vertex_count_; ++v) {
    if (part_[v] != kNoIndex && !started[part_[v]]) {
      started[part_[v]] = 1;
      group[v] = SparseLdlt::kFixed;
    }
  }
  if (Status s = system_.init(group, edges, options.most_bytes); s != Status::kOk)
    return s;

  pins_ = options.pins;
  if (pins_.empty())
    return Status::kOk;
  Vector<char> pinned(part_size_.size());
  Vector<uint32_t> pin_of(vertex_count_, kNoIndex);
  for (uint32_t p = 0; p < pins_.size(); ++p) {
    pin_of[pins_[p]] = p;
    if (part_[pins_[p]] != kNoIndex)
      pinned[part_[pins_[p]]] = 1;
  }
  group = h.vertex_node;
  for (uint32_t v = 0; v < vertex_count_; ++v) {
    if (part_[v] != kNoIndex && (!pinned[part_[v]] || pin_of[v] != kNoIndex))
      group[v] = SparseLdlt::kFixed;
  }
  if (Status s = pinned_system_.init(group, edges, options.most_bytes); s != Status::kOk)
    return s;
  Vector<uint32_t> unknown(vertex_count_, kNoIndex);
  for (uint32_t i = 0; i < pinned_system_.size(); ++i)
    unknown[pinned_system_.vertices()[i]] = i;
  for (const SparseLdlt::Edge& e : edges) {
    if (unknown[e.a] != kNoIndex && pin_of[e.b] != kNoIndex)
      pin_edges_.push_back({unknown[e.a], pin_of[e.b], e.weight});
    if (unknown[e.b] != kNoIndex && pin_of[e.a] != kNoIndex)
      pin_edges_.push_back({unknown[e.b], pin_of[e.a], e.weight});
  }
  return Status::kOk;
}

Status Msgi::init(const uint32_t* triangles, size_t triangle_count, uint32_t vertex_count,
                  const float* const* inputs, size_t input_count, const Options& options) {
  *this = Msgi();
  if (input_count == 0 || vertex_count == 0 || options.leaf_faces < 1 || options.leaf_faces > 255)
    return Status::kArgument;
  if (triangle_count >= UINT32_MAX / 3)
    return Status::kLimit;
  for (size_t k = 0; k < 3 * triangle_count; ++k) {
    if (triangles[k] >= vertex_count)
      return Status::kIndexRange;
  }
  for (size_t i = 0; i < input_count; ++i) {
    for (size_t k = 0; k < 3 * size_t{vertex_count}; ++k) {
      if (!std::isfinite(inputs[i][k]))
        return Status::kNonFinite;
    }
  }
  Vector<char> is_pin(options.pins.empty() ? 0 : vertex_count);
  for (uint32_t pin : options.pins) {
    if (pin >= vertex_count || is_pin[pin])
      return Status::kArgument;
    is_pin[pin] = 1;
  }
  vertex_count_ = vertex_count;
  input_count_ = input_count;
  sweeps_ = options.sweeps;

  if (blend_bytes(0, 0) > options.most_bytes)
    return Status::kLimit;
  Build build;
  build.graph = make_face_graph(triangles, triangle_count, vertex_count);
  align_inputs(build.graph, inputs);
  build.hierarchy = make_patch_hierarchy(build.graph, options.leaf_faces);
  if (blend_bytes(build.hierarchy.slot_vertex.size(), build.hierarchy.links.size()) >
      options.most_bytes)
    return Status::kLimit;

  const Vector<FaceGraph::Edge>& edges = build.graph.edges;
  Vector<double>& weight = build.edge_weight;
  weight.assign(edges.size(), 0);
  double mean = 0;
  for (size_t e = 0; e < edges.size(); ++e) {
    for (size_t i = 0; i < input_count; ++i)
      weight[e] += length(vector_at(inputs[i] + 3 * size_t{edges[e].a}) -
                          vector_at(inputs[i] + 3 * size_t{edges[e].b}));
    mean += weight[e];
  }
  mean /= static_cast<double>(std::max<size_t>(edges.size(), 1));
  for (double& w : weight)
    w = mean > 0 ? square(mean / std::max(w, kShortestEdge * mean)) : 1;

  set_up_patches(build);
  if (Status s = set_up_systems(build, options); s != Status::kOk)
    return s;

  PatchHierarchy& h = build.hierarchy;
  nodes_ = std::move(h.nodes);
  nodes_.shrink_to_fit();
  links_ = std::move(h.links);
  links_.shrink_to_fit();
  level_begin_ = std::move(h.level_begin);
  level_nodes_ = std::move(h.level_nodes);
  slot_begin_ = std::move(h.slot_begin);
  slot_begin_.shrink_to_fit();
  slot_vertex_ = std::move(h.slot_vertex);
  slot_vertex_.shrink_to_fit();
  slot_leaf_.resize(slot_vertex_.size());
  vertex_slot_begin_.assign(size_t{vertex_count} + 1, 0);
  for (size_t leaf = 0; leaf + 1 < slot_begin_.size(); ++leaf) {
    for (size_t s = slot_begin_[leaf]; s < slot_begin_[leaf + 1]; ++s) {
      slot_leaf_[s] = static_cast<uint32_t>(leaf);
      ++vertex_slot_begin_[slot_vertex_[s] + 1];
    }
  }
  for (size_t v = 0; v < vertex_count; ++v)
    vertex_slot_begin_[v + 1] += vertex_slot_begin_[v];
  vertex_slots_.resize(slot_vertex_.size());
  Vector<uint32_t> at(vertex_slot_begin_.begin(), vertex_slot_begin_.end() - 1);
  for (uint32_t s = 0; s < slot_vertex_.size(); ++s)
    vertex_slots_[at[slot_vertex_[s]]++] = s;
  return resident_bytes() <= options.most_bytes ? Status::kOk : Status::kLimit;
}

}  // namespace anicodec
