// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_OUTPUT_FOLDER_H_
#define ANICODEC_TOOLS_IO_FILES_OUTPUT_FOLDER_H_

#include <filesystem>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Makes the folders that an output is to be written in where they are missing, and removes those
/// it made again unless keep() is called.
class OutputFolder {
 public:
  /// Throws Error(kUsage) when a folder cannot be made.
  explicit OutputFolder(const std::string& output);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  void keep() { made_.clear(); }

 private:
  void remove();

  std::vector<std::filesystem::path> made_;  // outermost first
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_OUTPUT_FOLDER_H_
