// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_PACKAGE_HINT_H_
#define ANICODEC_TOOLS_IO_BASE_PACKAGE_HINT_H_

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// Whether a path is that of a stage of USD.
inline bool is_stage(const std::string& path) {
  constexpr std::array<std::string_view, 4> kStages = {".usd", ".usda", ".usdc", ".usdz"};
  return std::ranges::count(kStages, std::filesystem::path(path).extension().string()) > 0;
}

/// Names the package that reads and writes a file which the command alone does not, behind what is said of its path; empty for
/// other files.
inline std::string package_hint(const std::string& path) {
  constexpr std::array<std::string_view, 23> kSteps = {
      ".vtk",  ".vtp",  ".vtu",  ".vts",  ".vtr", ".vti",    ".vtm",    ".pvtp",
      ".pvtu", ".pvts", ".pvtr", ".pvti", ".pvd", ".series", ".vtkhdf", ".xdmf",
      ".xmf",  ".case", ".e",    ".exo",  ".ex2", ".npy",    ".npz"};
  if (is_stage(path))
    return "; stages of USD need the Python package: pip install 'anicodec[usd]'";
  if (std::ranges::count(kSteps, std::filesystem::path(path).extension().string()) > 0)
    return "; results of simulations need the Python package: pip install 'anicodec[vtk]'";
  return "";
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_PACKAGE_HINT_H_
