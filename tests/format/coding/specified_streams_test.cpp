// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The streams that spec/08-entropy.md shows, section 8: what the text says they hold is what they hold.
#include "build_paths.h"
#include "format/coding/binary_coder.h"
#include "format/coding/coefficient_model.h"
#include "format/coding/rans_coder.h"
#include "format/coding/time_weights.h"

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

std::string specification() {
  std::ifstream page(ANICODEC_SOURCE_DIR "/spec/08-entropy.md");
  return {std::istreambuf_iterator<char>(page), std::istreambuf_iterator<char>()};
}

template <class Bytes>
std::string hex(const Bytes& bytes) {
  std::string out;
  for (const uint8_t byte : bytes) {
    out += "0123456789abcdef"[byte >> 4];
    out += "0123456789abcdef"[byte & 15];
  }
  return out;
}

/// Residuals of section 8: three components, levels of 24 vertices, the neighbours being the eight before
/// the level.
std::string coefficients(uint32_t vertices, uint32_t channels) {
  constexpr uint32_t kLevel = 24;
  Vector<uint32_t> levels;
  std::vector<int32_t> neighbours;
  for (uint32_t v = 0; v < vertices; ++v) {
    const uint32_t first = v / kLevel * kLevel;
    if (v == first)
      levels.push_back(v);
    for (uint32_t a = 1; a <= 8; ++a)
      neighbours.push_back(first < a ? -1 : static_cast<int32_t>(first - a));
  }
  levels.push_back(vertices);
  CoefficientModel model(channels, neighbours.data(), 8, levels);
  RansEncoder encoder;
  for (uint32_t j = 0; j < 3; ++j) {
    std::vector<int32_t> q;
    for (uint32_t c = 0; c < channels; ++c) {
      for (uint32_t v = 0; v < vertices; ++v)
        q.push_back((v + j + c) % 3 == 0 ? static_cast<int32_t>((7 * v + 5 * j + 3 * c) % 11) - 5
                                         : 0);
    }
    model.code_component(encoder, q.data());
  }
  return hex(encoder.finish());
}

TEST(SpecifiedStreams, HoldTheCoefficientsOfTheText) {
  const std::string text = specification();
  for (const std::string& stream : {coefficients(72, 1), coefficients(48, 3)})
    EXPECT_NE(text.find("`" + stream + "`"), std::string::npos) << stream;
}

TEST(SpecifiedStreams, HoldTheTimeWeightsOfTheText) {
  constexpr uint32_t kFrames = 12;
  const std::string text = specification();
  for (uint32_t p = 0; p < kWeightPredictors; ++p) {
    std::vector<double> x;
    for (uint32_t row = 0; row < 3; ++row) {
      for (uint32_t f = 0; f < kFrames; ++f)
        x.push_back((3 * f * f + 11 * row * f) % 41 + 4 * ((5 * f + row) % 7) - 30.0);
    }
    TimeWeightModel model(kFrames);
    BinaryEncoder encoder;
    std::vector<int32_t> values(x.size());
    model.encode(encoder, 3, x.data(), 0, values.data(), 1u << p);
    std::string line = "| " + std::to_string(p) + " | `" + hex(encoder.finish()) + "` |";
    for (uint32_t row = 0; row < 3; ++row) {
      for (uint32_t f = 0; f < kFrames; ++f)
        line += (f == 0 ? " " : ", ") + std::to_string(values[row * kFrames + f]);
      line += " |";
    }
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace anicodec
