// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/massage_transfer.h"
#include "tools/io/file_formats.h"
#include "tools/io/write_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/progress_line.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kMassageTransferFooter =
    R"(Moves the faces of the first mesh over the surfaces of the others, one after the other: scans whose
faces differ become one clip. A frame that cannot be followed is reported and begins a new segment
with its own faces; segments are written as OUT with _1, _2 ... before the extension. --vertices
remeshes the first mesh of every segment before it is moved, as massage remesh does.

--json prints one object: files (file, first_frame, frames, vertices, faces), frames (first,
attempts, alarms, hausdorff, hausdorff_mean, turned_percent, conformal, dropped_percent),
hausdorff_percent, hausdorff_mean_percent.

Examples:
  anicodec massage transfer 'scan_*.obj' -o fitted.pc2
  anicodec massage transfer 'scan_*.obj' --vertices 20% -o fitted.pc2)";

struct TransferCommand {
  std::vector<std::string> inputs;
  std::string output, vertices;
};

/// "fitted.pc2" as "fitted_2.pc2".
std::string numbered(const std::string& path, size_t number) {
  const std::filesystem::path name(path);
  return (name.parent_path() /
          fmt::format("{}_{}{}", name.stem().string(), number, name.extension().string()))
      .string();
}

void run(const TransferCommand& command, const CommonOptions& common) {
  ProgressLine line(common.quiet);
  WriteOptions write_options;
  write_options.overwrite = common.overwrite;
  write_options.progress = line.callback();
  std::optional<Count> vertices;
  if (!command.vertices.empty())
    vertices = parse_count(command.vertices, "--vertices");
  const TransferredInput input = transfer_inputs(command.inputs, line.callback(), vertices);
  const std::vector<TransferSegment>& segments = input.result.segments;
  std::vector<std::string> names;
  for (size_t s = 0; s < segments.size(); ++s) {
    names.push_back(segments.size() > 1 ? numbered(command.output, s + 1) : command.output);
    check_sequence_output(names[s], segments[s].sequence.frame_count, write_options);
  }
  for (size_t s = 0; s < segments.size(); ++s) {
    write_options.first_number = segments[s].first_frame;
    write_sequence(names[s], segments[s].sequence, write_options);
  }
  line.clear();
  const SurfaceChange change = input.change();
  const double diagonal = input.result.diagonal;
  if (common.json) {
    nlohmann::ordered_json json;
    json["files"] = nlohmann::ordered_json::array();
    for (size_t s = 0; s < segments.size(); ++s)
      json["files"].push_back({{"file", names[s]},
                               {"first_frame", segments[s].first_frame},
                               {"frames", segments[s].sequence.frame_count},
                               {"vertices", segments[s].sequence.vertex_count},
                               {"faces", segments[s].sequence.polygons.size()}});
    json["frames"] = nlohmann::ordered_json::array();
    for (const TransferredFrame& frame : input.result.frames)
      json["frames"].push_back({{"first", frame.first},
                                {"attempts", frame.attempts},
                                {"alarms", alarm_names(frame.alarms)},
                                {"hausdorff", frame.max},
                                {"hausdorff_mean", frame.mean},
                                {"turned_percent", frame.turned},
                                {"conformal", frame.conformal},
                                {"dropped_percent", frame.dropped}});
    json["hausdorff_percent"] = 100 * change.max / diagonal;
    json["hausdorff_mean_percent"] = 100 * change.mean / diagonal;
    print_json(json);
    return;
  }
  for (size_t s = 1; s < segments.size(); ++s)
    fmt::print(stderr, "anicodec: a new segment begins with {}\n",
               input.reason(segments[s].first_frame));
  if (common.quiet)
    return;
  for (size_t s = 0; s < segments.size(); ++s)
    print_line("{}: frames {} to {} of {} vertices", names[s], segments[s].first_frame,
               segments[s].first_frame + segments[s].sequence.frame_count - 1,
               segments[s].sequence.vertex_count);
  fmt::print("{:.3g} % of the diagonal from the input on average, {:.3g} % at most\n",
             100 * change.mean / diagonal, 100 * change.max / diagonal);
}

}  // namespace

void add_massage_transfer(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<TransferCommand>();
  Options& options = add_command(
      commands, common, kForce | kQuiet | kThreads | kJson,
      {"massage transfer", "MESH... -o OUT [options]",
       "Give meshes of different faces the faces of the first one", kMassageTransferFooter},
      [c, &common] { run(*c, common); });
  options.arguments("MESH", c->inputs, "Meshes in the order of time, or a quoted pattern")
      .required();
  options.option("-o,--output", c->output, "OUT", output_names()).required();
  options.option("--vertices", c->vertices, "N",
                 "Vertices to carry, or a share such as 25% (default: those of the first mesh)");
}

}  // namespace anicodec::tools
