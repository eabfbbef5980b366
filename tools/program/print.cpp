// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/program/print.h"

#include "tools/program/command.h"
#include "tools/words/quantity.h"

#include <nlohmann/json.hpp>

namespace anicodec::tools {

void print_json(const nlohmann::ordered_json& json) {
  fmt::print("{}\n", json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
}

void print_written(const Written& written, const CommonOptions& common) {
  const bool has_origin = written.origin != std::array<double, 3>{};
  if (common.json) {
    nlohmann::ordered_json json{{"file", written.path},
                                {"frames", written.frames},
                                {"vertices", written.vertices},
                                {"faces", written.faces}};
    if (has_origin)
      json["origin"] = written.origin;
    print_json(json);
  } else if (!common.quiet) {
    print_line("{}: {} of {} and {}", written.path, counted(written.frames, "frame"),
               counted(written.vertices, "vertex", "vertices"), counted(written.faces, "face"));
    if (has_origin)
      print_line("its positions count from {}; {} have room for that",
                 fmt::join(written.origin, ","), written.rooms);
  }
}

}  // namespace anicodec::tools
