// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_PRIVATE_FOLDER_H_
#define ANICODEC_TOOLS_IO_FILES_PRIVATE_FOLDER_H_

#include <string>

namespace anicodec::tools {

/// A folder among the system's temporary files that only this user can enter. It goes with the
/// object, and all that is in it.
class PrivateFolder {
 public:
  /// Throws Error(kInternal) when it cannot be made.
  PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder();

  /// The path of a file in it.
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_PRIVATE_FOLDER_H_
