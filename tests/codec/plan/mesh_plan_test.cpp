// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/plan/mesh_plan.h"

#include "codec/sequence/error.h"
#include "corpus/clips.h"

#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::HasSubstr;

EncodeOptions within(double percent) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, percent, true};
  return options;
}

TEST(MeshPlan, HasNothingRelative) {
  const MeshSequence clip = corpus::make_scaled("limb", 100, 6);
  EncodeOptions options = within(0.5);
  options.cap = Target{ErrorMetric::kMaxError, 1, true};
  options.effort = Effort::kBest;
  const MeshPlan plan = plan_mesh(clip, options);
  EXPECT_EQ(plan.diagonal, diagonal(clip));
  ASSERT_EQ(plan.goals.size(), 1U);
  EXPECT_DOUBLE_EQ(plan.goals[0].bound.value, diagonal(clip) / 200);
  EXPECT_DOUBLE_EQ(*plan.goals[0].cap, diagonal(clip) / 100);
  EXPECT_EQ(plan.effort, Effort::kBest);
  EXPECT_FALSE(plan.is_lossless());
  EXPECT_TRUE(plan_mesh(clip, within(0)).is_lossless());
}

TEST(MeshPlan, RefusesOptionsThatExcludeOneAnother) {
  const MeshSequence clip = corpus::make_scaled("limb", 100, 6);
  const auto fault = [&](const std::function<void(EncodeOptions&)>& change) {
    EncodeOptions options = within(0.5);
    change(options);
    try {
      plan_mesh(clip, options);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUsage);
      return std::string(e.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(fault([](EncodeOptions&) {}), "none");
  EXPECT_THAT(fault([](EncodeOptions& o) { o.target = {}; }), HasSubstr("must be asked for"));
  EXPECT_THAT(fault([](EncodeOptions& o) { o.keyframes = 7; }), HasSubstr("more key-frames"));
  EXPECT_THAT(fault([](EncodeOptions& o) {
                o.basis = BasisChoice::kEigenshapes;
                o.interpolation = InterpolationChoice::kMsgi;
              }),
              HasSubstr("between key-frames"));
  EXPECT_THAT(fault([](EncodeOptions& o) { o.part = FrameRun{4, 3}; }), HasSubstr("all frames"));
  EXPECT_THAT(fault([](EncodeOptions& o) {
                o.part = FrameRun{0, 3};
                o.root_motion = true;
              }),
              HasSubstr("not of a part"));
  EXPECT_THAT(fault([](EncodeOptions& o) {
                o.target.value = 0;
                o.surface_change.emplace();
              }),
              HasSubstr("lossless"));
}

}  // namespace
}  // namespace anicodec
