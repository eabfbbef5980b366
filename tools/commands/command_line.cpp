// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/commands/command_line.h"

#include "tools/inputs/batch_clips.h"
#include "tools/io/files/cleanup.h"
#include "tools/program/command.h"

namespace anicodec::tools {
namespace {

constexpr const char* kLineFooter =
    R"(Examples:
  anicodec encode dance.obj dance.pc2 -o dance.anic
  anicodec encode 'frames/*.obj' -o clip.anic --kg 0.1
  anicodec decode clip.anic -o clip.pc2
  anicodec compare 'frames/*.obj' clip.anic

Exit status:
  0  done
  1  impossible options, or an output that exists (without -f)
  2  input that cannot be read or encoded
  3  a damaged .anic file
  4  a file or feature that this build does not support
  5  an internal error, no memory, or a full disk
'anicodec COMMAND --help' explains a command.)";

void declare_commands(Commands& commands, CommonOptions& common) {
  for (auto add : {add_encode,           add_decode,      add_join,           add_add,
                   add_remove,           add_info,        add_verify,         add_compare,
                   add_analyze,          add_interpolate, add_massage,        add_massage_fit,
                   add_massage_transfer, add_massage_map, add_massage_remesh, add_dump,
                   add_render,           add_export_vat,  add_corpus,         add_usd_plugin})
    add(commands, common);
}

}  // namespace

int run_command_line(int argc, const char* const* argv, bool leaves_stages) {
  if (leaves_stages)
    leave_stages_to_others();
  install_cleanup_on_signal();
  return run_program(
      {"anicodec", "Makes animated meshes small: encodes baked mesh sequences to .anic and back.",
       kLineFooter, declare_commands},
      argc, argv);
}

}  // namespace anicodec::tools
