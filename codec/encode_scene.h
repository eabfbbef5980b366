// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ENCODE_SCENE_H_
#define ANICODEC_CODEC_ENCODE_SCENE_H_

#include "codec/encode.h"
#include "codec/sequence/progress.h"
#include "codec/sequence/scene.h"

namespace anicodec {

/// Encodes several meshes to one file. Errors asked for are those of the whole scene: lengths in
/// per cent are of the box around everything, and a KG error becomes one RMSE for all. Each mesh
/// has the kind of basis that suits it; one that only turns and moves is a single key-frame with a
/// rigid motion where that is smallest. A mesh that comes and goes has segments for the frames it
/// is there in. The result's errors are those of the whole, its kind that of the first mesh. Throws
/// as encode(), naming mesh or frames, and Error(kUsage) for a target size, which cannot be shared
/// out.
EncodeResult encode_scene(Scene scene, const EncodeOptions& options, const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ENCODE_SCENE_H_
