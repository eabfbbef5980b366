// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_ACCESSOR_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_ACCESSOR_H_

#include "tools/io/gltf/gltf_document.h"

#include <cstdint>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Bytes of all elements of an accessor as floats or unsigned integers.
uint64_t bytes_as_floats(const GltfDocument& document, uint32_t accessor);

/// Elements of an accessor as floats, count x components: normalised integers scaled (as in
/// section 3.11 of the specification), sparse values in place. Throws Error(kInput) naming `path`,
/// that of the reference to the accessor, for values that are not finite and sparse indices out of
/// range, and for more zeros without a buffer view than the document has bytes (times 16).
std::vector<float> read_floats(const GltfDocument& document, uint32_t accessor,
                               const std::string& path);

/// The same for unsigned integers.
std::vector<uint32_t> read_unsigned(const GltfDocument& document, uint32_t accessor,
                                    const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_ACCESSOR_H_
