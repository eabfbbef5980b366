// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_CONFORMANCE_READING_VECTORS_H_
#define ANICODEC_TESTS_CONFORMANCE_READING_VECTORS_H_

#include "format/bytes.h"

#include <vector>

namespace anicodec {

struct SpecialVector {
  const char* name;  ///< of the file, without ".anic"
  Bytes (*make)();
};

/// Files for special_vectors, each for sentences of the specification that others let pass if misread.
const std::vector<SpecialVector>& reading_vectors();

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CONFORMANCE_READING_VECTORS_H_
