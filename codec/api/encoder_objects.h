// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The object behind the handle of encode.h, and helpers of its functions. Internal to codec/api.
#ifndef ANICODEC_CODEC_API_ENCODER_OBJECTS_H_
#define ANICODEC_CODEC_API_ENCODER_OBJECTS_H_

#include "codec/encode.h"
#include "codec/sequence/scene.h"

#include <anicodec/encode.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace anicodec {

/// A mesh without its positions, and where the host has them.
struct SourceMesh {
  SceneMesh mesh;
  anic_source_mesh host{};  ///< with strides; pointers to positions and callback alone are used
};

/// The host's options as the encoder takes them. Throws EncoderFailure(ANIC_E_ARGUMENT).
EncodeOptions options_of(const anic_encode_options& host);

/// Copies a mesh but for its positions. `clip_frames`: 0 for a live one. Throws EncoderFailure.
SourceMesh take_mesh(const anic_source_mesh& host, uint32_t clip_frames);

/// Adds an attribute to a mesh. Throws EncoderFailure(ANIC_E_ARGUMENT).
void take_attribute(const anic_source_attribute& host, MeshSequence* mesh);

/// Copies a frame, x, y, z of each vertex, from an origin.
void copy_positions(const void* positions, ptrdiff_t stride, anic_scalar scalar,
                    const Point& origin, std::span<float> to);

/// Reads all positions of a mesh from the host, from the origin of the mesh. `before_frame` is called with the number of each.
/// Throws EncoderFailure: ANIC_E_READ, ANIC_E_NON_FINITE.
void read_positions(const SourceMesh& source, const std::function<void(uint32_t)>& before_frame,
                    MeshSequence* mesh);

}  // namespace anicodec

/// Behind the handle.
struct anic_encoder {
  anicodec::MeshSequence clip;  ///< timing alone; a live one has no frame
  bool has_clip = false;
  bool find_origin = false;
  std::vector<anicodec::SourceMesh> meshes;
  anicodec::EncodeResult result;
  std::string text;
};

#endif  // ANICODEC_CODEC_API_ENCODER_OBJECTS_H_
