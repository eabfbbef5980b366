// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Which side of a face is its front: a node whose global transform has a negative determinant turns the
// faces of its mesh (glTF 2.0, section 3.7.4).
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_FACING_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_FACING_H_

#include "tools/io/gltf/gltf_document.h"

#include <array>

namespace anicodec::tools {

/// True when the scale mirrors: an odd number of its factors is negative, and none is 0.
bool mirrors(const std::array<double, 3>& scale);

/// The same of a column-major matrix: its determinant is negative.
bool mirrors(const std::array<double, 16>& matrix);

/// Sets GltfNode::facing of all nodes, from the pose at rest and the keys of all animations. Linear keys
/// are followed between each other; of a cubic spline the control points are taken, which its values do
/// not leave. Throws Error(kInput) for keys that cannot be read.
void find_facings(GltfDocument* document);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_FACING_H_
