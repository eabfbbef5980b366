// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/bench/bench_clips.h"

#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace anicodec::bench {
namespace {

bool names_files(const std::string& word) {
  return word.find(',') != std::string::npos || tools::is_sequence_input(word);
}

MeshSequence load_real(const std::string& name) {
  const char* folder = std::getenv("ANICODEC_DATA");
  if (folder != nullptr) {
    std::filesystem::path stem = std::filesystem::path(folder) / name;
    for (const char* mesh : {".obj", ".ply", ".off"}) {
      for (const char* cache : {".pc2", ".mdd"}) {
        std::vector<std::string> inputs{stem.string() + mesh, stem.string() + cache};
        if (std::ranges::all_of(
                inputs, [](const auto& path) { return std::filesystem::is_regular_file(path); }))
          return tools::load_sequence(inputs);
      }
    }
  }
  throw Error(ErrorKind::kUsage,
              fmt::format("no clip '{}' in $ANICODEC_DATA ({}) nor in the corpus: {}", name,
                          folder ? folder : "not set", fmt::join(corpus::clip_names(), " ")));
}

}  // namespace

MeshSequence load_clip(const std::string& word) {
  if (names_files(word)) {
    std::vector<std::string> inputs;
    std::istringstream list(word);
    for (std::string input; std::getline(list, input, ',');)
      inputs.push_back(input);
    return tools::load_sequence(inputs);
  }
  std::vector<std::string> names = corpus::clip_names();
  if (std::ranges::find(names, word) != names.end())
    return corpus::make_clip(word);
  return load_real(word);
}

std::vector<std::string> clip_words(const std::vector<std::string>& inputs,
                                    const std::vector<std::string>& clips) {
  std::vector<std::string> words;
  bool files = std::ranges::any_of(
      inputs, [](const auto& input) { return tools::is_sequence_input(input); });
  if (files)
    words.push_back(fmt::format("{}", fmt::join(inputs, ",")));
  else
    words = inputs;
  words.insert(words.end(), clips.begin(), clips.end());
  if (words.empty())
    throw Error(ErrorKind::kUsage, "no clip is named");
  return words;
}

}  // namespace anicodec::bench
