// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"
#include "codec/file/edit_clips.h"
#include "codec/file/left_out.h"
#include "codec/sequence/error.h"
#include "tools/inputs/clip_input.h"
#include "tools/inputs/encode_arguments.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/load_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kAddFooter =
    R"(FILE is an .anic file of one mesh, and INPUT is what encode takes, of the same mesh: vertices and
faces in the same order. The clips that are there are not coded again: their bytes stay. Mesh and
order are stored once, and so is the reference pose where that is smaller (-v says so). The new
clip keeps the target of the last clip of the file, a length in scene units, unless another one is
given; a percentage is of its own diagonal.

Examples:
  anicodec add hero.anic hero.obj jump.pc2
  anicodec add hero.anic hero.glb --clip Jump --name jump -o more.anic)";

constexpr const char* kRemoveFooter =
    R"(The clips that stay are not coded again: their bytes stay. A clip that shares its basis with one
that stays cannot be removed.

Examples:
  anicodec remove hero.anic jump
  anicodec remove hero.anic jump fly -o less.anic)";

void print_left_out(const std::vector<std::string>& lines) {
  for (const std::string& line : lines)
    print_line(stderr, "anicodec: {}", line);
}

void write_file(const std::string& path, const Bytes& bytes, bool overwrite) {
  AtomicFile output(path, overwrite);
  output.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  output.commit();
}

/// The target of the last clip, if another clip can be asked for it.
Target target_of(const ClipHome& home) {
  if (home.asked == ErrorMetric::kKg || home.asked == ErrorMetric::kMaxError ||
      home.asked == ErrorMetric::kRmse || is_motion(home.asked))
    return {home.asked, home.asked_value, false};
  return {ErrorMetric::kMaxError, 0.05, true};
}

bool has_target(const EncodeArguments& command) {
  return !command.kg.empty() || !command.max_error.empty() || !command.rmse.empty() ||
         !command.displacement.empty() || !command.sted.empty() || command.quality ||
         !command.size.empty() || !command.bpfv.empty();
}

void check_agrees(const std::string& path, const ClipHome& home, MeshSequence* sequence) {
  const UpAxis up = static_cast<UpAxis>(home.up);
  if (sequence->up != UpAxis::kUnknown && up != UpAxis::kUnknown && sequence->up != up)
    throw Error(ErrorKind::kInput, path + ": another axis is up than in the file");
  sequence->up = up;
  for (const ClipTiming& clip : clips_of(*sequence)) {
    if (std::ranges::find(home.names, clip.name) != home.names.end())
      throw Error(ErrorKind::kInput, path + ": the file has a clip '" + clip.name + "' already");
  }
}

void add(EncodeArguments command, const CommonOptions& common) {
  if (command.inputs.size() < 2)
    throw Error(ErrorKind::kUsage, "add: FILE.anic and an INPUT are required");
  const std::string path = command.inputs[0];
  command.inputs.erase(command.inputs.begin());
  const bool in_place = command.output.empty() || command.output == path;
  const std::string target = in_place ? path : command.output;
  check_anic_output(target);
  const std::string bytes = read_bytes(path);
  const ClipPart file{path, view_of(bytes)};
  const ClipHome home = clip_home(file);
  EncodeOptions options = encode_options(command);
  options.order = home.order;
  options.attributes.keep = false;
  ProgressLine line(common.quiet);
  const Progress progress = line.callback();
  LoadOptions load = load_options(command, progress);
  load.origin = home.origin;
  MeshSequence sequence = load_sequence(command.inputs, load);
  set_metadata(command, sequence);
  check_agrees(command.inputs[0], home, &sequence);
  if (has_target(command))
    set_target(command, sequence.metres_per_unit, &options);
  else
    options.target = target_of(home);
  Bytes best;
  std::vector<std::string> left_out;
  bool shares_pose = false;
  for (const bool with_pose : {true, false}) {
    if (with_pose && (!home.pose || options.basis == BasisChoice::kKeyframes))
      continue;
    options.pose = with_pose ? home.pose : nullptr;
    EncodeResult result;
    try {
      result = encode(sequence, options, progress);
    } catch (const Error& e) {
      if (!with_pose)
        throw Error(e.kind(), fmt::format("{}: {}", command.inputs[0], e.what()));
      continue;  // a pose of another number of vertices, or too coarse: the clip has its own
    }
    const ClipPart added{command.inputs[0], result.file};
    const Bytes all = add_clips(file, added);
    if (best.empty() || all.size() < best.size()) {
      best = all;
      left_out = list_left_out({file, added}, all);
      shares_pose = with_pose;
    }
  }
  line.clear();
  write_file(target, best, in_place || common.overwrite);
  const uint64_t more = best.size() - bytes.size();
  if (common.json) {
    print_json({{"file", target},
                {"bytes", best.size()},
                {"added", more},
                {"shares_pose", shares_pose},
                {"left_out", left_out}});
  } else if (!common.quiet) {
    print_left_out(left_out);
    print_line("{}: {} bytes, {} more", target, grouped(best.size()), grouped(more));
    if (common.verbosity > 0)
      print_line("shared with the file: mesh{}", shares_pose ? ", reference pose" : "");
  }
}

struct RemoveCommand {
  std::vector<std::string> words;
  std::string output;
};

void remove(const RemoveCommand& command, const CommonOptions& common) {
  if (command.words.size() < 2)
    throw Error(ErrorKind::kUsage, "remove: FILE.anic and a NAME are required");
  const std::string& path = command.words[0];
  const bool in_place = command.output.empty() || command.output == path;
  const std::string target = in_place ? path : command.output;
  check_anic_output(target);
  const std::string bytes = read_bytes(path);
  const ClipPart file{path, view_of(bytes)};
  const Bytes less = remove_clips(file, {command.words.begin() + 1, command.words.end()});
  const std::vector<std::string> left_out = list_left_out({file}, less);
  write_file(target, less, in_place || common.overwrite);
  if (common.json) {
    print_json({{"file", target}, {"bytes", less.size()}, {"left_out", left_out}});
  } else if (!common.quiet) {
    print_left_out(left_out);
    print_line("{}: {} bytes, {} less", target, grouped(less.size()),
               grouped(bytes.size() - less.size()));
  }
}

}  // namespace

void add_add(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<EncodeArguments>();
  Options& options =
      add_command(commands, common, kForce | kQuiet | kVerbose | kJson | kThreads,
                  {"add", "FILE.anic INPUT... [options]",
                   "Add a clip to a file without coding the others again", kAddFooter},
                  [c, &common] { add(*c, common); });
  add_clip_arguments(options, *c);
}

void add_remove(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<RemoveCommand>();
  Options& options =
      add_command(commands, common, kForce | kQuiet | kJson,
                  {"remove", "FILE.anic NAME... [options]",
                   "Take clips out of a file without coding the others again", kRemoveFooter},
                  [c, &common] { remove(*c, common); });
  options.arguments("FILE NAME", c->words, "The file, and the clips to take out").required();
  options.option("-o,--output", c->output, "FILE",
                 "The .anic file to write (default: FILE itself)");
}

}  // namespace anicodec::tools
