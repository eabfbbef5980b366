// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_CHOICE_H_
#define ANICODEC_CODEC_MASSAGE_CHOICE_H_

#include "codec/plan/encode_result.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"

namespace anicodec {

/// Whether massage() may make the file of a sequence clearly smaller: 16 frames are massaged by themselves, and what
/// both code to must differ by a tenth at least. For a target that is a size, at a KG error of 0.1 %. The sample is
/// not cleared of frame noise, which would make any clip smaller: it is the sliding that is looked
/// for. False for a sequence that massage() refuses, or of fewer than three frames. Writes the bytes of the sample
/// to `verdict`.
bool massage_pays(const MeshSequence& sequence, const EncodeOptions& options,
                  const Progress& progress, MassageVerdict* verdict);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_CHOICE_H_
