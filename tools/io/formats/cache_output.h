// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_CACHE_OUTPUT_H_
#define ANICODEC_TOOLS_IO_FORMATS_CACHE_OUTPUT_H_

#include <string>

namespace anicodec::tools {

struct FileFormat;

/// The mesh that is written beside a vertex cache: clip.obj of clip.pc2.
std::string mesh_of_cache(const std::string& cache);

extern const FileFormat kPc2, kMdd;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_CACHE_OUTPUT_H_
