// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/name_pattern.h"

#include "codec/sequence/error.h"

#include <algorithm>

namespace anicodec::tools {

std::string NamePattern::name(uint64_t number) const {
  if (!has_number)
    return before;
  std::string digits = std::to_string(number);
  return before + std::string(width - std::min(width, digits.size()), '0') + digits + after;
}

NamePattern parse_name_pattern(const std::string& path) {
  size_t percent = path.find('%');
  if (percent == std::string::npos)
    return {path, "", false, 0};
  NamePattern pattern;
  pattern.has_number = true;
  pattern.before = path.substr(0, percent);
  size_t i = percent + 1;
  if (i < path.size() && path[i] == '0') {
    for (++i; i < path.size() && path[i] >= '0' && path[i] <= '9' && pattern.width < 100; ++i)
      pattern.width = pattern.width * 10 + static_cast<size_t>(path[i] - '0');
  }
  if (i >= path.size() || path[i] != 'd' || path.find('%', i) != std::string::npos)
    throw Error(ErrorKind::kUsage, path + ": a pattern has one %d or %0Nd, such as frame_%04d.obj");
  pattern.after = path.substr(i + 1);
  return pattern;
}

}  // namespace anicodec::tools
