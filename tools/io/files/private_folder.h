// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_PRIVATE_FOLDER_H_
#define ANICODEC_TOOLS_IO_FILES_PRIVATE_FOLDER_H_

#include "tools/io/files/locked_folder.h"

#include <optional>
#include <string>

namespace anicodec::tools {

/// A folder among the system's temporary files that only this user can enter. It goes with the
/// object, and all that is in it; that of a run that was killed goes when the next one is made.
class PrivateFolder {
 public:
  /// Throws Error(kInternal) when it cannot be made.
  PrivateFolder();

  /// The path of a file in it.
  std::string operator/(const std::string& name) const { return folder_->path() + "/" + name; }

 private:
  std::optional<LockedFolder> folder_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_PRIVATE_FOLDER_H_
