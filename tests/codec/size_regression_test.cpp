// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Sizes of the corpus clips as tests/regression/sizes.csv states them. After a change that is meant
// to alter them, ANICODEC_UPDATE_SIZES=1 writes the file anew.
#include "build_paths.h"
#include "codec/encode.h"
#include "corpus/clips.h"

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr const char* kPath = ANICODEC_SOURCE_DIR "/tests/regression/sizes.csv";
constexpr const char* kHeader = "clip,basis,kg_asked,bytes";
constexpr double kTolerance = 0.01;  // of one machine against another

struct Preset {
  const char* basis;
  BasisChoice choice;
  double kg;
};

constexpr Preset kPresets[] = {{"auto", BasisChoice::kAuto, 0.1},
                               {"keyframes", BasisChoice::kKeyframes, 1}};

std::map<std::string, size_t> stated_sizes() {
  std::map<std::string, size_t> sizes;
  std::ifstream file(kPath);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    size_t comma = line.rfind(',');
    sizes[line.substr(0, comma)] = std::stoul(line.substr(comma + 1));
  }
  return sizes;
}

TEST(SlowSizes, AreAsStated) {
  const std::map<std::string, size_t> stated = stated_sizes();
  std::ostringstream measured;
  measured << kHeader << '\n';
  for (const std::string& clip : corpus::clip_names()) {
    const MeshSequence sequence = corpus::make_clip(clip);
    for (const Preset& preset : kPresets) {
      EncodeOptions options;
      options.target = {ErrorMetric::kKg, preset.kg, false};
      options.basis = preset.choice;
      options.effort = Effort::kFast;
      options.encoder = "anicodec";
      const size_t bytes = encode(sequence, options).file.size();
      std::ostringstream key;
      key << clip << ',' << preset.basis << ',' << preset.kg;
      measured << key.str() << ',' << bytes << '\n';
      const auto found = stated.find(key.str());
      EXPECT_TRUE(found != stated.end()) << key.str() << " is not in sizes.csv";
      if (found != stated.end()) {
        const auto size = static_cast<double>(found->second);
        EXPECT_NEAR(static_cast<double>(bytes), size, kTolerance * size + 8) << key.str();
      }
    }
  }
  if (std::getenv("ANICODEC_UPDATE_SIZES"))
    std::ofstream(kPath) << measured.str();
}

}  // namespace
}  // namespace anicodec
