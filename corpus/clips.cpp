// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/clips.h"

namespace anicodec::corpus {

std::vector<std::string> clip_names() {
  return {};
}

}  // namespace anicodec::corpus
