// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The only file that knows CLI11, which is slow to compile: it takes the command line apart.
#include "tools/options/parse_options.h"

#include "codec/sequence/error.h"
#include "tools/options/nearest_word.h"

#include <algorithm>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace anicodec::tools {
namespace {

[[noreturn]] void fail(const std::string& text) {
  throw Error(ErrorKind::kUsage, text);
}

/// An option and what CLI11 found of it.
struct Parsed {
  const Option* option;
  CLI::Option* found;

  bool is_given() const { return found->count() > 0; }
};

CLI::Option* declare(CLI::App& app, const Option& option, size_t number) {
  if (option.kind == Option::Kind::kFlag)
    return app.add_flag(option.names);
  CLI::Option* found =
      app.add_option(option.is_argument() ? fmt::format("argument{}", number) : option.names);
  found->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  if (option.kind == Option::Kind::kArguments)
    return found->expected(0, CLI::detail::expected_max_vector_size)->allow_extra_args();
  return found->expected(1);
}

/// Fails for words that belong to no option.
void refuse_unknown(const CLI::App& app, const Options& options) {
  std::vector<std::string> unknown = app.remaining();
  std::erase(unknown, "--");  // CLI11 counts it among them
  if (unknown.empty())
    return;
  const std::string name = unknown[0].substr(0, unknown[0].find('='));
  if (name.size() < 2 || name[0] != '-')
    fail(fmt::format("'{}' is one argument too many", unknown[0]));
  std::vector<std::string> names;
  for (const Option& option : options.all())
    if (!option.is_argument())
      names.push_back(option.long_name());
  const std::string meant = nearest_word(name, names);
  fail(fmt::format("there is no option {}{}", name,
                   meant.empty() ? "" : fmt::format("; did you mean {}?", meant)));
}

void read_values(const Parsed& parsed) {
  const Option& option = *parsed.option;
  if (option.kind == Option::Kind::kFlag) {
    for (const std::string& value : parsed.found->results()) {
      if (value != "true")  // --flag=value
        fail(option.long_name() + " takes no value");
      option.read("");
    }
    return;
  }
  if (option.kind == Option::Kind::kValue && !option.repeats && parsed.found->count() > 1)
    fail(option.long_name() + " is given more than once");
  for (const std::string& value : parsed.found->results())
    option.read(value);
}

void refuse_excluded(const Options& options, const std::vector<Parsed>& all) {
  for (const std::vector<std::string>& names : options.excluded()) {
    const auto given = std::count_if(all.begin(), all.end(), [&](const Parsed& parsed) {
      return parsed.is_given() &&
             std::find(names.begin(), names.end(), parsed.option->long_name()) != names.end();
    });
    if (given > 1)
      fail(fmt::format("only one of {} and {} can be given",
                       fmt::join(names.begin(), names.end() - 1, ", "), names.back()));
  }
}

}  // namespace

void parse_options(const Options& options, const std::vector<std::string>& words) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  std::vector<Parsed> all;
  for (const Option& option : options.all())
    all.push_back({&option, declare(app, option, all.size())});
  try {
    app.parse(
        std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them backwards
  } catch (const CLI::ArgumentMismatch& e) {  // "--output: 1 required TEXT missing"
    const std::string text = e.what();
    fail(text.substr(0, text.find(':')) + " needs a value");
  } catch (const CLI::ParseError& e) {
    fail(e.what());
  }
  for (const Parsed& parsed : all) {
    if (parsed.option->is_alone && parsed.is_given())
      return parsed.option->read("");
  }
  refuse_unknown(app, options);
  for (const Parsed& parsed : all)
    read_values(parsed);
  for (const Parsed& parsed : all)
    if (parsed.option->is_required && !parsed.is_given())
      fail(parsed.option->long_name() + " is missing");
  refuse_excluded(options, all);
}

}  // namespace anicodec::tools
