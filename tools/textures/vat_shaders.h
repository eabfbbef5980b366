// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_TEXTURES_VAT_SHADERS_H_
#define ANICODEC_TOOLS_TEXTURES_VAT_SHADERS_H_

#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// A file of bindings/shaders, which the build takes into the command.
struct VatShader {
  std::string_view engine;  ///< godot, unity, unreal, three
  std::string_view file;
  std::string_view text;
};

/// The shaders for engines, separated by commas. Throws Error(kUsage) for another name.
std::vector<VatShader> shaders_for(const std::string& engines);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_TEXTURES_VAT_SHADERS_H_
