// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_API_CONFORMANCE_FILE_H_
#define ANICODEC_TESTS_API_CONFORMANCE_FILE_H_

#include "build_paths.h"
#include "codec/encode.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

namespace anicodec {

/// A file of tests/conformance, by its name without ".anic".
inline Bytes conformance_file(const std::string& name) {
  std::ifstream file(ANICODEC_SOURCE_DIR "/tests/conformance/" + name + ".anic", std::ios::binary);
  EXPECT_TRUE(file.is_open()) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_API_CONFORMANCE_FILE_H_
