// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/interpolation.h"
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "tools/inputs/interpolation_input.h"
#include "tools/io/file_formats.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/write_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/report/interpolation_study.h"
#include "tools/words/progress_line.h"

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kInterpolateFooter =
    R"(A, B, ... are meshes of the same vertices and faces: files of one frame, or one frame of a clip
as FILE@FRAME (clip.pc2@12, clip.anic@0, 'frames/*.obj@5'). The clip goes from A to B and on to the
others in N equal steps. --range says from where to where, A being 0, B 1 and so on; beyond the ends
it extrapolates. --weights instead names a text file with a line for each frame and a number for
each mesh; the numbers of a line sum to 1, and may be negative.

Methods (thesis chapter 4):
  linear     vertices on straight lines
  gradients  deformation gradients, rotations by their principal logarithms
  bfs        the same, full turns tracked breadth first
  pml        tracked first where logarithms differ least
  pmln       and normals
  msgi-v     multi-scale interpolation of lengths and angles, blending vertices
  msgi       multi-scale interpolation, blending edges

--pin VERTICES=FILE (msgi only) holds vertices, such as 0,7,20-29, at the positions of a text file,
a line of three numbers for each: once for all frames, or for each frame in turn.

--refine takes steps on the lengths and angles themselves, after any method: closer to them, where a
method comes near, in about a second for each step, frame and 7000 vertices.

--compare prints how far the frames of every method are from the lengths, angles and volume that the
weights ask for, means over the frames; then -o may be left out. With --json one object before the
other: methods, for each method, length_percent, largest_length_percent, angle_degrees,
volume_percent, folded and collapsed (angles and lengths of all frames). --study PAGE.html writes
the same with pictures of up to five frames by each method, and charts of the errors by frame.

Vertices at one place in all meshes hold the mesh there for msgi, msgi-v and --refine, which know
lengths and angles alone: a base that rests stays, as far as the method keeps its shape.

Examples:
  anicodec interpolate a.obj b.obj -o between.pc2 --frame-count 25
  anicodec interpolate dance.pc2@0 dance.pc2@40 -o f_%02d.obj --frame-count 9 --range -0.5:1.5
  anicodec interpolate a.obj b.obj c.obj -o mix.pc2 --weights weights.txt --method pml
  anicodec interpolate a.obj b.obj --frame-count 9 --compare
  anicodec interpolate a.obj b.obj --frame-count 41 --range -0.5:1.5 --study methods.html)";

struct InterpolateCommand {
  std::vector<std::string> inputs;
  std::string output, mesh, weights, range, pin, study;
  uint32_t frames = 0, patch_faces = 0;
  int sweeps = -1, refine = 0;
  InterpolationMethod method = InterpolationMethod::kMsgi;
  bool compare = false;
};

/// All methods, by their words.
WordTable<InterpolationMethod> method_words() {
  static const std::vector<Word<InterpolationMethod>> kWords = [] {
    std::vector<Word<InterpolationMethod>> words;
    for (InterpolationMethod method : interpolation_methods())
      words.push_back({method, name_of(method).data()});  // a literal
    return words;
  }();
  return kWords;
}

WeightRows weights_of(const InterpolateCommand& command, size_t meshes) {
  if (!command.weights.empty()) {
    if (command.frames > 0 || !command.range.empty())
      throw Error(ErrorKind::kUsage,
                  "interpolate: --weights stands without --frame-count and --range");
    return read_weights(command.weights, meshes);
  }
  if (command.frames == 0)
    throw Error(ErrorKind::kUsage, "interpolate: --frame-count N or --weights FILE is needed");
  double first = 0, last = static_cast<double>(meshes - 1);
  if (!command.range.empty())
    std::tie(first, last) = parse_range(command.range, "--range");
  return path_weights(meshes, command.frames, first, last);
}

void compare_methods(const InterpolateCommand& command, const CommonOptions& common,
                     const MeshSequence& poses, const WeightRows& rows,
                     const InterpolationOptions& options, ProgressLine& line) {
  if (!command.pin.empty())
    throw Error(ErrorKind::kUsage, "interpolate: --compare and --study know no pins");
  std::optional<AtomicFile> page;
  if (!command.study.empty())
    page.emplace(command.study, common.overwrite);
  const InterpolationStudy study =
      study_interpolation(poses, rows, options, page.has_value(), line.callback());
  if (page) {
    page->write(interpolation_page(study, poses.name));
    page->commit();
  }
  line.clear();
  if (common.json)
    print_json(interpolation_json(study));
  else
    fmt::print("{}", interpolation_text(study));
}

void run(const InterpolateCommand& command, const CommonOptions& common) {
  if (command.inputs.size() < 2)
    throw Error(ErrorKind::kUsage, "interpolate: two meshes or more are needed");
  if (command.output.empty() && !command.compare && command.study.empty())
    throw Error(ErrorKind::kUsage, "interpolate: -o OUT is needed, --compare, or --study");
  ProgressLine line(common.quiet);
  MeshSequence poses = load_poses(command.inputs, command.mesh, line.callback());
  const WeightRows rows = weights_of(command, poses.frame_count);
  Pins pins;
  if (!command.pin.empty())
    pins = read_pins(command.pin, poses.vertex_count, rows.size());

  const std::vector<uint32_t> triangles = fan_triangles(poses.polygons);
  std::vector<std::span<const float>> inputs;
  for (uint32_t i = 0; i < poses.frame_count; ++i)
    inputs.push_back(std::as_const(poses).frame(i));
  InterpolationOptions options;
  options.method = command.method;
  options.leaf_faces = command.patch_faces;
  options.refinement_steps = command.refine;
  if (command.sweeps >= 0)
    options.sweeps = static_cast<uint32_t>(command.sweeps);
  else
    options.sweeps = pins.vertices.empty() ? 0 : 10;
  if (command.compare || !command.study.empty())
    compare_methods(command, common, poses, rows, options, line);
  if (command.output.empty())
    return;

  options.pins = pins.vertices;
  MeshSequence clip;
  clip.name = poses.name;
  static_cast<MeshDetails&>(clip) = poses;
  clip.polygons = poses.polygons;
  clip.vertex_count = poses.vertex_count;
  clip.frame_count = static_cast<uint32_t>(rows.size());
  clip.up = poses.up;
  clip.metres_per_unit = poses.metres_per_unit;
  WriteOptions write;
  write.overwrite = common.overwrite;
  write.progress = line.callback();
  check_sequence_output(command.output, clip.frame_count, write);
  line.show("setting up", 0);
  auto interpolation = make_interpolation(triangles, poses.vertex_count, inputs, options);
  write_sequence(
      command.output, clip,
      [&](uint32_t f) {
        return interpolation->evaluate(
            rows[f], pins.vertices.empty() ? std::span<const float>() : pins.at(f));
      },
      write);
  line.clear();
  print_written({command.output, clip.frame_count, clip.vertex_count, clip.polygons.size()},
                common);
}

}  // namespace

void add_interpolate(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<InterpolateCommand>();
  Options& options =
      add_command(commands, common, kForce | kQuiet | kThreads | kJson,
                  {"interpolate", "A B [C...] -o OUT --frame-count N [options]",
                   "Make a clip between meshes of one connectivity", kInterpolateFooter},
                  [c, &common] { run(*c, common); });
  options.arguments("A B", c->inputs, "The meshes").required();
  options.option("-o,--output", c->output, "OUT", output_names());
  options.number("--frame-count", c->frames, "N", {1U, (1U << 24) - 1}, "Frames to make");
  options.option("--range", c->range, "FROM:TO", "From where to where (default: A to the last)");
  options.option("--weights", c->weights, "FILE", "Weights of every frame");
  options.choice("--method", c->method, method_words(), "Default msgi");
  options.option("--pin", c->pin, "VERTICES=FILE", "Hold vertices at positions");
  options.number("--patch-faces", c->patch_faces, "N", {1, 255},
                 "Faces of a patch (msgi; default: 8 or fewer, by trial)");
  options.number("--sweeps", c->sweeps, "N", {0, 1000},
                 "Rounds of refitting the patches (default 0; 10 with --pin)");
  options.number("--refine", c->refine, "N", {0, 100},
                 "Gauss-Newton steps on lengths and angles afterwards (default 0)");
  options.option("--mesh", c->mesh, "FILE",
                 "Mesh of a vertex cache (default: same stem beside it)");
  options.flag("--compare", c->compare, "Print the errors of all methods");
  options.option("--study", c->study, "PAGE", "The same, as a page x.html with pictures");
}

}  // namespace anicodec::tools
