// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_OWN_FILE_H_
#define ANICODEC_TOOLS_IO_FILES_OWN_FILE_H_

#include <filesystem>

namespace anicodec::tools {

/// The file that this code was loaded from: the command, or a library that holds it, whoever runs it.
std::filesystem::path own_file();

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_OWN_FILE_H_
