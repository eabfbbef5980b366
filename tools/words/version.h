// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_WORDS_VERSION_H_
#define ANICODEC_TOOLS_WORDS_VERSION_H_

namespace anicodec::tools {

/// Version of the command and the libraries, "major.minor.patch".
const char* version();

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_VERSION_H_
