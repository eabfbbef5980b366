// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLB_BUFFER_H_
#define ANICODEC_TOOLS_IO_GLTF_GLB_BUFFER_H_

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// A GLB of a document's text and its binary data. Throws Error(kInput) beyond 4 GiB.
std::string pack_glb(std::string json, std::string_view binary);

/// The use of a buffer view (glTF 2.0, bufferView.target).
enum class GlbTarget : int { kNone = 0, kVertices = 34962, kIndices = 34963 };

/// The binary data of a GLB with the views and accessors that describe them. Each add_ returns the
/// number of its accessor and throws Error(kInput) beyond the 4 GiB that are possible.
class GlbBuffer {
 public:
  using Json = nlohmann::ordered_json;

  /// In the smallest type that has no value to spare as a restart.
  size_t add_indices(std::span<const uint32_t> indices, uint32_t vertices);

  /// `bounds`: with smallest and largest values.
  size_t add_floats(std::span<const float> values, size_t components, GlbTarget target,
                    bool bounds);

  /// An accessor of vertices, with bounds; elements of zeros are left out if that is smaller.
  size_t add_differences(std::span<const float> values, size_t components);

  /// `count` numbers: zeros but for these, in ascending order.
  size_t add_sparse(uint64_t count, std::span<const uint32_t> elements,
                    std::span<const float> values);

  /// Bytes that are no accessor's; returns the number of their view.
  size_t add_bytes(std::string_view bytes) { return add_view(bytes, GlbTarget::kNone); }

  const std::string& bytes() const { return bytes_; }

  void describe_in(Json& document) const;

 private:
  void check_size(uint64_t more) const;
  size_t add_view(std::string_view bytes, GlbTarget target);
  size_t add_accessor(Json accessor);
  size_t add_sparse(Json accessor, std::span<const uint32_t> elements,
                    std::span<const float> values);

  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
  std::map<std::pair<size_t, size_t>, size_t> zeros_;  ///< accessor, by values and components
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLB_BUFFER_H_
