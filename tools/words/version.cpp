// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/words/version.h"

namespace anicodec::tools {

const char* version() {
  return ANICODEC_VERSION;
}

}  // namespace anicodec::tools
