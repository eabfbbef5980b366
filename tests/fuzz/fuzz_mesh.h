// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_MESH_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_MESH_H_

#include "codec/sequence/error.h"
#include "tools/io/base/mesh.h"

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

namespace anicodec::tools {

inline void require(bool condition) {
  if (!condition)
    std::abort();
}

inline bool same_bits(std::span<const float> a, std::span<const float> b) {
  bool same = a.size() == b.size();
  for (size_t i = 0; same && i < a.size(); ++i)
    same = std::bit_cast<uint32_t>(a[i]) == std::bit_cast<uint32_t>(b[i]);
  return same;
}

/// Whatever a parser accepts is a valid mesh, and what a writer makes of it reads back the same.
template <typename Parse, typename Append>
void fuzz_mesh(std::string_view bytes, Parse parse, Append append) {
  Mesh mesh;
  try {
    parse(bytes, "fuzz", mesh);
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::kInput && *error.what() != '\0');
    return;
  }
  MeshSequence sequence;
  sequence.vertex_count = static_cast<uint32_t>(mesh.vertex_count());
  sequence.frame_count = 1;
  sequence.polygons = mesh.polygons;
  sequence.positions = mesh.positions;
  check(sequence);
  std::string written;
  append(mesh.polygons, mesh.positions, written);
  Mesh again;
  parse(written, "again", again);
  require(again.polygons == mesh.polygons && same_bits(again.positions, mesh.positions));
}

inline std::string_view as_text(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TESTS_FUZZ_FUZZ_MESH_H_
