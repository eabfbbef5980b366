// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_MASSAGE_TRANSFER_H_
#define ANICODEC_TOOLS_INPUTS_MASSAGE_TRANSFER_H_

#include "codec/encode.h"
#include "codec/transfer/connectivity_transfer.h"
#include "tools/words/quantity.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Meshes without a common connectivity, brought to one (or one for each segment).
struct TransferredInput {
  std::vector<std::string> files;  ///< one a frame
  TransferResult result;           ///< segments have the clip's name and no timing

  /// Mean and largest symmetric distance between the carried meshes and the input's.
  SurfaceChange change() const;

  /// Why frame f began a new segment: "scan_7.obj: (distance, turned)".
  std::string reason(uint32_t f) const;
};

/// Reads one mesh after the other and carries the connectivity of the first through them, if
/// `vertices` is given after remesh() to so many of the first mesh's. Throws Error(kInput) naming
/// the file, Error(kUsage) for a vertex cache.
TransferredInput transfer_inputs(std::span<const std::string> inputs, const Progress& progress,
                                 const std::optional<Count>& vertices = {});

/// The same as one sequence. Throws Error(kInput) naming the first frame that cannot be followed
/// and its alarms.
MeshSequence transfer_to_one(std::span<const std::string> inputs, const Progress& progress,
                             SurfaceChange* change);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_MASSAGE_TRANSFER_H_
