// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/encode_arguments.h"

#include "codec/sequence/error.h"
#include "tools/io/base/frame_rate.h"
#include "tools/words/choice.h"
#include "tools/words/quantity.h"
#include "tools/words/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

void set_target(const EncodeArguments& command, EncodeOptions& options) {
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

}  // namespace

void add_arguments(CLI::App& command, EncodeArguments& a) {
  command.add_option("INPUT", a.inputs, "Mesh and vertex cache, frames, or a scene");
  command.add_option("-o,--output", a.output, "The .anic file to write; of --batch: the folder")
      ->option_text("FILE")
      ->required();
  command
      .add_option("--mesh", a.mesh,
                  "Mesh of a lone vertex cache (default: same stem beside it),\n"
                  "or the name of one in a scene (default: all)")
      ->option_text("FILE|NAME");
  command.add_option("--clip", a.clip, "Animation of a scene, or none")->option_text("NAME|INDEX");

  command.add_option("--frames", a.frames, "Encode a part, A to B - 1, to be joined with others")
      ->option_text("A:B");
  command
      .add_option("--batch", a.batch,
                  "Encode all clips in a folder, or in a list with a clip per line")
      ->option_text("DIR|LIST");
  command.add_option("--memory", a.memory, "Of --batch: for clips side by side (default: half)")
      ->option_text("BYTES");

  auto target = [&command](const char* name, std::string& value, const char* text,
                           const char* description) {
    command.add_option(name, value, description)->option_text(text)->group("Target");
  };
  target("--max-error", a.max_error, "LEN", "Largest error of any vertex (default 0.05%)");
  target("--kg", a.kg, "PCT", "KG error in per cent");
  target("--rmse", a.rmse, "LEN", "Root mean square error");
  target("--size", a.size, "BYTES", "Smallest error in a file of at most 40000, 40k or 1.5M bytes");
  target("--bpfv", a.bpfv, "BITS", "The same, as bits per frame and vertex");

  const char* method = "Method";
  add_choice<BasisChoice>(command, "--basis", a.basis,
                          {{"auto", BasisChoice::kAuto},
                           {"keyframes", BasisChoice::kKeyframes},
                           {"eigenshapes", BasisChoice::kEigenshapes},
                           {"eigentrajectories", BasisChoice::kEigentrajectories}},
                          "Kind of basis (default auto: the smallest file)")
      ->group(method);
  command.add_option("--keyframes", a.keyframes, "Number of key-frames (default: as few as do)")
      ->option_text("K")
      ->check(CLI::Range(uint32_t{1}, format::kMaxFrames))
      ->group(method);
  add_choice<KeyframeMethod>(command, "--select", a.select,
                             {{"gas", KeyframeMethod::kGas},
                              {"pivot", KeyframeMethod::kPivot},
                              {"uniform", KeyframeMethod::kUniform}},
                             "How key-frames are chosen (default pivot)")
      ->group(method);
  add_choice<InterpolationChoice>(command, "--interpolation", a.interpolation,
                                  {{"linear", InterpolationChoice::kLinear},
                                   {"msgi", InterpolationChoice::kMsgi},
                                   {"auto", InterpolationChoice::kAuto}},
                                  "How frames come from key-frames (default linear)")
      ->group(method);
  add_choice<format::OrderMode>(command, "--order", a.order,
                                {{"vertices", format::OrderMode::kVertices},
                                 {"free", format::OrderMode::kFree},
                                 {"all", format::OrderMode::kAll}},
                                "Source order kept: vertices (default), none, faces too")
      ->group(method);
  add_choice<Topology>(command, "--topology", a.topology,
                       {{"one", Topology::kOne}, {"segments", Topology::kSegments}},
                       "Frames of another connectivity: an error (default one), or segments\n"
                       "of the file with meshes of their own")
      ->group(method);
  add_choice<Meshes>(command, "--meshes", a.meshes,
                     {{"one", Meshes::kOne}, {"apart", Meshes::kApart}},
                     "Objects of the input: parts of one mesh (default), or each a mesh\n"
                     "of its own that is there only in frames that show it")
      ->group(method);
  add_choice<format::CoderId>(
      command, "--mesh-coder", a.mesh_coder,
      {{"draco", format::CoderId::kDraco}, {"plain", format::CoderId::kPlain}},
      "Coder of faces and key-frames (default draco)")
      ->group(method);
  command
      .add_option("--effort", a.effort,
                  "How long to search, 1 to 9 (default 5); files from 7 on open slower")
      ->option_text("N")
      ->check(CLI::Range(1, 9))
      ->group(method);

  const char* massage = "Massage";
  add_choice<Massage>(command, "--massage", a.massage,
                      {{"off", Massage::kOff},
                       {"on", Massage::kOn},
                       {"auto", Massage::kAuto},
                       {"transfer", Massage::kTransfer}},
                      "Move vertices along their surface first (default off)")
      ->group(massage);
  command
      .add_option("--massage-strength", a.massage_strength,
                  "Of shape against distance, between 0 and 1 (default 0.5)")
      ->option_text("X")
      ->group(massage);
  command
      .add_option("--massage-tolerance", a.massage_tolerance,
                  "How far the surface may move anywhere (default: as far as it needs)")
      ->option_text("LEN")
      ->group(massage);

  const char* attributes = "Attributes";
  command.add_flag("--no-attributes", a.no_attributes, "Positions and faces alone")
      ->group(attributes);
  command
      .add_option("--uv-bits", a.attributes.uv_bits,
                  "Texture coordinates in steps of 2^-N (default 12)")
      ->option_text("N")
      ->check(CLI::Range(1, 24))
      ->group(attributes);
  command
      .add_option("--colour-bits", a.attributes.colour_bits,
                  "Of a component of a colour (default 8)")
      ->option_text("N")
      ->check(CLI::Range(1, 16))
      ->group(attributes);
  command
      .add_option("--attribute-error", a.attribute_error,
                  "Largest error of colours, texture coordinates and other numbers that\n"
                  "change, in their own units or per cent of their range (default: half\n"
                  "a step of --colour-bits for colours, 0.1% for others)")
      ->option_text("X")
      ->group(attributes);
  command
      .add_option("--store-normals", a.normal_error,
                  "Normals and tangents of the first frame as numbers, not only the hard\n"
                  "edges: to within an angle in degrees, as 0.05")
      ->option_text("DEG")
      ->group(attributes);

  const char* metadata = "Metadata (positions stay as they are)";
  command
      .add_option("--fps", a.rate,
                  "Frames per second (default: as in the input, else 24;\n"
                  "of a scene: the rate of its keys, at least 30)")
      ->option_text("N[/D]")
      ->group(metadata);
  add_choice<UpAxis>(command, "--up", a.up, {{"y", UpAxis::kY}, {"z", UpAxis::kZ}},
                     "Axis that points up")
      ->group(metadata);
  command.add_option("--unit", a.unit, "Length of a scene unit: metres, or m cm mm km in ft")
      ->option_text("METRES")
      ->group(metadata);
  command.add_flag("--loop", a.loop, "The clip is meant to be repeated")->group(metadata);
  command.add_flag("--json", a.json, "Print the result as JSON")->group("Options");
}

EncodeOptions encode_options(const EncodeArguments& command) {
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
  if (!command.normal_error.empty())
    options.attributes.normals = parse_positive(command.normal_error, "--store-normals");
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

LoadOptions load_options(const EncodeArguments& command, const Progress& progress) {
  LoadOptions options;
  options.mesh = command.mesh;
  options.clip = command.clip;
  options.progress = progress;
  if (!command.rate.empty())
    options.rate = parse_frame_rate(command.rate);
  return options;
}

MassageOptions massage_options(const EncodeArguments& command, const MeshSequence& sequence) {
  MassageOptions options;
  options.strength = command.massage_strength;
  if (!command.massage_tolerance.empty()) {
    const Length length = parse_length(command.massage_tolerance, "--massage-tolerance");
    options.tolerance = length.percent ? length.value / 100 * diagonal(sequence) : length.value;
  }
  return options;
}

MassageMode massage_mode(const EncodeArguments& command) {
  const Massage massage = command.massage;
  return massage == Massage::kOn     ? MassageMode::kOn
         : massage == Massage::kAuto ? MassageMode::kAuto
                                     : MassageMode::kOff;
}

void set_metadata(const EncodeArguments& command, MeshSequence& sequence) {
  if (command.up != UpAxis::kUnknown)
    sequence.up = command.up;
  if (!command.unit.empty())
    sequence.metres_per_unit = parse_unit(command.unit, "--unit");
  sequence.loop = command.loop;
}

std::string settings_of(const EncodeArguments& c, const EncodeOptions& options) {
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
  settings.push_back(c.normal_error);
  for (uint32_t number : {uint32_t{options.attributes.keep}, options.attributes.uv_bits,
                          options.attributes.colour_bits})
    settings.push_back(number);
  return settings.dump();
}

}  // namespace anicodec::tools
