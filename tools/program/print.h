// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A command's words on the standard output. Names in them move no cursor.
#ifndef ANICODEC_TOOLS_PROGRAM_PRINT_H_
#define ANICODEC_TOOLS_PROGRAM_PRINT_H_

#include "tools/io/base/printable.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

namespace anicodec::tools {

struct CommonOptions;

/// Prints one line, what it holds made printable().
template <typename... Arguments>
void print_line(std::FILE* stream, fmt::format_string<Arguments...> text,
                Arguments&&... arguments) {
  fmt::print(stream, "{}\n", printable(fmt::format(text, std::forward<Arguments>(arguments)...)));
}

template <typename... Arguments>
void print_line(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  print_line(stdout, text, std::forward<Arguments>(arguments)...);
}

/// Prints an object on one line, as ASCII: other characters are escaped, bytes that are no UTF-8
/// replaced.
void print_json(const nlohmann::ordered_json& json);

/// A mesh sequence that a command has written.
struct Written {
  std::string path;
  uint32_t frames = 0, vertices = 0;
  size_t faces = 0;
  std::array<double, 3> origin{};  ///< that positions count from, where the file has no room for it
  std::string rooms = {};          ///< files that have
};

/// Says so: as an object, or as a line unless quiet.
void print_written(const Written& written, const CommonOptions& common);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_PROGRAM_PRINT_H_
