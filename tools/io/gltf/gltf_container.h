// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_CONTAINER_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_CONTAINER_H_

#include "tools/io/gltf/json_node.h"

#include <optional>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// The JSON of a .gltf or .glb, and the binary chunk of the latter, which points into its bytes.
struct GltfContainer {
  nlohmann::json document;
  std::optional<std::string_view> binary;
};

/// Takes a file apart. A .glb is told by its first four bytes; its length must be that of the file.
/// JSON nested deeper than 64 levels is refused. Throws Error(kInput).
GltfContainer open_gltf(std::string_view bytes, std::string_view name);

/// True for "data:".
bool is_data_uri(std::string_view uri);

/// Bytes of a base64 data URI. Throws at the node.
std::vector<char> decode_data_uri(std::string_view uri, const JsonNode& node);

/// A URI with its percent signs decoded, and a path as a URI.
std::string decoded_uri(std::string_view uri);
std::string encoded_uri(std::string_view path);

/// A relative URI as a path without detours: percent signs decoded. Throws at the node for URIs
/// with a scheme and absolute paths, and for those that climb out of the folder unless
/// `allow_outside`.
std::string path_of_uri(std::string_view uri, const JsonNode& node, bool allow_outside);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_CONTAINER_H_
