// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/base/cpu_features.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(CpuFeatures, AreThoseThatTheCompilerFinds) {
#if !defined(__x86_64__)
  EXPECT_FALSE(cpu_features().avx2);
#else
  const CpuFeatures& cpu = cpu_features();
  EXPECT_EQ(cpu.avx2, __builtin_cpu_supports("avx2") != 0);
  EXPECT_EQ(cpu.fma, __builtin_cpu_supports("fma") != 0);
  EXPECT_EQ(cpu.avx512f, __builtin_cpu_supports("avx512f") != 0);
  EXPECT_EQ(cpu.avx512vl, __builtin_cpu_supports("avx512vl") != 0);
  EXPECT_EQ(cpu.avx512vbmi2, __builtin_cpu_supports("avx512vbmi2") != 0);
#endif
}

TEST(CpuFeatures, OfLaterSetsComeWithEarlierOnes) {
  const CpuFeatures& cpu = cpu_features();
  EXPECT_TRUE(cpu.f16c || !cpu.avx2);
  EXPECT_TRUE(cpu.avx2 || !cpu.avx512f);
  EXPECT_TRUE(cpu.avx512f || !cpu.avx512vl);
}

}  // namespace
}  // namespace anicodec
