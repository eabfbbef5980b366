// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_STAGE_HINT_H_
#define ANICODEC_TOOLS_IO_BASE_STAGE_HINT_H_

#include <filesystem>
#include <string>

namespace anicodec::tools {

/// Whether a path is that of a stage of USD.
inline bool is_stage(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".usd" || extension == ".usda" || extension == ".usdc" ||
         extension == ".usdz";
}

/// Names the package that reads and writes stages of USD, behind what is said of a path; empty for other files.
inline std::string stage_hint(const std::string& path) {
  return is_stage(path) ? "; stages of USD need the Python package: pip install 'anicodec[usd]'"
                        : "";
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_STAGE_HINT_H_
