// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/assimp/assimp_plugin.h"

#include "codec/sequence/error.h"
#include "tools/io/files/own_file.h"

#include <filesystem>
#include <system_error>

#include <dlfcn.h>

namespace anicodec::tools {

ImportWithAssimp assimp_plugin(const std::string& path) {
  const std::filesystem::path folder = own_file().parent_path();
  for (const std::filesystem::path& plugin :
       {folder / kAssimpPlugin, folder.parent_path() / "lib/anicodec" / kAssimpPlugin}) {
    std::error_code none;
    if (!std::filesystem::exists(plugin, none))
      continue;
    void* library = ::dlopen(plugin.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* function = library ? ::dlsym(library, kAssimpFunction) : nullptr;
    if (function)
      return reinterpret_cast<ImportWithAssimp>(function);
    const char* fault = ::dlerror();
    throw Error(
        ErrorKind::kUnsupported,
        path +
            ": assimp, which reads this format, cannot be loaded (Debian has it as libassimp5): " +
            (fault ? fault : plugin.string()));
  }
  throw Error(ErrorKind::kUnsupported,
              path +
                  ": this build is without assimp, which reads this format; export the clip as "
                  "glTF, or as OBJ with PC2 or MDD");
}

}  // namespace anicodec::tools
