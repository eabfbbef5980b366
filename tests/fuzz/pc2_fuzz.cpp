// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/fuzz/fuzz_cache.h"

using namespace anicodec::tools;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz_cache(as_text(data, size), open_pc2);
  return 0;
}
