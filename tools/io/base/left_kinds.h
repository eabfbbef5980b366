// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_LEFT_KINDS_H_
#define ANICODEC_TOOLS_IO_BASE_LEFT_KINDS_H_

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// "1 camera", "2 cameras".
inline std::string counted_kind(size_t count, const std::string& kind) {
  return std::to_string(count) + " " + kind + (count == 1 ? "" : "s");
}

/// Kinds of data that an importer met in a file and does not keep, in the order in which it met them.
class LeftKinds {
 public:
  void add(std::string_view kind) {
    if (std::ranges::find(kinds_, kind) == kinds_.end())
      kinds_.emplace_back(kind);
  }

  void add(const LeftKinds& others) {
    for (const std::string& kind : others.kinds_)
      add(kind);
  }

  const std::vector<std::string>& kinds() const { return kinds_; }

  /// "2 cameras, lights"; empty for none.
  std::string text() const {
    std::string all;
    for (const std::string& kind : kinds_)
      all += (all.empty() ? "" : ", ") + kind;
    return all;
  }

 private:
  std::vector<std::string> kinds_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_LEFT_KINDS_H_
