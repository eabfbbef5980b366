// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/options/parse_options.h"

#include "tests/tools/io_testing.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

enum class Fruit { kApple, kPear };

constexpr Word<Fruit> kFruits[] = {{Fruit::kApple, "apple"}, {Fruit::kPear, "pear"}};

/// A command with an option of every kind.
class ParseOptions : public testing::Test {
 protected:
  ParseOptions() {
    options_.arguments("INPUT", inputs_, "Inputs");
    options_.option("-o,--output", output_, "FILE", "Output").required();
    options_.flag("-q,--quiet", quiet_, "Quiet");
    options_.count("-v,--verbose", verbosity_, "Verbose");
    options_.number("--effort", effort_, "N", {1, 9}, "Effort");
    options_.number("--share", share_, "X", {}, "Share");
    options_.choice("--fruit", fruit_, {kFruits}, "Fruit");
    options_.flag("--csv", csv_, "CSV");
    options_.flag("--json", json_, "JSON");
    options_.flag("--help", help_, "Help").is_alone = true;
    options_.exclude({"--csv", "--json"});
  }

  void parse(const std::vector<std::string>& words) { parse_options(options_, words); }

  std::string fault_of(const std::vector<std::string>& words) {
    return fault([&] { parse(words); }, ErrorKind::kUsage);
  }

  Options options_;
  std::vector<std::string> inputs_;
  std::string output_;
  bool quiet_ = false, csv_ = false, json_ = false, help_ = false;
  int verbosity_ = 0;
  uint32_t effort_ = 5;
  double share_ = 0.5;
  Fruit fruit_ = Fruit::kApple;
};

TEST_F(ParseOptions, ReadsEveryKind) {
  parse({"a", "--output", "x", "b", "-qv", "--effort=7", "--share", "-0.25", "--fruit", "pear",
         "-v", "--csv"});
  EXPECT_THAT(inputs_, ElementsAre("a", "b"));
  EXPECT_EQ(output_, "x");
  EXPECT_TRUE(quiet_);
  EXPECT_EQ(verbosity_, 2);
  EXPECT_EQ(effort_, 7U);
  EXPECT_EQ(share_, -0.25);
  EXPECT_EQ(fruit_, Fruit::kPear);
  EXPECT_TRUE(csv_);
  EXPECT_FALSE(json_);
}

TEST_F(ParseOptions, TakesArgumentsWithDashesAfterTwo) {
  parse({"-ox", "--", "-a.obj", "--csv"});
  EXPECT_THAT(inputs_, ElementsAre("-a.obj", "--csv"));
  EXPECT_FALSE(csv_);
}

TEST_F(ParseOptions, TakesALoneDash) {
  parse({"-", "-o", "-"});
  EXPECT_THAT(inputs_, ElementsAre("-"));
  EXPECT_EQ(output_, "-");
}

TEST_F(ParseOptions, NamesWhatIsWrong) {
  EXPECT_EQ(fault_of({"a"}), "--output is missing");
  EXPECT_EQ(fault_of({"a", "-o"}), "--output needs a value");
  EXPECT_EQ(fault_of({"-o", "x", "-o", "y"}), "--output is given more than once");
  EXPECT_EQ(fault_of({"-o", "x", "--effort", "12"}),
            "--effort: '12' is not a whole number from 1 to 9");
  EXPECT_EQ(fault_of({"-o", "x", "--effort", "7x"}),
            "--effort: '7x' is not a whole number from 1 to 9");
  EXPECT_EQ(fault_of({"-o", "x", "--share", "nan"}), "--share: 'nan' is not a number");
  EXPECT_EQ(fault_of({"-o", "x", "--fruit", "plum"}), "--fruit: 'plum' is not one of apple|pear");
  EXPECT_EQ(fault_of({"-o", "x", "--csv", "--json"}), "only one of --csv and --json can be given");
  EXPECT_EQ(fault_of({"-o", "x", "--csv=no"}), "--csv takes no value");
}

TEST_F(ParseOptions, SuggestsAnOption) {
  EXPECT_EQ(fault_of({"-o", "x", "--efort", "3"}),
            "there is no option --efort; did you mean --effort?");
  EXPECT_EQ(fault_of({"-o", "x", "--colour"}), "there is no option --colour");
  EXPECT_EQ(fault_of({"-o", "x", "-w"}), "there is no option -w");
}

TEST_F(ParseOptions, RefusesMoreArgumentsThanThereAre) {
  Options one;
  std::string file;
  one.argument("FILE", file, "File");
  parse_options(one, {"a"});
  EXPECT_EQ(file, "a");
  EXPECT_EQ(fault(
                [&] {
                  parse_options(one, {"a", "b"});
                },
                ErrorKind::kUsage),
            "'b' is one argument too many");
}

TEST_F(ParseOptions, HelpNeedsNothingElse) {
  parse({"--colour", "--help"});
  EXPECT_TRUE(help_);
}

}  // namespace
}  // namespace anicodec::tools
