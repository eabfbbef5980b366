// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_LOCKED_FOLDER_H_
#define ANICODEC_TOOLS_IO_FILES_LOCKED_FOLDER_H_

#include <functional>
#include <string>

namespace anicodec::tools {

/// A new folder that only this user can enter, with a lock on it (flock) as long as it is in use:
/// the lock of a run that was killed is free, and tells that its folder can go. The folder goes
/// with the object, and all that is in it.
class LockedFolder {
 public:
  /// Makes PARENT/PREFIXxxxxxx. Throws std::system_error.
  LockedFolder(const std::string& parent, const std::string& prefix);
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;
  ~LockedFolder();

  const std::string& path() const { return path_; }

  int descriptor() const { return descriptor_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

/// Removes the folders PARENT/PREFIXxxxxxx of this user that no run holds; before that, with the
/// lock taken, calls `finish` (where given), which returns false to keep one. Never throws.
void remove_abandoned_folders(const std::string& parent, const std::string& prefix,
                              const std::function<bool(const std::string& path)>& finish = {});

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_LOCKED_FOLDER_H_
