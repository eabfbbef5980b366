// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/private_folder.h"

#include "codec/sequence/error.h"

#include <cstdlib>
#include <filesystem>

namespace anicodec::tools {

PrivateFolder::PrivateFolder()
    : path_((std::filesystem::temp_directory_path() / "anicodec_XXXXXX").string()) {
  if (mkdtemp(path_.data()) == nullptr)
    throw Error(ErrorKind::kInternal, path_ + ": cannot be created");
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace anicodec::tools
