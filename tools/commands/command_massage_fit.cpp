// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "codec/transfer/remesh_fit.h"
#include "tools/inputs/mesh_input.h"
#include "tools/io/file_formats.h"
#include "tools/io/write_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/fit_table.h"
#include "tools/words/progress_line.h"

#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kMassageFitFooter =
    R"(Moves the vertices of MESH so that it lies closer to SURFACE, a mesh of any faces. The faces
stay the same, with their texture coordinates and materials. If no closer position is found the mesh
is written as it was. One of the two may be closed where the other has a small opening, such as a
slit that a decimater has filled: up to a twentieth of the diagonal, which is told.

--json prints one object: file, vertices, faces, improved, before and after: hausdorff,
hausdorff_percent, hausdorff_mean, hausdorff_mean_percent, radius_ratio, turned.

Example:
  anicodec massage fit coarse.obj fine.obj -o fitted.obj)";

struct FitCommand {
  std::string mesh, surface, output;
};

void run(const FitCommand& command, const CommonOptions& common) {
  ProgressLine line(common.quiet);
  const MeshSequence mesh = load_mesh(command.mesh, line.callback());
  const SurfaceFrame surface = surface_of(load_mesh(command.surface, line.callback()));
  WriteOptions write_options;
  write_options.overwrite = common.overwrite;
  check_sequence_output(command.output, 1, write_options);
  line.show("fitting", 0);
  RemeshFit fit;
  try {
    fit = fit_remesh(surface_of(mesh), surface);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{} and {}: {}", command.mesh, command.surface, e.what()));
  }
  const MeshSequence result = with_positions(mesh, fit.positions);
  write_sequence(command.output, result, write_options);
  line.clear();
  if (common.json) {
    nlohmann::ordered_json json;
    json["file"] = command.output;
    json["vertices"] = result.vertex_count;
    json["faces"] = result.polygons.size();
    add_fit(fit, &json);
    print_json(json);
  } else if (!common.quiet) {
    if (!fit.improved)
      print_line("{}: no closer position was found, the mesh is as it was", command.output);
    print_fit(fit);
  }
}

}  // namespace

void add_massage_fit(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<FitCommand>();
  Options& options = add_command(commands, common, kForce | kQuiet | kThreads | kJson,
                                 {"massage fit", "MESH SURFACE -o OUT [options]",
                                  "Lay a coarse mesh on a fine surface", kMassageFitFooter},
                                 [c, &common] { run(*c, common); });
  options.argument("MESH", c->mesh, "The mesh to move").required();
  options.argument("SURFACE", c->surface, "The surface to lie on").required();
  options.option("-o,--output", c->output, "OUT", mesh_names()).required();
}

}  // namespace anicodec::tools
