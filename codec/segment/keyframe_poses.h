// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_KEYFRAME_POSES_H_
#define ANICODEC_CODEC_SEGMENT_KEYFRAME_POSES_H_

#include <cstdint>

namespace anicodec {

/// The coder of key-frames' poses: that of reference poses, each key-frame predicted from an earlier
/// one; Draco as in the thesis' codec, which decoders may lack; or whichever takes fewer bytes.
enum class KeyframePoses : uint8_t { kNative, kDraco, kAuto };

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_KEYFRAME_POSES_H_
