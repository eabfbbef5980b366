// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_TOOLS_IO_TESTING_H_
#define ANICODEC_TESTS_TOOLS_IO_TESTING_H_

#include "codec/sequence/error.h"
#include "codec/sequence/mesh_sequence.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace anicodec::tools {

/// A folder of its own for one test, removed at its end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "anicodec_test_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }

  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  std::string write(const std::string& name, std::string_view bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return *this / name;
  }

  std::string read(const std::string& name) const {
    std::ifstream in(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// Names of all files, sorted.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

/// Text of the Error of the given kind that the call throws, else a description of what happened.
template <typename Call>
std::string fault(Call call, ErrorKind kind = ErrorKind::kInput) {
  try {
    call();
  } catch (const Error& e) {
    return e.kind() == kind ? e.what() : "wrong kind: " + std::string(e.what());
  }
  return "no error";
}

/// Mixed polygons with everything that a reader might be tempted to repair: an unused vertex, a
/// duplicate face, degenerate faces, a non-manifold edge, two components, boundaries; coordinates
/// that need all digits.
inline MeshSequence awkward_clip(uint32_t frames) {
  MeshSequence s;
  s.name = "awkward";
  s.vertex_count = 10;
  s.frame_count = frames;
  for (const std::vector<uint32_t>& polygon : std::vector<std::vector<uint32_t>>{
           {0, 1, 2, 3}, {0, 1, 4}, {1, 0, 5}, {0, 1, 4}, {2, 2, 3}, {1, 3, 1}, {6, 7, 8, 4, 5}})
    s.polygons.add(polygon);
  for (uint32_t i = 0; i < frames * s.vertex_count * 3; ++i) {
    float x = 1.0F / static_cast<float>(i + 3);
    s.positions.push_back(i % 3 == 0 ? -x : i % 5 == 0 ? x * 1e-20F : x * 1000.0F);
  }
  s.positions[1] = 0.0F;
  s.positions[2] = -0.0F;
  s.positions[4] = 1e-45F;
  s.positions[5] = 3.4028235e38F;
  return s;
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TESTS_TOOLS_IO_TESTING_H_
