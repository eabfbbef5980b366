// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/massage.h"
#include "codec/massage/massage_quality.h"
#include "codec/metrics/hausdorff.h"
#include "codec/sequence/error.h"
#include "tools/io/file_formats.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kMassageFooter =
    R"(Moves the vertices of every frame along its surface until the triangles have the shapes that they
have in the first frame, or the one of --reference, and then denoises the frames: captured vertices
that slide over the body come to rest, and the clip codes smaller. Faces and frames stay the same.
The surface moves a little; the command measures by how much, as the Hausdorff distance between each
frame and its result. OUT is a vertex cache or frame files, as for decode.

--json prints one object: file, vertices, faces, frames, hausdorff, hausdorff_percent,
hausdorff_frame, hausdorff_mean, hausdorff_mean_percent, converged (frames), drawn_back (vertices,
by --massage-tolerance or because a triangle turned), before and after: conformal_mean, area_mean,
radius_ratio, turned.

Examples:
  anicodec massage capture.obj capture.pc2 -o massaged.pc2
  anicodec massage 'frames/*.ply' -o out/frame_%04d.ply --massage-tolerance 0.2%)";

struct MassageCommand {
  std::vector<std::string> inputs;
  std::string output, mesh, tolerance;
  double strength = 0.5;
  uint32_t reference = 0;
};

struct Counted {
  uint32_t converged = 0;
  uint64_t drawn_back = 0;
};

Counted count(const MassageResult& result, uint32_t reference) {
  Counted counted;
  for (size_t f = 0; f < result.frames.size(); ++f) {
    const MassagedFrame& frame = result.frames[f];
    counted.converged += f == reference || frame.sliding.converged || frame.fitting.converged;
    counted.drawn_back += frame.drawn_back;
  }
  return counted;
}

nlohmann::ordered_json json_of(const MassageQuality& quality) {
  return {{"conformal_mean", quality.distortion.conformal_mean},
          {"area_mean", quality.distortion.area_mean},
          {"radius_ratio", quality.radius_ratio},
          {"turned", quality.turned}};
}

void print_row(const char* name, const MassageQuality& q) {
  fmt::print("{:<10} {:>10.4f} {:>10.4f} {:>13.4f} {:>8}\n", name, q.distortion.conformal_mean,
             q.distortion.area_mean, q.radius_ratio, q.turned);
}

void run(const MassageCommand& command, const CommonOptions& common) {
  MassageOptions options;
  options.strength = command.strength;
  options.reference = command.reference;
  Length tolerance;
  if (!command.tolerance.empty())
    tolerance = parse_length(command.tolerance, "--massage-tolerance");
  ProgressLine line(common.quiet);
  LoadOptions load_options;
  load_options.mesh = command.mesh;
  load_options.progress = line.callback();
  const MeshSequence sequence = load_sequence(command.inputs, load_options);
  WriteOptions write_options;
  write_options.overwrite = common.overwrite;
  write_options.progress = line.callback();
  check_sequence_output(command.output, sequence.frame_count, write_options);
  tolerance = tolerance.in_scene_units(sequence.metres_per_unit, "--massage-tolerance");
  options.tolerance =
      tolerance.percent ? tolerance.value / 100 * diagonal(sequence) : tolerance.value;
  MassageResult result;
  try {
    result = massage(sequence, options, line.callback());
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", command.inputs[0], e.what()));
  }
  line.show("measuring", 0);
  const SurfaceComparison distance = compare_surfaces(sequence, result.sequence);
  const MassageQuality before = massage_quality(sequence, sequence, options.reference);
  const MassageQuality after = massage_quality(sequence, result.sequence, options.reference);
  write_sequence(command.output, result.sequence, write_options);
  line.clear();

  const Counted counted = count(result, options.reference);
  const HausdorffDistance& total = distance.total;
  if (common.json) {
    nlohmann::ordered_json json;
    json["file"] = command.output;
    json["vertices"] = sequence.vertex_count;
    json["faces"] = sequence.polygons.size();
    json["frames"] = sequence.frame_count;
    json["hausdorff"] = total.max();
    json["hausdorff_percent"] = distance.percent(total.max());
    json["hausdorff_frame"] = distance.max_frame;
    json["hausdorff_mean"] = total.mean();
    json["hausdorff_mean_percent"] = distance.percent(total.mean());
    json["converged"] = counted.converged;
    json["drawn_back"] = counted.drawn_back;
    json["before"] = json_of(before);
    json["after"] = json_of(after);
    print_json(json);
  } else if (!common.quiet) {
    fmt::print(
        "{}: {} frames of {} vertices; the surface moved by {:.3g} % of the diagonal on "
        "average, {:.3g} % at most (frame {})\n",
        command.output, sequence.frame_count, sequence.vertex_count, distance.percent(total.mean()),
        distance.percent(total.max()), distance.max_frame);
    fmt::print("{:<10} {:>10} {:>10} {:>13} {:>8}\n", "triangles", "conformal", "area",
               "radius ratio", "turned");
    print_row("before", before);
    print_row("after", after);
    if (counted.drawn_back > 0)
      fmt::print("vertices were drawn back {} times, by the tolerance or to turn no triangle\n",
                 grouped(counted.drawn_back));
    if (common.verbosity > 0) {
      fmt::print("{} of {} frames still moved in their last round\n",
                 sequence.frame_count - counted.converged, sequence.frame_count);
      fmt::print("frame  slide rounds  step  fit rounds    step   reverted     mean %    max %\n");
      for (size_t f = 0; f < result.frames.size(); ++f) {
        const MassagedFrame& frame = result.frames[f];
        fmt::print("{:>5} {:>12} {:>6.3f} {:>14} {:>6.3f} {:>11} {:>8.4f} {:>8.4f}\n", f,
                   frame.sliding.rounds, frame.sliding.step, frame.fitting.rounds,
                   frame.fitting.step, frame.drawn_back,
                   distance.percent(distance.frames[f].mean()),
                   distance.percent(distance.frames[f].max()));
      }
    }
  }
}

}  // namespace

void add_massage(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<MassageCommand>();
  Options& options =
      add_command(commands, common, kForce | kQuiet | kVerbose | kThreads | kJson,
                  {"massage", "INPUT... -o OUT [options]",
                   "Bring vertices that slide over a surface to rest", kMassageFooter},
                  [c, &common] { run(*c, common); });
  options.arguments("INPUT", c->inputs, "As for encode").required();
  options.option("-o,--output", c->output, "OUT", output_names()).required();
  options.option("--mesh", c->mesh, "FILE",
                 "Mesh of a lone vertex cache (default: same stem beside it)");
  options.number("--massage-strength", c->strength, "X", {},
                 "Weight of shape against distance, between 0 and 1 (default 0.5)");
  options.option("--massage-tolerance", c->tolerance, "LEN",
                 "How far the surface may move anywhere (default: as far as it needs)");
  options.number("--reference", c->reference, "FRAME", {},
                 "Frame whose shapes are followed (default 0)");
}

}  // namespace anicodec::tools
