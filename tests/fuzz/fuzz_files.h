// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_FILES_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_FILES_H_

#include "format/container.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace anicodec {

/// A file of tests/conformance, whole and chunk by chunk.
struct FuzzFile {
  struct Part {
    Chunk chunk;
    Bytes payload;
  };

  std::string name;
  Bytes bytes;
  uint64_t features = 0;
  std::vector<Part> parts;
};

/// Those whose chunks chunk_fuzz changes, in its order: each kind of chunk and coder, quickly decoded.
inline std::vector<FuzzFile> fuzz_files() {
  std::vector<FuzzFile> result;
  for (const char* name : {"triangle", "nonmanifold_keyframes", "polygons_all", "quad_box_corrected",
                           "soup", "limb_small", "far_rigid", "uneven_times", "painted_box", "heated",
                           "walk", "exact", "alike", "regions", "nonmanifold_interpolated"}) {
    std::ifstream in(std::string(ANICODEC_CONFORMANCE) + "/" + name + ".anic", std::ios::binary);
    FuzzFile& file = result.emplace_back();
    file.name = name;
    file.bytes.assign(std::istreambuf_iterator<char>(in), {});
    ContainerReader reader;
    if (!reader.open(file.bytes).ok())
      std::abort();
    file.features = reader.features();
    for (const Chunk& chunk : reader.chunks()) {
      ByteView view;
      if (!reader.payload(chunk, &view).ok())
        std::abort();
      file.parts.push_back({chunk, {view.data, view.data + view.size}});
    }
  }
  return result;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FUZZ_FUZZ_FILES_H_
