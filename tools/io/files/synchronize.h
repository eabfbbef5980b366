// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_SYNCHRONIZE_H_
#define ANICODEC_TOOLS_IO_FILES_SYNCHRONIZE_H_

#include <string>

namespace anicodec::tools {

/// Waits until the disk has the content of an open file. False with errno when it cannot be written; true for file
/// systems that cannot tell.
bool synchronize(int descriptor);

/// Waits until the disk has the names in a folder ("" is the working folder), as far as the file system can tell: what
/// was made, renamed or removed there stays so when the power goes.
void synchronize_folder(const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_SYNCHRONIZE_H_
