// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/msgi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace anicodec {
namespace {

constexpr size_t kPatchGrain = 256;
constexpr size_t kVertexGrain = 4096;

/// Takes arrays from a block of memory one after the other; counts only when there is none.
class Block {
 public:
  explicit Block(void* memory) : memory_(static_cast<unsigned char*>(memory)) {}

  template <class T>
  T* take(size_t count) {
    static_assert(alignof(T) <= 8 && std::is_trivially_destructible<T>::value, "plain data");
    unsigned char* at = memory_ ? memory_ + taken_ : nullptr;
    taken_ += (count * sizeof(T) + 7) / 8 * 8;
    return reinterpret_cast<T*>(at);
  }

  size_t taken() const { return taken_; }

 private:
  unsigned char* memory_;
  size_t taken_ = 0;
};

}  // namespace

bool Msgi::is_there() {
  return true;
}

/// Scratch memory for one frame.
struct Msgi::Scratch {
  UnitQuaternion* rotations;  ///< per patch
  UnitQuaternion* relative;   ///< per link
  Matrix3* matrices;          ///< per patch
  double* forces;             ///< slots x 3
  double* solution;           ///< of either system
  double* positions;          ///< vertices x 3
  Matrix3* products;          ///< per component
  Vector3* means;             ///< per component
  float* target;              ///< vertices x 3: the inputs blended on straight lines
  size_t bytes;
};

Msgi::Scratch Msgi::lay_out(void* memory) const {
  const size_t leaves = leaf_count(), coordinates = 3 * size_t{vertex_count_};
  Block block(memory);
  Scratch scratch;
  scratch.rotations = block.take<UnitQuaternion>(leaves);
  scratch.relative = block.take<UnitQuaternion>(links_.size());
  scratch.matrices = block.take<Matrix3>(leaves);
  scratch.forces = block.take<double>(3 * slot_vertex_.size());
  scratch.solution =
      block.take<double>(std::max(system_.scratch_size(), pinned_system_.scratch_size()));
  scratch.positions = block.take<double>(coordinates);
  scratch.products = block.take<Matrix3>(part_size_.size());
  scratch.means = block.take<Vector3>(part_size_.size());
  scratch.target = block.take<float>(coordinates);
  scratch.bytes = block.taken();
  return scratch;
}

size_t Msgi::scratch_bytes() const {
  return lay_out(nullptr).bytes;
}

// ---------------------------------------------------------------------------------------------
// One frame

/// Forces of all patches and rotations of all links, as linear combinations of those of the inputs.
void Msgi::blend(const double* weights, Scratch& scratch, const HostThreads& threads) const {
  const size_t slots = slot_vertex_.size(), links = links_.size();
  for_ranges(threads, leaf_count(), kPatchGrain, [&](size_t first, size_t last) {
    double* forces = scratch.forces;
    const size_t begin = 3 * size_t{slot_begin_[first]}, end = 3 * size_t{slot_begin_[last]};
    std::fill(forces + begin, forces + end, 0.0);
    for (size_t i = 0; i < input_count_; ++i) {
      const double t = weights[i];
      if (t == 0)
        continue;
      const float* from = forces_.data() + 3 * slots * i;
      for (size_t k = begin; k < end; ++k)
        forces[k] += t * double{from[k]};
    }
    // Rounded to floats, a patch's forces are not quite in balance; summed over a long mesh that
    // would show.
    for (size_t leaf = first; leaf < last; ++leaf) {
      Vector3 sum;
      for (size_t s = slot_begin_[leaf]; s < slot_begin_[leaf + 1]; ++s)
        sum += vector_at(forces + 3 * s);
      for (size_t s = slot_begin_[leaf]; s < slot_begin_[leaf + 1]; ++s) {
        for (size_t axis = 0; axis < 3; ++axis)
          forces[3 * s + axis] -= double{slot_share_[s]} * sum[axis];
      }
    }
  });
  for_ranges(threads, links, kPatchGrain, [&](size_t first, size_t last) {
    for (size_t j = first; j < last; ++j) {
      Vector3 turn;
      for (size_t i = 0; i < input_count_; ++i) {
        if (weights[i] != 0)
          turn += weights[i] * vector_at(turns_.data() + 3 * (links * i + j));
      }
      scratch.relative[j] = exp_rotation(turn);
    }
  });
}

/// Rotations of all patches of a component against one another: at every node those of the right
/// half are turned so that the links to the left half agree best.
void Msgi::merge(Scratch& scratch, const HostThreads& threads) const {
  std::fill_n(scratch.rotations, leaf_count(), UnitQuaternion{});
  for (size_t level = 1; level + 1 < level_begin_.size(); ++level) {
    const uint32_t* nodes = level_nodes_.data() + level_begin_[level];
    for_ranges(threads, level_begin_[level + 1] - level_begin_[level], 64,
               [&](size_t first, size_t last) {
                 for (size_t k = first; k < last; ++k) {
                   const PatchHierarchy::Node& node = nodes_[nodes[k]];
                   RotationVotes votes;
                   for (size_t j = node.first_link; j < node.last_link; ++j) {
                     const PatchHierarchy::Link& link = links_[j];
                     votes.add(scratch.rotations[link.p] * scratch.relative[j] *
                                   scratch.rotations[link.q].conjugate(),
                               link.weight);
                   }
                   UnitQuaternion turn = votes.leading();
                   const PatchHierarchy::Node& right = nodes_[node.right];
                   for (size_t leaf = right.first_leaf; leaf < right.last_leaf; ++leaf)
                     scratch.rotations[leaf] = turn * scratch.rotations[leaf];
                 }
               });
  }
}

/// The right-hand side: for every unknown the forces of its slots, turned with their patches.
void Msgi::turn_forces(const SparseLdlt& system, Scratch& scratch,
                       const HostThreads& threads) const {
  for_ranges(threads, leaf_count(), kPatchGrain, [&](size_t first, size_t last) {
    for (size_t leaf = first; leaf < last; ++leaf)
      scratch.matrices[leaf] = to_matrix(scratch.rotations[leaf]);
  });
  for_ranges(threads, system.size(), kVertexGrain, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      const uint32_t v = system.vertices()[i];
      Vector3 sum;
      for (uint32_t k = vertex_slot_begin_[v]; k < vertex_slot_begin_[v + 1]; ++k) {
        const uint32_t slot = vertex_slots_[k];
        sum += scratch.matrices[slot_leaf_[slot]] * vector_at(&scratch.forces[3 * size_t{slot}]);
      }
      double* out = &scratch.solution[SparseLdlt::kLanes * i];
      for (size_t axis = 0; axis < 3; ++axis)
        out[axis] = sum[axis];
      out[3] = 0;
    }
  });
}

void Msgi::solve(Scratch& scratch, const HostThreads& threads) const {
  turn_forces(system_, scratch, threads);
  system_.solve(scratch.solution, threads);
  for (size_t i = 0; i < system_.size(); ++i) {
    const double* x = &scratch.solution[SparseLdlt::kLanes * i];
    std::copy(x, x + 3, &scratch.positions[3 * size_t{system_.vertices()[i]}]);
  }
}

/// Turns every patch onto the positions.
void Msgi::refit(Scratch& scratch, const HostThreads& threads) const {
  for_ranges(threads, leaf_count(), kPatchGrain, [&](size_t first, size_t last) {
    for (size_t leaf = first; leaf < last; ++leaf) {
      const size_t begin = slot_begin_[leaf], end = slot_begin_[leaf + 1];
      const Vector3 origin = vector_at(&scratch.positions[3 * size_t{slot_vertex_[begin]}]);
      // The sum of w (q_a - q_b)(x_a - x_b)^T over the edges of the patch, by vertices.
      Matrix3 products;
      for (size_t s = begin; s < end; ++s) {
        Vector3 x = vector_at(&scratch.positions[3 * size_t{slot_vertex_[s]}]);
        products.add_product(vector_at(&scratch.forces[3 * s]), x - origin);
      }
      scratch.rotations[leaf] = votes_for(products).leading();
    }
  });
}

/// Turns and moves every component to where the weights put it; vertices without face too.
void Msgi::place(const double* weights, Scratch& scratch, const HostThreads& threads) const {
  const size_t coordinates = 3 * size_t{vertex_count_}, parts = part_size_.size();
  float* target = scratch.target;
  for_ranges(threads, coordinates, kVertexGrain, [&](size_t first, size_t last) {
    std::fill(&target[first], &target[first] + (last - first), 0.0F);
    for (size_t i = 0; i < input_count_; ++i) {
      const auto t = static_cast<float>(weights[i]);
      const float* from = aligned_.data() + coordinates * i;
      if (t != 0) {
        for (size_t k = first; k < last; ++k)
          target[k] += t * from[k];
      }
    }
  });
  std::fill_n(scratch.products, parts, Matrix3{});
  std::fill_n(scratch.means, parts, Vector3{});
  for (size_t v = 0; v < vertex_count_; ++v) {
    if (part_[v] == kNoIndex)
      continue;
    Vector3 x = vector_at(&scratch.positions[3 * v]);
    scratch.means[part_[v]] += x;
    scratch.products[part_[v]].add_product(x, vector_at(&target[3 * v]));
  }
  // The targets' centroids are zero but for rounding: that of x need not be taken off first.
  for (size_t c = 0; c < parts; ++c) {
    Vector3 turn, centroid;
    for (size_t i = 0; i < input_count_; ++i) {
      turn += weights[i] * placement_[parts * i + c].turn;
      centroid += weights[i] * placement_[parts * i + c].centroid;
    }
    Matrix3& matrix = scratch.products[c];
    matrix = to_matrix(exp_rotation(turn) * votes_for(matrix).leading());
    scratch.means[c] =
        centroid - matrix * ((1 / static_cast<double>(part_size_[c])) * scratch.means[c]);
  }
  for_ranges(threads, vertex_count_, kVertexGrain, [&](size_t first, size_t last) {
    for (size_t v = first; v < last; ++v) {
      double* x = &scratch.positions[3 * v];
      Vector3 placed = part_[v] == kNoIndex
                           ? vector_at(&target[3 * v])
                           : scratch.products[part_[v]] * vector_at(x) + scratch.means[part_[v]];
      std::copy(placed.x, placed.x + 3, x);
    }
  });
}

/// Solves again for the components with pins, from where they lie without.
void Msgi::solve_pinned(const float* pin_positions, Scratch& scratch,
                        const HostThreads& threads) const {
  for (size_t p = 0; p < pins_.size(); ++p)
    std::copy(pin_positions + 3 * p, pin_positions + 3 * p + 3,
              &scratch.positions[3 * size_t{pins_[p]}]);
  turn_forces(pinned_system_, scratch, threads);
  for (const PinEdge& e : pin_edges_) {
    for (size_t axis = 0; axis < 3; ++axis)
      scratch.solution[SparseLdlt::kLanes * e.unknown + axis] +=
          e.weight * double{pin_positions[3 * size_t{e.pin} + axis]};
  }
  pinned_system_.solve(scratch.solution, threads);
  for (size_t i = 0; i < pinned_system_.size(); ++i) {
    const double* x = &scratch.solution[SparseLdlt::kLanes * i];
    std::copy(x, x + 3, &scratch.positions[3 * size_t{pinned_system_.vertices()[i]}]);
  }
}

Status Msgi::evaluate(const double* weights, const float* pin_positions, void* memory, float* out,
                      const HostThreads& threads) const {
  double sum = 0;
  for (size_t i = 0; i < input_count_; ++i)
    sum += weights[i];
  if (!(std::fabs(sum - 1) <= 1e-5) || (!pins_.empty() && !pin_positions))
    return Status::kArgument;
  for (size_t p = 0; p < 3 * pins_.size(); ++p) {
    if (!std::isfinite(pin_positions[p]))
      return Status::kArgument;
  }
  Scratch scratch = lay_out(memory);
  const size_t coordinates = 3 * size_t{vertex_count_};
  std::fill_n(scratch.positions, coordinates, 0.0);
  blend(weights, scratch, threads);
  merge(scratch, threads);
  solve(scratch, threads);
  for (uint32_t k = 0; k < sweeps_; ++k) {
    refit(scratch, threads);
    solve(scratch, threads);
  }
  place(weights, scratch, threads);
  if (!pins_.empty()) {
    for (uint32_t k = 0; k < 1 + sweeps_; ++k) {
      refit(scratch, threads);
      solve_pinned(pin_positions, scratch, threads);
    }
  }
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (size_t k = 0; k < coordinates; ++k)
    out[k] = static_cast<float>(std::clamp(scratch.positions[k], -kLargest, kLargest));
  return Status::kOk;
}

size_t Msgi::resident_bytes() const {
  return blend_bytes(slot_vertex_.size(), links_.size()) +
         sizeof(uint32_t) * (part_.size() + part_size_.size() + level_begin_.size() +
                             level_nodes_.size() + slot_begin_.size() + 3 * slot_vertex_.size() +
                             vertex_slot_begin_.size() + pins_.size()) +
         sizeof(PatchHierarchy::Node) * nodes_.size() +
         sizeof(PatchHierarchy::Link) * links_.size() + sizeof(Placement) * placement_.size() +
         sizeof(PinEdge) * pin_edges_.size() + system_.resident_bytes() +
         pinned_system_.resident_bytes();
}

size_t Msgi::required_bytes() const {
  return std::max({resident_bytes(), system_.setup_bytes(), pinned_system_.setup_bytes()});
}

/// Sizes of the arrays that grow with the number of inputs.
size_t Msgi::blend_bytes(size_t slots, size_t links) const {
  return sizeof(float) * slots +
         input_count_ * (sizeof(float) * 3 * (slots + vertex_count_) + sizeof(double) * 3 * links);
}

}  // namespace anicodec
