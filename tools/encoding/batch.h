// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_ENCODING_BATCH_H_
#define ANICODEC_TOOLS_ENCODING_BATCH_H_

#include "codec/encode.h"
#include "codec/sequence/mesh_sequence.h"
#include "tools/inputs/batch_clips.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace anicodec::tools {

struct BatchOptions {
  std::string folder;      ///< of the outputs
  unsigned jobs = 1;       ///< clips side by side
  uint64_t memory = 0;     ///< bytes that clips at work may take; one that needs more runs alone
  bool overwrite = false;  ///< outputs that the batch has not written
  bool quiet = false;      ///< only failures and the summary
  bool json = false;       ///< an object for each clip and for the summary
  std::string settings;    ///< all that the bytes of an output depend on beside the clip
};

/// How each clip is read and encoded; called from several threads. `note` is told what is not kept.
using BatchLoad = std::function<MeshSequence(const BatchClip& clip,
                                             const std::function<void(const std::string&)>& note)>;
using BatchEncode = std::function<EncodeResult(const BatchClip& clip, MeshSequence sequence)>;

/// Encodes clips to FOLDER/NAME.anic, with a line for each and a summary at the end. Writes down
/// what is done in FOLDER/.anicodec-batch, by hashes of content, settings and output, so that a
/// second run only does what is missing or has changed. A clip that fails does not stop the others:
/// afterwards throws an Error of the kind of the first in the list.
void run_batch(const std::vector<BatchClip>& clips, const BatchOptions& options,
               const BatchLoad& load, const BatchEncode& encode);

/// A hash of all that a sequence holds.
uint64_t content_hash(const MeshSequence& sequence);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_ENCODING_BATCH_H_
