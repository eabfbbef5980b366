// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips that the project may not distribute, in the folder named by ANICODEC_DATA (default:
// shared/data beside the checkout).
#include "tests/real_data.h"

#include "tests/tools/command_testing.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

class RealDataEncode : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(real_data_folder()))
      GTEST_SKIP() << real_data_folder()
                   << " is absent; ANICODEC_DATA names the folder of real clips";
  }
};

TEST_P(RealDataEncode, KeepsItsPromise) {
  TemporaryFolder folder;
  std::string source = real_data_folder() + "/" + GetParam();
  Outcome encoded = anicodec({"encode", source, "-o", folder / "a.anic", "--max-error", "0.1%"});
  ASSERT_EQ(encoded.status, 0) << encoded;
  EXPECT_EQ(anicodec({"verify", folder / "a.anic"}).status, 0);
  Outcome compared = anicodec({"compare", source, folder / "a.anic", "--json", "--no-sted"});
  ASSERT_EQ(compared.status, 0) << compared;
  EXPECT_LE(compared.json()["max_error_percent"], 0.1);
}

INSTANTIATE_TEST_SUITE_P(, RealDataEncode,
                         testing::Values("classic/horse.pc2", "classic/horse_obj/*.obj",
                                         "classic/dance.pc2", "classic/chicken.pc2",
                                         "captured/face.pc2", "simulated/flag.pc2",
                                         "exported/obj/*.obj"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

class RealDataDance : public testing::Test {};

TEST_F(RealDataDance, FortyFiveKeyframesStayBelowOnePerCent) {
  std::string dance = real_data_folder() + "/classic/dance";
  if (!std::filesystem::exists(dance + ".pc2"))
    GTEST_SKIP() << dance << ".pc2 is absent; ANICODEC_DATA names the folder of real clips";
  TemporaryFolder folder;
  Outcome encoded = anicodec({"encode", dance + ".obj", dance + ".pc2", "-o", folder / "a.anic",
                              "--basis", "keyframes", "--keyframes", "45"});
  ASSERT_EQ(encoded.status, 0) << encoded;
  ASSERT_EQ(anicodec({"decode", folder / "a.anic", "-o", folder / "a.pc2"}).status, 0);
  Outcome compared = anicodec({"compare", dance + ".pc2", folder / "a.pc2", "--json"});
  ASSERT_EQ(compared.status, 0) << compared;
  EXPECT_LE(compared.json()["kg"], 1.0);
}

}  // namespace
}  // namespace anicodec::tools
