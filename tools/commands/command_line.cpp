// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/commands/command_line.h"

#include "codec/sequence/error.h"
#include "tools/commands/command.h"
#include "tools/io/files/cleanup.h"
#include "tools/words/help_format.h"
#include "tools/words/version.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <tbb/global_control.h>

namespace anicodec::tools {
namespace {

constexpr const char* kFooter = R"(
Examples:
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

/// Prints an error as one line.
void print_error(std::string_view text) {
  std::string line(text);
  line.erase(line.find_last_not_of(" \n") + 1);
  std::replace(line.begin(), line.end(), '\n', ' ');
  fmt::print(stderr, "anicodec: {}\n", line);
}

int status_of(ErrorKind kind) {
  return static_cast<int>(kind);
}

void add_version(CLI::App& app) {
  app.set_version_flag("--version", fmt::format("anicodec {}", version()), "Print the version");
}

void parse_and_run(int argc, const char* const* argv) {
  CommonOptions common;
  CLI::App app("Makes animated meshes small: encodes baked mesh sequences to .anic and back.");
  app.name("anicodec");
  app.formatter(std::make_shared<HelpFormat>("COMMAND [options]"));
  app.set_help_flag("-h,--help", "Print this help");
  add_version(app);
  app.require_subcommand(1);
  app.footer(kFooter);
  for (auto add : {add_encode, add_decode, add_join, add_info, add_verify, add_compare, add_analyze,
                   add_interpolate, add_massage, add_dump, add_render, add_corpus})
    add(app, common);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    app.exit(e);  // prints help or version
  } catch (const CLI::ParseError& e) {
    std::string command;
    for (const CLI::App* sub : app.get_subcommands())
      command = sub->get_name() + ": ";
    throw Error(ErrorKind::kUsage, command + e.what());
  }
  if (std::fflush(stdout) != 0)
    throw Error(ErrorKind::kInternal, "the standard output cannot be written");
}

}  // namespace

CLI::App* add_command(CLI::App& app, CommonOptions& common, const CommandHelp& help,
                      std::function<void()> run) {
  CLI::App* command = app.add_subcommand(help.name, help.description);
  command->group("Commands");
  command->formatter(std::make_shared<HelpFormat>(help.usage));
  command->footer(help.footer.empty() ? "" : "\n" + help.footer);
  const char* group = kGeneralGroup;
  command->set_help_flag("-h,--help", "Print this help")->group(group);
  add_version(*command);
  command->get_version_ptr()->group(group);
  command->add_flag("-f,--force", common.overwrite, "Overwrite outputs that exist")->group(group);
  command->add_flag("-q,--quiet", common.quiet, "Print nothing but errors and what was asked for")
      ->group(group);
  command->add_flag("-v,--verbose", common.verbosity, "Print more")->group(group);
  command->add_option("-j,--threads", common.threads, "Threads (default: one for every processor)")
      ->option_text("N")
      ->check(CLI::Range(1, 1024))
      ->group(group);
  command->callback([&common, run = std::move(run)] {
    size_t threads =
        common.threads > 0
            ? static_cast<size_t>(common.threads)
            : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    run();
  });
  return command;
}

int run_command_line(int argc, const char* const* argv) {
  install_cleanup_on_signal();
  try {
    parse_and_run(argc, argv);
    return 0;
  } catch (const Error& e) {
    print_error(e.what());
    return status_of(e.kind());
  } catch (const std::bad_alloc&) {
    print_error("not enough memory");
  } catch (const std::exception& e) {
    print_error(fmt::format("internal error: {}", e.what()));
  }
  return status_of(ErrorKind::kInternal);
}

}  // namespace anicodec::tools
