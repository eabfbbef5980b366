// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/join_clips.h"
#include "codec/file/left_out.h"
#include "tools/inputs/clip_input.h"
#include "tools/io/files/atomic_file.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/quantity.h"

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kJoinFooter =
    R"(PART are .anic files that encode --part made of one clip with the same options, in any order and
without gaps; together they need not be the whole clip. Nothing is coded again: the mesh and the
reference pose, which all parts share, are stored once.

Examples:
  anicodec encode walk.obj walk.pc2 --kg 0.1 --part 0:500    -o a.anic     # on one machine
  anicodec encode walk.obj walk.pc2 --kg 0.1 --part 500:1000 -o b.anic     # on another
  anicodec join a.anic b.anic -o walk.anic)";

struct JoinCommand {
  std::vector<std::string> inputs;
  std::string output;
};

void run(const JoinCommand& command, const CommonOptions& common) {
  check_anic_output(command.output);
  AtomicFile output(command.output, common.overwrite);
  std::deque<std::string> files;
  std::vector<ClipPart> parts;
  for (const std::string& path : command.inputs) {
    files.push_back(read_bytes(path));
    parts.push_back({path, view_of(files.back())});
  }
  const Bytes joined = join_clips(parts);
  const std::vector<std::string> left_out = list_left_out(parts, joined);
  output.write({reinterpret_cast<const char*>(joined.data()), joined.size()});
  output.commit();
  if (common.json) {
    print_json({{"file", command.output},
                {"bytes", joined.size()},
                {"parts", parts.size()},
                {"left_out", left_out}});
  } else if (!common.quiet) {
    for (const std::string& line : left_out)
      print_line(stderr, "anicodec: {}", line);
    print_line("{}: {} bytes of {} parts", command.output, grouped(joined.size()), parts.size());
  }
}

}  // namespace

void add_join(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<JoinCommand>();
  Options& options =
      add_command(commands, common, kForce | kQuiet | kJson,
                  {"join", "PART... -o FILE.anic [options]",
                   "Make one .anic file of parts that were encoded apart", kJoinFooter},
                  [c, &common] { run(*c, common); });
  options.arguments("PART", c->inputs, "Parts of a clip").required();
  options.option("-o,--output", c->output, "FILE", "The .anic file to write").required();
}

}  // namespace anicodec::tools
