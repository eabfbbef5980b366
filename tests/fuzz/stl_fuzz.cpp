// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/fuzz/fuzz_mesh.h"
#include "tools/io/formats/stl.h"

using namespace anicodec::tools;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  // Zeroes of either sign are one place, so a welded mesh is compared with itself after one trip.
  auto parse = [](std::string_view bytes, std::string_view name, Mesh& mesh) {
    std::vector<float> soup;
    LocalOrigin origin;
    LeftKinds left_out;
    parse_stl(bytes, name, soup, origin, left_out);
    StlWeld weld(soup, std::string(name), true);
    mesh.clear();
    mesh.polygons = weld.polygons();
    weld.append_vertices(soup, name, mesh.positions);
  };
  for (bool ascii : {true, false}) {
    fuzz_mesh(as_text(data, size), parse,
              [ascii](const auto& polygons, const auto& positions, std::string& out) {
                append_stl(polygons, positions, ascii, out);
              });
  }
  return 0;
}
