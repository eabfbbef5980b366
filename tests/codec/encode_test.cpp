// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"

#include "codec/metrics/metrics.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "sdk/clip/sample.h"
#include "tests/codec/edited_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

Target max_error(double percent) {
  return {ErrorMetric::kMaxError, percent, true};
}

EncodeOptions asking(const Target& target, BasisChoice basis) {
  EncodeOptions options;
  options.target = target;
  options.basis = basis;
  options.effort = Effort::kFast;
  return options;
}

/// Polygons of a clip's mesh, each rotated to start at its smallest corner, sorted.
template <class Numbers>
std::vector<std::vector<uint32_t>> cycles(const Numbers& offsets, const Numbers& corners) {
  std::vector<std::vector<uint32_t>> all;
  for (size_t p = 0; p + 1 < offsets.size(); ++p) {
    std::vector<uint32_t>& f =
        all.emplace_back(corners.begin() + offsets[p], corners.begin() + offsets[p + 1]);
    if (!f.empty())
      std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

MeshSequence decoded(const Bytes& file, const MeshSequence& like) {
  Clip clip;
  Failure failure = clip.open(file);
  EXPECT_TRUE(failure.ok()) << status_string(failure.status) << ": " << failure.detail;
  EXPECT_TRUE(clip.check_hashes().ok());
  EXPECT_EQ(clip.vertex_count(), like.vertex_count);
  EXPECT_EQ(clip.frame_count(), like.frame_count);
  MeshSequence out = like;
  for (uint32_t f = 0; f < clip.frame_count(); ++f)
    EXPECT_EQ(show_positions(clip, 0, f, out.frame(f).data()), Status::kOk);
  const Topology& t = clip.meshes()[0].topology;
  EXPECT_EQ(cycles(t.polygon_offsets, t.polygon_corners),
            cycles(like.polygons.offsets, like.polygons.corners));
  return out;
}

double largest_coordinate(const MeshSequence& sequence) {
  double largest = 0;
  for (float x : sequence.positions)
    largest = std::max(largest, std::abs(static_cast<double>(x)));
  return largest;
}

class EncodeClip : public testing::TestWithParam<std::tuple<std::string, BasisChoice>> {};

TEST_P(EncodeClip, KeepsTheMaximumErrorInTheSourcesOrder) {
  auto [name, basis] = GetParam();
  MeshSequence source = corpus::make_clip(name);
  EncodeResult result;
  try {
    result = encode(source, asking(max_error(0.05), basis));
  } catch (const Error& e) {
    // Far from the origin, float32 is coarser than the error asked for.
    ASSERT_EQ(e.kind(), ErrorKind::kUsage);
    ASSERT_THAT(e.what(), testing::HasSubstr("smallest possible"));
    ASSERT_GT(4 * largest_coordinate(source) * 0x1p-24, 0.0005 * diagonal(source) / 2);
    return;
  }
  Comparison measured = compare(source, decoded(result.file, source), {.sted = false});
  EXPECT_LE(measured.max_error, 0.0005 * diagonal(source));
  EXPECT_DOUBLE_EQ(measured.max_error, result.max_error);
  EXPECT_DOUBLE_EQ(measured.kg, result.kg);
}

std::string parameter_name(const testing::TestParamInfo<EncodeClip::ParamType>& info) {
  constexpr const char* kBases[] = {"auto", "keyframes", "eigenshapes", "eigentrajectories"};
  std::string name =
      std::get<0>(info.param) + "_" + kBases[static_cast<int>(std::get<1>(info.param))];
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, EncodeClip,
    testing::Combine(testing::ValuesIn(corpus::clip_names()),
                     testing::Values(BasisChoice::kAuto, BasisChoice::kKeyframes,
                                     BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories)),
    parameter_name);

TEST(Encode, IsAFunctionOfItsInput) {
  MeshSequence source = corpus::make_clip(corpus::clip_names()[0]);
  for (BasisChoice basis : {BasisChoice::kKeyframes, BasisChoice::kEigenshapes}) {
    Bytes first = encode(source, asking(max_error(0.1), basis)).file;
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(encode(source, asking(max_error(0.1), basis)).file, first);
  }
}

TEST(Encode, TellsAboutHowFarItIs) {
  const MeshSequence clip = corpus::make_clip("limb");
  for (const BasisChoice basis : {BasisChoice::kAuto, BasisChoice::kEigenshapes}) {
    for (const ErrorMetric metric : {ErrorMetric::kMaxError, ErrorMetric::kKg}) {
      EncodeOptions options;
      options.basis = basis;
      options.target = {metric, 0.1, metric == ErrorMetric::kMaxError};
      options.effort = Effort::kNormal;
      std::vector<double> parts;
      encode(clip, options, [&](std::string_view, double done) { parts.push_back(done); });
      ASSERT_TRUE(std::ranges::is_sorted(parts));
      EXPECT_GT(parts.back(), 0.6);
    }
  }
}

TEST(Encode, FreeOrderLeavesOutTheVertexMapAndNothingElse) {
  for (const char* clip : {"limb", "nonmanifold"}) {
    EncodeOptions options = asking({ErrorMetric::kKg, 0.5, false}, BasisChoice::kAuto);
    options.effort = Effort::kFast;
    EditedFile ordered(encode(corpus::make_clip(clip), options).file);
    options.order = OrderMode::kFree;
    EditedFile free(encode(corpus::make_clip(clip), options).file);
    ASSERT_EQ(ordered.part("VMAP").chunk.type, chunk_type("VMAP"));
    std::erase_if(ordered.parts, [](const auto& p) { return p.chunk.type == chunk_type("VMAP"); });
    ordered.change_clip([](ClipsRecord& r) { r.order = OrderMode::kFree; });
    EXPECT_EQ(ordered.bytes(), free.bytes()) << clip;
  }
}

TEST(Encode, KeyframeCountAddsAtMostATenthToTheError) {
  MeshSequence source = corpus::make_clip(corpus::clip_names()[0]);
  EncodeOptions options;
  options.keyframes = 5;
  options.basis = BasisChoice::kKeyframes;
  EncodeResult coarse = encode(source, options);
  EXPECT_EQ(coarse.components, 5U);
  EXPECT_GT(coarse.max_error, 0);
}

TEST(Encode, RefusesWhatCannotBe) {
  MeshSequence source = corpus::make_clip(corpus::clip_names()[0]);
  auto fault = [&](const EncodeOptions& options) -> std::string {
    try {
      encode(source, options);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUsage);
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(fault({}), testing::HasSubstr("must be asked for"));
  EXPECT_THAT(fault(asking(max_error(-1), BasisChoice::kKeyframes)), testing::HasSubstr("greater"));
  EXPECT_THAT(fault(asking(max_error(1e-9), BasisChoice::kKeyframes)),
              testing::HasSubstr("smallest possible"));
  EncodeOptions few = asking({ErrorMetric::kKg, 0.001, false}, BasisChoice::kKeyframes);
  few.keyframes = 2;
  EXPECT_THAT(fault(few), testing::HasSubstr("the best is"));
}

/// A file, or the reason that there is none, which is no defect.
std::string reason(const MeshSequence& sequence, const EncodeOptions& options) {
  try {
    const EncodeResult result = encode(sequence, options);
    Clip clip;
    EXPECT_TRUE(clip.open(result.file).ok());
    return "";
  } catch (const Error& e) {
    EXPECT_NE(e.kind(), ErrorKind::kInternal) << e.what();
    return e.what();
  }
}

MeshSequence points(std::vector<float> positions, uint32_t frames) {
  MeshSequence sequence;
  sequence.frame_count = frames;
  sequence.vertex_count = static_cast<uint32_t>(positions.size() / 3 / frames);
  sequence.polygons.offsets = {0};
  sequence.positions.assign(positions.begin(), positions.end());
  return sequence;
}

TEST(Encode, TakesErrorsBeyondAllNumbers) {
  const MeshSequence limb = corpus::make_wave_grid(30, 8, 3);
  for (const BasisChoice basis : {BasisChoice::kAuto, BasisChoice::kKeyframes,
                                  BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories}) {
    for (const ErrorMetric metric : {ErrorMetric::kKg, ErrorMetric::kMaxError, ErrorMetric::kRmse,
                                     ErrorMetric::kDisplacement, ErrorMetric::kSted}) {
      for (const double value : {1e30, 3e38, 1e300})
        EXPECT_EQ(reason(limb, asking({metric, value, false}, basis)), "") << value;
    }
  }
}

TEST(Encode, KeepsPointsThatStandStillExactlyOrSaysSo) {
  std::vector<float> positions;
  for (int f = 0; f < 8; ++f)
    positions.insert(positions.end(), {9, 16, 4});
  const MeshSequence still = points(positions, 8);
  EXPECT_EQ(reason(still, asking(max_error(0.05), BasisChoice::kAuto)), "");
  EncodeOptions by_draco = asking(max_error(0.05), BasisChoice::kKeyframes);
  by_draco.keyframe_poses = KeyframePoses::kDraco;
  by_draco.order = OrderMode::kFree;
  EXPECT_THAT(reason(still, by_draco), testing::AnyOf("", "the target cannot be reached"));
}

TEST(Encode, RefusesTheMotionOfTheWholeOfLargestNumbers) {
  constexpr float kMost = std::numeric_limits<float>::max();
  EncodeOptions options = asking(max_error(0.05), BasisChoice::kAuto);
  options.root_motion = true;
  EXPECT_THAT(reason(points({kMost, 0, kMost, 1, 2, 3, 0, 0, 0, 4, 5, kMost}, 2), options),
              testing::HasSubstr("too large"));
  EXPECT_THAT(reason(points({1, 2, 3, -kMost, 5, -kMost}, 2), options),
              testing::HasSubstr("too large"));
}

TEST(Encode, InterpolatesOutliersByWeightsThatSumToOne) {
  constexpr float kMost = std::numeric_limits<float>::max();
  std::vector<float> positions;
  for (int f = 0; f < 6; ++f)
    positions.insert(positions.end(), {3, 10, 17, 5, f == 1 ? -kMost : 12.0F, 0});
  EncodeOptions options = asking({ErrorMetric::kKg, 5, false}, BasisChoice::kKeyframes);
  options.interpolation = InterpolationChoice::kMsgi;
  reason(points(positions, 6), options);
}

TEST(Encode, SizeTargetIsKept) {
  MeshSequence source = corpus::make_clip(corpus::clip_names()[0]);
  EncodeResult all = encode(source, asking(max_error(0.05), BasisChoice::kKeyframes));
  double budget = 0.7 * static_cast<double>(all.file.size());
  EncodeResult small =
      encode(source, asking({ErrorMetric::kSize, budget, false}, BasisChoice::kKeyframes));
  EXPECT_LE(static_cast<double>(small.file.size()), budget);
  EXPECT_GT(small.rmse, all.rmse);
}

/// An exactly sized copy on the heap, so that a sanitizer sees a read past its end.
Status open_status(const Bytes& bytes) {
  std::unique_ptr<uint8_t[]> copy(new uint8_t[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), copy.get());
  Clip clip;
  OpenOptions options;
  options.limits.vertices = 100000;
  options.limits.resident_bytes = 100 << 20;
  Status status = clip.open({copy.get(), bytes.size()}, options).status;
  if (status == Status::kOk) {
    std::vector<float> frame(size_t{3} * clip.vertex_count());
    for (uint32_t f = 0; f < std::min(clip.frame_count(), 4U); ++f) {
      if (show_positions(clip, 0, f, frame.data()) == Status::kOk) {
        EXPECT_TRUE(
            std::all_of(frame.begin(), frame.end(), [](float x) { return std::isfinite(x); }));
      }
    }
  }
  return status;
}

class HostileFile : public testing::TestWithParam<BasisChoice> {};

TEST_P(HostileFile, EveryTruncationIsRefused) {
  Bytes file = encode(corpus::make_clip("nonmanifold"), asking(max_error(1), GetParam())).file;
  ASSERT_EQ(open_status(file), Status::kOk);
  for (size_t n = 0; n < file.size(); ++n)
    EXPECT_NE(open_status({file.begin(), file.begin() + static_cast<ptrdiff_t>(n)}), Status::kOk);
}

TEST_P(HostileFile, TruncatedAndChangedPayloadsDoNoHarm) {
  Bytes file = encode(corpus::make_clip("nonmanifold"), asking(max_error(1), GetParam())).file;
  const EditedFile whole(file);
  std::mt19937 random(5);
  for (size_t i = 0; i < whole.parts.size(); ++i) {
    const Bytes& payload = whole.parts[i].payload;
    EditedFile edited = whole;
    // A cut stream may be another valid one: only checksums and hashes tell.
    for (size_t n = 0; n < payload.size(); n += 1 + payload.size() / 50) {
      edited.parts[i].payload.assign(payload.begin(), payload.begin() + static_cast<ptrdiff_t>(n));
      open_status(edited.bytes());
    }
    for (int run = 0; run < 60; ++run) {
      edited.parts[i].payload = payload;
      for (int flips = 0; flips < 1 + run % 4; ++flips)
        edited.parts[i].payload[random() % payload.size()] ^=
            static_cast<uint8_t>(1 << random() % 8);
      open_status(edited.bytes());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, HostileFile,
                         testing::Values(BasisChoice::kKeyframes, BasisChoice::kEigenshapes,
                                         BasisChoice::kEigentrajectories));

}  // namespace
}  // namespace anicodec
