// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_SERIAL_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_SERIAL_H_

#include "tools/io/gltf/gltf_document.h"

#include <string>

namespace anicodec::tools {

/// A document as a GLB from which parse_gltf_document() makes the same, checking all of it: how a
/// document crosses from one process to another. Not of compressed or sparse data, nor of hidden
/// nodes. Throws Error(kInput) for more than the 4 GB of a GLB.
std::string glb_of(const GltfDocument& document);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_SERIAL_H_
