// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A glTF 2.0 document whose every index, range and hierarchy has been checked. References are to
// the Khronos glTF 2.0 specification.
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_DOCUMENT_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_DOCUMENT_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/base/left_kinds.h"
#include "tools/io/gltf/gltf_material.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

inline constexpr uint32_t kGltfNone = UINT32_MAX;  ///< an index that is not given

// Extensions by which views and primitives are compressed.
inline constexpr const char* kMeshoptExtensions[] = {"KHR_meshopt_compression",
                                                     "EXT_meshopt_compression"};
inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

inline constexpr const char* kInstancingExtension = "EXT_mesh_gpu_instancing";

enum class GltfComponent : uint32_t {
  kInt8 = 5120,
  kUint8 = 5121,
  kInt16 = 5122,
  kUint16 = 5123,
  kUint32 = 5125,
  kFloat = 5126,
  kHalf = 5131  ///< KHR_accessor_float16
};

/// Bytes of a component.
uint32_t size_of(GltfComponent component);

/// Bytes of a buffer; those of a view that was compressed (kMeshoptExtensions) are its own.
struct GltfView {
  std::string_view bytes;
  uint32_t stride = 0;             ///< 0: packed
  std::vector<char> decompressed;  ///< what `bytes` points to, if compressed
};

/// Values that replace some of an accessor's.
struct GltfSparse {
  uint32_t count = 0;
  uint32_t index_view = 0, value_view = 0;
  uint64_t index_offset = 0, value_offset = 0;
  GltfComponent index_type = GltfComponent::kUint32;
};

/// Its range lies within its view, that of its sparse parts in theirs.
struct GltfAccessor {
  uint32_t view = kGltfNone;  ///< none: zeros
  uint64_t offset = 0;
  uint32_t count = 0;       ///< elements
  uint32_t components = 1;  ///< of an element; 16 for a matrix
  bool matrix = false;
  GltfComponent type = GltfComponent::kFloat;
  bool normalized = false;
  std::optional<GltfSparse> sparse;
};

/// KHR_draco_mesh_compression.
struct GltfDraco {
  uint32_t view = 0;
  std::map<std::string, uint32_t> attributes;  ///< name -> unique id in the bitstream
};

struct GltfPrimitive {
  std::map<std::string, uint32_t> attributes;  ///< name -> accessor
  uint32_t indices = kGltfNone;
  uint32_t material = kGltfNone;
  uint32_t mode = 4;
  std::vector<std::map<std::string, uint32_t>> targets;
  std::optional<GltfDraco> draco;
};

struct GltfMesh {
  std::string name;
  std::vector<GltfPrimitive> primitives;  ///< all with the same number of targets
  std::vector<double> weights;            ///< of the targets
};

/// How the front of a mesh's faces changes, in the pose at rest and in all animations.
enum class GltfFacing {
  kKept,
  kTurned,   ///< the global transform of the node mirrors
  kChanging  ///< it does so at some times
};

/// EXT_mesh_gpu_instancing: the mesh of a node is shown once for each, instead of by itself.
struct GltfInstances {
  uint32_t count = 0;
  uint32_t translations = kGltfNone, rotations = kGltfNone, scales = kGltfNone;  ///< accessors
};

struct GltfNode {
  std::string name;
  uint32_t parent = kGltfNone;
  std::vector<uint32_t> children;
  uint32_t mesh = kGltfNone, skin = kGltfNone;
  std::array<double, 3> translation{0, 0, 0}, scale{1, 1, 1};
  std::array<double, 4> rotation{0, 0, 0, 1};    ///< x y z w
  std::optional<std::array<double, 16>> matrix;  ///< column-major, instead of the three
  std::vector<double> weights;                   ///< empty: those of the mesh
  bool visible = true;                           ///< KHR_node_visibility: with all below it
  std::optional<GltfInstances> instances;
  GltfFacing facing = GltfFacing::kKept;
};

struct GltfSkin {
  std::vector<uint32_t> joints;
  uint32_t inverse_binds = kGltfNone;
};

enum class GltfInterpolation { kStep, kLinear, kCubicSpline };

struct GltfSampler {
  uint32_t input = 0, output = 0;
  GltfInterpolation interpolation = GltfInterpolation::kLinear;
};

enum class GltfPath { kTranslation, kRotation, kScale, kWeights, kVisibility };

struct GltfChannel {
  uint32_t sampler = 0, node = 0;
  GltfPath path = GltfPath::kTranslation;
  uint32_t element = kGltfNone;  ///< of weights, that of one target; none: all
};

struct GltfAnimation {
  std::string name;
  std::vector<GltfSampler> samplers;
  std::vector<GltfChannel> channels;
  std::vector<NamedTime> events;  ///< of extras
  std::string rate;               ///< "24/1" of a clip that anicodec wrote, else empty
};

/// Nodes form trees. Views point into the buffers, so that a document can be moved only.
struct GltfDocument {
  GltfDocument() = default;
  GltfDocument(GltfDocument&&) = default;
  GltfDocument& operator=(GltfDocument&&) = default;

  std::string name;    ///< of the file, for messages
  uint64_t bytes = 0;  ///< of the file and its buffers, decompressed
  std::vector<std::vector<char>> buffers;
  std::vector<GltfView> views;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfMesh> meshes;
  std::vector<GltfNode> nodes;
  std::vector<uint32_t> roots;  ///< of the scene to be shown
  std::vector<GltfSkin> skins;
  std::vector<GltfAnimation> animations;
  std::vector<GltfMaterial> materials;
  std::vector<GltfImage> images;  ///< empty where they are files of their own
  LeftKinds left_out;             ///< what a scene has and a clip does not keep
};

/// Gives the bytes of a file that a document names by a relative URI. Throws Error(kInput).
using GltfResolver = std::function<std::string(const std::string& path)>;

/// Reads a .gltf or .glb, told apart by their first bytes. `memory_limit` bounds what decompressed
/// buffer views may take; buffers outside the folder of the file are refused unless
/// `allow_outside`. Throws Error(kInput) "name: /json/pointer: reason", Error(kUnsupported)
/// for extensions that are required and not known.
GltfDocument parse_gltf_document(std::string_view bytes, std::string_view name,
                                 const GltfResolver& resolve, uint64_t memory_limit,
                                 bool allow_outside = false);

/// Throws Error(kInput) "name: path: reason".
[[noreturn]] void fail_gltf(const GltfDocument& document, const std::string& path,
                            const std::string& reason);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_DOCUMENT_H_
