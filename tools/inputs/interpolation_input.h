// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The inputs of anicodec interpolate: meshes of one connectivity, weights, pinned vertices.
#ifndef ANICODEC_TOOLS_INPUTS_INTERPOLATION_INPUT_H_
#define ANICODEC_TOOLS_INPUTS_INTERPOLATION_INPUT_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Loads the meshes of a command line as the frames of one clip, each the only frame of a file or
/// FILE@FRAME of a clip (a vertex cache, an .anic file, a pattern). Throws Error(kInput) when their
/// vertices or faces differ, Error(kUsage) for a clip without @FRAME.
MeshSequence load_poses(std::span<const std::string> arguments, const std::string& mesh,
                        const Progress& progress);

/// One row of weights per frame.
using WeightRows = std::vector<std::vector<double>>;

/// A text file: a line for every frame, a number for every mesh, separated by blanks or commas; #
/// begins a comment. Throws Error(kInput) naming the line: numbers too many or too few, not finite,
/// or that do not sum to one within 1e-5.
WeightRows read_weights(const std::string& path, size_t meshes);

/// From mesh to mesh: `frames` places from `first` to `last`, mesh i being at i.
WeightRows path_weights(size_t meshes, uint32_t frames, double first, double last);

/// "FROM:TO", two different finite numbers. Throws Error(kUsage).
std::pair<double, double> parse_range(const std::string& text, const std::string& option);

struct Pins {
  std::vector<uint32_t> vertices;
  std::vector<float> positions;  ///< frames x pins x 3, or pins x 3 for all frames

  std::span<const float> at(size_t frame) const;
};

/// "VERTICES=FILE": numbers and ranges such as 0,5,10-12, and a text file of three coordinates for
/// each in that order, once for all frames or for one frame after the other. Throws Error(kUsage)
/// for the list, Error(kInput) for the file.
Pins read_pins(const std::string& text, uint32_t vertex_count, size_t frames);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_INTERPOLATION_INPUT_H_
