// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_LATTICE_H_
#define ANICODEC_CODEC_SEGMENT_LATTICE_H_

#include "format/exact_record.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// The lattice that all of the coordinates lie on, or nearly all to within a rounding of binary32: those of
/// clips that were quantised, or were decimals in a text. A lattice that is not used where there is none;
/// one that errs has at most `most` points.
/// Cost: O(n log n) for n coordinates.
ExactRecord::Lattice find_lattice(std::vector<float> coordinates, uint64_t most);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_LATTICE_H_
