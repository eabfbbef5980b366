// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_REAL_DATA_H_
#define ANICODEC_TESTS_REAL_DATA_H_

#include "build_paths.h"

#include <cstdlib>
#include <string>

namespace anicodec {

/// The folder of real clips: $ANICODEC_DATA, else shared/data beside the checkout.
inline std::string real_data_folder() {
  const char* set = std::getenv("ANICODEC_DATA");
  return set != nullptr ? set : std::string(ANICODEC_SOURCE_DIR) + "/../shared/data";
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_REAL_DATA_H_
