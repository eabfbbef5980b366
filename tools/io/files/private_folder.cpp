// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/private_folder.h"

#include "codec/sequence/error.h"

#include <filesystem>
#include <system_error>

namespace anicodec::tools {

PrivateFolder::PrivateFolder() {
  const std::string parent = std::filesystem::temp_directory_path().string();
  constexpr const char* kPrefix = ".anicodec-private-";
  remove_abandoned_folders(parent, kPrefix);
  try {
    folder_.emplace(parent, kPrefix);
  } catch (const std::system_error& e) {
    throw Error(ErrorKind::kInternal, parent + ": " + e.code().message());
  }
}

}  // namespace anicodec::tools
