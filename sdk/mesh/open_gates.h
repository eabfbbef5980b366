// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_OPEN_GATES_H_
#define ANICODEC_SDK_MESH_OPEN_GATES_H_

#include "format/memory.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// The sides of faces that no other face has met yet, each as a gate: the directed edge that a face
/// beyond it has, so the reverse of the side. A gate is named by the corner at which the side
/// starts. Any number of gates may lead from one vertex to another.
class OpenGates {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// Memory: 24 bytes a corner, 8 a vertex.
  OpenGates(uint32_t vertices, uint32_t corners)
      : gates_(corners), out_(vertices, kNone), in_(vertices, kNone) {}

  /// The latest gate that starts, or ends, at a vertex, or kNone.
  uint32_t latest_from(uint32_t v) const { return out_[v]; }

  uint32_t latest_to(uint32_t v) const { return in_[v]; }

  uint32_t from(uint32_t gate) const { return gates_[gate].from; }

  uint32_t to(uint32_t gate) const { return gates_[gate].to; }

  /// The vertex after v along the gates: the end of the latest that starts there, or kNone.
  uint32_t after(uint32_t v) const { return out_[v] == kNone ? kNone : gates_[out_[v]].to; }

  /// The vertex before v: the start of the latest gate that ends there, or kNone.
  uint32_t before(uint32_t v) const { return in_[v] == kNone ? kNone : gates_[in_[v]].from; }

  /// The latest gate from a to b among the kLooks latest from a, or kNone: what bounds the time of a
  /// mesh all of whose gates start at one vertex.
  uint32_t find(uint32_t a, uint32_t b) const {
    uint32_t gate = out_[a];
    for (uint32_t looks = 0; looks < kLooks && gate != kNone;
         ++looks, gate = gates_[gate].out.next) {
      if (gates_[gate].to == b)
        return gate;
    }
    return kNone;
  }

  /// @pre a gate of this name was never opened
  void open(uint32_t gate, uint32_t from, uint32_t to) {
    gates_[gate] = {from, to, {kNone, out_[from]}, {kNone, in_[to]}};
    if (out_[from] != kNone)
      gates_[out_[from]].out.previous = gate;
    if (in_[to] != kNone)
      gates_[in_[to]].in.previous = gate;
    out_[from] = in_[to] = gate;
  }

  /// @pre the gate is open
  void close(uint32_t gate) {
    const Gate& g = gates_[gate];
    unlink(&Gate::out, g.out, &out_[g.from]);
    unlink(&Gate::in, g.in, &in_[g.to]);
  }

 private:
  static constexpr uint32_t kLooks = 64;

  struct Link {
    uint32_t previous, next;
  };

  struct Gate {
    uint32_t from, to;
    Link out, in;  ///< gates that start, and end, at the same vertex; the latest is first
  };

  void unlink(Link Gate::*list, const Link& link, uint32_t* head) {
    if (link.previous == kNone)
      *head = link.next;
    else
      (gates_[link.previous].*list).next = link.next;
    if (link.next != kNone)
      (gates_[link.next].*list).previous = link.previous;
  }

  Vector<Gate> gates_;
  Vector<uint32_t> out_, in_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_OPEN_GATES_H_
