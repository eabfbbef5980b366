// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ENCODE_MASSAGED_H_
#define ANICODEC_CODEC_ENCODE_MASSAGED_H_

#include "codec/encode.h"
#include "codec/massage/massage.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"

#include <cstdint>
#include <optional>

namespace anicodec {

enum class MassageMode : uint8_t { kOff, kOn, kAuto };

/// The massage that was done, and the reason.
struct MassageVerdict {
  std::optional<SurfaceChange> change;  ///< none: the file holds the source
  uint64_t sample_plain_bytes = 0;      ///< kAuto: of the sample frames
  uint64_t sample_massaged_bytes = 0;   ///< the same, massaged; 0: not possible
  uint64_t plain_bytes = 0;             ///< kAuto: of the whole clip; 0: not tried
};

/// encode(), after massage() if the mode says so. kAuto massages 16 frames by themselves and
/// compares what both code to; where that falls by a tenth at least, the whole clip is coded both
/// ways and the smaller file is returned. So no file is larger than without, for a target that is
/// an error; for one that is a size the sample alone decides, at a KG error of 0.1 %. The sample is
/// not cleared of frame noise, which would make any clip smaller: it is the sliding that is looked
/// for. A clip that massage() refuses, or of fewer than three frames, is coded as it is by kAuto.
/// Throws as encode() and, for kOn, as massage().
EncodeResult encode_massaged(MeshSequence sequence, MassageMode mode,
                             const MassageOptions& massage_options, const EncodeOptions& options,
                             MassageVerdict* verdict, const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ENCODE_MASSAGED_H_
