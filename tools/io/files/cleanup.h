// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_CLEANUP_H_
#define ANICODEC_TOOLS_IO_FILES_CLEANUP_H_

#include <cstddef>
#include <string>

namespace anicodec::tools {

/// A file to be removed when a signal ends the process, from construction to destruction. Holds one
/// of 65536 places; once they are taken, further files are not removed.
class RemoveOnSignal {
 public:
  explicit RemoveOnSignal(const std::string& path);
  RemoveOnSignal(const RemoveOnSignal&) = delete;
  RemoveOnSignal& operator=(const RemoveOnSignal&) = delete;
  ~RemoveOnSignal();

 private:
  size_t place_;
};

/// Makes SIGINT, SIGTERM and SIGHUP remove all registered files before they end the process as
/// usual. A signal that is ignored stays ignored.
void install_cleanup_on_signal();

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_CLEANUP_H_
