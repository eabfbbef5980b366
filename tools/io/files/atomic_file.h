// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_ATOMIC_FILE_H_
#define ANICODEC_TOOLS_IO_FILES_ATOMIC_FILE_H_

#include "tools/io/files/cleanup.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// Throws Error(kUsage) when the path exists and overwrite is false or is not a regular file. Lets
/// a long computation fail before it starts.
void check_output(const std::string& path, bool overwrite);

/// An output that appears under its name whole or not at all: written beside it under a temporary
/// name, renamed by commit(), removed by the destructor otherwise and by signals
/// (install_cleanup_on_signal). Writes through symbolic links.
class AtomicFile {
 public:
  /// Throws like check_output, and Error(kUsage) when the file cannot be created.
  AtomicFile(const std::string& path, bool overwrite);
  AtomicFile(AtomicFile&&) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Throws Error(kInternal) naming the file when the disk is full.
  void write(std::string_view bytes);

  /// Ends writing, so that many files can wait for commit() without a descriptor each.
  void close();

  /// Closes and renames. Throws Error(kUsage) when the path has come to exist and overwrite is
  /// false.
  void commit();

  /// Removes what commit() has put in place.
  void undo();

  const std::string& path() const { return path_; }

 private:
  void write_all(std::string_view bytes);
  [[noreturn]] void fail_writing() const;

  std::string path_;       ///< as given
  std::string target_;     ///< behind symbolic links
  std::string temporary_;  ///< in the same folder
  bool overwrite_;
  struct Descriptor;
  std::unique_ptr<Descriptor> file_;
  std::unique_ptr<RemoveOnSignal> remove_on_signal_;
  std::string buffer_;
};

/// Commits all or none: when one fails, removes those that it has put in place (but cannot bring
/// back what they replaced).
void commit_all(std::vector<AtomicFile>& files);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_ATOMIC_FILE_H_
