// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/encode_arguments.h"

#include "codec/sequence/error.h"
#include "tools/options/options.h"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

/// The settings of a command line that gives one option, by its place in the table; empty: it takes no such
/// value.
std::string settings_with(size_t number, const std::string& value) {
  Options options;
  EncodeArguments arguments;
  add_arguments(options, arguments);
  try {
    options.all()[number].read(value);
  } catch (const Error&) {
    return "";
  }
  return settings_of(arguments, {});
}

TEST(EncodeArguments, EveryOptionThatChangesAnOutputChangesTheSettings) {
  Options options;
  EncodeArguments none;
  add_arguments(options, none);
  const std::set<std::string> elsewhere = {"INPUT", "--output", "--batch", "--memory"};
  std::set<std::string> seen{settings_of(none, {})};
  for (size_t i = 0; i < options.all().size(); ++i) {
    const Option& option = options.all()[i];
    std::string settings;
    std::vector<std::string> values = option.words;
    values.insert(values.end(), {option.kind == Option::Kind::kFlag ? "" : "1", "0.5", "text"});
    for (size_t v = 0; settings.empty() && v < values.size(); ++v)
      settings = settings_with(i, values[v]);
    EXPECT_FALSE(settings.empty()) << option.names;
    EXPECT_EQ(seen.insert(settings).second, !elsewhere.contains(option.long_name()))
        << option.names;
  }
}

}  // namespace
}  // namespace anicodec::tools
