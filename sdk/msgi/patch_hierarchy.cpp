// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/patch_hierarchy.h"

#include "format/sort.h"

#include <algorithm>
#include <tuple>

namespace anicodec {
namespace {

constexpr uint32_t kMostDepth = 48;

/// Cuts sets of faces in two.
class Bisection {
 public:
  explicit Bisection(const FaceGraph& graph)
      : graph_(graph), mark_(graph.face_count()), queues_{Queue(graph), Queue(graph)} {}

  /// Reorders faces[0 .. count-1], ascending and connected, into two such sets; returns the size of
  /// the first. count must be 2 or more.
  size_t cut(uint32_t* faces, size_t count) {
    inside_ = ++stamp_;
    for (size_t i = 0; i < count; ++i)
      mark_[faces[i]] = inside_;
    uint32_t a = farthest(faces[0], faces, count);
    uint32_t b = farthest(a, faces, count);
    uint32_t mark_a = ++stamp_, mark_b = ++stamp_;
    queues_[0].start(a);
    queues_[1].start(b);
    mark_[a] = mark_a;
    mark_[b] = mark_b;
    bool more_a = true, more_b = true;
    while (more_a || more_b) {
      if (more_a && (queues_[0].size <= queues_[1].size || !more_b))
        more_a = grow(queues_[0], mark_a);
      else
        more_b = grow(queues_[1], mark_b);
    }
    return partition(faces, count, mark_a);
  }

 private:
  /// Faces in the order reached, and where their neighbours are being looked at.
  struct Queue {
    explicit Queue(const FaceGraph& graph) : faces(graph.face_count()) {}

    void start(uint32_t face) {
      faces[0] = face;
      size = 1;
      at = 0;
      neighbour = 0;
    }

    Vector<uint32_t> faces;
    size_t size = 0, at = 0;
    uint32_t neighbour = 0;
  };

  /// Moves the faces with a mark to the front; each part stays ascending. Returns how many they
  /// are.
  size_t partition(uint32_t* faces, size_t count, uint32_t mark) {
    Vector<uint32_t>& others = queues_[1].faces;  // no longer in use
    size_t front = 0, back = 0;
    for (size_t i = 0; i < count; ++i)
      (mark_[faces[i]] == mark ? faces[front++] : others[back++]) = faces[i];
    std::copy_n(others.begin(), back, faces + front);
    return front;
  }

  /// Adds one face that is still free; false when there is none.
  bool grow(Queue& queue, uint32_t mark) {
    for (; queue.at < queue.size; ++queue.at, queue.neighbour = 0) {
      uint32_t f = queue.faces[queue.at];
      uint32_t first = graph_.begin[f], count = graph_.begin[f + 1] - first;
      while (queue.neighbour < count) {
        uint32_t g = graph_.neighbours[first + queue.neighbour++];
        if (mark_[g] == inside_) {
          mark_[g] = mark;
          queue.faces[queue.size++] = g;
          return true;
        }
      }
    }
    return false;
  }

  uint32_t farthest(uint32_t from, const uint32_t* faces, size_t count) {
    uint32_t seen = ++stamp_;
    Queue& queue = queues_[0];
    queue.start(from);
    mark_[from] = seen;
    while (grow(queue, seen)) {
    }
    for (size_t i = 0; i < count; ++i)
      mark_[faces[i]] = inside_;
    return queue.faces[queue.size - 1];
  }

  const FaceGraph& graph_;
  Vector<uint32_t> mark_;
  uint32_t stamp_ = 0, inside_ = 0;
  Queue queues_[2];
};

/// The tree over all faces, and the faces in the order of its leaves.
struct Tree {
  Vector<uint32_t> faces;
  Vector<uint32_t> leaf_begin;  ///< into faces
};

/// Lists the faces by component, ascending; returns where each component begins.
Vector<uint32_t> sort_by_component(const FaceGraph& graph, Vector<uint32_t>& faces) {
  Vector<uint32_t> begin(size_t{graph.component_count} + 1);
  for (uint32_t c : graph.face_component)
    ++begin[c + 1];
  for (size_t c = 1; c < begin.size(); ++c)
    begin[c] += begin[c - 1];
  Vector<uint32_t> at(begin.begin(), begin.end() - 1);
  faces.resize(graph.face_count());
  for (uint32_t f = 0; f < graph.face_count(); ++f)
    faces[at[graph.face_component[f]]++] = f;
  return begin;
}

Tree grow_tree(const FaceGraph& graph, uint32_t leaf_faces, PatchHierarchy& h) {
  struct Task {
    uint32_t first, last, depth;
    uint32_t left;  ///< kNoIndex until the first half is done
    uint32_t middle;
  };

  Tree tree;
  Vector<uint32_t> component_begin = sort_by_component(graph, tree.faces);
  Bisection bisection(graph);
  Vector<Task> stack;
  for (uint32_t c = 0; c < graph.component_count; ++c) {
    stack.push_back({component_begin[c], component_begin[c + 1], 0, kNoIndex, 0});
    while (!stack.empty()) {
      Task& task = stack.back();
      auto node = static_cast<uint32_t>(h.nodes.size());
      PatchHierarchy::Node made;
      if (task.last - task.first <= leaf_faces || task.depth >= kMostDepth) {
        made.first_leaf = static_cast<uint32_t>(h.leaf_node.size());
        made.last_leaf = made.first_leaf + 1;
        h.leaf_node.push_back(node);
        tree.leaf_begin.push_back(task.first);
      } else if (task.middle == 0) {
        task.middle = task.first + static_cast<uint32_t>(bisection.cut(&tree.faces[task.first],
                                                                       task.last - task.first));
        stack.push_back({task.first, task.middle, task.depth + 1, kNoIndex, 0});
        continue;
      } else if (task.left == kNoIndex) {
        task.left = node - 1;
        stack.push_back({task.middle, task.last, task.depth + 1, kNoIndex, 0});
        continue;
      } else {
        made.left = task.left;
        made.right = node - 1;
        made.first_leaf = h.nodes[made.left].first_leaf;
        made.last_leaf = h.nodes[made.right].last_leaf;
        h.nodes[made.left].parent = h.nodes[made.right].parent = node;
      }
      h.nodes.push_back(made);
      stack.pop_back();
    }
  }
  tree.leaf_begin.push_back(static_cast<uint32_t>(tree.faces.size()));
  return tree;
}

/// Slots and edges of the patches.
void lay_out_patches(const FaceGraph& graph, const Tree& tree, PatchHierarchy& h) {
  Vector<uint32_t> face_mark(graph.face_count(), kNoIndex);
  Vector<uint32_t> vertex_slot(graph.vertex_count, kNoIndex);
  Vector<uint32_t> edges;
  Vector<uint32_t>& patch = h.patch_faces;
  h.face_begin.push_back(0);
  h.slot_begin.push_back(0);
  h.edge_begin.push_back(0);
  for (uint32_t leaf = 0; leaf + 1 < tree.leaf_begin.size(); ++leaf) {
    const size_t first = patch.size();
    for (uint32_t i = tree.leaf_begin[leaf]; i < tree.leaf_begin[leaf + 1]; ++i) {
      patch.push_back(tree.faces[i]);
      face_mark[tree.faces[i]] = leaf;
    }
    const size_t own_end = patch.size();
    for (size_t i = first; i < own_end; ++i) {
      for (uint32_t k = graph.begin[patch[i]]; k < graph.hinge_end[patch[i]]; ++k) {
        uint32_t g = graph.neighbours[k];
        if (face_mark[g] != leaf) {
          face_mark[g] = leaf;
          patch.push_back(g);
        }
      }
    }
    h.own_end.push_back(static_cast<uint32_t>(own_end));
    h.face_begin.push_back(static_cast<uint32_t>(patch.size()));
    edges.clear();
    for (size_t i = first; i < patch.size(); ++i) {
      for (size_t k = size_t{3} * patch[i]; k < size_t{3} * patch[i] + 3; ++k) {
        uint32_t& slot = vertex_slot[graph.corners[k]];
        if (slot == kNoIndex) {
          slot = static_cast<uint32_t>(h.slot_vertex.size());
          h.slot_vertex.push_back(graph.corners[k]);
        }
        if (graph.face_edges[k] != kNoIndex)
          edges.push_back(graph.face_edges[k]);
      }
    }
    sort_ascending(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (uint32_t e : edges)
      h.patch_edges.push_back({e, vertex_slot[graph.edges[e].a], vertex_slot[graph.edges[e].b]});
    for (size_t s = h.slot_begin.back(); s < h.slot_vertex.size(); ++s)
      vertex_slot[h.slot_vertex[s]] = kNoIndex;
    h.slot_begin.push_back(static_cast<uint32_t>(h.slot_vertex.size()));
    h.edge_begin.push_back(static_cast<uint32_t>(h.patch_edges.size()));
  }
}

/// The lowest common ancestor of two leaves, p <= q.
uint32_t meeting_node(const PatchHierarchy& h, uint32_t p, uint32_t q) {
  uint32_t node = h.leaf_node[p];
  while (h.nodes[node].last_leaf <= q)
    node = h.nodes[node].parent;
  return node;
}

void link_patches(const FaceGraph& graph, const Vector<uint32_t>& face_leaf, PatchHierarchy& h) {
  struct Found {
    uint32_t node, p, q;

    bool operator<(const Found& other) const {
      return std::tie(node, p, q) < std::tie(other.node, other.p, other.q);
    }

    bool operator==(const Found& other) const { return p == other.p && q == other.q; }
  };

  Vector<Found> found;
  for (uint32_t f = 0; f < graph.face_count(); ++f) {
    for (uint32_t k = graph.begin[f]; k < graph.begin[f + 1]; ++k) {
      uint32_t p = face_leaf[f], q = face_leaf[graph.neighbours[k]];
      if (p < q)
        found.push_back({meeting_node(h, p, q), p, q});
    }
  }
  sort_ascending(found.begin(), found.end());
  size_t i = 0;
  for (uint32_t n = 0; n < h.nodes.size(); ++n) {
    h.nodes[n].first_link = static_cast<uint32_t>(h.links.size());
    while (i < found.size() && found[i].node == n) {
      size_t first = i;
      while (i < found.size() && found[i] == found[first])
        ++i;
      h.links.push_back({found[first].p, found[first].q, static_cast<uint32_t>(i - first)});
    }
    h.nodes[n].last_link = static_cast<uint32_t>(h.links.size());
  }
}

void list_levels(PatchHierarchy& h) {
  Vector<uint32_t> height(h.nodes.size());
  uint32_t heights = 0;
  for (size_t n = 0; n < h.nodes.size(); ++n) {
    const PatchHierarchy::Node& node = h.nodes[n];
    if (node.left != kNoIndex)
      height[n] = 1 + std::max(height[node.left], height[node.right]);
    heights = std::max(heights, height[n] + 1);
  }
  h.level_begin.assign(size_t{heights} + 1, 0);
  for (uint32_t x : height)
    ++h.level_begin[x + 1];
  for (size_t i = 1; i < h.level_begin.size(); ++i)
    h.level_begin[i] += h.level_begin[i - 1];
  Vector<uint32_t> at(h.level_begin.begin(), h.level_begin.end() - 1);
  h.level_nodes.resize(h.nodes.size());
  for (uint32_t n = 0; n < h.nodes.size(); ++n)
    h.level_nodes[at[height[n]]++] = n;
}

/// Finds the node of every vertex from the first and the last leaf that has a face of it.
void place_vertices(const FaceGraph& graph, const Vector<uint32_t>& face_leaf, PatchHierarchy& h) {
  Vector<uint32_t> lowest(graph.vertex_count, kNoIndex), highest(graph.vertex_count, 0);
  for (size_t i = 0; i < graph.corners.size(); ++i) {
    uint32_t v = graph.corners[i], leaf = face_leaf[i / 3];
    lowest[v] = std::min(lowest[v], leaf);
    highest[v] = std::max(highest[v], leaf);
  }
  h.vertex_node.assign(graph.vertex_count, kNoIndex);
  for (uint32_t v = 0; v < graph.vertex_count; ++v) {
    if (lowest[v] != kNoIndex)
      h.vertex_node[v] = meeting_node(h, lowest[v], highest[v]);
  }
}

}  // namespace

PatchHierarchy make_patch_hierarchy(const FaceGraph& graph, uint32_t leaf_faces) {
  PatchHierarchy h;
  Tree tree = grow_tree(graph, leaf_faces, h);
  lay_out_patches(graph, tree, h);
  Vector<uint32_t> face_leaf(graph.face_count());
  for (uint32_t leaf = 0; leaf < h.leaf_count(); ++leaf) {
    for (uint32_t i = tree.leaf_begin[leaf]; i < tree.leaf_begin[leaf + 1]; ++i)
      face_leaf[tree.faces[i]] = leaf;
  }
  link_patches(graph, face_leaf, h);
  list_levels(h);
  place_vertices(graph, face_leaf, h);
  return h;
}

}  // namespace anicodec
