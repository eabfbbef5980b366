// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/fuzz/fuzz_mesh.h"
#include "tools/io/formats/ply.h"

using namespace anicodec;
using namespace anicodec::tools;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  for (bool ascii : {true, false}) {
    fuzz_mesh(
        as_text(data, size),
        [](std::string_view text, std::string_view name, Mesh& mesh) {
          MeshDetails details;
          parse_ply(text, name, mesh, &details);
        },
        [ascii](const auto& polygons, const auto& positions, std::string& out) {
          append_ply(polygons, positions, ascii, out);
        });
  }
  return 0;
}
