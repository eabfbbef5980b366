// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The object behind the handle of encode.h, and helpers of its functions. Internal to codec/api.
#ifndef ANICODEC_CODEC_API_ENCODER_OBJECTS_H_
#define ANICODEC_CODEC_API_ENCODER_OBJECTS_H_

#include "codec/encode.h"
#include "codec/encode_massaged.h"
#include "codec/sequence/scene.h"

#include <anicodec/encode.h>

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace anicodec {

/// A mesh without its positions, and where the host has them.
struct SourceMesh {
  SceneMesh mesh;
  anic_source_mesh host{};  ///< with strides; pointers to positions and callback alone are used
};

/// Ends a call: thrown inside the library, never out of it.
class EncoderFailure : public std::exception {
 public:
  EncoderFailure(anic_status status, std::string text) : status_(status), text_(std::move(text)) {}

  anic_status status() const { return status_; }

  const char* what() const noexcept override { return text_.c_str(); }

 private:
  anic_status status_;
  std::string text_;
};

/// The host's options as the encoder takes them.
struct EncodingPlan {
  EncodeOptions options;
  MassageMode mode = MassageMode::kOff;
  MassageOptions massage;
};

/// Throws EncoderFailure(ANIC_E_ARGUMENT).
EncodingPlan encoding_plan(const anic_encode_options& host);

/// Copies a mesh but for its positions. Throws EncoderFailure.
SourceMesh take_mesh(const anic_source_mesh& host, uint32_t clip_frames);

/// Adds an attribute to a mesh. Throws EncoderFailure(ANIC_E_ARGUMENT).
void take_attribute(const anic_source_attribute& host, MeshSequence* mesh);

/// Reads all positions of a mesh from the host, from the origin of the mesh. `before_frame` is called with the number of each.
/// Throws EncoderFailure: ANIC_E_READ, ANIC_E_NON_FINITE.
void read_positions(const SourceMesh& source, const std::function<void(uint32_t)>& before_frame,
                    MeshSequence* mesh);

}  // namespace anicodec

/// Behind the handle.
struct anic_encoder {
  anicodec::MeshSequence clip;  ///< timing alone
  bool find_origin = false;
  std::vector<anicodec::SourceMesh> meshes;
  anicodec::EncodeResult result;
  std::string text;
};

#endif  // ANICODEC_CODEC_API_ENCODER_OBJECTS_H_
