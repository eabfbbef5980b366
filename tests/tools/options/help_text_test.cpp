// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/options/help_text.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(HelpText, PutsGeneralOptionsLastAndWrapsTexts) {
  Options options;
  bool flag = false;
  std::string value;
  std::vector<std::string> values;
  options.group(kGeneralGroup);
  options.flag("-h,--help", flag, "Print this help");
  options.group("Options");
  options.arguments("INPUT", values, "Files");
  options.option("-o,--output", value, "FILE",
                 "A text of more letters than there is place for in the column that is left to it, "
                 "which is wrapped");
  options.option("--a-name-that-fills-its-column", value, "N", "Short");
  EXPECT_EQ(help_text(options), R"(
Arguments:
  INPUT...                    Files

Options:
  -o,--output FILE            A text of more letters than there is place for in the column that is
                              left to it, which is wrapped
  --a-name-that-fills-its-column N
                              Short

General:
  -h,--help                   Print this help
)");
}

}  // namespace
}  // namespace anicodec::tools
