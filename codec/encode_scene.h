// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ENCODE_SCENE_H_
#define ANICODEC_CODEC_ENCODE_SCENE_H_

#include "codec/plan/encode_options.h"
#include "codec/plan/encode_result.h"
#include "codec/sequence/progress.h"
#include "codec/sequence/scene.h"

namespace anicodec {

/// encode() of several meshes, or of one that is not there in all frames: each with a share of the target, small ones
/// at the same time as others. The error of the first mesh that has one is thrown.
EncodeResult encode_scene(Scene scene, const EncodeOptions& options, const Progress& progress);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ENCODE_SCENE_H_
