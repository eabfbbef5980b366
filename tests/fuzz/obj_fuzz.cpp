// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/fuzz/fuzz_mesh.h"
#include "tools/io/formats/obj.h"

using namespace anicodec;
using namespace anicodec::tools;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz_mesh(
      as_text(data, size),
      [](std::string_view text, std::string_view name, Mesh& mesh) {
        MeshDetails details;
        parse_obj(text, name, mesh, &details);
      },
      [](const Polygons& polygons, std::span<const float> positions, std::string& out) {
        append_obj(polygons, positions, out);
      });
  return 0;
}
