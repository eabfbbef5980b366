// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/own_file.h"

#include <string_view>
#include <system_error>

#include <dlfcn.h>

namespace anicodec::tools {

std::filesystem::path own_file() {
  static const char inside = 0;
  std::error_code none;
  Dl_info found{};
  // A program is named as it was called, which may be without a folder.
  if (::dladdr(&inside, &found) != 0 && std::string_view(found.dli_fname).ends_with(".so"))
    return std::filesystem::canonical(found.dli_fname, none);
  return std::filesystem::read_symlink("/proc/self/exe", none);
}

}  // namespace anicodec::tools
