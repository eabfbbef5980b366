// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/metrics/metrics.h"

#include "build_paths.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tests/codec/metrics/square.h"
#include "tests/random.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Pseudo-random offsets of up to `size`.
MeshSequence disturbed(MeshSequence s, float size) {
  SmallRandom random(1);
  for (float& x : s.positions)
    x += size * static_cast<float>(random.symmetric());
  return s;
}

TEST(Metrics, EqualClipsHaveNoError) {
  MeshSequence s = corpus::make_clip("limb");
  Comparison c = compare(s, s);
  EXPECT_EQ(c.kg, 0);
  EXPECT_EQ(c.rmse, 0);
  EXPECT_EQ(c.max_error, 0);
  EXPECT_EQ(c.displacement_error, 0);
  EXPECT_EQ(c.psnr, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(c.has_sted);
  EXPECT_EQ(c.sted.sted, 0);
  EXPECT_DOUBLE_EQ(c.diagonal, diagonal(s));
  EXPECT_EQ(c.frames.size(), s.frame_count);
}

TEST(Metrics, TranslationCountsItsLength) {
  MeshSequence p = square(3), q = p;
  for (size_t i = 0; i < q.positions.size(); i += 3) {
    q.positions[i] += 0.375F;
    q.positions[i + 1] -= 0.5F;
  }
  Comparison c = compare(p, q);
  // Every vertex is sqrt(1/2) from the middle of the square.
  EXPECT_DOUBLE_EQ(c.kg, 100 * 0.625 / std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(c.rmse, 0.625);
  EXPECT_DOUBLE_EQ(c.max_error, 0.625);
  EXPECT_EQ(c.max_frame, 0U);
  EXPECT_EQ(c.max_vertex, 0U);
  EXPECT_DOUBLE_EQ(c.diagonal, std::sqrt(2));
  EXPECT_DOUBLE_EQ(c.percent(c.max_error), 100 * 0.625 / std::sqrt(2));
  EXPECT_DOUBLE_EQ(c.psnr, 20 * std::log10(std::sqrt(2) / 0.625));
  EXPECT_EQ(c.displacement_error, 0);
  EXPECT_EQ(c.max_displacement_error, 0);
  EXPECT_EQ(c.sted.sted, 0);
}

TEST(Metrics, DisplacementIsThatOfTheWorstMove) {
  MeshSequence p = square(3), q = p;
  q.positions[3 * (4 + 1)] += 0.25F;  // vertex 1 in frame 1
  q.positions[3 * (8 + 1)] -= 0.5F;
  const Comparison c = compare(p, q);
  EXPECT_DOUBLE_EQ(c.max_displacement_error, 0.75);
  EXPECT_DOUBLE_EQ(c.displacement_error, std::sqrt((0.0625 + 0.5625) / 8));
}

TEST(Metrics, ScaleAboutTheMeanGivesItsKg) {
  MeshSequence p = square(2), q = p;
  for (size_t i = 0; i < q.positions.size(); ++i)
    q.positions[i] = i % 3 == 2 ? 0 : 0.5F + 1.25F * (p.positions[i] - 0.5F);
  Comparison c = compare(p, q);
  EXPECT_DOUBLE_EQ(c.kg, 25);
  EXPECT_DOUBLE_EQ(c.rmse, 0.25 * std::sqrt(0.5));
  EXPECT_NEAR(c.sted.spatial, 0, 1e-15);
}

TEST(Metrics, MeanIsThatOfEachFrame) {
  // The second frame is far away: neither a mean over time nor over all frames would give this.
  MeshSequence p = square(2);
  for (size_t i = 12; i < 24; ++i)
    p.positions[i] += 1000;
  MeshSequence q = p;
  q.positions[0] += 0.5F;
  EXPECT_DOUBLE_EQ(compare(p, q).kg, 100 * 0.5 / std::sqrt(8 * 0.5));
}

TEST(Metrics, OneMovedVertexIsFoundAndCounted) {
  MeshSequence p = square(4), q = p;
  q.positions[2 * 12 + 3 * 3 + 2] = 0.75F;
  Comparison c = compare(p, q);
  EXPECT_DOUBLE_EQ(c.max_error, 0.75);
  EXPECT_EQ(c.max_frame, 2U);
  EXPECT_EQ(c.max_vertex, 3U);
  EXPECT_DOUBLE_EQ(c.rmse, 0.75 / 4);
  EXPECT_DOUBLE_EQ(c.kg, 100 * 0.75 / std::sqrt(16 * 0.5));
  // It jumps away and back: two moves of 0.75 among 4 vertices times 3 moves.
  EXPECT_DOUBLE_EQ(c.displacement_error, std::sqrt(2 * 0.75 * 0.75 / 12));
  EXPECT_EQ(c.frames[1].max, 0);
  EXPECT_DOUBLE_EQ(c.frames[2].max, 0.75);
  EXPECT_EQ(c.frames[2].max_vertex, 3U);
  EXPECT_DOUBLE_EQ(c.frames[2].rmse, 0.375);
  EXPECT_GT(c.frames[2].sted_spatial, 0);
  EXPECT_EQ(c.frames[3].sted_spatial, 0);
}

TEST(Metrics, FirstOfEqualErrorsIsNamed) {
  MeshSequence p = square(3), q = p;
  for (size_t f : {1U, 2U}) {
    q.positions[f * 12 + 3 * 1] += 0.25F;
    q.positions[f * 12 + 3 * 2] += 0.25F;
  }
  Comparison c = compare(p, q);
  EXPECT_EQ(c.max_frame, 1U);
  EXPECT_EQ(c.max_vertex, 1U);
}

TEST(Metrics, DenominatorOfZeroCountsAsOne) {
  MeshSequence p = corpus::make_clip("one_vertex"), q = p;
  for (float& x : q.positions)
    x += 0.5F;
  Comparison c = compare(p, q);
  EXPECT_DOUBLE_EQ(c.kg, 100 * std::sqrt(4 * 0.75));
  EXPECT_EQ(c.sted.sted, 0);
}

TEST(Metrics, PercentOfAZeroDiagonalIsInfiniteUnlessExact) {
  MeshSequence p;
  p.vertex_count = p.frame_count = 1;
  p.positions = {1, 2, 3};
  MeshSequence q = p;
  EXPECT_EQ(compare(p, q).percent(0), 0);
  q.positions[0] = 2;
  Comparison c = compare(p, q);
  EXPECT_EQ(c.percent(c.max_error), std::numeric_limits<double>::infinity());
  EXPECT_EQ(c.psnr, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(c.displacement_error, 0);
}

TEST(Metrics, LeavesStedOutWhenAsked) {
  MeshSequence p = corpus::make_clip("cloth"), q = disturbed(p, 0.01F);
  Comparison with = compare(p, q), without = compare(p, q, {.sted = false});
  EXPECT_GT(with.sted.sted, 0);
  EXPECT_FALSE(without.has_sted);
  EXPECT_EQ(without.sted.sted, 0);
  EXPECT_EQ(with.kg, without.kg);
}

TEST(Metrics, AsksEachFrameOnceInOrderFromOneBuffer) {
  MeshSequence p = corpus::make_clip("face"), q = disturbed(p, 0.01F);
  std::vector<uint32_t> asked;
  std::vector<float> buffer;
  FrameSource source = [&](uint32_t f) {
    asked.push_back(f);
    buffer.assign(q.frame(f).begin(), q.frame(f).end());
    return std::span<const float>(buffer);
  };
  Comparison streamed = compare(p.polygons, p.vertex_count, p.frame_count, frames_of(p), source);
  Comparison whole = compare(p, q);
  ASSERT_EQ(asked.size(), p.frame_count);
  for (uint32_t f = 0; f < p.frame_count; ++f)
    EXPECT_EQ(asked[f], f);
  EXPECT_EQ(streamed.kg, whole.kg);
  EXPECT_EQ(streamed.sted.sted, whole.sted.sted);
  EXPECT_EQ(streamed.displacement_error, whole.displacement_error);
}

TEST(Metrics, RefusesClipsThatDoNotFit) {
  EXPECT_THROW(compare(square(2), square(3)), Error);
  EXPECT_THROW(compare(square(2), corpus::make_clip("limb")), Error);
  MeshSequence empty;
  EXPECT_THROW(compare(empty, empty), Error);
  MeshSequence bad = square(2);
  bad.positions[12 + 7] = std::numeric_limits<float>::quiet_NaN();
  try {
    compare(square(2), bad);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kInput);
    EXPECT_THAT(e.what(), testing::HasSubstr("frame 1, vertex 2 of the decoded clip"));
  }
}

TEST(Metrics, AgreesWithDefinitionsWrittenOut) {
  MeshSequence p = corpus::make_clip("rigid"), q = disturbed(p, 0.02F);
  size_t n = p.vertex_count, frames = p.frame_count;
  long double error = 0, spread = 0, displacement = 0, most = 0;
  for (size_t f = 0; f < frames; ++f) {
    for (size_t axis = 0; axis < 3; ++axis) {
      long double mean = 0;
      for (size_t v = 0; v < n; ++v)
        mean += static_cast<long double>(p.frame(f)[3 * v + axis]) / n;
      for (size_t v = 0; v < n; ++v)
        spread += std::pow(static_cast<long double>(p.frame(f)[3 * v + axis]) - mean, 2.L);
    }
    for (size_t v = 0; v < n; ++v) {
      long double square = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        auto at = [&](const MeshSequence& s, size_t g) {
          return static_cast<long double>(s.frame(g)[3 * v + axis]);
        };
        square += std::pow(at(p, f) - at(q, f), 2.L);
        if (f > 0)
          displacement += std::pow((at(p, f) - at(p, f - 1)) - (at(q, f) - at(q, f - 1)), 2.L);
      }
      error += square;
      most = std::max(most, square);
    }
  }
  Comparison c = compare(p, q);
  EXPECT_NEAR(c.kg, static_cast<double>(100 * std::sqrt(error / spread)), 1e-12 * c.kg);
  EXPECT_NEAR(c.rmse, static_cast<double>(std::sqrt(error / (n * frames))), 1e-12 * c.rmse);
  EXPECT_DOUBLE_EQ(c.max_error, static_cast<double>(std::sqrt(most)));
  EXPECT_NEAR(c.displacement_error,
              static_cast<double>(std::sqrt(displacement / (n * (frames - 1)))),
              1e-12 * c.displacement_error);
}

TEST(Metrics, AreRelativeToTheSizeOfTheClip) {
  MeshSequence p = corpus::make_clip("large"), q = p;
  MeshSequence small = corpus::make_clip("tiny"), r = small;
  for (size_t i = 0; i < q.positions.size(); i += 5) {
    q.positions[i] *= 1.01F;
    r.positions[i] *= 1.01F;
  }
  Comparison c = compare(p, q), d = compare(small, r);
  EXPECT_GT(c.kg, 0.1);
  EXPECT_DOUBLE_EQ(c.kg, d.kg);
  EXPECT_DOUBLE_EQ(c.sted.sted, d.sted.sted);
  EXPECT_DOUBLE_EQ(c.psnr, d.psnr);
}

void write_pc2(const std::filesystem::path& path, const MeshSequence& s) {
  std::ofstream file(path, std::ios::binary);
  file.write("POINTCACHE2\0", 12);
  auto put = [&](auto value) { file.write(reinterpret_cast<const char*>(&value), 4); };
  put(int32_t{1});
  put(static_cast<int32_t>(s.vertex_count));
  put(0.F);
  put(1.F);
  put(static_cast<int32_t>(s.frame_count));
  file.write(reinterpret_cast<const char*>(s.positions.data()),
             static_cast<std::streamsize>(s.positions.size() * sizeof(float)));
}

TEST(Metrics, AgreesWithTheIndependentScript) {
  if (std::system("python3 -c '' >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "python3 is not installed";
  MeshSequence p = corpus::make_clip("limb"), q = disturbed(p, 0.005F);
  auto folder = std::filesystem::path(testing::TempDir()) / "metrics_script";
  std::filesystem::create_directories(folder);
  write_pc2(folder / "p.pc2", p);
  write_pc2(folder / "q.pc2", q);
  std::string command = "python3 " ANICODEC_SOURCE_DIR "/tests/scripts/compare.py " +
                        (folder / "p.pc2").string() + " " + (folder / "q.pc2").string() + " > " +
                        (folder / "out").string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::string text;
  std::getline(std::ifstream(folder / "out"), text);
  std::filesystem::remove_all(folder);
  auto value = [&](const std::string& key) {
    size_t at = text.find("\"" + key + "\": ");
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + key.size() + 4));
  };
  Comparison c = compare(p, q);
  EXPECT_NEAR(value("kg_percent"), c.kg, 1e-10 * c.kg);
  EXPECT_NEAR(value("rmse"), c.rmse, 1e-10 * c.rmse);
  EXPECT_NEAR(value("max_error"), c.max_error, 1e-12);
  EXPECT_EQ(value("max_frame"), c.max_frame);
  EXPECT_EQ(value("max_vertex"), c.max_vertex);
  EXPECT_NEAR(value("diagonal"), c.diagonal, 1e-12);
}

}  // namespace
}  // namespace anicodec
