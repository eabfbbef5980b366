// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"
#include "codec/sequence/error.h"
#include "tools/encoding/batch.h"
#include "tools/encoding/encode_report.h"
#include "tools/encoding/live_capture.h"
#include "tools/inputs/clip_input.h"
#include "tools/inputs/encode_arguments.h"
#include "tools/inputs/massage_transfer.h"
#include "tools/io/file_formats.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/gltf/gltf_format.h"
#include "tools/io/load_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kEncodeFooter =
    R"(INPUT is a mesh and its vertex cache (mesh.obj cache.pc2), a vertex cache with the mesh beside it or
given by --mesh, a quoted pattern ('frames/*.obj', in natural order), a list of frames of equal
connectivity, a scene, or an archive. Meshes: .obj .ply .off .stl; caches: .pc2 .mdd; scenes: .gltf
.glb .fbx .md3, and in builds with assimp .dae .md2 .3ds and others; archives: .abc (Alembic).
Stages of USD (.usd .usda .usdc .usdz) are read if pip has installed 'anicodec[usd]', results of
simulations (.pvd .vtu .vtkhdf .xdmf .case .npz and others) with 'anicodec[vtk]'; they have a help
of their own: anicodec encode x.usd --help.

INPUT - is a scene in one file or a mesh from the standard input; -o - writes the .anic file to the
standard output, and nothing else; decode, info and verify read one from -.

A scene is baked: skins, morph targets and moving nodes become vertices that move, all its meshes
(or the one of --mesh) one mesh, at --fps, from the first key of the clip to the last. Animations
that move different things are played together; several takes of the same are clips of the file.
--clip names or numbers one alone, --clip A+B plays two together, --clip none takes none, and
--clips takes some, or each by itself (all). --part, --split-objects and --massage take the first
take, and a note names the others.

Several vertex caches of one mesh are clips of one file, too: the mesh, its attributes and the
reference pose are stored once, and clips of a kind share a basis where that is smaller (-v says
which). Every clip keeps the target for itself; a --size is that of the file.

-o model.glb of a glTF scene writes the scene with its clip inside (extension ANIC_mesh_animation):
materials, textures, cameras, lights, nodes and extras stay, what moved the vertices goes, and
viewers that do not know the extension show the first frame. decode, info and verify read the clip
in such a file.

An archive has a frame for each of its samples (or at --fps); --mesh takes one mesh by its path.

--split-objects stores each object of the input (node of a scene, o of an OBJ) as a mesh with its
name. A rigid object is stored as one motion where that is smaller; an object whose vertices all lie
at one point in a frame, as those of hidden objects do, is absent from that frame.

--topology-changes keep stores frames whose faces change, as of a fluid, with a mesh for each run of
equal faces. --topology-changes transfer instead moves the faces of the first frame over the
surfaces of all others (anicodec massage transfer), for scans of one body.

--part A:B encodes some frames of a long clip, so that several machines can share the work; every
machine reads the whole clip, and join makes one file of the parts.

--live encodes a capture while it goes on: INPUT is the mesh, frames of --fps come from the standard
input. The output grows by a file every --piece seconds. anic_stream plays these files one after the
other; all other commands take them together for one clip, and join -o makes one file of them, which
seeks and opens as others do. --effort fast manages 10,000 vertices.

--batch encodes many clips to the folder -o, -j of them side by side: of a folder every scene or
stage, every vertex cache with its mesh, and every run of numbered frames, of a list a clip per
line, its inputs separated by tabs. Clips that are done already, by the content of what goes in and
comes out, are left alone; one that fails does not stop the others.

Texture coordinates, colours, other numbers, materials (values and names of images) and objects are
kept; numbers in every frame, all others as they are in the first. Normals are kept as hard edges:
they come from the positions of a frame. Other data of a scene are named as not kept.

A LEN is in scene units (0.02), in per cent of the diagonal of the box around all frames (0.05%; of
several clips each takes its own, --live takes that of --box or of the first piece, which is smaller
than that of the whole), or where the unit of the scene is known in m, cm, mm, km, in or ft (5mm).
Give one target; --max-error may stand beside any other as a cap. Without a target it is
--max-error 0.05%: no vertex of any frame is further off. --keyframes alone sets no target: the
quantisation then adds at most a tenth to the error of that many exact key-frames.

--interpolation msgi rebuilds frames by multi-scale geometry interpolation of key-frames (--basis
keyframes or --keyframes), which keeps lengths and volume where limbs swing far; auto takes what
does better. Both take longer, and the file takes longer to open and to play. --basis auto does so
where it makes the file a tenth smaller (-v says why not), with --interpolation linear never. A
decoder may lack geometry interpolation, and Draco: encode and info say that a file needs one of
them.

--massage on moves the vertices of every frame along its surface before coding (anicodec massage);
errors are then those against the moved clip, and the file records how far the surface moved. auto
does so only where the file becomes smaller.

Examples:
  anicodec encode dance.obj dance.pc2 -o dance.anic --fps 30
  anicodec encode 'frames/*.obj' -o clip.anic --kg 0.1
  anicodec encode fox.glb --clip Run --fps 60 -o run.anic
  anicodec encode fox.glb -o fox.anic --kg 0.1
  anicodec encode fox.glb --clips Walk,Run -o small/fox.glb
  anicodec encode hero.obj walk.pc2 run.pc2 -o hero.anic --fps 30
  anicodec encode flag.mdd --mesh flag.obj -o flag.anic --size 200k --max-error 1%
  anicodec encode dance.obj dance.pc2 -o dance.anic --keyframes 45
  anicodec encode --batch clips -o encoded -j 4
  capture | anicodec encode --live body.obj --fps 30 --effort fast -o take.anic)";

MeshSequence load(const EncodeArguments& command, const Progress& progress,
                  EncodeOptions* encode_options) {
  LoadOptions options = load_options(command, progress);
  // These have one clip each.
  options.takes =
      command.part.empty() && !command.split_objects && command.massage == MassageMode::kOff;
  MeshSequence sequence;
  if (command.topology_changes == TopologyChanges::kTransfer) {
    sequence = transfer_to_one(command.inputs, progress, &encode_options->surface_change.emplace());
    if (options.rate)
      sequence.rate = *options.rate;
  } else {
    sequence = load_sequence(command.inputs, options);
  }
  set_metadata(command, sequence);
  set_fields(command, {&sequence});
  return sequence;
}

void encode_batch(const EncodeArguments& command, const CommonOptions& common) {
  if (!command.part.empty())
    throw Error(ErrorKind::kUsage, "--part takes a part of one clip, --batch has many");
  if (command.topology_changes != TopologyChanges::kRefuse)
    throw Error(ErrorKind::kUsage, "--topology-changes goes with one clip, --batch has many");
  if (!command.inputs.empty())
    throw Error(ErrorKind::kUsage, command.inputs[0] + ": --batch takes its inputs from " +
                                       command.batch + ", no others");
  if (!command.events.empty())
    throw Error(ErrorKind::kUsage, "--event goes with one file, --batch has many");
  if (command.split_objects && command.massage != MassageMode::kOff)
    throw Error(ErrorKind::kUsage, "--split-objects goes without --massage");
  EncodeOptions options = encode_options(command);
  BatchOptions batch;
  batch.folder = command.output;
  batch.jobs = common.threads > 0 ? static_cast<unsigned>(common.threads)
                                  : std::max(1U, std::thread::hardware_concurrency());
  batch.memory =
      command.memory.empty() ? half_of_machine() : parse_size(command.memory, "--memory");
  options.most_bytes = 0;  // a clip that takes more runs alone
  batch.overwrite = common.overwrite;
  batch.quiet = common.quiet;
  batch.json = common.json;
  batch.settings = settings_of(command, options);
  run_batch(
      find_clips(command.batch), batch,
      [&](const BatchClip& clip, const std::function<void(const std::string&)>& note) {
        EncodeArguments one = command;
        one.inputs = clip.inputs;
        one.note = note;
        return load(one, {}, &options);
      },
      [&](const BatchClip& clip, MeshSequence sequence) {
        EncodeOptions own = options;
        own.order = order_of(command.order, clip.inputs);
        Scene scene = command.split_objects ? split_parts(std::move(sequence))
                                            : scene_of(std::move(sequence));
        set_lengths(command, scene, &own);
        return encode(std::move(scene), own);
      });
}

/// Throws Error(kUsage) where no glTF scene can carry the clip.
void check_glb_output(const EncodeArguments& command) {
  if (command.inputs.size() != 1 || !carries_clip(command.inputs[0]))
    throw Error(ErrorKind::kUsage, command.output +
                                       ": a .glb carries the clip of one .gltf or .glb, which is "
                                       "the input; others become an .anic file");
  if (!command.part.empty() || command.split_objects || !command.batch.empty() ||
      command.topology_changes != TopologyChanges::kRefuse)
    throw Error(
        ErrorKind::kUsage,
        command.output + ": a .glb goes without --part, --split-objects and --topology-changes");
  if (command.order == OrderChoice::kFree)
    throw Error(ErrorKind::kUsage,
                command.output + ": the surface in a .glb counts on the order of its vertices");
}

/// The first frame, which the scene shows if nobody plays the clip. Takes from the clip what the
/// scene keeps.
StillSurface split_surface(MeshSequence& sequence) {
  StillSurface still;
  still.positions.assign(sequence.frame(0).begin(), sequence.frame(0).end());
  for (const Attribute& attribute : sequence.attributes) {
    if (attribute.kind == AttributeKind::kNormal && attribute.per_vertex())
      still.normals.assign(attribute.values.begin(), attribute.values.end());
  }
  std::erase_if(sequence.attributes, [](const Attribute& attribute) {
    const bool moves = attribute.frames > 1;
    return !moves &&
           (attribute.kind == AttributeKind::kUv || attribute.kind == AttributeKind::kColour);
  });
  sequence.materials.looks.clear();
  return still;
}

/// Reads frames whose connectivity changes: each run of the same is a mesh.
Scene load_changing(const EncodeArguments& command, const Progress& progress) {
  Scene scene = load_topologies(command.inputs, load_options(command, progress));
  set_metadata(command, scene.clip);
  std::vector<MeshDetails*> meshes;
  for (SceneMesh& mesh : scene.meshes)
    meshes.push_back(&mesh.sequence);
  set_fields(command, meshes);
  return scene;
}

/// Reads the input as the meshes of the file, and what of the options depends on it. `still`: of a scene that carries
/// the clip, or null.
Scene load_meshes(const EncodeArguments& command, const Progress& progress, StillSurface* still,
                  EncodeOptions* options) {
  if (command.topology_changes == TopologyChanges::kKeep)
    return load_changing(command, progress);
  MeshSequence sequence = load(command, progress, options);
  if (command.split_objects)
    return split_parts(std::move(sequence));
  if (still) {
    *still = split_surface(sequence);
    options->order = OrderMode::kVertices;
  }
  if (options->keyframes && *options->keyframes > sequence.frame_count)
    throw Error(ErrorKind::kUsage,
                fmt::format("--keyframes {}: {} has only {} frames", *options->keyframes,
                            command.inputs[0], sequence.frame_count));
  if (!command.part.empty()) {
    const FrameRange range = parse_frames(command.part, "--part", sequence.frame_count);
    if (range.step != 1)
      throw Error(ErrorKind::kUsage, "--part: a part has all frames from A to B - 1, without step");
    options->part = FrameRun{range.first, range.size()};
  }
  return scene_of(std::move(sequence));
}

EncodeResult encode_meshes(const EncodeArguments& command, Scene scene, EncodeOptions options,
                           const Progress& progress) {
  try {
    set_lengths(command, scene, &options);
    return encode(std::move(scene), options, progress);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", command.inputs[0], e.what()));
  }
}

/// Collects what the input does not keep, and prints some lines of it above the line of progress.
std::function<void(const std::string&)> notes_above(ProgressLine& line, bool quiet,
                                                    std::vector<std::string>& notes) {
  constexpr int kMost = 20;
  return [&line, quiet, &notes, told = 0](const std::string& text) mutable {
    notes.push_back(text);
    if (quiet || ++told > kMost + 1)
      return;
    line.clear();
    print_line(stderr, "{}", told <= kMost ? text : "... and more of the like");
  };
}

void check_goes_together(const EncodeArguments& command) {
  const TopologyChanges changes = command.topology_changes;
  if (changes != TopologyChanges::kRefuse && command.split_objects)
    throw Error(ErrorKind::kUsage, "--topology-changes goes without --split-objects");
  if (changes != TopologyChanges::kRefuse && command.massage != MassageMode::kOff)
    throw Error(ErrorKind::kUsage, "--topology-changes goes without --massage");
  if (changes == TopologyChanges::kKeep && !command.part.empty())
    throw Error(ErrorKind::kUsage, "--topology-changes keep goes without --part");
  if (command.split_objects && (!command.part.empty() || command.massage != MassageMode::kOff))
    throw Error(ErrorKind::kUsage, "--split-objects goes without --part and --massage");
}

void run(EncodeArguments command, const CommonOptions& common) {
  if (!command.memory.empty())
    set_memory_for_frames(parse_size(command.memory, "--memory"));
  if (command.live)
    return encode_live(command, common);
  if (!command.batch.empty())
    return encode_batch(command, common);
  if (command.inputs.empty())
    throw Error(ErrorKind::kUsage, "encode: INPUT is required, or --batch");
  check_goes_together(command);
  EncodeOptions options = encode_options(command);
  const bool in_scene = is_scene_output(command.output);
  if (in_scene)
    check_glb_output(command);
  else
    check_anic_output(command.output);
  const bool to_standard_output = command.output == "-";
  std::optional<AtomicFile> output;
  if (!to_standard_output)
    output.emplace(command.output, common.overwrite);
  ProgressLine line(common.quiet);
  Progress progress = line.callback();
  std::vector<std::string> notes;
  command.note = notes_above(line, common.quiet, notes);
  StillSurface still;
  Scene meshes = load_meshes(command, progress, in_scene ? &still : nullptr, &options);
  const EncodeResult result = encode_meshes(command, std::move(meshes), options, progress);
  std::string_view written(reinterpret_cast<const char*>(result.file.data()), result.file.size());
  std::string scene;
  if (in_scene)
    written = scene = carry_clip(command.inputs[0], load_options(command, {}), still, written);
  line.clear();
  if (to_standard_output) {
    if (std::fwrite(written.data(), 1, written.size(), stdout) != written.size())
      throw Error(ErrorKind::kInternal, "the standard output cannot be written");
    return;
  }
  output->write(written);
  output->commit();
  const EncodeReport report{
      command.output,        result,       command.massage == MassageMode::kAuto,
      !command.rate.empty(), scene.size(), notes};
  if (common.json)
    print_json(report.json());
  else if (!common.quiet)
    report.print_text(common.verbosity);
  if (in_scene && !common.json && !common.quiet)
    print_line(stdout, "{}: {} bytes with surface, materials and images", command.output,
               scene.size());
}

}  // namespace

void add_encode(Commands& commands, CommonOptions& common) {
  auto arguments = std::make_shared<EncodeArguments>();
  Options& options = add_command(commands, common, kForce | kQuiet | kVerbose | kThreads | kJson,
                                 {"encode", "INPUT...|--batch DIR -o OUT [target] [options]",
                                  "Encode a mesh sequence to an .anic file", kEncodeFooter},
                                 [arguments, &common] { run(*arguments, common); });
  add_arguments(options, *arguments);
}

}  // namespace anicodec::tools
