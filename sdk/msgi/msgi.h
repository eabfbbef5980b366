// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MSGI_MSGI_H_
#define ANICODEC_SDK_MSGI_MSGI_H_

#include "format/memory.h"
#include "format/status.h"
#include "sdk/base/parallel_for.h"
#include "sdk/base/quaternion.h"
#include "sdk/base/vector3.h"
#include "sdk/msgi/patch_hierarchy.h"
#include "sdk/msgi/sparse_ldlt.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Multi-scale geometry interpolation between meshes of one connectivity (thesis section 4.2): any
/// number of inputs, weights that sum to one and may lie outside [0, 1]. Small overlapping patches
/// are blended each in a frame of its own; the rotations between neighbouring patches are
/// interpolated and merged along a hierarchy, and the edges of all patches so turned are blended by
/// one constant linear system. Rotations are taken modulo a full turn between neighbours only, so
/// that the whole may turn by any angle. Every input is reproduced at its own weights.
///
/// Any triangles will do: holes, boundaries, duplicate and degenerate faces, edges of many faces.
/// Parts that share no vertex are interpolated apart, each with the shortest rotation and a
/// straight path of its centroid. Vertices without face move on straight lines. A patch whose
/// vertices lie on a line has an open rotation about it, its positions are right. Zero-length edges
/// count as a thousandth of the mean.
///
/// Immutable once initialised: threads share it, each with memory of its own to work in.
class Msgi {
 public:
  struct Options {
    uint32_t leaf_faces = 8;  ///< faces of a patch, without the ring around it; 1 to 255
    /// Rounds of refitting the patches' rotations to the positions: for extrapolation and pins.
    uint32_t sweeps = 0;
    /// Vertices whose positions evaluate() is given, each at most once.
    Vector<uint32_t> pins;
    /// kLimit when init() would need more, by required_bytes().
    size_t most_bytes = size_t{4} << 30;
  };

  /// Whether this build has it: without, init() ends in kFeature.
  static bool is_there();

  /// inputs[i] holds vertex_count x 3 coordinates; nothing given is kept. Errors: kArgument for no
  /// input, leaf_faces or pins out of range; kIndexRange for a corner that is no vertex; kNonFinite
  /// for a coordinate; kLimit. Cost: O(vertices log vertices) and the factorisation, and
  /// O(vertices) for each input.
  Status init(const uint32_t* triangles, size_t triangle_count, uint32_t vertex_count,
              const float* const* inputs, size_t input_count, const Options& options);

  uint32_t vertex_count() const { return vertex_count_; }

  size_t input_count() const { return input_count_; }

  /// The largest angle in radians between neighbouring patches in any input, against the first.
  /// Above a right angle smaller patches may do better.
  double largest_turn() const { return largest_turn_; }

  size_t resident_bytes() const;

  /// The least Options::most_bytes for which init() does not end in kLimit: resident_bytes(), or
  /// what factoring the system takes for a moment where that is more, as in small meshes.
  size_t required_bytes() const;

  /// Bytes of the memory that evaluate() works in.
  size_t scratch_bytes() const;

  /// The mesh at weights[0 .. inputs-1]: vertex_count x 3 floats. pin_positions: three coordinates
  /// for each pin, null when there are none. scratch: scratch_bytes() bytes at a multiple of 8.
  /// Errors: kArgument when the weights are not finite or do not sum to one within 1e-5, or pins
  /// are missing. Allocates nothing. Linear in vertices x inputs (of a weight other than 0) +
  /// factor. The result does not depend on the threads.
  Status evaluate(const double* weights, const float* pin_positions, void* scratch, float* out,
                  const HostThreads& threads = {}) const;

 private:
  /// A component in one input: how it lies against the same component of the first.
  struct Placement {
    Vector3 turn;  ///< logarithm of the rotation
    Vector3 centroid;
  };

  /// Edge from an unknown to a pin.
  struct PinEdge {
    uint32_t unknown, pin;
    double weight;
  };

  struct Build;
  struct Scratch;

  size_t leaf_count() const { return slot_begin_.empty() ? 0 : slot_begin_.size() - 1; }

  size_t blend_bytes(size_t slots, size_t links) const;
  Scratch lay_out(void* memory) const;
  void align_inputs(const FaceGraph& graph, const float* const* inputs);
  void set_up_patches(const Build& build);
  Status set_up_systems(const Build& build, const Options& options);

  void blend(const double* weights, Scratch& scratch, const HostThreads& threads) const;
  void merge(Scratch& scratch, const HostThreads& threads) const;
  void turn_forces(const SparseLdlt& system, Scratch& scratch, const HostThreads& threads) const;
  void solve(Scratch& scratch, const HostThreads& threads) const;
  void refit(Scratch& scratch, const HostThreads& threads) const;
  void place(const double* weights, Scratch& scratch, const HostThreads& threads) const;
  void solve_pinned(const float* pin_positions, Scratch& scratch, const HostThreads& threads) const;

  size_t input_count_ = 0;
  uint32_t sweeps_ = 0;
  double largest_turn_ = 0;

  uint32_t vertex_count_ = 0;
  Vector<uint32_t> part_;        ///< component of each vertex, kNoIndex without face
  Vector<uint32_t> part_size_;   ///< vertices of each component
  Vector<Placement> placement_;  ///< inputs x components
  Vector<float> aligned_;        ///< inputs x vertices x 3: turned onto the first, centroid at 0

  Vector<PatchHierarchy::Node> nodes_;
  Vector<PatchHierarchy::Link> links_;
  Vector<uint32_t> level_begin_, level_nodes_;
  Vector<double> turns_;  ///< inputs x links x 3: logarithms of the relative rotations
  Vector<uint32_t> slot_begin_, slot_vertex_, slot_leaf_;
  Vector<uint32_t> vertex_slot_begin_, vertex_slots_;
  /// inputs x slots x 3: gradient of the patch's edge energy, in the patch's frame.
  Vector<float> forces_;
  Vector<float> slot_share_;  ///< of the weights of the patch's edges; they sum to one

  SparseLdlt system_;
  Vector<uint32_t> pins_;
  Vector<PinEdge> pin_edges_;
  SparseLdlt pinned_system_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MSGI_MSGI_H_
