// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/fuzz/fuzz_mesh.h"
#include "tools/io/formats/md3.h"

using namespace anicodec;
using namespace anicodec::tools;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    check(parse_md3(as_text(data, size), "fuzz",
                    [](const std::string& text) { require(!text.empty()); }));
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::kInput && *error.what() != '\0');
  }
  return 0;
}
