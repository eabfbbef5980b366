// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "codec/transfer/mesh_map.h"
#include "tools/inputs/mesh_input.h"
#include "tools/inputs/number_rows.h"
#include "tools/io/file_formats.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/write_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/progress_line.h"
#include "tools/words/word_table.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kMassageMapFooter =
    R"(Maps mesh A to the surface of B with little distortion, and writes the shape of B with the faces of
A (cross-parametrisation, thesis section 3.3.3). The faces of B may be any.

--landmarks names a text file: a line for each landmark with a vertex of A and the vertex of B that
it belongs to, counted from 0; # begins a comment. At least three that are not on a line. Without
landmarks A and B must lie over each other.

The result has the texture coordinates and materials of A, whose faces it has; --details b gives it
those of B, and its colours and other numbers, by the map: a texture of B then lies on A as on B. A
face of A that lies across a seam of B takes its corners from both sides of it. --map writes the
map: for each vertex of A, in order, a line with three vertices of B, counted from 0, and their
weights.

Distortion compares each triangle of A with its image, before and after the map is improved:
conformal (of its angles) and area, 1 if nothing changes, means weighted by area.

--json prints one object: file, vertices, faces, converged, turned (triangles), before and after:
conformal_mean, conformal_max, area_mean, area_max; hausdorff, hausdorff_percent, hausdorff_mean,
hausdorff_mean_percent (between the result and B).

Examples:
  anicodec massage map sphere.obj egg.obj -o egg_of_sphere.obj
  anicodec massage map horse.obj camel.obj --landmarks pairs.txt -o camel_of_horse.obj)";

/// Whose texture coordinates, colours and materials the result has.
enum class MapDetails { kMesh, kSurface };
constexpr Word<MapDetails> kMapDetails[] = {{MapDetails::kMesh, "a"}, {MapDetails::kSurface, "b"}};

struct MapCommand {
  std::string mesh, surface, landmarks, output, map;
  MapDetails details = MapDetails::kMesh;
};

/// A line for each vertex of A: three vertices of B and their weights.
void write_map(const std::string& path, const Polygons& surface, const MeshMap& map,
               const CommonOptions& common) {
  std::string text = "# vertex of A by vertex: three vertices of B, and the weight of each\n";
  for (const MeshPoint& point : map.points) {
    for (const uint32_t corner : point.corners)
      text += fmt::format("{} ", surface.corners[corner]);
    text +=
        fmt::format("{:.9g} {:.9g} {:.9g}\n", point.weights[0], point.weights[1], point.weights[2]);
  }
  AtomicFile file(path, common.overwrite);
  file.write(text);
  file.commit();
}

/// "12 40" on every line.
std::vector<VertexPair> read_landmarks(const std::string& path) {
  std::vector<VertexPair> pairs;
  for (const NumberRow& row : read_number_rows(path)) {
    auto is_vertex = [](double x) { return x >= 0 && x <= UINT32_MAX && x == std::floor(x); };
    if (row.numbers.size() != 2 || !is_vertex(row.numbers[0]) || !is_vertex(row.numbers[1]))
      throw Error(ErrorKind::kInput,
                  fmt::format("{}:{}: a landmark is a vertex of A and one of B", path, row.line));
    pairs.push_back({static_cast<uint32_t>(row.numbers[0]), static_cast<uint32_t>(row.numbers[1])});
  }
  if (pairs.empty())
    throw Error(ErrorKind::kInput, path + ": holds no landmarks");
  return pairs;
}

nlohmann::ordered_json json_of(const Distortion& d) {
  return {{"conformal_mean", d.conformal_mean},
          {"conformal_max", d.conformal_max},
          {"area_mean", d.area_mean},
          {"area_max", d.area_max}};
}

nlohmann::ordered_json json_of(const std::string& file, const MeshSequence& result,
                               const MeshMap& map) {
  nlohmann::ordered_json json;
  json["file"] = file;
  json["vertices"] = result.vertex_count;
  json["faces"] = result.polygons.size();
  json["converged"] = map.converged;
  json["turned"] = map.turned;
  json["before"] = json_of(map.before);
  json["after"] = json_of(map.after);
  json["hausdorff"] = map.distance.max();
  json["hausdorff_percent"] = 100 * map.distance.max() / map.diagonal;
  json["hausdorff_mean"] = map.distance.mean();
  json["hausdorff_mean_percent"] = 100 * map.distance.mean() / map.diagonal;
  return json;
}

void print_text(const std::string& file, const MeshMap& map) {
  print_line("{}: {:.3g} % of the diagonal from the surface on average, {:.3g} % at most", file,
             100 * map.distance.mean() / map.diagonal, 100 * map.distance.max() / map.diagonal);
  fmt::print("{:<10} {:>10} {:>10} {:>10} {:>10}\n", "distortion", "conformal", "largest", "area",
             "largest");
  auto print_row = [](const char* name, const Distortion& d) {
    fmt::print("{:<10} {:>10.4f} {:>10.4f} {:>10.4f} {:>10.4f}\n", name, d.conformal_mean,
               d.conformal_max, d.area_mean, d.area_max);
  };
  print_row("before", map.before);
  print_row("after", map.after);
  if (map.turned > 0)
    fmt::print("{} triangles face against the surface\n", map.turned);
}

void run(const MapCommand& command, const CommonOptions& common) {
  ProgressLine line(common.quiet);
  const MeshSequence mesh = load_mesh(command.mesh, line.callback());
  const MeshSequence surface = load_mesh(command.surface, line.callback());
  std::vector<VertexPair> landmarks;
  if (!command.landmarks.empty())
    landmarks = read_landmarks(command.landmarks);
  WriteOptions write_options;
  write_options.overwrite = common.overwrite;
  check_sequence_output(command.output, 1, write_options);
  line.show("mapping", 0);
  MeshMap map;
  try {
    map = map_mesh(surface_of(mesh), surface_of(surface), landmarks);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{} and {}: {}", command.mesh, command.surface, e.what()));
  }
  MeshSequence result = with_positions(mesh, map.positions);
  if (command.details == MapDetails::kSurface)
    carry_details(surface, map, &result);
  if (!command.map.empty())
    write_map(command.map, surface.polygons, map, common);
  write_sequence(command.output, result, write_options);
  line.clear();
  if (common.json)
    print_json(json_of(command.output, result, map));
  else if (!common.quiet)
    print_text(command.output, map);
}

}  // namespace

void add_massage_map(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<MapCommand>();
  Options& options = add_command(
      commands, common, kForce | kQuiet | kThreads | kJson,
      {"massage map", "A B -o OUT [options]", "Give mesh A the shape of mesh B", kMassageMapFooter},
      [c, &common] { run(*c, common); });
  options.argument("A", c->mesh, "The mesh whose faces are kept").required();
  options.argument("B", c->surface, "The mesh whose shape is taken").required();
  options.option("-o,--output", c->output, "OUT", mesh_names()).required();
  options.option("--map", c->map, "FILE", "Write the map as text");
  options.choice("--details", c->details, {kMapDetails},
                 "Whose texture coordinates, colours and materials the result has (default a)");
  options.option("--landmarks", c->landmarks, "FILE", "Vertices of A and B that belong together");
}

}  // namespace anicodec::tools
