// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/subdivide.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tools/io/file_formats.h"
#include "tools/io/write_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/progress_line.h"

#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kCorpusFooter = R"(Examples:
  anicodec corpus --list
  anicodec corpus limb -o limb.pc2
  anicodec corpus cloth -o cloth/frame_%04d.obj --vertices 20000 --frame-count 100
  anicodec corpus limb -o fine.pc2 --subdivide 2)";

struct CorpusCommand {
  std::string name, output;
  bool list = false;
  uint32_t vertices = 0, frames = 0, levels = 0;
};

void run(const CorpusCommand& command, const CommonOptions& common) {
  if (command.list) {
    if (!command.name.empty() || !command.output.empty())
      throw Error(ErrorKind::kUsage, "corpus: --list stands alone");
    for (const corpus::ClipInfo& clip : corpus::clips()) {
      if (common.json)
        print_json(
            {{"name", clip.name}, {"description", clip.description}, {"scalable", clip.scalable}});
      else
        fmt::print("{:<14} {}{}\n", clip.name, clip.description,
                   clip.scalable ? " (scalable)" : "");
    }
    return;
  }
  if (command.name.empty() || command.output.empty())
    throw Error(ErrorKind::kUsage, "corpus: a NAME and -o OUT are needed, or --list");
  ProgressLine line(common.quiet);
  MeshSequence clip = command.vertices > 0 || command.frames > 0
                          ? corpus::make_scaled(command.name, command.vertices, command.frames)
                          : corpus::make_clip(command.name);
  if (command.levels > 0)
    clip = subdivide(clip, command.levels);
  WriteOptions options;
  options.overwrite = common.overwrite;
  options.progress = line.callback();
  check_sequence_output(command.output, clip.frame_count, options);
  write_sequence(command.output, clip, options);
  line.clear();
  print_written({command.output, clip.frame_count, clip.vertex_count, clip.polygons.size()},
                common);
}

}  // namespace

void add_corpus(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<CorpusCommand>();
  Options& options = add_command(
      commands, common, kForce | kQuiet | kJson,
      {"corpus", "NAME -o OUT [options]", "Make one of the clips of the corpus", kCorpusFooter},
      [c, &common] { run(*c, common); });
  options.argument("NAME", c->name, "Which clip");
  options.option("-o,--output", c->output, "OUT", output_names());
  options.flag("--list", c->list, "List the clips");
  options.number("--vertices", c->vertices, "N", {1U, (1U << 31) - 1},
                 "About as many vertices (scalable clips)");
  options.number("--frame-count", c->frames, "N", {1U, (1U << 24) - 1},
                 "As many frames (scalable clips)");
  options.number("--subdivide", c->levels, "LEVELS", {1U, 8U},
                 "Smooth by Loop subdivision: four triangles of each, without attributes");
}

}  // namespace anicodec::tools
