// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/encode_arguments.h"

#include "codec/sequence/error.h"
#include "codec/sequence/machine_memory.h"
#include "format/metadata.h"
#include "tools/io/base/file_kind.h"
#include "tools/io/base/frame_rate.h"
#include "tools/options/help_text.h"
#include "tools/words/names.h"
#include "tools/words/quantity.h"
#include "tools/words/version.h"
#include "tools/words/word_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

/// Found by looking at frames of dance, chicken, horse, flag and a captured face beside their originals
/// (`render --view original,clip`): ripples are seen at 0.1, at 0.05 only if the two are compared, at 0.02 no more.
double sted_of(Quality quality) {
  switch (quality) {
    case Quality::kGood:
      return 0.05;
    case Quality::kBetter:
      return 0.02;
    case Quality::kBest:
      return 0.01;
  }
  return 0;
}

/// `metres_per_unit`: nothing before the clip is known.
void set_target(const EncodeArguments& command, std::optional<double> metres_per_unit,
                EncodeOptions& options) {
  auto length_of = [&](const std::string& text, const char* option) {
    const Length length = parse_length(text, option);
    return metres_per_unit ? length.in_scene_units(*metres_per_unit, option) : length;
  };
  if (command.lossless) {
    options.target = {ErrorMetric::kMaxError, 0, false};
    return;
  }
  std::vector<Target> targets;
  if (!command.kg.empty())
    targets.push_back({ErrorMetric::kKg, parse_percent(command.kg, "--kg"), false});
  if (!command.rmse.empty()) {
    const Length length = length_of(command.rmse, "--rmse");
    targets.push_back({ErrorMetric::kRmse, length.value, length.percent});
  }
  if (!command.displacement.empty()) {
    const Length length = length_of(command.displacement, "--displacement");
    targets.push_back({ErrorMetric::kDisplacement, length.value, length.percent});
  }
  if (!command.sted.empty())
    targets.push_back({ErrorMetric::kSted, parse_positive(command.sted, "--sted"), false});
  if (command.quality)
    targets.push_back({ErrorMetric::kSted, sted_of(*command.quality), false});
  if (!command.size.empty())
    targets.push_back(
        {ErrorMetric::kSize, static_cast<double>(parse_size(command.size, "--size")), false});
  if (!command.bpfv.empty())
    targets.push_back({ErrorMetric::kBpfv, parse_positive(command.bpfv, "--bpfv"), false});
  if (!targets.empty())
    options.target = targets[0];
  if (!command.max_error.empty()) {
    const Length length = length_of(command.max_error, "--max-error");
    Target bound{ErrorMetric::kMaxError, length.value, length.percent};
    if (targets.empty())
      options.target = bound;
    else
      options.cap = bound;
  } else if (targets.empty() && !options.keyframes) {
    options.target = {ErrorMetric::kMaxError, 0.05, true};
  }
}

constexpr Word<std::optional<Quality>> kQualities[] = {
    {Quality::kGood, "good"}, {Quality::kBetter, "better"}, {Quality::kBest, "best"}};
constexpr Word<BasisChoice> kBases[] = {{BasisChoice::kAuto, "auto"},
                                        {BasisChoice::kKeyframes, "keyframes"},
                                        {BasisChoice::kEigenshapes, "eigenshapes"},
                                        {BasisChoice::kEigentrajectories, "eigentrajectories"}};
constexpr Word<KeyframeMethod> kSelections[] = {{KeyframeMethod::kGas, "gas"},
                                                {KeyframeMethod::kPivot, "pivot"},
                                                {KeyframeMethod::kUniform, "uniform"}};
constexpr Word<std::optional<InterpolationChoice>> kInterpolations[] = {
    {InterpolationChoice::kLinear, "linear"},
    {InterpolationChoice::kMsgi, "msgi"},
    {InterpolationChoice::kAuto, "auto"}};
constexpr Word<KeyframePoses> kKeyframePoses[] = {{KeyframePoses::kNative, "native"},
                                                  {KeyframePoses::kDraco, "draco"},
                                                  {KeyframePoses::kAuto, "auto"}};
constexpr Word<OrderChoice> kOrders[] = {{OrderChoice::kAuto, "auto"},
                                         {OrderChoice::kVertices, "vertices"},
                                         {OrderChoice::kFree, "free"},
                                         {OrderChoice::kAll, "all"}};
constexpr Word<TopologyChanges> kTopologyChanges[] = {{TopologyChanges::kRefuse, "refuse"},
                                                      {TopologyChanges::kKeep, "keep"},
                                                      {TopologyChanges::kTransfer, "transfer"}};
constexpr Word<MassageMode> kMassageModes[] = {
    {MassageMode::kOff, "off"}, {MassageMode::kOn, "on"}, {MassageMode::kAuto, "auto"}};

void set_names(const std::string& list, MeshSequence& sequence) {
  if (list.empty())
    return;
  if (sequence.clips.empty()) {
    sequence.name = list;
    return;
  }
  const std::vector<std::string> names = split_at_commas(list);
  if (names.size() != sequence.clips.size())
    throw Error(ErrorKind::kUsage,
                fmt::format("--name: {} names for {} clips", names.size(), sequence.clips.size()));
  for (size_t c = 0; c < names.size(); ++c)
    sequence.clips[c].name = names[c];
}

/// Adds the events of --event to their clips.
void set_events(const std::vector<std::string>& events, MeshSequence& sequence) {
  for (const std::string& text : events) {
    const size_t equals = text.rfind('=');
    if (equals == std::string::npos)
      throw Error(ErrorKind::kUsage, "--event: '" + text + "' is not NAME=SECONDS");
    NamedTime event{text.substr(0, equals), -1};
    const char* last = text.data() + text.size();
    const auto read = std::from_chars(text.data() + equals + 1, last, event.seconds);
    if (read.ec != std::errc() || read.ptr != last || !std::isfinite(event.seconds))
      throw Error(ErrorKind::kUsage, "--event: '" + text + "' has no time in seconds");
    if (sequence.clips.empty()) {
      ClipTiming clip = clips_of(sequence)[0];
      add_event(event, &clip);
      sequence.events = std::move(clip.events);
      continue;
    }
    const auto clip = std::ranges::find_if(
        sequence.clips, [&](const ClipTiming& c) { return event.name.starts_with(c.name + ":"); });
    if (clip == sequence.clips.end())
      throw Error(ErrorKind::kUsage,
                  "--event: '" + text + "' names no clip; of several it is CLIP:NAME=SECONDS");
    event.name.erase(0, clip->name.size() + 1);
    add_event(event, &*clip);
  }
}

void add_target(Options& options, EncodeArguments& a) {
  options.group("Target");
  options.option("--max-error", a.max_error, "LEN", "Largest error of any vertex (default 0.05%)");
  options.option("--kg", a.kg, "PCT", "KG error in per cent");
  options.option("--rmse", a.rmse, "LEN", "Root mean square error");
  options.option("--displacement", a.displacement, "LEN",
                 "Largest error of a vertex's move from frame to frame: less jitter");
  options.option("--sted", a.sted, "X", "STED, a perceptual error");
  options.choice(
      "--quality", a.quality, {kQualities},
      "Visible beside the original (good, STED 0.05), hardly (better, 0.02), not (best, 0.01)");
  options.option("--size", a.size, "BYTES",
                 "Smallest error in a file of at most 40000, 40k or 1.5M bytes");
  options.option("--bpfv", a.bpfv, "BITS", "The same, as bits per frame and vertex");
  options.flag("--lossless", a.lossless,
               "The positions come back bit for bit; the file is several times as large");
  options.exclude({"--kg", "--rmse", "--displacement", "--sted", "--quality", "--size", "--bpfv",
                   "--lossless"});
  options.exclude({"--max-error", "--lossless"});
}

void add_method(Options& options, EncodeArguments& a) {
  options.group("Method");
  options.choice("--basis", a.basis, {kBases}, "Kind of basis (default auto: the smallest file)");
  options.number("--keyframes", a.keyframes, "K", {1, kMaxFrames},
                 "Number of key-frames (default: as few as do)");
  options.choice("--keyframe-selection", a.selection, {kSelections},
                 "How key-frames are chosen (default pivot)");
  options.choice("--interpolation", a.interpolation, {kInterpolations},
                 "How frames come from key-frames: linear, msgi, which decoders may lack, or auto "
                 "(default linear, of --basis auto auto)");
  options.choice(
      "--keyframe-coder", a.keyframe_coder, {kKeyframePoses},
      "Coder of key-frames: native (default), draco, which decoders may lack, or the smaller "
      "(auto)");
  options.choice(
      "--order", a.order, {kOrders},
      "Source order kept: that of vertices, none (free), of faces too (all); default auto: "
      "vertices, of glTF and FBX scenes none");
  options.choice("--topology-changes", a.topology_changes, {kTopologyChanges},
                 "Frames whose faces differ: refuse them (default), keep them as meshes of the "
                 "file, or transfer the faces of the first frame to all");
  options.flag("--split-objects", a.split_objects,
               "Store each object of the input as a mesh, present only in the frames that show it "
               "(default: as parts of one mesh)");
  options.choice("--effort", a.effort, {kEfforts}, "How long to search (default normal)");
  options.flag(
      "--smallest", a.smallest,
      "Make the file as small as can be, however long it takes to open (default: a balance)");
}

void add_massage_options(Options& options, EncodeArguments& a) {
  options.group("Massage");
  options.choice("--massage", a.massage, {kMassageModes},
                 "Move vertices along their surface first (default off)");
  options.number("--massage-strength", a.massage_strength, "X", {},
                 "Weight of shape against distance, between 0 and 1 (default 0.5)");
  options.option("--massage-tolerance", a.massage_tolerance, "LEN",
                 "How far the surface may move anywhere (default: as far as it needs)");
}

void add_attributes(Options& options, EncodeArguments& a) {
  options.group("Attributes");
  options.flag("--no-attributes", a.no_attributes, "Positions and faces alone");
  options.number("--uv-bits", a.attributes.uv_bits, "N", {1, 24},
                 "Texture coordinates in steps of 2^-N (default 12)");
  options.number("--colour-bits", a.attributes.colour_bits, "N", {1, 16},
                 "Bits for each component of a colour (default 8)");
  options.option("--attribute-error", a.attribute_error, "X",
                 "Largest error of colours, texture coordinates and other numbers that change, in "
                 "their own units or per cent of their range (default: half a step of "
                 "--colour-bits for colours, 0.1% for others)");
  options.option(
      "--fields", a.fields, "NAME,...|none",
      "Numbers beside positions, colours and texture coordinates that are kept (default: all)");
  options.repeated("--field-error", a.field_errors, "NAME=X|exact",
                   "Largest error of one of them, or of another attribute, in its units or per "
                   "cent of its range; exact: "
                   "whole numbers stay as they are");
  options.repeated("--field-unit", a.field_units, "NAME=TEXT",
                   "Unit of its values, as K or m/s: shown by info");
  options.option("--store-normals", a.normal_error, "DEG",
                 "Normals and tangents of the first frame as numbers, not only the hard edges: to "
                 "within an angle in degrees, as 0.05");
}

void add_metadata(Options& options, EncodeArguments& a) {
  options.group("Metadata (positions stay as they are)");
  options.option("--fps", a.rate, "N[/D]",
                 "Frames per second (default: as in the input, else 24; of a scene: the grid that "
                 "its keys stand on, or without one a rate of 30 or more that ends with the last)");
  options.choice("--up", a.up, {kUpAxes}, "Axis that points up");
  options.option("--unit", a.unit, "METRES", "Length of a scene unit: metres, or m cm mm km in ft");
  options.repeated("--event", a.events, "[CLIP:]NAME=SECONDS",
                   "A named time of the clip, from its first frame on, or of one of several clips");
  options.repeated("--meta", a.metadata, "KEY=VALUE",
                   "Facts to store in the file, as author=, licence=, source=: shown by info");
  options.option("--meta-file", a.metadata_file, "FILE.json", "The same, as a JSON object");
  options.flag("--root-motion", a.root_motion,
               "Keep the motion of the whole along the ground, and its turn about the up axis, "
               "apart: a program can leave it out and move the character itself");
  options.flag("--loop", a.loop, "The clip is meant to be repeated");
}

}  // namespace

namespace {

/// The JSON object of --meta-file with the entries of --meta; empty for none.
std::string metadata_of(const EncodeArguments& command) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  if (!command.metadata_file.empty()) {
    const std::string text = read_bytes(command.metadata_file);
    if (is_metadata(view_of(text)))
      object = nlohmann::ordered_json::parse(text, nullptr, false);
    if (!is_metadata(view_of(text)) || !object.is_object())
      throw Error(ErrorKind::kInput,
                  command.metadata_file + ": is not a JSON object in UTF-8 of at most 2^20 bytes");
  }
  for (const std::string& entry : command.metadata) {
    const size_t equals = entry.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Error(ErrorKind::kUsage, "--meta takes KEY=VALUE, not " + entry);
    object[entry.substr(0, equals)] = entry.substr(equals + 1);
  }
  if (object.empty())
    return {};
  try {
    return object.dump();
  } catch (const nlohmann::ordered_json::exception&) {
    throw Error(ErrorKind::kUsage, "--meta: a key or value is not UTF-8");
  }
}

}  // namespace

void add_arguments(Options& options, EncodeArguments& a) {
  options.arguments("INPUT", a.inputs, "Mesh and vertex cache, frames, or a scene");
  options
      .option("-o,--output", a.output, "FILE",
              "The .anic file to write, or a .glb for a glTF scene; of --batch: the folder")
      .required();
  options.option(
      "--mesh", a.mesh, "FILE|NAME",
      "Mesh of a lone vertex cache (default: same stem beside it), or the name of one in "
      "a scene (default: all)");
  options.option("--clip", a.clip, "NAME|INDEX", "Animation of a scene, several as A+B, or none");
  options.option("--clips", a.clips, "all|NAME,...",
                 "Several animations of a scene, as clips of one file");
  options.option("--name", a.names, "NAME,...",
                 "Name of the clip, or of each (default: of the cache or animation)");
  options.exclude({"--clip", "--clips"});
  options.option("--part", a.part, "A:B", "Encode only frames A to B - 1, as a part for join");
  options.option("--batch", a.batch, "DIR|LIST",
                 "Encode all clips in a folder, or in a list with a clip per line");
  options.option("--memory", a.memory, "BYTES",
                 "For a run, or all clips of --batch (default: half of the machine): frames beyond "
                 "a third of it lie in files in "
                 "TMPDIR or /var/tmp; fewer threads work where it is short; what takes more is "
                 "refused, or runs alone");
  options.flag("--allow-outside", a.allow_outside,
               "Let a scene name files outside its folder: those of strangers then choose what is "
               "read");
  options.option("--origin", a.origin, "auto|none|X,Y,Z",
                 "Point that positions are kept from, as float32 has few digits for a small mesh "
                 "far from zero; decode adds it "
                 "(default auto: amid such a mesh, else none)");
  options.flag("--no-weld", a.no_weld,
               "Take every corner of STL files as a vertex: corners at one place may part later");
  options.flag("--live", a.live,
               "INPUT is a mesh, its frames come from the standard input: float32 x, y, z of each "
               "vertex, little-endian");
  options.number("--piece", a.piece, "SECONDS", {0.001, 3600},
                 "Length of a piece of --live (default 1)");
  options.number(
      "--key-every", a.key_every, "SECONDS", {0, 1e6},
      "Time between pieces of --live that need none before them (default 4; 0: all are such)");
  options.option("--box", a.box, "LEN",
                 "Diagonal for percentages of --live (default: the first piece's)");
  add_target(options, a);
  add_method(options, a);
  add_massage_options(options, a);
  add_attributes(options, a);
  add_metadata(options, a);
  options.watch([&a](const Option& option, const std::string& value) {
    const std::string name = option.long_name();
    if (!option.is_argument() && option.group != kGeneralGroup && name != "--output" &&
        name != "--batch" && name != "--memory")
      a.given.push_back(name + "=" + value);
  });
}

void add_clip_arguments(Options& options, EncodeArguments& a) {
  options.arguments("FILE INPUT", a.inputs,
                    "The file, then mesh and vertex cache, frames, or a scene");
  options.option("-o,--output", a.output, "FILE", "The .anic file to write (default: FILE itself)");
  options.option("--mesh", a.mesh, "FILE|NAME", "Mesh of a lone vertex cache, or one of a scene");
  options.option("--clip", a.clip, "NAME|INDEX", "Animation of a scene");
  options.option("--name", a.names, "NAME",
                 "Name of the clip (default: of the cache or animation)");
  add_target(options, a);
  options.group("Method");
  options.choice("--basis", a.basis, {kBases}, "Kind of basis (default auto: the smallest file)");
  options.choice("--effort", a.effort, {kEfforts}, "How long to search (default normal)");
  add_metadata(options, a);
}

OrderMode order_of(OrderChoice choice, const std::vector<std::string>& inputs) {
  switch (choice) {
    case OrderChoice::kVertices:
      return OrderMode::kVertices;
    case OrderChoice::kFree:
      return OrderMode::kFree;
    case OrderChoice::kAll:
      return OrderMode::kAll;
    case OrderChoice::kAuto:
      break;
  }
  const bool scenes = !inputs.empty() && std::ranges::all_of(inputs, [](const std::string& path) {
    return is_scene(kind_of(path));
  });
  return scenes ? OrderMode::kFree : OrderMode::kVertices;
}

namespace {

AttributeBound parse_bound(const std::string& text, const std::string& option) {
  const Length error = parse_length(text, option);
  if (error.metres > 0)
    throw Error(ErrorKind::kUsage, option + ": colours and numbers have no length");
  return {error.percent ? AttributeBound::Measure::kPercent : AttributeBound::Measure::kUnits,
          error.value};
}

/// Does something with all attributes of a name. Throws Error(kUsage) if there are none.
template <class Work>
void with_attributes(const std::vector<MeshDetails*>& meshes, const std::string& name,
                     const std::string& option, const Work& work) {
  bool found = false;
  std::set<std::string> others;
  for (MeshDetails* mesh : meshes) {
    for (Attribute& attribute : mesh->attributes) {
      if (attribute.name == name) {
        found = true;
        work(attribute);
      } else if (!attribute.name.empty()) {
        others.insert(attribute.name);
      }
    }
  }
  if (!found)
    throw Error(ErrorKind::kUsage,
                others.empty() ? fmt::format("{}: there is no attribute with a name", option)
                               : fmt::format("{}: there is no attribute {}, but {}", option, name,
                                             fmt::join(others, ", ")));
}

/// NAME and VALUE of NAME=VALUE.
std::pair<std::string, std::string> name_and_value(const std::string& text,
                                                   const std::string& option) {
  const size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(ErrorKind::kUsage, fmt::format("{} takes NAME=VALUE, not {}", option, text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace

EncodeOptions encode_options(const EncodeArguments& command) {
  EncodeOptions options;
  options.basis = command.basis;
  if (command.keyframes > 0) {
    if (command.basis != BasisChoice::kAuto && command.basis != BasisChoice::kKeyframes)
      throw Error(ErrorKind::kUsage, "--keyframes goes with --basis keyframes only");
    options.keyframes = command.keyframes;
    options.basis = BasisChoice::kKeyframes;
  }
  options.select = command.selection;
  const bool fits =
      options.basis == BasisChoice::kKeyframes ||
      (options.basis == BasisChoice::kAuto && command.interpolation != InterpolationChoice::kMsgi);
  if (command.interpolation && !fits)
    throw Error(ErrorKind::kUsage,
                command.interpolation == InterpolationChoice::kMsgi
                    ? "--interpolation msgi goes with --basis keyframes or --keyframes"
                    : "--interpolation goes with --basis auto or keyframes");
  options.interpolation = command.interpolation;
  if (command.keyframe_coder != KeyframePoses::kNative && options.basis != BasisChoice::kKeyframes)
    throw Error(ErrorKind::kUsage, "--keyframe-coder goes with --basis keyframes or --keyframes");
  options.keyframe_poses = command.keyframe_coder;
  options.order = order_of(command.order, command.inputs);
  options.attributes = command.attributes;
  options.attributes.keep = !command.no_attributes;
  if (!command.normal_error.empty())
    options.attributes.normals = parse_positive(command.normal_error, "--store-normals");
  if (!command.attribute_error.empty()) {
    options.attributes.error = parse_bound(command.attribute_error, "--attribute-error");
  }
  options.root_motion = command.root_motion;
  options.metadata = metadata_of(command);
  options.effort = command.effort;
  options.smallest = command.smallest;
  options.most_bytes =
      command.memory.empty() ? half_of_machine() : parse_size(command.memory, "--memory");
  options.encoder = fmt::format("anicodec {}", version());
  set_target(command, std::nullopt, options);
  return options;
}

void set_target(const EncodeArguments& command, double metres_per_unit, EncodeOptions* options) {
  set_target(command, std::optional(metres_per_unit), *options);
}

namespace {

/// Empty: the importer finds one.
std::optional<Point> origin_of(const EncodeArguments& command) {
  const bool moves = !command.live && kind_of(command.output) != FileKind::kGlb;
  if (command.origin.empty() || command.origin == "auto")
    return moves ? std::nullopt : std::optional(Point());
  if (command.origin == "none")
    return Point();
  if (!moves)
    throw Error(ErrorKind::kUsage, "--origin goes without --live and .glb outputs");
  Point point{};
  const std::vector<std::string> numbers = split_at_commas(command.origin);
  for (size_t k = 0; k < 3; ++k) {
    const char* end = numbers.size() == 3 ? numbers[k].data() + numbers[k].size() : nullptr;
    if (!end || std::from_chars(numbers[k].data(), end, point[k]).ptr != end ||
        !std::isfinite(point[k]))
      throw Error(ErrorKind::kUsage,
                  "--origin: '" + command.origin + "' is neither auto, none nor X,Y,Z");
  }
  return point;
}

}  // namespace

LoadOptions load_options(const EncodeArguments& command, const Progress& progress) {
  LoadOptions options;
  options.mesh = command.mesh;
  options.clip = command.clip;
  options.clips = split_at_commas(command.clips);
  options.progress = progress;
  options.allow_outside = command.allow_outside;
  options.weld_stl = !command.no_weld;
  options.measures_rounding = command.lossless;
  options.origin = origin_of(command);
  options.scene_stays = kind_of(command.output) == FileKind::kGlb;
  if (!command.memory.empty() && command.batch.empty())
    options.memory = parse_size(command.memory, "--memory");
  options.note = command.note;
  if (!command.rate.empty())
    options.rate = parse_frame_rate(command.rate);
  return options;
}

MassageOptions massage_options(const EncodeArguments& command, const MeshSequence& sequence) {
  MassageOptions options;
  options.strength = command.massage_strength;
  if (!command.massage_tolerance.empty()) {
    const Length length = parse_length(command.massage_tolerance, "--massage-tolerance")
                              .in_scene_units(sequence.metres_per_unit, "--massage-tolerance");
    options.tolerance = length.percent ? length.value / 100 * diagonal(sequence) : length.value;
  }
  return options;
}

void set_metadata(const EncodeArguments& command, MeshSequence& sequence) {
  if (command.up != UpAxis::kUnknown)
    sequence.up = command.up;
  if (!command.unit.empty())
    sequence.metres_per_unit = parse_unit(command.unit, "--unit");
  sequence.loop = command.loop;
  for (ClipTiming& clip : sequence.clips)
    clip.loop = command.loop;
  set_names(command.names, sequence);
  set_events(command.events, sequence);
}

void set_fields(const EncodeArguments& command, const std::vector<MeshDetails*>& meshes) {
  if (!command.fields.empty()) {
    std::vector<std::string> kept;
    if (command.fields != "none")
      kept = split_at_commas(command.fields);
    for (const std::string& name : kept)
      with_attributes(meshes, name, "--fields", [](const Attribute&) {});
    for (MeshDetails* mesh : meshes)
      std::erase_if(mesh->attributes, [&](const Attribute& a) {
        return a.kind == AttributeKind::kCustom && std::ranges::count(kept, a.name) == 0;
      });
  }
  for (const std::string& text : command.field_errors) {
    const auto [name, value] = name_and_value(text, "--field-error");
    const std::string option = "--field-error " + name;
    const AttributeBound bound = value == "exact" ? AttributeBound{AttributeBound::Measure::kExact}
                                                  : parse_bound(value, option);
    with_attributes(meshes, name, option, [&](Attribute& a) { a.bound = bound; });
  }
  for (const std::string& text : command.field_units) {
    const auto [name, unit] = name_and_value(text, "--field-unit");
    with_attributes(meshes, name, "--field-unit " + name,
                    [unit = unit](Attribute& a) { a.unit = unit; });
  }
}

std::string settings_of(const EncodeArguments& c, const EncodeOptions& options) {
  return nlohmann::ordered_json{c.given, options.encoder, options.metadata}.dump();
}

}  // namespace anicodec::tools
