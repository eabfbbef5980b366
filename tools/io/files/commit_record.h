// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// How several files are replaced as one: as a database does it, with a record that the next run
// finishes when this one is killed.
#ifndef ANICODEC_TOOLS_IO_FILES_COMMIT_RECORD_H_
#define ANICODEC_TOOLS_IO_FILES_COMMIT_RECORD_H_

#include <cstdint>
#include <string>
#include <vector>

namespace anicodec::tools {

/// A file that waits in a staging folder as "NUMBER" to be renamed to ../NAME; the file it replaces
/// is kept as "NUMBER.old".
struct Replacement {
  uint32_t number = 0;
  std::string name;
  std::string before;  ///< which file has the name, by identity_of(); empty: none
  std::string after;   ///< which file waits
};

/// Which file a path names and in which state: it changes with every change of the content, and
/// stays when the file is renamed. Empty where there is none.
std::string identity_of(const std::string& path);

/// Writes the record down for good: from here on a run that finds it renames all files. Throws
/// std::system_error.
void write_commit_record(const std::string& staging, const std::vector<Replacement>& files);

/// Makes the record say that all goes back to what it was. Never fails when the record is there.
void turn_commit_record(const std::string& staging);

/// Removes the record: what it says has been done.
void remove_commit_record(const std::string& staging);

/// Puts what was replaced back in place, after turn_commit_record(). Never throws.
void put_back(const std::string& staging, const std::vector<Replacement>& files);

/// Does what the record of a killed run says, if there is one. A target that somebody has changed
/// since stays as it is, and so do all that have not been renamed. False when the record says more
/// than can be done now.
bool finish_commit(const std::string& staging);

/// Names that a killed run has not got to replace, in the staging folders of this one.
std::vector<std::string> unfinished_names(const std::string& staging);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_COMMIT_RECORD_H_
