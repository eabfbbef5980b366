// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// In builds without exact positions.
#include "sdk/exact/exact_positions.h"

namespace anicodec {

Status open_exact_positions(ByteView, const SegmentContext&, Segment*) {
  return Status::kFeature;
}

}  // namespace anicodec
