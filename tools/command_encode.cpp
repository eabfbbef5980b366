// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"
#include "codec/encode_scene.h"
#include "codec/error.h"
#include "codec/massage_choice.h"
#include "tools/batch.h"
#include "tools/choice.h"
#include "tools/clip_input.h"
#include "tools/command.h"
#include "tools/io/atomic_file.h"
#include "tools/io/frame_rate.h"
#include "tools/io/load_sequence.h"
#include "tools/massage_transfer.h"
#include "tools/names.h"
#include "tools/progress.h"
#include "tools/quantity.h"
#include "tools/version.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace anicodec::tools {
namespace {

constexpr const char* kFooter =
    R"(INPUT is a mesh and its vertex cache (mesh.obj cache.pc2), a vertex cache with the mesh beside it or
given by --mesh, a quoted pattern ('frames/*.obj', in natural order), a list of frames of equal
connectivity, or a scene. Meshes: .obj .ply .off .stl; caches: .pc2 .mdd; scenes: .gltf .glb, and
in builds with assimp .fbx .dae .md2 .md3 .3ds and others.

INPUT - is a scene in one file or a mesh from the standard input; -o - writes the .anic file to the
standard output, and nothing else; decode, info and verify read one from -.

A scene is baked: skins, morph targets and moving nodes become vertices that move, all its meshes
(or the one of --mesh) one mesh, at --fps, from the first key of the clip to the last. --clip names
or numbers the clip; without it the first one that moves anything is taken, --clip none takes none.

--meshes apart makes each object of the input (node of a scene, o of an OBJ) a mesh of its own with
its name. One that only turns and moves is stored as that where it is smaller; one whose vertices
are all at one point in a frame, as those of hidden objects are, is not there in that frame.

--frames A:B encodes some frames of a long clip, on one of several machines perhaps; every machine
reads the whole clip, and join makes one file of the parts.

--batch encodes many clips to the folder -o, -j of them side by side: of a folder every scene, every
vertex cache with its mesh, and every run of numbered frames, of a list a clip per line, its inputs
separated by tabs. Clips that are done already, by the content of what goes in and comes out, are
left alone; one that fails does not stop the others.

Texture coordinates, colours, materials and objects are kept, as they are in the first frame. Of
normals the hard edges are: normals come from the positions of a frame.

A LEN is in scene units (0.02), or in per cent of the diagonal of the box around all frames (0.05%).
Give one target; --max-error may stand beside any other as a cap. Without a target it is
--max-error 0.05%: no vertex of any frame is further off. --keyframes alone sets no target: the
quantisation then adds at most a tenth to the error of that many exact key-frames.

--interpolation msgi rebuilds frames by multi-scale geometry interpolation of the key-frames, which
keeps lengths and volume where limbs swing far; auto takes what does better. Both need key-frames
(--basis keyframes or --keyframes), take longer, and the file takes longer to open and to play.

--massage on moves the vertices of every frame along its surface before coding (anicodec massage);
errors are then those against the moved clip, and the file records how far the surface moved. auto
does so only where the file becomes smaller. transfer takes meshes whose faces differ and gives them
those of the first one.

Examples:
  anicodec encode dance.obj dance.pc2 -o dance.anic --fps 30
  anicodec encode 'frames/*.obj' -o clip.anic --kg 0.1
  anicodec encode fox.glb --clip Run --fps 60 -o run.anic
  anicodec encode flag.mdd --mesh flag.obj -o flag.anic --size 200k --max-error 1%
  anicodec encode dance.obj dance.pc2 -o dance.anic --keyframes 45
  anicodec encode --batch clips -o encoded -j 4)";

/// What frames of another connectivity are: a mistake, or segments of their own.
enum class Topology { kOne, kSegments };

/// What the objects of the input are: parts of one mesh, or each a mesh.
enum class Meshes { kOne, kApart };

enum class Massage { kOff, kOn, kAuto, kTransfer };

struct EncodeCommand {
  std::vector<std::string> inputs;
  std::string output, mesh, clip, batch, memory, frames;
  std::string kg, max_error, rmse, size, bpfv;
  BasisChoice basis = BasisChoice::kAuto;
  uint32_t keyframes = 0;
  KeyframeMethod select = KeyframeMethod::kPivot;
  InterpolationChoice interpolation = InterpolationChoice::kLinear;
  format::OrderMode order = format::OrderMode::kVertices;
  format::CoderId mesh_coder = format::CoderId::kDraco;
  int effort = 5;
  Topology topology = Topology::kOne;
  Meshes meshes = Meshes::kOne;
  Massage massage = Massage::kOff;
  double massage_strength = 0.5;
  std::string massage_tolerance;
  std::string rate, unit;
  UpAxis up = UpAxis::kUnknown;
  bool loop = false;
  bool no_attributes = false;
  AttributeOptions attributes;
  std::string attribute_error;
  bool json = false;
};

void set_target(const EncodeCommand& command, EncodeOptions& options) {
  using format::ErrorMetric;
  std::vector<Target> targets;
  if (!command.kg.empty())
    targets.push_back({ErrorMetric::kKg, parse_positive(command.kg, "--kg"), false});
  if (!command.rmse.empty()) {
    Length length = parse_length(command.rmse, "--rmse");
    targets.push_back({ErrorMetric::kRmse, length.value, length.percent});
  }
  if (!command.size.empty())
    targets.push_back(
        {ErrorMetric::kSize, static_cast<double>(parse_size(command.size, "--size")), false});
  if (!command.bpfv.empty())
    targets.push_back({ErrorMetric::kBpfv, parse_positive(command.bpfv, "--bpfv"), false});
  if (targets.size() > 1)
    throw Error(ErrorKind::kUsage, "only one of --kg, --rmse, --size and --bpfv can be the target");
  if (!targets.empty())
    options.target = targets[0];
  if (!command.max_error.empty()) {
    Length length = parse_length(command.max_error, "--max-error");
    Target bound{ErrorMetric::kMaxError, length.value, length.percent};
    if (targets.empty())
      options.target = bound;
    else
      options.cap = bound;
  } else if (targets.empty() && !options.keyframes) {
    options.target = {ErrorMetric::kMaxError, 0.05, true};
  }
}

EncodeOptions options_of(const EncodeCommand& command) {
  EncodeOptions options;
  options.basis = command.basis;
  if (command.keyframes > 0) {
    if (command.basis != BasisChoice::kAuto && command.basis != BasisChoice::kKeyframes)
      throw Error(ErrorKind::kUsage, "--keyframes goes with --basis keyframes only");
    options.keyframes = command.keyframes;
    options.basis = BasisChoice::kKeyframes;
  }
  options.select = command.select;
  if (command.interpolation != InterpolationChoice::kLinear &&
      options.basis != BasisChoice::kKeyframes)
    throw Error(ErrorKind::kUsage, "--interpolation goes with --basis keyframes or --keyframes");
  options.interpolation = command.interpolation;
  options.order = command.order;
  options.mesh_coder = command.mesh_coder;
  options.attributes = command.attributes;
  options.attributes.keep = !command.no_attributes;
  if (!command.attribute_error.empty()) {
    const Length error = parse_length(command.attribute_error, "--attribute-error");
    options.attributes.error = error.value;
    options.attributes.error_percent = error.percent;
  }
  options.effort = command.effort;
  options.encoder = fmt::format("anicodec {}", version());
  set_target(command, options);
  return options;
}

LoadOptions load_options_of(const EncodeCommand& command, const Progress& progress) {
  LoadOptions options;
  options.mesh = command.mesh;
  options.clip = command.clip;
  options.progress = progress;
  if (!command.rate.empty())
    options.rate = parse_frame_rate(command.rate);
  return options;
}

void set_metadata(const EncodeCommand& command, MeshSequence& sequence) {
  if (command.up != UpAxis::kUnknown)
    sequence.up = command.up;
  if (!command.unit.empty())
    sequence.metres_per_unit = parse_unit(command.unit, "--unit");
  sequence.loop = command.loop;
}

MeshSequence load(const EncodeCommand& command, const Progress& progress,
                  EncodeOptions* encode_options) {
  const LoadOptions options = load_options_of(command, progress);
  MeshSequence sequence;
  if (command.massage == Massage::kTransfer) {
    sequence = transfer_to_one(command.inputs, progress, &encode_options->surface_change.emplace());
    if (options.rate)
      sequence.rate = *options.rate;
  } else {
    sequence = load_sequence(command.inputs, options);
  }
  set_metadata(command, sequence);
  return sequence;
}

/// What a file of this size means for a clip.
struct Rate {
  explicit Rate(const EncodeResult& result) {
    const auto positions = static_cast<double>(result.positions);
    auto bytes = static_cast<double>(result.file.size());
    ratio = 12 * positions / bytes;
    bpfv = 8 * bytes / positions;
  }

  double ratio = 0;  ///< float32 positions against it
  double bpfv = 0;   ///< bits per frame and vertex
};

double percent(double length, double diagonal) {
  return length == 0 ? 0 : 100 * length / diagonal;
}

MassageOptions massage_options_of(const EncodeCommand& command, const MeshSequence& sequence) {
  MassageOptions options;
  options.strength = command.massage_strength;
  if (!command.massage_tolerance.empty()) {
    const Length length = parse_length(command.massage_tolerance, "--massage-tolerance");
    options.tolerance = length.percent ? length.value / 100 * diagonal(sequence) : length.value;
  }
  return options;
}

MassageMode mode_of(Massage massage) {
  return massage == Massage::kOn     ? MassageMode::kOn
         : massage == Massage::kAuto ? MassageMode::kAuto
                                     : MassageMode::kOff;
}

EncodeResult encode_as_asked(const EncodeCommand& command, MeshSequence sequence,
                             const EncodeOptions& options, MassageVerdict* massage,
                             const Progress& progress) {
  const MassageOptions massage_options = massage_options_of(command, sequence);
  return encode_massaged(std::move(sequence), mode_of(command.massage), massage_options, options,
                         massage, progress);
}

void print_json(const EncodeCommand& command, const EncodeResult& result,
                const MassageVerdict& massage) {
  Rate rate(result);
  nlohmann::ordered_json json;
  json["file"] = command.output;
  json["bytes"] = result.file.size();
  json["ratio"] = rate.ratio;
  json["bpfv"] = rate.bpfv;
  json["vertices"] = result.vertices;
  json["faces"] = result.faces;
  json["frames"] = result.frames;
  json["basis"] = name_of(result.kind);
  json["components"] = result.components;
  json["kg"] = result.kg;
  json["rmse"] = result.rmse;
  json["max_error"] = result.max_error;
  json["max_error_percent"] = percent(result.max_error, result.diagonal);
  json["diagonal"] = result.diagonal;
  json["massaged"] = massage.change.has_value();
  json["surface_error"] = massage.change ? massage.change->max : 0;
  json["surface_error_mean"] = massage.change ? massage.change->mean : 0;
  json["moving_attributes"] = nlohmann::ordered_json::array();
  for (const AttributeResult& a : result.attributes)
    json["moving_attributes"].push_back({{"kind", name_of(a.kind)},
                                         {"name", a.name},
                                         {"kept", a.kept},
                                         {"note", a.note},
                                         {"bytes", a.bytes},
                                         {"asked", a.asked},
                                         {"max_error", a.max_error},
                                         {"rmse", a.rmse}});
  fmt::print("{}\n", json.dump(2));
}

void print_text(const EncodeCommand& command, const EncodeResult& result,
                const MassageVerdict& massage, int verbosity) {
  if (verbosity > 0) {
    for (const Trial& trial : result.trials)
      fmt::print("  tried {:<28} {:>12} bytes  RMSE {:<11.4g} max error {:.4g}\n", trial.what,
                 grouped(trial.bytes), trial.rmse, trial.max_error);
  }
  if (command.massage == Massage::kAuto && verbosity > 0)
    fmt::print("  massage: sample {} bytes plain, {} massaged; whole clip plain {}\n",
               grouped(massage.sample_plain_bytes), grouped(massage.sample_massaged_bytes),
               grouped(massage.plain_bytes));
  if (massage.change)
    fmt::print(
        "massaged: the surface moved by {:.3g} % of the diagonal on average, {:.3g} % at most\n",
        percent(massage.change->mean, result.diagonal),
        percent(massage.change->max, result.diagonal));
  else if (command.massage == Massage::kAuto)
    fmt::print("not massaged: the clip would not become smaller\n");
  Rate rate(result);
  fmt::print(
      "{}: {} bytes, {:.1f} : 1, {:.3f} bpfv; {} {}; max error {:.4g} ({:.3g} %), KG {:.3g} %\n",
      command.output, grouped(result.file.size()), rate.ratio, rate.bpfv, result.components,
      components_of(result.kind), result.max_error, percent(result.max_error, result.diagonal),
      result.kg);
  for (const AttributeResult& a : result.attributes) {
    if (a.kept)
      fmt::print("  {} \"{}\": {} bytes, max error {:.3g} of {:.3g}\n", name_of(a.kind),
                 printable(a.name), grouped(a.bytes), a.max_error, a.asked);
    else
      fmt::print("  {} \"{}\" {}\n", name_of(a.kind), printable(a.name), a.note);
  }
}

/// All that an output depends on beside its clip.
std::string settings_of(const EncodeCommand& c, const EncodeOptions& options) {
  nlohmann::ordered_json settings{c.kg,   c.max_error, c.rmse,   c.size,
                                  c.bpfv, c.keyframes, c.effort, options.encoder};
  for (int choice :
       {static_cast<int>(c.basis), static_cast<int>(c.select), static_cast<int>(c.order),
        static_cast<int>(c.mesh_coder), static_cast<int>(c.interpolation),
        static_cast<int>(c.massage), static_cast<int>(c.meshes)})
    settings.push_back(choice);
  settings.push_back(c.massage_strength);
  settings.push_back(c.massage_tolerance);
  settings.push_back(c.attribute_error);
  for (uint32_t number : {uint32_t{options.attributes.keep}, options.attributes.uv_bits,
                          options.attributes.colour_bits, uint32_t{options.attributes.normals}})
    settings.push_back(number);
  return settings.dump();
}

/// Half of what the machine has.
uint64_t default_memory() {
  const auto pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGE_SIZE);
  return static_cast<uint64_t>(pages) * static_cast<uint64_t>(size) / 2;
}

void encode_batch(const EncodeCommand& command, const CommonOptions& common) {
  if (!command.frames.empty())
    throw Error(ErrorKind::kUsage, "--frames takes a part of one clip, --batch has many");
  if (command.topology == Topology::kSegments)
    throw Error(ErrorKind::kUsage, "--topology segments goes with one clip, --batch has many");
  if (!command.inputs.empty())
    throw Error(ErrorKind::kUsage, command.inputs[0] + ": --batch takes its inputs from " +
                                       command.batch + ", no others");
  if (command.meshes == Meshes::kApart && command.massage != Massage::kOff)
    throw Error(ErrorKind::kUsage, "--meshes apart goes without --massage");
  if (command.massage == Massage::kTransfer)
    throw Error(ErrorKind::kUsage,
                "--massage transfer takes the frames of one clip, --batch has many");
  EncodeOptions options = options_of(command);
  BatchOptions batch;
  batch.folder = command.output;
  batch.jobs = common.threads > 0 ? static_cast<unsigned>(common.threads)
                                  : std::max(1U, std::thread::hardware_concurrency());
  batch.memory = command.memory.empty() ? default_memory() : parse_size(command.memory, "--memory");
  batch.overwrite = common.overwrite;
  batch.quiet = common.quiet;
  batch.settings = settings_of(command, options);
  run_batch(
      find_clips(command.batch), batch,
      [&](const BatchClip& clip) {
        EncodeCommand one = command;
        one.inputs = clip.inputs;
        return load(one, {}, &options);
      },
      [&](MeshSequence sequence) {
        if (command.meshes == Meshes::kApart)
          return encode_scene(split_parts(std::move(sequence)), options);
        MassageVerdict massage;
        return encode_as_asked(command, std::move(sequence), options, &massage, {});
      });
}

/// Encodes several meshes: objects of a scene, or frames whose connectivity changes.
EncodeResult encode_meshes(const EncodeCommand& command, EncodeOptions options,
                           const Progress& progress) {
  const bool segments = command.topology == Topology::kSegments;
  if (!command.frames.empty() || command.massage != Massage::kOff)
    throw Error(ErrorKind::kUsage,
                fmt::format("{} goes without --frames and --massage",
                            segments ? "--topology segments" : "--meshes apart"));
  Scene scene = segments ? load_topologies(command.inputs, load_options_of(command, progress))
                         : split_parts(load(command, progress, &options));
  set_metadata(command, scene.clip);
  try {
    return encode_scene(std::move(scene), options, progress);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", command.inputs[0], e.what()));
  }
}

/// Encodes frames of one connectivity.
EncodeResult encode_clip(const EncodeCommand& command, EncodeOptions options,
                         MassageVerdict* massage, const Progress& progress) {
  MeshSequence sequence = load(command, progress, &options);
  if (options.keyframes && *options.keyframes > sequence.frame_count)
    throw Error(ErrorKind::kUsage,
                fmt::format("--keyframes {}: {} has only {} frames", *options.keyframes,
                            command.inputs[0], sequence.frame_count));
  if (!command.frames.empty()) {
    const FrameRange range = parse_frames(command.frames, "--frames", sequence.frame_count);
    if (range.step != 1)
      throw Error(ErrorKind::kUsage,
                  "--frames: a part has all frames from A to B - 1, without step");
    options.part = FrameRun{range.first, range.size()};
  }
  try {
    EncodeResult result = encode_as_asked(command, std::move(sequence), options, massage, progress);
    if (command.massage == Massage::kTransfer)
      massage->change = options.surface_change;
    return result;
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", command.inputs[0], e.what()));
  }
}

void run(const EncodeCommand& command, const CommonOptions& common) {
  if (!command.batch.empty())
    return encode_batch(command, common);
  if (command.inputs.empty())
    throw Error(ErrorKind::kUsage, "encode: INPUT is required, or --batch");
  EncodeOptions options = options_of(command);
  if (is_sequence_input(command.output))
    throw Error(
        ErrorKind::kUsage,
        command.output + ": the output of encode is an .anic file (for other formats: decode)");
  const bool to_standard_output = command.output == "-";
  std::optional<AtomicFile> output;
  if (!to_standard_output)
    output.emplace(command.output, common.overwrite);
  ProgressLine line(common.quiet);
  Progress progress = line.callback();
  MassageVerdict massage;
  EncodeResult result = command.topology == Topology::kSegments || command.meshes == Meshes::kApart
                            ? encode_meshes(command, options, progress)
                            : encode_clip(command, options, &massage, progress);
  line.clear();
  if (to_standard_output) {
    if (std::fwrite(result.file.data(), 1, result.file.size(), stdout) != result.file.size())
      throw Error(ErrorKind::kInternal, "the standard output cannot be written");
    return;
  }
  output->write({reinterpret_cast<const char*>(result.file.data()), result.file.size()});
  output->commit();
  if (command.json)
    print_json(command, result, massage);
  else if (!common.quiet)
    print_text(command, result, massage, common.verbosity);
}

}  // namespace

void add_encode(CLI::App& app, CommonOptions& common) {
  auto c = std::make_shared<EncodeCommand>();
  CLI::App* command = add_command(app, common,
                                  {"encode", "INPUT...|--batch DIR -o OUT [target] [options]",
                                   "Encode a mesh sequence to an .anic file", kFooter},
                                  [c, &common] { run(*c, common); });
  command->add_option("INPUT", c->inputs, "Mesh and vertex cache, frames, or a scene");
  command->add_option("-o,--output", c->output, "The .anic file to write; of --batch: the folder")
      ->option_text("FILE")
      ->required();
  command
      ->add_option("--mesh", c->mesh,
                   "Mesh of a lone vertex cache (default: same stem beside it),\n"
                   "or the name of one in a scene (default: all)")
      ->option_text("FILE|NAME");
  command->add_option("--clip", c->clip, "Animation of a scene, or none")
      ->option_text("NAME|INDEX");

  command->add_option("--frames", c->frames, "Encode a part, A to B - 1, to be joined with others")
      ->option_text("A:B");
  command
      ->add_option("--batch", c->batch,
                   "Encode all clips in a folder, or in a list with a clip per line")
      ->option_text("DIR|LIST");
  command->add_option("--memory", c->memory, "Of --batch: for clips side by side (default: half)")
      ->option_text("BYTES");

  auto target = [command](const char* name, std::string& value, const char* text,
                          const char* description) {
    command->add_option(name, value, description)->option_text(text)->group("Target");
  };
  target("--max-error", c->max_error, "LEN", "Largest error of any vertex (default 0.05%)");
  target("--kg", c->kg, "PCT", "KG error in per cent");
  target("--rmse", c->rmse, "LEN", "Root mean square error");
  target("--size", c->size, "BYTES",
         "Smallest error in a file of at most 40000, 40k or 1.5M bytes");
  target("--bpfv", c->bpfv, "BITS", "The same, as bits per frame and vertex");

  const char* method = "Method";
  add_choice<BasisChoice>(*command, "--basis", c->basis,
                          {{"auto", BasisChoice::kAuto},
                           {"keyframes", BasisChoice::kKeyframes},
                           {"eigenshapes", BasisChoice::kEigenshapes},
                           {"eigentrajectories", BasisChoice::kEigentrajectories}},
                          "Kind of basis (default auto: the smallest file)")
      ->group(method);
  command->add_option("--keyframes", c->keyframes, "Number of key-frames (default: as few as do)")
      ->option_text("K")
      ->check(CLI::Range(uint32_t{1}, format::kMaxFrames))
      ->group(method);
  add_choice<KeyframeMethod>(*command, "--select", c->select,
                             {{"gas", KeyframeMethod::kGas},
                              {"pivot", KeyframeMethod::kPivot},
                              {"uniform", KeyframeMethod::kUniform}},
                             "How key-frames are chosen (default pivot)")
      ->group(method);
  add_choice<InterpolationChoice>(*command, "--interpolation", c->interpolation,
                                  {{"linear", InterpolationChoice::kLinear},
                                   {"msgi", InterpolationChoice::kMsgi},
                                   {"auto", InterpolationChoice::kAuto}},
                                  "How frames come from key-frames (default linear)")
      ->group(method);
  add_choice<format::OrderMode>(*command, "--order", c->order,
                                {{"vertices", format::OrderMode::kVertices},
                                 {"free", format::OrderMode::kFree},
                                 {"all", format::OrderMode::kAll}},
                                "Source order kept: vertices (default), none, faces too")
      ->group(method);
  add_choice<Topology>(*command, "--topology", c->topology,
                       {{"one", Topology::kOne}, {"segments", Topology::kSegments}},
                       "Frames of another connectivity: an error (default one), or segments\n"
                       "of the file with meshes of their own")
      ->group(method);
  add_choice<Meshes>(*command, "--meshes", c->meshes,
                     {{"one", Meshes::kOne}, {"apart", Meshes::kApart}},
                     "Objects of the input: parts of one mesh (default), or each a mesh\n"
                     "of its own that is there only in frames that show it")
      ->group(method);
  add_choice<format::CoderId>(
      *command, "--mesh-coder", c->mesh_coder,
      {{"draco", format::CoderId::kDraco}, {"plain", format::CoderId::kPlain}},
      "Coder of faces and key-frames (default draco)")
      ->group(method);
  command
      ->add_option("--effort", c->effort,
                   "How long to search, 1 to 9 (default 5); files from 7 on open slower")
      ->option_text("N")
      ->check(CLI::Range(1, 9))
      ->group(method);

  const char* massage = "Massage";
  add_choice<Massage>(*command, "--massage", c->massage,
                      {{"off", Massage::kOff},
                       {"on", Massage::kOn},
                       {"auto", Massage::kAuto},
                       {"transfer", Massage::kTransfer}},
                      "Move vertices along their surface first (default off)")
      ->group(massage);
  command
      ->add_option("--massage-strength", c->massage_strength,
                   "Of shape against distance, between 0 and 1 (default 0.5)")
      ->option_text("X")
      ->group(massage);
  command
      ->add_option("--massage-tolerance", c->massage_tolerance,
                   "How far the surface may move anywhere (default: as far as it needs)")
      ->option_text("LEN")
      ->group(massage);

  const char* attributes = "Attributes";
  command->add_flag("--no-attributes", c->no_attributes, "Positions and faces alone")
      ->group(attributes);
  command
      ->add_option("--uv-bits", c->attributes.uv_bits,
                   "Texture coordinates in steps of 2^-N (default 12)")
      ->option_text("N")
      ->check(CLI::Range(1, 24))
      ->group(attributes);
  command
      ->add_option("--colour-bits", c->attributes.colour_bits,
                   "Of a component of a colour (default 8)")
      ->option_text("N")
      ->check(CLI::Range(1, 16))
      ->group(attributes);
  command
      ->add_option("--attribute-error", c->attribute_error,
                   "Largest error of colours, texture coordinates and other numbers that\n"
                   "change, in their own units or per cent of their range (default: half\n"
                   "a step of --colour-bits for colours, 0.1% for others)")
      ->option_text("X")
      ->group(attributes);
  command
      ->add_flag("--store-normals", c->attributes.normals,
                 "Normals and tangents of the first frame as numbers, not only\nthe hard edges")
      ->group(attributes);

  const char* metadata = "Metadata (positions stay as they are)";
  command
      ->add_option("--fps", c->rate,
                   "Frames per second (default: as in the input, else 24;\n"
                   "of a scene: the rate of its keys, at least 30)")
      ->option_text("N[/D]")
      ->group(metadata);
  add_choice<UpAxis>(*command, "--up", c->up, {{"y", UpAxis::kY}, {"z", UpAxis::kZ}},
                     "Axis that points up")
      ->group(metadata);
  command->add_option("--unit", c->unit, "Length of a scene unit: metres, or m cm mm km in ft")
      ->option_text("METRES")
      ->group(metadata);
  command->add_flag("--loop", c->loop, "The clip is meant to be repeated")->group(metadata);
  command->add_flag("--json", c->json, "Print the result as JSON")->group("Options");
}

}  // namespace anicodec::tools
