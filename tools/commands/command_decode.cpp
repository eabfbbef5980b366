// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "tools/inputs/clip_input.h"
#include "tools/inputs/played_clip.h"
#include "tools/inputs/turned_axes.h"
#include "tools/io/file_formats.h"
#include "tools/io/files/name_pattern.h"
#include "tools/io/gltf/gltf_format.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/names.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"
#include "tools/words/word_table.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr const char* kDecodeFooter =
    R"(OUT is a vertex cache (clip.pc2, clip.mdd; the mesh is written beside it as clip.obj), a file per
frame (dir/frame_%04d.obj, .ply, .off, .stl), a scene (clip.glb) with a morph target for each frame
and an animation of their weights, or an Alembic archive (clip.abc) with an object for each mesh,
shown in its frames, and for each of its topologies. Polygons come back as polygons, but for STL and
GLB, which have triangles. GLB, Alembic and frames of OBJ are turned to Y up, and GLB is scaled to
metres, where the clip says which axis is up and what its unit is; a cache and the mesh beside it
keep the axes of the clip, so that the cache fits the mesh that it came from (--up turns both).
Frames are counted from 0; A:B is A to B - 1, both may be left out, and A alone is one frame. A rate
that STEP divides is divided; PC2 carries no rate. A clip whose topology changes needs a file per
frame, or .abc. Frames that show no mesh have no file of their own; other outputs hold them, at most
a million of them. OUT may be a stage of USD (.usd .usda .usdc .usdz) if pip has installed
'anicodec[usd]', or a result of a simulation (.pvd .vtkhdf .xdmf .npz) with 'anicodec[vtk]':
anicodec decode -o x.usd --help.

Examples:
  anicodec decode clip.anic -o clip.pc2
  anicodec decode clip.anic -o frames/frame_%04d.ply --frames 0:100:2
  anicodec decode clip.anic -o clip.glb --textures scene.glb
  anicodec decode clip.anic -o clip.abc --normals
  anicodec decode clip.anic -o first.obj --frames 0
  anicodec decode *.anic --format glb -o decoded)";

constexpr Word<std::string_view> kFormats[] = {{"pc2", "pc2"}, {"mdd", "mdd"}, {"abc", "abc"},
                                               {"glb", "glb"}, {"obj", "obj"}, {"ply", "ply"},
                                               {"off", "off"}, {"stl", "stl"}};

struct DecodeCommand {
  std::vector<std::string> inputs;
  std::string output, clip, frames, quality, textures;
  std::string_view format;
  uint32_t start = 0;
  UpAxis up = UpAxis::kUnknown;
  bool ascii = false, hold = false, normals = false;
};

/// Timing of every step-th frame of a clip.
void take_frames(const FrameRange& range, MeshSequence& clip) {
  if (clip.times.empty()) {
    clip.start_time += range.first / clip.rate.value();
    if (range.step > 1 && clip.rate.denominator <= UINT32_MAX / range.step)
      clip.rate.denominator *= range.step;
  } else {
    std::vector<double> times;
    for (uint32_t i = 0; i < range.size(); ++i)
      times.push_back(clip.times[range.first + i * range.step] - clip.times[range.first]);
    clip.start_time += clip.times[range.first];
    clip.times = std::move(times);
  }
  clip.frame_count = range.size();
}

bool is_written_by_frame(const std::string& path) {
  return output_format(path).frame_writer != nullptr;
}

/// Frames that are written together, and the meshes that they show.
struct DecodeRun {
  FrameRange frames;
  std::vector<uint32_t> meshes;
};

/// Some frames of a clip, cut where what they show changes; those that show nothing are left out.
std::vector<DecodeRun> runs_of(const PlayedClip& clip, const FrameRange& range) {
  struct Change {
    uint32_t at, mesh;  // number in the range
    bool appears;
  };

  std::vector<Change> changes;
  for (uint32_t m : clip.meshes()) {
    for (const FrameRun& run : runs_in(clip.present_in(m), range)) {
      changes.push_back({run.first, m, true});
      changes.push_back({run.first + run.count, m, false});
    }
  }
  std::ranges::sort(changes, {}, &Change::at);
  std::vector<DecodeRun> runs;
  std::set<uint32_t> shown;
  for (size_t i = 0; i < changes.size(); ++i) {
    const auto& [at, mesh, appears] = changes[i];
    if (appears)
      shown.insert(mesh);
    else
      shown.erase(mesh);
    if (shown.empty() || changes[i + 1].at == at)
      continue;
    const uint32_t last = changes[i + 1].at - 1;
    runs.push_back(
        {{range.first + at * range.step, range.first + last * range.step + 1, range.step},
         {shown.begin(), shown.end()}});
  }
  return runs;
}

/// The source and the goal of a clip.
struct DecodePaths {
  std::string input, output;
};

/// The output of one of several clips: in a folder by its name, frames in a folder of their own.
std::string output_in(const std::string& folder, const std::string& input,
                      std::string_view format) {
  const std::filesystem::path stem =
      std::filesystem::path(folder) / std::filesystem::path(input).stem();
  const std::string clip = fmt::format("{}.{}", stem.string(), format);
  return is_written_by_frame(clip) ? fmt::format("{}/frame_%04d.{}", stem.string(), format) : clip;
}

/// Writes each mesh of a clip as it is there.
Written write_archive(const DecodePaths& paths, const PlayedClip& clip, const FrameRange& range,
                      const WriteOptions& options) {
  MeshSequence timing = clip.describe(clip.meshes());
  if (range.size() < clip.frame_count())
    take_frames(range, timing);
  std::vector<AlembicTrack> tracks;
  for (uint32_t m : clip.meshes()) {
    AlembicTrack track;
    track.present_in = runs_in(clip.present_in(m), range);
    if (track.present_in.empty())
      continue;
    track.mesh = clip.describe({m});
    track.frames = [all = clip.play({m}), range](uint32_t f) {
      return all(range.first + f * range.step);
    };
    if (auto attributes = clip.play_attributes({m}))
      track.attributes = [attributes, range](uint32_t f) {
        return attributes(range.first + f * range.step);
      };
    tracks.push_back(std::move(track));
  }
  write_tracks(paths.output, timing, tracks, options);
  return {paths.output, timing.frame_count, timing.vertex_count, timing.polygons.size()};
}

void decode(const DecodeCommand& command, const DecodePaths& paths, const CommonOptions& common) {
  const bool by_frame = is_written_by_frame(paths.output);
  ProgressLine line(common.quiet);
  std::string bytes = read_bytes(paths.input);
  const double quality = command.quality.empty() ? 1 : parse_share(command.quality, "--quality");
  PlayedClip clip(paths.input, view_of(bytes), Topologies::kAny, quality);
  if (quality == 1)
    clip.verify();
  // A GLB has an animation for each.
  const bool together = is_scene_output(paths.output) && command.clip.empty();
  clip.choose(together ? "all" : command.clip);
  bytes = {};

  FrameRange range{0, clip.frame_count(), 1};
  if (!command.frames.empty())
    range = parse_frames(command.frames, "--frames", clip.frame_count());
  WriteOptions options;
  options.overwrite = common.overwrite;
  options.ascii = command.ascii;
  options.step = command.hold;
  options.normals = command.normals;
  options.group_faces = clip.order() != ANIC_ORDER_ALL;
  options.progress = line.callback();
  const UpAxis up = clip.up();
  const AxisTurn turn(up, up_of_output(paths.output, up, command.up));
  std::vector<GltfImage> images;
  if (!command.textures.empty()) {
    if (!is_scene_output(paths.output))
      throw Error(ErrorKind::kUsage, "--textures: images are put into .glb alone");
    if (!carries_clip(command.textures))
      throw Error(ErrorKind::kUsage, command.textures + ": is no glTF scene");
    images = load_images(command.textures);
    options.images = &images;
  }
  std::vector<DecodeRun> runs{{range, clip.meshes()}};
  if (by_frame)
    runs = runs_of(clip, range);
  else
    clip.check_empty_frames(range);
  const auto number_of = [&](const FrameRange& own) {
    return command.start + (own.first - range.first) / range.step;
  };
  if (runs.size() > 1 && !parse_name_pattern(paths.output).has_number)
    check_sequence_output(paths.output, range.size(), options);  // says so
  for (const DecodeRun& run : runs) {
    options.first_number = number_of(run.frames);
    check_sequence_output(paths.output, run.frames.size(), options);
  }
  if (output_format(paths.output).write_tracks) {
    const Written written = write_archive(paths, clip, range, options);
    line.clear();
    return print_written(written, common);
  }
  if (!by_frame && clip.takes_turns())
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: has one mesh, but {} has {} that take turns; write a file per "
                            "frame, as in frame_%04d.obj, or .abc",
                            paths.output, paths.input, clip.meshes().size()));
  std::vector<Written> written;
  for (const auto& [own, meshes] : runs) {
    MeshSequence description = clip.describe(meshes);
    if (own.size() < clip.frame_count())
      take_frames(own, description);
    else if (is_scene_output(paths.output) && clip.clips().size() > 1)
      description.clips = clip.timings();
    options.first_number = number_of(own);
    turn.turn(description.attributes);
    description.origin = turn.turned(description.origin);
    FrameSource all = turn.turned(clip.play(meshes));
    options.attributes = {};
    if (auto attributes = clip.play_attributes(meshes))
      options.attributes = [attributes = turn.turned(attributes), frames = own](uint32_t f) {
        return attributes(frames.first + f * frames.step);
      };
    write_sequence(
        paths.output, description,
        [&all, frames = own](uint32_t f) { return all(frames.first + f * frames.step); }, options);
    written.push_back({paths.output, description.frame_count, description.vertex_count,
                       description.polygons.size(),
                       keeps_origin(paths.output, command.ascii) ? Point() : description.origin,
                       list_formats([](const FileFormat& f) { return f.has_room_for_origin; })});
  }
  line.clear();
  for (const Written& run : written)
    print_written(run, common);
  if (turn.turns() && !common.quiet && !common.json)
    print_line("turned from {} up to {} up; --up {} keeps the axes of the clip", name_of(up),
               up == UpAxis::kZ ? "y" : "z", name_of(up));
}

void run(const DecodeCommand& command, const CommonOptions& common) {
  if (command.format.empty()) {
    if (command.inputs.size() > 1)
      throw Error(ErrorKind::kUsage,
                  fmt::format("decode: {} files need --format, and a folder as output",
                              command.inputs.size()));
    return decode(command, {command.inputs[0], command.output}, common);
  }
  std::map<std::string, std::string> outputs;  // and what they come from
  for (const std::string& input : command.inputs) {
    const auto [other, is_new] =
        outputs.emplace(output_in(command.output, input, command.format), input);
    if (!is_new)
      throw Error(ErrorKind::kUsage, fmt::format("{}: would be written to {}, and so would {}",
                                                 input, other->first, other->second));
  }
  run_for_each(command.inputs, common, [&](const std::string& input) {
    decode(command, {input, output_in(command.output, input, command.format)}, common);
  });
}

}  // namespace

void add_decode(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<DecodeCommand>();
  Options& options = add_command(commands, common, kForce | kQuiet | kJson,
                                 {"decode", "FILE.anic... -o OUT [options]",
                                  "Decode .anic files to mesh sequences", kDecodeFooter},
                                 [c, &common] { run(*c, common); });
  options.arguments("FILE", c->inputs, "The .anic file to read; several with --format").required();
  options.option("-o,--output", c->output, "OUT", output_names()).required();
  options.choice("--format", c->format, {kFormats},
                 "Write each clip in this format to the folder OUT, by its name");
  options.option(
      "--clip", c->clip, "NAME",
      "The clip to write, of a file that has several; all: one after the other, at the rate "
      "of the first; GLB has an animation for each (default: all of them)");
  options.choice(
      "--up", c->up, {kUpAxes},
      "Axis that points up in frames and caches, of a clip that knows its own (default: y "
      "in OBJ frames, else that of the clip)");
  options.option("--frames", c->frames, "A:B[:STEP]",
                 "Frames A to B - 1, every STEP-th (default: all)");
  options.number("--start", c->start, "N", {}, "Number of the first file (default 0)");
  options.flag("--hold", c->hold, "GLB: hold each frame until the next, without in-betweens");
  options.option("--textures", c->textures, "SCENE.glb",
                 "GLB: put in the images of this scene that materials name");
  options.flag("--normals", c->normals, "Alembic: normals of every corner in every frame");
  options.flag("--ascii", c->ascii, "PLY and STL as text");
  options.option("--quality", c->quality, "Q", "Share of the components to use, above 0 to 1");
}

}  // namespace anicodec::tools
