// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_STAGING_H_
#define ANICODEC_TOOLS_IO_FILES_STAGING_H_

#include "tools/io/files/cleanup.h"
#include "tools/io/files/locked_folder.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace anicodec::tools {

/// A hidden folder beside outputs, in which they wait to be renamed: so they are in their file
/// system, and what a killed run leaves behind is one folder that tells it. Safe for threads.
class Staging {
 public:
  /// That of a folder, shared by all outputs that wait there; empty: the working folder. First
  /// finishes what killed runs have left in it. Throws std::system_error.
  static std::shared_ptr<Staging> in(const std::string& folder);

  /// Takes a number for a file that is to be made.
  uint32_t take_number();

  const std::string& path() const { return folder_.path(); }

  std::string file(uint32_t number) const { return path() + "/" + std::to_string(number); }

 private:
  explicit Staging(const std::string& folder);

  LockedFolder folder_;
  RemoveOnSignal remove_on_signal_;
  std::atomic<uint32_t> count_{0};
};

/// Finishes what killed runs have left in a folder, and removes their temporary files. Gives the
/// names of files that still are to be replaced, because this run may not.
std::vector<std::string> recover_folder(const std::string& folder);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_STAGING_H_
