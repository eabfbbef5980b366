// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_count.h"
#include "codec/studies/basis_error.h"
#include "tests/codec/real_clip.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr KeyframeMethod kGas = KeyframeMethod::kGas;
constexpr KeyframeMethod kPivot = KeyframeMethod::kPivot;
constexpr KeyframeWeights kLinear = KeyframeWeights::kLinear;
constexpr KeyframeWeights kRigid = KeyframeWeights::kRigid;

class RealDataKeyframes : public testing::Test {
 protected:
  // KG error in per cent.
  double kg(KeyframeFitter& fitter, size_t count, KeyframeMethod method, KeyframeWeights kind) {
    return fitter.kg(fitter.fit(count, method, kind));
  }
};

#define READ_OR_SKIP(clip, name)                                        \
  const RealClip clip = read_real_clip(name);                           \
  if (clip.frame_count == 0) {                                          \
    GTEST_SKIP() << name << " is not in " << real_data_folder()         \
                 << " (set ANICODEC_DATA to the folder of real clips)"; \
  }

TEST_F(RealDataKeyframes, ReproduceTheDance) {
  READ_OR_SKIP(clip, "classic/dance.pc2");
  KeyframeFitter fitter(clip.view());
  EXPECT_LE(kg(fitter, 10, kGas, kLinear), 14.2);
  EXPECT_LE(kg(fitter, 20, kGas, kLinear), 5.3);
  EXPECT_LE(kg(fitter, 45, kGas, kLinear), 0.9);
  EXPECT_LE(kg(fitter, 10, kPivot, kLinear), 11.9);
  EXPECT_LE(kg(fitter, 20, kPivot, kLinear), 4.1);
  EXPECT_LE(kg(fitter, 45, kPivot, kLinear), 0.56);
  EXPECT_LE(kg(fitter, 4, kPivot, kRigid), 14);
  EXPECT_LE(kg(fitter, 20, kPivot, kRigid), 2.2);
  EXPECT_LE(kg(fitter, 45, kPivot, kRigid), 0.38);
}

TEST_F(RealDataKeyframes, MatchThePrincipalComponentsOfTheDance) {
  READ_OR_SKIP(clip, "classic/dance.pc2");
  KeyframeFitter fitter(clip.view());
  const auto errors = principal_errors(about_mean(fitter.products(kLinear)));
  const double reference = fitter.gram().kg_reference();
  EXPECT_NEAR(kg_error(errors[10], reference), 8.0, 0.05);
  EXPECT_NEAR(kg_error(errors[20], reference), 2.6, 0.05);
  EXPECT_NEAR(kg_error(errors[45], reference), 0.34, 0.005);
}

TEST_F(RealDataKeyframes, FitWithRigidMotionNoWorseThanWithout) {
  for (const char* name : {"simulated/flag.pc2", "classic/horse.pc2", "captured/face.pc2"}) {
    READ_OR_SKIP(clip, name);
    KeyframeFitter fitter(clip.view());
    for (size_t count : {4u, 8u, 20u}) {
      const KeyframeFit still = fitter.fit(count, kPivot, KeyframeWeights::kSumToOne);
      EXPECT_LE(fitter.kg(fitter.fit(still.keyframes, kRigid)), fitter.kg(still) * 1.0001) << name;
    }
  }
}

TEST_F(RealDataKeyframes, AreFewerWithABetterChoice) {
  READ_OR_SKIP(clip, "classic/chicken.pc2");
  KeyframeFitter fitter(clip.view());
  const ErrorTarget target{1.0, 1e300};
  const size_t linear = fewest_keyframes(fitter, target, kPivot, kLinear).keyframes.size();
  const size_t rigid = fewest_keyframes(fitter, target, kPivot, kRigid).keyframes.size();
  EXPECT_LE(linear, 52u);
  EXPECT_LT(rigid, linear);
}

}  // namespace
}  // namespace anicodec
