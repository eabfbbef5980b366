// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The two compressed forms of glTF geometry.
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_COMPRESSION_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_COMPRESSION_H_

#include "tools/io/gltf/json_node.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// A buffer view of KHR_meshopt_compression or EXT_meshopt_compression.
struct MeshoptView {
  std::string_view bytes;  ///< compressed
  uint32_t count = 0, stride = 0;
  std::string mode, filter;
};

/// count x stride bytes. Throws at the node: Error(kInput) for damaged data, Error(kUnsupported) in
/// a build without meshoptimizer.
std::vector<char> decode_meshopt(const MeshoptView& view, const JsonNode& node);

/// The content of a Draco bitstream, as floats.
struct DracoPrimitive {
  struct Values {
    uint32_t components = 0;
    std::vector<float> values;    ///< points x components
    float normalizing_scale = 1;  ///< makes numbers from 0 or -1 to 1 of integers
  };

  uint32_t points = 0;
  std::vector<uint32_t> indices;
  std::map<std::string, Values> attributes;
};

/// A Draco bitstream, and what the document says of it.
struct DracoSource {
  std::string_view bytes;
  const std::map<std::string, uint32_t>& attributes;  ///< those asked for, name -> unique id
  uint32_t points = 0, indices = 0;
};

/// Nothing when the bitstream is damaged or lacks an attribute, or has other than the given counts.
std::optional<DracoPrimitive> decode_draco(const DracoSource& source);

/// The same in a process that may take as much memory and time as such a bitstream can need. Throws
/// Error(kInput) "name: reason" when that is not enough, and for more points than it can hold.
std::optional<DracoPrimitive> decode_draco_guarded(const DracoSource& source,
                                                   const std::string& name, uint64_t memory_limit);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_COMPRESSION_H_
