// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/massage.h"
#include "codec/massage/massage_quality.h"
#include "codec/metrics/hausdorff.h"
#include "codec/sequence/error.h"
#include "codec/transfer/remesh_fit.h"
#include "tools/commands/command.h"
#include "tools/inputs/massage_transfer.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kFooter =
    R"(Moves the vertices of every frame along its surface until the triangles have the shapes that they
have in the first frame, or the one of --reference, and takes out what single frames have of their
own: captured vertices that slide over the body come to rest, and the clip codes smaller. Faces and
frames stay the same; the surface moves a little, and by how much is measured: the Hausdorff
distance between each frame and what became of it. OUT is a vertex cache or frame files, as for
decode.

--fit COARSE --to FINE moves the vertices of one mesh so that it lies closer to the surface of
another. --transfer brings meshes of different faces to the faces of the first one; a frame that
cannot be followed is reported and begins a new segment with its own faces, and the segments are
written as OUT with _1, _2 ... before the extension.

--json prints one object: file, vertices, faces, frames, hausdorff, hausdorff_percent,
hausdorff_frame, hausdorff_mean, hausdorff_mean_percent, converged (frames), drawn_back (vertices,
by --massage-tolerance or because a triangle turned), before and after: conformal_mean, area_mean,
radius_ratio, turned. For --fit: file, vertices, faces, improved, before and after: hausdorff,
hausdorff_percent, hausdorff_mean, hausdorff_mean_percent, radius_ratio, turned. For --transfer:
files (file, first_frame, frames, vertices, faces), frames (first, attempts, alarms, hausdorff,
hausdorff_mean, turned_percent, conformal, dropped_percent), hausdorff_percent,
hausdorff_mean_percent.

Examples:
  anicodec massage capture.obj capture.pc2 -o massaged.pc2
  anicodec massage 'frames/*.ply' -o out/frame_%04d.ply --massage-tolerance 0.2%
  anicodec massage --fit coarse.obj --to fine.obj -o fitted.obj
  anicodec massage --transfer 'scan_*.obj' -o fitted.pc2)";

struct MassageCommand {
  std::vector<std::string> inputs;
  std::string output, mesh, tolerance, fit, to;
  bool transfer = false;
  double strength = 0.5;
  uint32_t reference = 0;
  bool json = false;
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

SurfaceFrame load_mesh(const std::string& path, const Progress& progress) {
  LoadOptions options;
  options.progress = progress;
  MeshSequence mesh = load_sequence({&path, 1}, options);
  if (mesh.frame_count != 1)
    throw Error(ErrorKind::kUsage, path + ": one mesh is fitted to one other, not a sequence");
  return {std::move(mesh.polygons), std::move(mesh.positions)};
}

nlohmann::ordered_json json_of(const HausdorffDistance& distance, double diagonal,
                               const RadiusRatio& ratio, uint32_t turned) {
  return {{"hausdorff", distance.max()},
          {"hausdorff_percent", 100 * distance.max() / diagonal},
          {"hausdorff_mean", distance.mean()},
          {"hausdorff_mean_percent", 100 * distance.mean() / diagonal},
          {"radius_ratio", ratio.mean},
          {"turned", turned}};
}

void run_fit(const MassageCommand& command, const CommonOptions& common) {
  if (command.fit.empty() || command.to.empty() || !command.inputs.empty())
    throw Error(ErrorKind::kUsage, "--fit MESH goes with --to MESH and no other input");
  ProgressLine line(common.quiet);
  const SurfaceFrame mesh = load_mesh(command.fit, line.callback());
  const SurfaceFrame surface = load_mesh(command.to, line.callback());
  WriteOptions write_options;
  write_options.overwrite = common.overwrite;
  check_sequence_output(command.output, 1, write_options);
  line.show("fitting", 0);
  RemeshFit fit;
  try {
    fit = fit_remesh(mesh, surface);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{} and {}: {}", command.fit, command.to, e.what()));
  }
  MeshSequence result;
  result.polygons = mesh.polygons;
  result.vertex_count = static_cast<uint32_t>(mesh.positions.size() / 3);
  result.frame_count = 1;
  result.positions = fit.positions;
  write_sequence(command.output, result, write_options);
  line.clear();
  if (command.json) {
    nlohmann::ordered_json json;
    json["file"] = command.output;
    json["vertices"] = result.vertex_count;
    json["faces"] = result.polygons.size();
    json["improved"] = fit.improved;
    json["before"] = json_of(fit.before, fit.diagonal, fit.ratio_before, fit.turned_before);
    json["after"] = json_of(fit.after, fit.diagonal, fit.ratio_after, fit.turned_after);
    fmt::print("{}\n", json.dump(2));
  } else if (!common.quiet) {
    if (!fit.improved)
      fmt::print("{}: no closer position was found, the mesh is as it was\n", command.output);
    fmt::print("{:<10} {:>12} {:>12} {:>13} {:>8}\n", "", "mean %", "max %", "radius ratio",
               "turned");
    auto row = [&fit](const char* name, const HausdorffDistance& d, const RadiusRatio& ratio,
                      uint32_t turned) {
      fmt::print("{:<10} {:>12.5f} {:>12.5f} {:>13.4f} {:>8}\n", name,
                 100 * d.mean() / fit.diagonal, 100 * d.max() / fit.diagonal, ratio.mean, turned);
    };
    row("before", fit.before, fit.ratio_before, fit.turned_before);
    row("after", fit.after, fit.ratio_after, fit.turned_after);
  }
}

std::string numbered(const std::string& path, size_t number) {
  const std::filesystem::path name(path);
  return (name.parent_path() /
          fmt::format("{}_{}{}", name.stem().string(), number, name.extension().string()))
      .string();
}

void run_transfer(const MassageCommand& command, const CommonOptions& common) {
  ProgressLine line(common.quiet);
  WriteOptions write_options;
  write_options.overwrite = common.overwrite;
  write_options.progress = line.callback();
  const TransferredInput input = transfer_inputs(command.inputs, line.callback());
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
  if (command.json) {
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
    fmt::print("{}\n", json.dump(2));
    return;
  }
  for (size_t s = 1; s < segments.size(); ++s)
    fmt::print(stderr, "anicodec: a new segment begins with {}\n",
               input.reason(segments[s].first_frame));
  if (common.quiet)
    return;
  for (size_t s = 0; s < segments.size(); ++s)
    fmt::print("{}: frames {} to {} of {} vertices\n", names[s], segments[s].first_frame,
               segments[s].first_frame + segments[s].sequence.frame_count - 1,
               segments[s].sequence.vertex_count);
  fmt::print("{:.3g} % of the diagonal from the input on average, {:.3g} % at most\n",
             100 * change.mean / diagonal, 100 * change.max / diagonal);
}

void run(const MassageCommand& command, const CommonOptions& common) {
  const bool fit = !command.fit.empty() || !command.to.empty();
  if (fit && command.transfer)
    throw Error(ErrorKind::kUsage, "--fit and --transfer are different things to do");
  if (fit) {
    run_fit(command, common);
    return;
  }
  if (command.inputs.empty())
    throw Error(ErrorKind::kUsage, "no input is given");
  if (command.transfer) {
    run_transfer(command, common);
    return;
  }
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
  if (command.json) {
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
    fmt::print("{}\n", json.dump(2));
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
      fmt::print("frame  slid rounds  step   fitted rounds  step   drawn back  mean %     max %\n");
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
  Options& options = add_command(
      commands, common, kForce | kQuiet | kVerbose | kThreads,
      {"massage", "[INPUT...] -o OUT [options]",
       "Move vertices along their surface, to even triangles or to other meshes", kFooter},
      [c, &common] { run(*c, common); });
  options.arguments("INPUT", c->inputs, "As for encode; for --transfer meshes in their order");
  options.option("-o,--output", c->output, "OUT", "x.pc2, x.mdd, dir/frame_%04d.obj|ply|off|stl")
      .required();
  options.option("--mesh", c->mesh, "FILE",
                 "Mesh of a lone vertex cache (default: same stem beside it)");
  options.number("--massage-strength", c->strength, "X", {},
                 "Of shape against distance, between 0 and 1 (default 0.5)");
  options.option("--massage-tolerance", c->tolerance, "LEN",
                 "How far the surface may move anywhere (default: as far as it needs)");
  options.number("--reference", c->reference, "FRAME", {},
                 "Frame whose shapes are followed (default 0)");
  options.flag("--json", c->json, "Print one JSON object");
  options.group("Other modes");
  options.option("--fit", c->fit, "MESH", "Mesh to lay on a surface");
  options.option("--to", c->to, "MESH", "The surface, a mesh of any faces");
  options.flag("--transfer", c->transfer, "Give all meshes the faces of the first one");
}

}  // namespace anicodec::tools
