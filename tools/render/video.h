// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_RENDER_VIDEO_H_
#define ANICODEC_TOOLS_RENDER_VIDEO_H_

#include "tools/render/image.h"

#include <string>
#include <vector>

namespace anicodec::tools {

/// The bytes of an MP4 file (H.264), made by the ffmpeg command. Images of one size. Throws
/// Error(kUnsupported) when there is none on the path, Error(kInternal) when it fails.
std::string mp4_bytes(const std::vector<Image>& images, double frames_per_second);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_RENDER_VIDEO_H_
