// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/encode_arguments.h"

#include "codec/sequence/error.h"
#include "codec/sequence/machine_memory.h"
#include "format/metadata.h"
#include "tools/inputs/clip_input.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/file_formats.h"
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
    targets.push_back(
        {ErrorMetric::kSted, kQualitySteds[static_cast<size_t>(*command.quality)], false});
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
  add_encode_choices(options, a);
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
  add_clip_choices(options, a);
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
    return is_scene(path);
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
  copy_choices(command, &options);
  if (command.keyframes > 0) {
    if (command.basis != BasisChoice::kAuto && command.basis != BasisChoice::kKeyframes)
      throw Error(ErrorKind::kUsage, "--keyframes goes with --basis keyframes only");
    options.keyframes = command.keyframes;
    options.basis = BasisChoice::kKeyframes;
  }
  const bool fits =
      options.basis == BasisChoice::kKeyframes ||
      (options.basis == BasisChoice::kAuto && command.interpolation != InterpolationChoice::kMsgi);
  if (command.interpolation && !fits)
    throw Error(ErrorKind::kUsage,
                command.interpolation == InterpolationChoice::kMsgi
                    ? "--interpolation msgi goes with --basis keyframes or --keyframes"
                    : "--interpolation goes with --basis auto or keyframes");
  if (command.keyframe_coder != KeyframePoses::kNative && options.basis != BasisChoice::kKeyframes)
    throw Error(ErrorKind::kUsage, "--keyframe-coder goes with --basis keyframes or --keyframes");
  options.order = order_of(command.order, command.inputs);
  if (!command.normal_error.empty())
    options.attributes.normals = parse_positive(command.normal_error, "--store-normals");
  if (!command.attribute_error.empty()) {
    options.attributes.error = parse_bound(command.attribute_error, "--attribute-error");
  }
  options.metadata = metadata_of(command);
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
  const bool moves = !command.live && !is_scene_output(command.output);
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
  options.scene_stays = is_scene_output(command.output);
  if (!command.memory.empty() && command.batch.empty())
    options.memory = parse_size(command.memory, "--memory");
  options.note = command.note;
  if (!command.rate.empty())
    options.rate = parse_frame_rate(command.rate);
  return options;
}

void set_lengths(const EncodeArguments& command, const Scene& scene, EncodeOptions* options) {
  const double metres_per_unit = scene.clip.metres_per_unit;
  set_target(command, metres_per_unit, options);
  if (!command.massage_tolerance.empty()) {
    const Length length = parse_length(command.massage_tolerance, "--massage-tolerance")
                              .in_scene_units(metres_per_unit, "--massage-tolerance");
    options->massage.options.tolerance =
        length.percent ? length.value / 100 * diagonal(scene.meshes[0].sequence) : length.value;
  }
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
