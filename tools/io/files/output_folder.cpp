// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/output_folder.h"

#include "codec/sequence/error.h"
#include "tools/io/files/synchronize.h"

#include <system_error>

namespace anicodec::tools {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const std::string& output) {
  fs::path folder;
  for (const fs::path& part : fs::path(output).parent_path()) {
    folder /= part;
    std::error_code error;
    if (fs::create_directory(folder, error)) {
      made_.push_back(folder);
      synchronize_folder(folder.parent_path().string());
    }
    if (!fs::is_directory(folder, error)) {
      remove();
      throw Error(ErrorKind::kUsage,
                  output + ": the folder " + folder.string() + " cannot be made");
    }
  }
}

OutputFolder::~OutputFolder() {
  remove();
}

void OutputFolder::remove() {
  for (; !made_.empty(); made_.pop_back()) {
    std::error_code error;
    fs::remove(made_.back(), error);  // not when there is anything in it
  }
}

}  // namespace anicodec::tools
