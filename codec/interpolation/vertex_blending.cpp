// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/vertex_blending.h"

#include "codec/algebra/rigid_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

double length_of(const EdgeShape& shape, uint32_t edge) {
  return edge == kNoIndex ? 0 : shape.lengths[column(edge)];
}

/// The third corner of a triangle: its place along the side ab, and its distance from it.
std::pair<double, double> apex(double ab, double a, double b) {
  const double along = ab > 0 ? (a * a - b * b + ab * ab) / (2 * ab) : 0;
  return {along, std::sqrt(std::max(0.0, a * a - along * along))};
}

}  // namespace

VertexBlending::VertexBlending(const EdgeNetwork& network, std::span<const Points> inputs,
                               uint32_t leaf_faces)
    : network_(network),
      graph_(make_face_graph(network.triangles.data(), network.triangles.size() / 3,
                             network.vertex_count)),
      hierarchy_(make_patch_hierarchy(graph_, leaf_faces)),
      inputs_(inputs.begin(), inputs.end()),
      shapes_(measure_edges(network, inputs)) {
  plan_patches();
  plan_merges();
}

/// Chooses for every patch a triangle to start from and the order in which others unfold.
void VertexBlending::plan_patches() {
  const PatchHierarchy& h = hierarchy_;
  std::vector<std::vector<uint32_t>> hinges(graph_.face_count());
  for (uint32_t k = 0; k < network_.hinges.size(); ++k) {
    hinges[network_.hinges[k].face_c].push_back(k);
    hinges[network_.hinges[k].face_d].push_back(k);
  }
  auto edge_between = [&](uint32_t face, uint32_t u, uint32_t v) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t e = graph_.face_edges[3 * size_t{face} + k];
      if (e != kNoIndex && graph_.edges[e].a == std::min(u, v) &&
          graph_.edges[e].b == std::max(u, v))
        return e;
    }
    return kNoIndex;
  };
  std::vector<uint32_t> in_patch(graph_.face_count(), kNoIndex), seen = in_patch;
  std::vector<uint32_t> slot_of(graph_.vertex_count, kNoIndex);
  std::vector<char> lies(h.slot_vertex.size());
  std::vector<uint32_t> queue;
  for (uint32_t leaf = 0; leaf < h.leaf_count(); ++leaf) {
    const uint32_t first = h.face_begin[leaf], own_end = h.own_end[leaf];
    for (uint32_t i = first; i < h.face_begin[leaf + 1]; ++i)
      in_patch[h.patch_faces[i]] = leaf;
    for (uint32_t s = h.slot_begin[leaf]; s < h.slot_begin[leaf + 1]; ++s)
      slot_of[h.slot_vertex[s]] = s;
    // The own face with most neighbours in the patch is somewhere in the middle.
    uint32_t start = h.patch_faces[first];
    size_t most = 0;
    for (uint32_t i = first; i < own_end; ++i) {
      const uint32_t f = h.patch_faces[i];
      size_t inside = 0;
      for (uint32_t k = graph_.begin[f]; k < graph_.hinge_end[f]; ++k)
        inside += in_patch[graph_.neighbours[k]] == leaf;
      if (inside > most) {
        most = inside;
        start = f;
      }
    }
    Start made;
    for (size_t k = 0; k < 3; ++k) {
      made.slots[k] = slot_of[graph_.corners[3 * size_t{start} + k]];
      made.edges[k] = graph_.face_edges[3 * size_t{start} + k];
      lies[made.slots[k]] = 1;
    }
    made.first_unfolding = static_cast<uint32_t>(unfoldings_.size());
    starts_.push_back(made);
    queue.assign(1, start);
    seen[start] = leaf;
    for (size_t i = 0; i < queue.size(); ++i) {
      for (uint32_t k : hinges[queue[i]]) {
        Hinge hinge = network_.hinges[k];
        if (hinge.face_c != queue[i]) {
          // The same angle seen from the other side.
          std::swap(hinge.a, hinge.b);
          std::swap(hinge.c, hinge.d);
          std::swap(hinge.face_c, hinge.face_d);
        }
        if (in_patch[hinge.face_d] != leaf || seen[hinge.face_d] == leaf)
          continue;
        seen[hinge.face_d] = leaf;
        queue.push_back(hinge.face_d);
        const uint32_t slot = slot_of[hinge.d];
        if (lies[slot])
          continue;
        lies[slot] = 1;
        unfoldings_.push_back({slot, slot_of[hinge.a], slot_of[hinge.b], slot_of[hinge.c],
                               hinge.edge, edge_between(hinge.face_d, hinge.a, hinge.d),
                               edge_between(hinge.face_d, hinge.b, hinge.d), k});
      }
    }
  }
  Start end{};
  end.first_unfolding = static_cast<uint32_t>(unfoldings_.size());
  starts_.push_back(end);
}

/// Lists for every node the slots that its halves share, and where each vertex is complete.
void VertexBlending::plan_merges() {
  const PatchHierarchy& h = hierarchy_;
  std::vector<uint32_t> leaves_of(graph_.vertex_count), counted(h.slot_vertex.size(), 1);
  for (uint32_t v : h.slot_vertex)
    ++leaves_of[v];
  // A slot's word counts by the own faces of its patch around the vertex.
  std::vector<double> weight(h.slot_vertex.size(), 0.25);
  std::vector<uint32_t> slot_of(graph_.vertex_count, kNoIndex);
  for (uint32_t leaf = 0; leaf < h.leaf_count(); ++leaf) {
    for (uint32_t s = h.slot_begin[leaf]; s < h.slot_begin[leaf + 1]; ++s)
      slot_of[h.slot_vertex[s]] = s;
    for (uint32_t i = h.face_begin[leaf]; i < h.own_end[leaf]; ++i) {
      for (size_t k = 0; k < 3; ++k)
        weight[slot_of[graph_.corners[3 * size_t{h.patch_faces[i]} + k]]] += 1;
    }
  }
  std::fill(slot_of.begin(), slot_of.end(), kNoIndex);
  final_slot_.assign(graph_.vertex_count, kNoIndex);
  final_node_.assign(graph_.vertex_count, kNoIndex);
  std::vector<std::vector<uint32_t>> open(h.nodes.size());
  for (uint32_t n = 0; n < h.nodes.size(); ++n) {
    const PatchHierarchy::Node& node = h.nodes[n];
    merges_.push_back(
        {static_cast<uint32_t>(shared_.size()), static_cast<uint32_t>(moved_.size())});
    auto keep = [&](uint32_t slot) {
      const uint32_t v = h.slot_vertex[slot];
      if (counted[slot] == leaves_of[v]) {
        final_slot_[v] = slot;
        final_node_[v] = n;
      } else {
        open[n].push_back(slot);
      }
    };
    if (node.left == kNoIndex) {
      for (uint32_t s = h.slot_begin[node.first_leaf]; s < h.slot_begin[node.last_leaf]; ++s)
        keep(s);
      continue;
    }
    for (uint32_t s : open[node.left])
      slot_of[h.slot_vertex[s]] = s;
    for (uint32_t s : open[node.right]) {
      const uint32_t left = std::exchange(slot_of[h.slot_vertex[s]], kNoIndex);
      if (left == kNoIndex) {
        moved_.push_back(s);
        keep(s);
        continue;
      }
      shared_.push_back({left, s, weight[left] / (weight[left] + weight[s])});
      weight[left] += weight[s];
      counted[left] += counted[s];
      keep(left);
    }
    for (uint32_t s : open[node.left]) {
      if (std::exchange(slot_of[h.slot_vertex[s]], kNoIndex) == s)
        open[n].push_back(s);
    }
    std::vector<uint32_t>().swap(open[node.left]);
    std::vector<uint32_t>().swap(open[node.right]);
  }
  merges_.push_back({static_cast<uint32_t>(shared_.size()), static_cast<uint32_t>(moved_.size())});
}

/// Every patch in a frame of its own.
Points VertexBlending::unfold(const EdgeShape& shape) const {
  Points x = Points::Zero(3, static_cast<Index>(hierarchy_.slot_vertex.size()));
  for (size_t leaf = 0; leaf + 1 < starts_.size(); ++leaf) {
    const Start& start = starts_[leaf];
    const double side = length_of(shape, start.edges[0]);
    auto [along, height] =
        apex(side, length_of(shape, start.edges[2]), length_of(shape, start.edges[1]));
    x.col(column(start.slots[1])) = Vector3d(side, 0, 0);
    if (start.slots[2] != start.slots[0] && start.slots[2] != start.slots[1])
      x.col(column(start.slots[2])) = Vector3d(along, height, 0);
    for (uint32_t k = start.first_unfolding; k < starts_[leaf + 1].first_unfolding; ++k) {
      const Unfolding& u = unfoldings_[k];
      const Vector3d a = x.col(column(u.a));
      Vector3d side_ab = x.col(column(u.b)) - a;
      side_ab = side_ab.norm() > 0 ? Vector3d(side_ab.normalized()) : Vector3d::UnitX();
      Vector3d normal = side_ab.cross(x.col(column(u.c)) - a);
      normal = normal.norm() > 0 ? Vector3d(normal.normalized()) : side_ab.unitOrthogonal();
      const Vector3d inward = normal.cross(side_ab);
      auto [at, far] =
          apex(length_of(shape, u.edge_ab), length_of(shape, u.edge_a), length_of(shape, u.edge_b));
      const double angle = shape.angles[column(u.hinge)];
      x.col(column(u.slot)) =
          a + at * side_ab - far * (std::cos(angle) * inward + std::sin(angle) * normal);
    }
  }
  return x;
}

Points VertexBlending::evaluate(std::span<const double> weights) const {
  const PatchHierarchy& h = hierarchy_;
  Points slots = unfold(blend_edges(shapes_, weights));
  std::vector<RigidMotion> motion(h.nodes.size());
  for (uint32_t n = 0; n < h.nodes.size(); ++n) {
    const Merge &merge = merges_[n], &next = merges_[n + 1];
    if (h.nodes[n].left == kNoIndex)
      continue;
    Vector3d left = Vector3d::Zero(), right = Vector3d::Zero();
    for (uint32_t k = merge.first_shared; k < next.first_shared; ++k) {
      left += slots.col(column(shared_[k].left));
      right += slots.col(column(shared_[k].right));
    }
    const double count = std::max(1.0, static_cast<double>(next.first_shared - merge.first_shared));
    left /= count;
    right /= count;
    Matrix3d products = Matrix3d::Zero();
    for (uint32_t k = merge.first_shared; k < next.first_shared; ++k)
      products += (slots.col(column(shared_[k].left)) - left) *
                  (slots.col(column(shared_[k].right)) - right).transpose();
    RigidMotion& m = motion[h.nodes[n].right];
    m.rotation = best_rotation(products);
    m.translation = left - m.rotation * right;
    for (uint32_t k = merge.first_shared; k < next.first_shared; ++k) {
      const Shared& s = shared_[k];
      slots.col(column(s.left)) =
          s.left_share * slots.col(column(s.left)) +
          (1 - s.left_share) * (m.rotation * slots.col(column(s.right)) + m.translation);
    }
    for (uint32_t k = merge.first_moved; k < next.first_moved; ++k)
      slots.col(column(moved_[k])) = m.rotation * slots.col(column(moved_[k])) + m.translation;
  }
  // A vertex complete below the root goes along with everything above it.
  for (size_t n = h.nodes.size(); n-- > 0;) {
    const uint32_t parent = h.nodes[n].parent;
    if (parent == kNoIndex)
      continue;
    motion[n].translation =
        motion[parent].rotation * motion[n].translation + motion[parent].translation;
    motion[n].rotation = motion[parent].rotation * motion[n].rotation;
  }
  Points x = weights[0] * inputs_[0];
  for (size_t i = 1; i < inputs_.size(); ++i)
    x += weights[i] * inputs_[i];
  std::vector<Vector3d> from(graph_.component_count, Vector3d::Zero()), to = from;
  std::vector<Matrix3d> products(graph_.component_count, Matrix3d::Zero());
  std::vector<double> size(graph_.component_count);
  Points built = x;
  for (uint32_t v = 0; v < graph_.vertex_count; ++v) {
    if (final_slot_[v] == kNoIndex)
      continue;
    const uint32_t part = graph_.vertex_component[v];
    const RigidMotion& m = motion[final_node_[v]];
    built.col(column(v)) = m.rotation * slots.col(column(final_slot_[v])) + m.translation;
    from[part] += built.col(column(v));
    to[part] += x.col(column(v));
    size[part] += 1;
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (uint32_t v = 0; v < graph_.vertex_count; ++v) {
      if (final_slot_[v] == kNoIndex)
        continue;
      const uint32_t part = graph_.vertex_component[v];
      const Vector3d offset = built.col(column(v)) - from[part] / size[part];
      if (pass == 0)
        products[part] += (x.col(column(v)) - to[part] / size[part]) * offset.transpose();
      else
        x.col(column(v)) = products[part] * offset + to[part] / size[part];
    }
    for (Matrix3d& m : products)
      m = best_rotation(m);
  }
  return x;
}

}  // namespace anicodec
