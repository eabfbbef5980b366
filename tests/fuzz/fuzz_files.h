// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_FILES_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_FILES_H_

#include "tests/fuzz/fuzz_file.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace anicodec {

/// A file of tests/conformance, whole and chunk by chunk.
struct FuzzFile : FuzzParts {
  std::string name;
  Bytes bytes;
};

/// The files whose chunks chunk_fuzz changes, in its order: each kind of chunk and coder, quickly
/// decoded.
inline std::vector<FuzzFile> fuzz_files() {
  std::vector<FuzzFile> result;
  for (const char* name :
       {"triangle", "nonmanifold_keyframes", "polygons_all", "quad_box_corrected", "soup",
        "limb_small", "far_rigid", "uneven_times", "painted_box", "heated", "walk", "exact",
        "alike", "regions", "nonmanifold_interpolated", "boxes_and_metadata"}) {
    std::ifstream in(std::string(ANICODEC_CONFORMANCE) + "/" + name + ".anic", std::ios::binary);
    FuzzFile& file = result.emplace_back();
    file.name = name;
    file.bytes.assign(std::istreambuf_iterator<char>(in), {});
    if (!ContainerReader().open(file.bytes).ok() || !file.read(file.bytes))
      std::abort();
  }
  return result;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FUZZ_FUZZ_FILES_H_
