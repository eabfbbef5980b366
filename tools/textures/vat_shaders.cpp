// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/vat_shaders.h"

#include "codec/sequence/error.h"
#include "tools/words/word_list.h"

#include <algorithm>

namespace anicodec::tools {
namespace {

// Made by tools/CMakeLists.txt of the files of shaders.
constexpr VatShader kShaders[] = {
#include "anicodec_vat_shaders.inc"
};

}  // namespace

std::vector<VatShader> shaders_for(const std::string& engines) {
  std::vector<VatShader> chosen;
  for (const std::string& name : split_at_commas(engines)) {
    const auto* found = std::ranges::find(kShaders, name, &VatShader::engine);
    if (found == std::end(kShaders))
      throw Error(ErrorKind::kUsage,
                  "--shaders: godot, unity, unreal or three, separated by commas");
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace anicodec::tools
