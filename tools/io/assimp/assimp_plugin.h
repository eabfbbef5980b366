// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_PLUGIN_H_
#define ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_PLUGIN_H_

#include "tools/io/assimp/assimp_import.h"

#include <string>

namespace anicodec::tools {

/// Loads the plug-in, which stands beside this program or library or in lib/anicodec of its prefix. The
/// first call takes milliseconds. Throws Error(kUnsupported) naming `path`, the file to be read, where it
/// was not built or assimp is not installed.
ImportWithAssimp assimp_plugin(const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_PLUGIN_H_
