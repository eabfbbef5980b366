// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/remesh.h"
#include "codec/sequence/error.h"
#include "tools/inputs/mesh_input.h"
#include "tools/io/file_formats.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/fit_table.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"
#include "tools/words/word_table.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kMassageRemeshFooter =
    R"(Gives a mesh another number of vertices, then moves them to where the new mesh lies closest to
the surface. Fewer vertices are a part of the old ones, large triangles where the surface is flat
(decimate). More vertices cover the surface with triangles of equal size (isotropic), which keeps
boundaries and edges of 60 degrees and more. --method loop smooths by Loop subdivision, then
decimates to the number.

The result is made of triangles and has no attributes, materials and objects; what of them the mesh
has is told. Triangles without area at a repeated vertex are left out. An edge of more than two
faces, or of two faces wound in opposite ways, is refused.

--json prints one object: file, method, vertices, faces, degenerate, repeated (triangles left out),
parted (vertices added where faces touched in one only), left_out, improved, before and after:
hausdorff, hausdorff_percent, hausdorff_mean, hausdorff_mean_percent, radius_ratio, turned.

Examples:
  anicodec massage remesh horse.obj --vertices 10% -o coarse.obj
  anicodec massage remesh horse.obj --max-distance 0.2% -o coarse.obj
  anicodec massage remesh scan.ply --vertices 20000 --method isotropic -o even.ply)";

constexpr Word<RemeshMethod> kMethods[] = {{RemeshMethod::kAuto, "auto"},
                                           {RemeshMethod::kDecimate, "decimate"},
                                           {RemeshMethod::kIsotropic, "isotropic"},
                                           {RemeshMethod::kLoop, "loop"}};

struct RemeshCommand {
  std::string mesh, output, vertices, distance;
  RemeshMethod method = RemeshMethod::kAuto;
  bool no_fit = false;
};

/// Names of what the mesh has and the result has not.
std::vector<std::string> left_out(const MeshSequence& mesh) {
  std::vector<std::string> words;
  for (const Attribute& attribute : mesh.attributes)
    words.push_back(fmt::format("attribute '{}'", attribute.name));
  if (!mesh.materials.names.empty())
    words.emplace_back("materials");
  if (!mesh.parts.names.empty())
    words.emplace_back("objects");
  return words;
}

RemeshOptions options_for(const RemeshCommand& command, const MeshSequence& mesh) {
  RemeshOptions options;
  options.method = command.method;
  options.fit = !command.no_fit;
  if (!command.vertices.empty())
    options.vertices = parse_count(command.vertices, "--vertices").of(mesh.vertex_count);
  if (!command.distance.empty()) {
    const Length length = parse_length(command.distance, "--max-distance")
                              .in_scene_units(mesh.metres_per_unit, "--max-distance");
    options.max_distance = length.percent ? length.value / 100 * diagonal(mesh) : length.value;
    if (options.method == RemeshMethod::kAuto)
      options.method = RemeshMethod::kDecimate;
  }
  if (options.vertices == 0 && options.max_distance == 0)
    throw Error(ErrorKind::kUsage, "massage remesh: --vertices N or --max-distance LEN is needed");
  if (options.max_distance > 0 && options.method != RemeshMethod::kDecimate)
    throw Error(ErrorKind::kUsage, "--max-distance goes with --method decimate");
  return options;
}

void print_text(const RemeshCommand& command, const RemeshOptions& options,
                const RemeshResult& result) {
  const size_t vertices = result.mesh.positions.size() / 3;
  const size_t triangles = result.mesh.polygons.size();
  print_line("{}: {} vertices and {} triangle{} ({})", command.output, grouped(vertices),
             grouped(triangles), triangles == 1 ? "" : "s", word_of(kMethods, result.method));
  if (options.vertices > 0 && vertices != options.vertices && options.max_distance == 0)
    fmt::print("the shape does not allow {} vertices\n", grouped(options.vertices));
  const MeshRepairs& repairs = result.repairs;
  if (repairs.any())
    fmt::print("left out: degenerate triangles: {}, repeated ones: {}; vertices parted: {}\n",
               repairs.degenerate, repairs.repeated, repairs.parted);
  if (!result.no_fit.empty())
    print_line("not fitted: {}", result.no_fit);
  print_fit(result.fit);
}

nlohmann::ordered_json json_of(const RemeshCommand& command, const RemeshResult& result,
                               const std::vector<std::string>& lost) {
  nlohmann::ordered_json json;
  json["file"] = command.output;
  json["method"] = word_of(kMethods, result.method);
  json["vertices"] = result.mesh.positions.size() / 3;
  json["faces"] = result.mesh.polygons.size();
  json["degenerate"] = result.repairs.degenerate;
  json["repeated"] = result.repairs.repeated;
  json["parted"] = result.repairs.parted;
  json["left_out"] = lost;
  add_fit(result.fit, &json);
  return json;
}

void run(const RemeshCommand& command, const CommonOptions& common) {
  ProgressLine line(common.quiet);
  LoadOptions load_options;
  load_options.progress = line.callback();
  const MeshSequence mesh = load_sequence({&command.mesh, 1}, load_options);
  if (mesh.frame_count != 1)
    throw Error(ErrorKind::kUsage, fmt::format("{}: one mesh is remeshed, not {} frames",
                                               command.mesh, mesh.frame_count));
  const RemeshOptions options = options_for(command, mesh);
  WriteOptions write_options;
  write_options.overwrite = common.overwrite;
  check_sequence_output(command.output, 1, write_options);
  RemeshResult result;
  try {
    result = remesh({mesh.polygons, mesh.positions}, options, line.callback());
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", command.mesh, e.what()));
  }
  write_sequence(command.output, single_frame(result.mesh), write_options);
  line.clear();
  const std::vector<std::string> lost = left_out(mesh);
  if (common.json) {
    print_json(json_of(command, result, lost));
  } else if (!common.quiet) {
    if (!lost.empty())
      print_line(stderr, "anicodec: {}: left out: {}", command.mesh, fmt::join(lost, ", "));
    print_text(command, options, result);
  }
}

}  // namespace

void add_massage_remesh(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<RemeshCommand>();
  Options& options =
      add_command(commands, common, kForce | kQuiet | kThreads | kJson,
                  {"massage remesh", "MESH -o OUT [options]",
                   "Give a mesh fewer, more or even triangles", kMassageRemeshFooter},
                  [c, &common] { run(*c, common); });
  options.argument("MESH", c->mesh, "The mesh, whose surface is kept").required();
  options.option("-o,--output", c->output, "OUT", mesh_names()).required();
  options.option("--vertices", c->vertices, "N", "How many vertices, or a share such as 25%");
  options.option("--max-distance", c->distance, "LEN",
                 "Decimate only as far as removed vertices stay so close to the new mesh, before "
                 "it is fitted");
  options.choice("--method", c->method, {kMethods},
                 "How: auto is decimate for fewer vertices and isotropic for more (default auto)");
  options.flag("--no-fit", c->no_fit, "Leave the vertices where the method puts them");
}

}  // namespace anicodec::tools
