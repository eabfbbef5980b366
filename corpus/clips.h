// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CORPUS_CLIPS_H_
#define ANICODEC_CORPUS_CLIPS_H_

#include <string>
#include <vector>

#include "codec/mesh_sequence.h"

namespace anicodec::corpus {

/// Names of all clips that make() knows, in a fixed order.
std::vector<std::string> clip_names();

}  // namespace anicodec::corpus

#endif  // ANICODEC_CORPUS_CLIPS_H_
