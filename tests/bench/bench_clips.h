// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_BENCH_CLIPS_H_
#define ANICODEC_TESTS_BENCH_BENCH_CLIPS_H_

#include "codec/sequence/mesh_sequence.h"

#include <string>
#include <vector>

namespace anicodec::bench {

/// Loads the clip that a word names: inputs of `anicodec encode` joined by commas, else a clip of
/// the corpus, else mesh and cache of that name in the folder $ANICODEC_DATA ("classic/dance").
/// Throws Error.
MeshSequence load_clip(const std::string& word);

/// The words for what the command line names: `inputs` are names of clips, or together the files
/// of one clip; each of `clips` is a word of its own. Throws Error(kUsage) when there is none.
std::vector<std::string> clip_words(const std::vector<std::string>& inputs,
                                    const std::vector<std::string>& clips);

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_BENCH_CLIPS_H_
