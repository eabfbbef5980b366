// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/fuzz/fuzz_mesh.h"
#include "tools/io/formats/off.h"

using namespace anicodec::tools;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz_mesh(as_text(data, size), parse_off,
            [](const auto& polygons, const auto& positions, std::string& out) {
              append_off(polygons, positions, out);
            });
  return 0;
}
