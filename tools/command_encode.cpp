// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"
#include "codec/error.h"
#include "codec/massage_choice.h"
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

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kFooter =
    R"(INPUT is a mesh and its vertex cache (mesh.obj cache.pc2), a vertex cache with the mesh beside it or
given by --mesh, a quoted pattern ('frames/*.obj', in natural order), or a list of frames of equal
connectivity. Meshes: .obj .ply .off .stl; caches: .pc2 .mdd.

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
  anicodec encode flag.mdd --mesh flag.obj -o flag.anic --size 200k --max-error 1%
  anicodec encode dance.obj dance.pc2 -o dance.anic --keyframes 45)";

enum class Massage { kOff, kOn, kAuto, kTransfer };

struct EncodeCommand {
  std::vector<std::string> inputs;
  std::string output, mesh;
  std::string kg, max_error, rmse, size, bpfv;
  BasisChoice basis = BasisChoice::kAuto;
  uint32_t keyframes = 0;
  KeyframeMethod select = KeyframeMethod::kPivot;
  InterpolationChoice interpolation = InterpolationChoice::kLinear;
  format::OrderMode order = format::OrderMode::kVertices;
  format::CoderId mesh_coder = format::CoderId::kDraco;
  int effort = 5;
  Massage massage = Massage::kOff;
  double massage_strength = 0.5;
  std::string massage_tolerance;
  std::string rate, unit;
  UpAxis up = UpAxis::kUnknown;
  bool loop = false;
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
  options.effort = command.effort;
  options.encoder = fmt::format("anicodec {}", version());
  set_target(command, options);
  return options;
}

MeshSequence load(const EncodeCommand& command, const Progress& progress,
                  EncodeOptions* encode_options) {
  LoadOptions options;
  options.mesh = command.mesh;
  options.progress = progress;
  if (!command.rate.empty())
    options.rate = parse_frame_rate(command.rate);
  MeshSequence sequence;
  if (command.massage == Massage::kTransfer) {
    sequence = transfer_to_one(command.inputs, progress, &encode_options->surface_change.emplace());
    if (options.rate)
      sequence.rate = *options.rate;
  } else {
    sequence = load_sequence(command.inputs, options);
  }
  if (command.up != UpAxis::kUnknown)
    sequence.up = command.up;
  if (!command.unit.empty())
    sequence.metres_per_unit = parse_unit(command.unit, "--unit");
  sequence.loop = command.loop;
  return sequence;
}

/// What a file of this size means for a clip.
struct Rate {
  explicit Rate(const EncodeResult& result) {
    double positions = static_cast<double>(result.vertices) * result.frames;
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
}

void run(const EncodeCommand& command, const CommonOptions& common) {
  EncodeOptions options = options_of(command);
  if (is_sequence_input(command.output))
    throw Error(
        ErrorKind::kUsage,
        command.output + ": the output of encode is an .anic file (for other formats: decode)");
  AtomicFile output(command.output, common.overwrite);
  ProgressLine line(common.quiet);
  Progress progress = line.callback();
  MeshSequence sequence = load(command, progress, &options);
  if (options.keyframes && *options.keyframes > sequence.frame_count)
    throw Error(ErrorKind::kUsage,
                fmt::format("--keyframes {}: {} has only {} frames", *options.keyframes,
                            command.inputs[0], sequence.frame_count));
  EncodeResult result;
  MassageVerdict massage;
  try {
    const MassageOptions massage_options = massage_options_of(command, sequence);
    result = encode_massaged(std::move(sequence), mode_of(command.massage), massage_options,
                             options, &massage, progress);
    if (command.massage == Massage::kTransfer)
      massage.change = options.surface_change;
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", command.inputs[0], e.what()));
  }
  output.write({reinterpret_cast<const char*>(result.file.data()), result.file.size()});
  output.commit();
  line.clear();
  if (command.json)
    print_json(command, result, massage);
  else if (!common.quiet)
    print_text(command, result, massage, common.verbosity);
}

}  // namespace

void add_encode(CLI::App& app, CommonOptions& common) {
  auto c = std::make_shared<EncodeCommand>();
  CLI::App* command = add_command(app, common,
                                  {"encode", "INPUT... -o FILE.anic [target] [options]",
                                   "Encode a mesh sequence to an .anic file", kFooter},
                                  [c, &common] { run(*c, common); });
  command->add_option("INPUT", c->inputs, "Mesh and vertex cache, or frames")->required();
  command->add_option("-o,--output", c->output, "The .anic file to write")
      ->option_text("FILE")
      ->required();
  command
      ->add_option("--mesh", c->mesh, "Mesh of a lone vertex cache (default: same stem beside it)")
      ->option_text("FILE");

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

  const char* metadata = "Metadata (positions stay as they are)";
  command->add_option("--fps", c->rate, "Frames per second (default: as in the input, else 24)")
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
