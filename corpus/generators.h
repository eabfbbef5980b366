// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// One function per clip of the registry in clips.cpp.
#ifndef ANICODEC_CORPUS_GENERATORS_H_
#define ANICODEC_CORPUS_GENERATORS_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>

namespace anicodec::corpus {

/// The size of a scalable clip: about as many vertices, exactly as many frames.
struct ClipSize {
  uint32_t vertices;
  uint32_t frames;
};

// deforming.cpp: smooth motion of one surface
MeshSequence limb(ClipSize size);
MeshSequence cloth(ClipSize size);
MeshSequence face(ClipSize size);
MeshSequence helix(ClipSize size);
MeshSequence noisy(ClipSize size);
MeshSequence limb_soup(ClipSize size);
MeshSequence sliding(ClipSize size);

// rigid.cpp: rigid bodies, and where coordinates are large or small
MeshSequence rigid(ClipSize size);
MeshSequence far_tumble(ClipSize size);
MeshSequence large(ClipSize size);
MeshSequence tiny(ClipSize size);

// timing.cpp: frames that do not simply follow each other
MeshSequence cuts(ClipSize size);
MeshSequence repeats(ClipSize size);
MeshSequence motionless(ClipSize size);
MeshSequence one_frame(ClipSize size);
MeshSequence uneven(ClipSize size);

// connectivity.cpp: faces that coders trip over
MeshSequence one_triangle(ClipSize size);
MeshSequence one_vertex(ClipSize size);
MeshSequence points(ClipSize size);
MeshSequence nonmanifold(ClipSize size);
MeshSequence moebius(ClipSize size);
MeshSequence open_pair(ClipSize size);
MeshSequence polygons(ClipSize size);
MeshSequence box_of_quads(ClipSize size);
MeshSequence painted_box(ClipSize size);
MeshSequence leftovers(ClipSize size);

MeshSequence heated(ClipSize size);

}  // namespace anicodec::corpus

#endif  // ANICODEC_CORPUS_GENERATORS_H_
