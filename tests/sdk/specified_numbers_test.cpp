// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The numbers that spec/09, 09b and 09d show to check a decoder by are what the library works out.
// tests/scripts/check_numbers.py works them out from the text.
#include "build_paths.h"
#include "format/coding/binary_coder.h"
#include "sdk/exact/exact_coding.h"
#include "sdk/pose/pose_prediction.h"
#include "sdk/prediction/refit_solver.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

std::string specified_page(const char* name) {
  std::ifstream page(std::string(ANICODEC_SOURCE_DIR "/spec/") + name);
  return {std::istreambuf_iterator<char>(page), std::istreambuf_iterator<char>()};
}

/// The numbers of the line that begins so.
std::vector<double> specified(const std::string& page, const std::string& name) {
  const size_t at = page.find("\n" + name + ": ");
  EXPECT_NE(at, std::string::npos) << name;
  std::vector<double> numbers;
  if (at == std::string::npos)
    return numbers;
  const char* next = page.c_str() + at + name.size() + 3;
  for (char* end = nullptr; *next != '\n'; next = end) {
    numbers.push_back(std::strtod(next, &end));
    if (end == next)
      break;
  }
  return numbers;
}

TEST(SpecifiedNumbers, AreTheWeightsOfARank) {
  constexpr size_t kM = 8;
  const std::string page = specified_page("09-reconstruction.md");
  const float positions[] = {0, 0, 0, 10, 0, 0, 0, 12, 1, -9, 3, 0, 2, -11, 2, 7, 8, -3, -5, -6, 4};
  const int32_t neighbours[kM] = {1, 2, 3, 4, 5, 6, -1, -1};
  PredictionJob job;
  job.neighbour_count = kM;
  job.positions = positions;
  job.neighbours = neighbours;
  job.radius = 12;
  RefitSolver<1, kM> solver;
  solver.set_prior(job, 0, 1);
  solver.clear();
  std::vector<double> prior, weights;
  for (const auto& w : solver.prior)
    prior.push_back(double{w[0]});
  EXPECT_EQ(specified(page, "w0"), prior);
  const std::vector<double> sample = specified(page, "p0, y, e");
  ASSERT_EQ(sample.size(), 3U);
  const float x[kM] = {-3, 5.5F, 1.25F, -0.5F, 7, 2, 0, 0}, omega = 0x1.6a09e6p+0F;
  RefitSolver<1, kM>::Float of_lane[1][kM], error[1] = {};
  for (size_t a = 0; a < kM; ++a)
    of_lane[0][a] = RefitSolver<1, kM>::splat(x[a]);
  error[0] += static_cast<float>(sample[2]);
  solver.accumulate(of_lane, error, &omega, 1);
  solver.refit();
  for (const auto& w : solver.weights)
    weights.push_back(double{w[0]});
  EXPECT_EQ(specified(page, "w"), weights);
}

TEST(SpecifiedNumbers, AreWhatIsExpectedOfAVertex) {
  const std::string page = specified_page("09b-reference-pose.md");
  const int32_t pose[] = {0, 0, 10, 100, 5, 0, 8, 96, -7, -104, 3, 4, -6, -99, 12};
  Topology fan;
  fan.coded_vertices = 5;
  fan.triangles = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
  const CornerTable table(fan);
  PosePrediction prediction(table);
  for (uint32_t v = 0; v < 5; ++v) {
    prediction.begin(v, pose);
    for (int step = 0; step < 3; ++step) {
      const PosePrediction::Expectation e = prediction.expect(step);
      if (v == 4) {
        EXPECT_EQ(specified(page, std::string("axis ") + "ijk"[step] +
                                      ": mean, scale, near, spread, before"),
                  (std::vector<double>{e.mean, e.scale, e.near, e.spread, e.before}));
      }
      prediction.learn(step, pose[size_t{3} * v + prediction.axis(step)]);
    }
  }
}

TEST(SpecifiedNumbers, AreCodedAsExactPositions) {
  constexpr float kShown[3][4] = {
      {0.1F, 0.35F, -0.2F, 0.7F}, {0.13F, 0.4F, -0.21F, 0.79F}, {0.17F, 0.44F, -0.2F, 0.9F}};
  Topology topology;
  topology.coded_vertices = 4;
  topology.triangles = {0, 1, 2, 0, 2, 3, 1, 2, 3};
  const EarlierNeighbours neighbours(topology);
  ExactRecord record;
  record.noise = 0.01;
  std::vector<float> positions;
  for (const auto& frame : kShown) {
    for (const float x : frame)
      positions.insert(positions.end(), {x, 0, 0});
  }
  ExactCoding coding(record, neighbours, 4);
  BinaryEncoder encoder;
  for (uint32_t f = 0; f < 3; ++f)
    ASSERT_TRUE(coding.code_frame(encoder, f, f > 0 ? f - 1 : 0, positions.data()));
  std::string stream;
  for (const uint8_t byte : encoder.finish()) {
    stream += "0123456789abcdef"[byte >> 4];
    stream += "0123456789abcdef"[byte & 15];
  }
  EXPECT_NE(specified_page("09d-exact-positions.md").find("`" + stream + "`"), std::string::npos)
      << stream;
}

}  // namespace
}  // namespace anicodec
