// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_BATCH_CLIPS_H_
#define ANICODEC_TOOLS_INPUTS_BATCH_CLIPS_H_

#include <string>
#include <vector>

namespace anicodec::tools {

/// One clip of many to be encoded.
struct BatchClip {
  std::string name;                 ///< for messages, and of the output, may have folders
  std::vector<std::string> inputs;  ///< as load_sequence takes them
};

/// Takes stages of USD in folders for no clips from here on: the Python package encodes them itself.
void leave_stages_to_others();

/// The clips of a folder and the folders in it, in natural order of their names: every scene and
/// stage, every vertex cache, and every two or more meshes whose names differ in a number at the
/// end. For a list (any other file): a clip per line, its inputs separated by tabs; empty lines and
/// lines that begin with # mean nothing. Throws Error(kInput) when nothing is found, Error(kUsage)
/// when two clips have one name.
std::vector<BatchClip> find_clips(const std::string& source);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_BATCH_CLIPS_H_
