// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_CLEANUP_H_
#define ANICODEC_TOOLS_IO_FILES_CLEANUP_H_

#include <cstddef>
#include <cstdint>
#include <string>

namespace anicodec::tools {

/// A folder of temporary files "0", "0.old", "1" ... that goes with them when a signal ends the
/// process, from construction to destruction. Holds one of 1024 places; once they are taken,
/// further folders stay, for the next run to remove.
class RemoveOnSignal {
 public:
  /// `folder` is the folder's descriptor, which must stay open as long as this.
  RemoveOnSignal(int folder, const std::string& path);
  RemoveOnSignal(const RemoveOnSignal&) = delete;
  RemoveOnSignal& operator=(const RemoveOnSignal&) = delete;
  ~RemoveOnSignal();

  /// Files "0" to count - 1 may be there. To be called before one is made.
  void set_count(uint32_t count);

 private:
  size_t place_;
};

/// While one of these lives, signals that would end the process wait, so that outputs that belong
/// together are renamed together. Signals that cannot wait (SIGABRT) leave all files in place.
class HoldSignals {
 public:
  HoldSignals();
  HoldSignals(const HoldSignals&) = delete;
  HoldSignals& operator=(const HoldSignals&) = delete;
  ~HoldSignals();
};

/// Makes the signals that end a process (SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU,
/// SIGABRT) remove all registered files first. A signal that is ignored stays ignored; SIGXFSZ is
/// ignored from here on, so that writing fails and says why.
void install_cleanup_on_signal();

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_CLEANUP_H_
