// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_API_ALL_FILES_H_
#define ANICODEC_TESTS_API_ALL_FILES_H_

#include "build_paths.h"
#include "codec/file/clip_file.h"
#include "codec/search/time_segmentation.h"
#include "tests/api/opened.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {

/// A clip in two segments.
inline Bytes two_segments(const MeshSequence& clip) {
  EncoderInput input(clip);
  LinearAnalysis analysis(input.frames());
  LinearSearch whole(input, analysis, BasisKind::kEigenshapes, Effort::kFast, 1, true);
  const double rmse = 0.0005 * diagonal(clip);
  std::optional<CodedSegment> one = whole.at_rmse(rmse);
  TimeSegmentation segmentation(input, whole, one->encoded.reference, rmse);
  const uint32_t half = clip.frame_count / 2;
  std::vector<CodedSegment> segments;
  for (uint32_t first : {0U, half}) {
    std::optional<CodedSegment> segment =
        segmentation.coded({first, first == 0 ? half : clip.frame_count - half});
    segment->encoded.sizes.first_frame = first;
    segments.push_back(std::move(*segment));
  }
  return clip_file(ClipsRecord{}, input.layout, {&segments[0].encoded, &segments[1].encoded});
}

inline const Bytes& cut_clip() {
  static const Bytes file = two_segments(corpus::make_scaled("limb", 300, 48));
  return file;
}

/// By name: clips of every basis, in two segments, and the valid files of tests/conformance, with
/// corrections, rigid motions, layers.
inline const std::map<std::string, Bytes>& all_files() {
  static const std::map<std::string, Bytes> all = [] {
    std::map<std::string, Bytes> files;
    for (const auto& [clip, basis] : cases())
      files[clip] = encoded_clip(clip, basis);
    files["two_segments"] = cut_clip();
    const std::string folder = std::string(ANICODEC_SOURCE_DIR) + "/tests/conformance";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".anic")
        continue;
      std::ifstream file(entry.path(), std::ios::binary);
      files[entry.path().filename()].assign(std::istreambuf_iterator<char>(file), {});
    }
    return files;
  }();
  return all;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_API_ALL_FILES_H_
