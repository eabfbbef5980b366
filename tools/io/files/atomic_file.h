// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_ATOMIC_FILE_H_
#define ANICODEC_TOOLS_IO_FILES_ATOMIC_FILE_H_

#include "tools/io/files/output_folder.h"
#include "tools/io/files/staging.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

struct Replacement;

/// Throws Error(kUsage) when the path exists and overwrite is false or is not a regular file. Lets
/// a long computation fail before it starts. Throws Error(kInput) when the name is too long.
void check_output(const std::string& path, bool overwrite);

/// An output that appears under its name whole or not at all, and with it the folders that it lies in: written to a
/// hidden folder beside it, renamed by commit() once the disk has it, removed by the destructor otherwise and by signals
/// (install_cleanup_on_signal). The file that it replaces stays until then, and its mode is kept. Writes
/// through symbolic links. A power loss leaves the old file or the new one, and after commit() the new one.
class AtomicFile {
 public:
  /// Throws like check_output, and Error(kUsage) when the file or its folder cannot be created.
  AtomicFile(const std::string& path, bool overwrite);
  AtomicFile(AtomicFile&&) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Throws Error(kInternal) naming the file when the disk is full.
  void write(std::string_view bytes);

  /// Puts bytes in place of some that write() has been given. Throws like it.
  void rewrite(uint64_t offset, std::string_view bytes);

  /// Ends writing, so that many files can wait for commit() without a descriptor each. The disk
  /// has the bytes afterwards.
  void close();

  /// Closes and renames. Throws Error(kUsage) when the path has come to exist and overwrite is
  /// false, Error(kInternal) when what is there cannot be replaced; it stays then.
  void commit();

  const std::string& path() const { return path_; }

 private:
  friend class CommitAll;

  void write_all(std::string_view bytes);
  void keep_mode();
  void keep_old(Replacement& replacement) const;
  void place();
  [[noreturn]] void fail_writing() const;

  std::string path_;       ///< as given
  std::string target_;     ///< behind symbolic links
  std::string temporary_;  ///< empty when renamed or moved from
  bool overwrite_;
  std::unique_ptr<OutputFolder> folder_;  ///< goes last, and stays where a file is in it
  std::shared_ptr<Staging> staging_;
  uint32_t number_ = 0;
  struct Descriptor;
  std::unique_ptr<Descriptor> file_;
  std::string buffer_;
};

/// Commits all or none: when one fails, puts back what the others have replaced. A run that is
/// killed in between, by a power loss too, leaves a record by which the next run that reads or writes there renames
/// the rest.
void commit_all(std::vector<AtomicFile>& files);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_ATOMIC_FILE_H_
