// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "tools/io/gltf/gltf_compression.h"

#ifdef ANICODEC_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace anicodec::tools {

#ifdef ANICODEC_MESHOPTIMIZER

namespace {

/// Refuses counts that the compressed bytes cannot hold, before there is memory for them. A block
/// of 256 vertices takes at least two bits for each byte of a vertex; an index or triangle one
/// byte.
void check_count(const MeshoptView& view, const JsonNode& node) {
  constexpr uint64_t kMostForAByte = 1024;
  const uint64_t bytes = view.bytes.size();
  const bool attributes = view.mode == "ATTRIBUTES";
  const uint64_t least = attributes ? uint64_t{view.count} * view.stride / kMostForAByte
                         : view.mode == "TRIANGLES" ? view.count / 3
                                                    : view.count;
  if (least > bytes)
    node.fail(std::to_string(view.count) + " elements of " + std::to_string(view.stride) +
              " bytes cannot come from " + std::to_string(bytes) + " compressed bytes");
}

}  // namespace

std::vector<char> decode_meshopt(const MeshoptView& view, const JsonNode& node) {
  check_count(view, node);
  std::vector<char> out(size_t{view.count} * view.stride);
  const auto* source = reinterpret_cast<const unsigned char*>(view.bytes.data());
  const bool attributes = view.mode == "ATTRIBUTES";
  int result = -1;
  if (attributes) {
    if (view.stride == 0 || view.stride > 256 || view.stride % 4 != 0)
      node.fail("a stride of " + std::to_string(view.stride) + " is impossible for ATTRIBUTES");
    result =
        meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, source, view.bytes.size());
  } else if (view.mode == "TRIANGLES" || view.mode == "INDICES") {
    const bool triangles = view.mode == "TRIANGLES";
    if (view.stride != 2 && view.stride != 4)
      node.fail("a stride of " + std::to_string(view.stride) + " is impossible for indices");
    if (triangles && view.count % 3 != 0)
      node.fail(std::to_string(view.count) + " indices do not make triangles");
    result = triangles ? meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, source,
                                                   view.bytes.size())
                       : meshopt_decodeIndexSequence(out.data(), view.count, view.stride, source,
                                                     view.bytes.size());
  } else {
    node.fail("'" + view.mode + "' is not a known mode");
  }
  if (result != 0)
    node.fail("the compressed data are damaged");

  if (view.filter.empty() || view.filter == "NONE")
    return out;
  auto require = [&](bool possible) {
    if (!attributes || !possible)
      node.fail("filter " + view.filter + " is impossible for this mode and stride");
  };
  if (view.filter == "OCTAHEDRAL") {
    require(view.stride == 4 || view.stride == 8);
    meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  } else if (view.filter == "QUATERNION") {
    require(view.stride == 8);
    meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  } else if (view.filter == "EXPONENTIAL") {
    require(view.stride % 4 == 0);
    meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  } else if (view.filter == "COLOR") {
    require(view.stride == 4 || view.stride == 8);
    meshopt_decodeFilterColor(out.data(), view.count, view.stride);
  } else {
    node.fail("'" + view.filter + "' is not a known filter");
  }
  return out;
}

#else

std::vector<char> decode_meshopt(const MeshoptView&, const JsonNode& node) {
  try {
    node.fail("meshopt compression is not read by this build, which is without meshoptimizer");
  } catch (const Error& e) {
    throw Error(ErrorKind::kUnsupported, e.what());
  }
}

#endif

}  // namespace anicodec::tools
