// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/guard/guarded_call.h"

#include "tests/tools/io_testing.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

std::string run(const std::function<std::string()>& work, GuardLimits limits = {}) {
  return run_guarded("a.fbx", limits, work);
}

TEST(GuardedCall, GivesWhatTheWorkReturns) {
  EXPECT_EQ(run([] { return std::string("hello"); }), "hello");
  EXPECT_EQ(run([] { return std::string(); }), "");
  const std::string large(3000000, 'x');
  EXPECT_EQ(run([&] { return large; }), large);
}

TEST(GuardedCall, ThrowsTheErrorsOfTheWork) {
  EXPECT_EQ(fault([] { run([]() -> std::string { throw Error(ErrorKind::kUnsupported, "no"); }); },
                  ErrorKind::kUnsupported),
            "no");
  EXPECT_EQ(fault([] { run([]() -> std::string { throw std::runtime_error("gone"); }); }), "gone");
}

TEST(GuardedCall, TellsACrash) {
  EXPECT_THAT(fault([] {
                run([]() -> std::string {
                  ::raise(SIGSEGV);
                  return {};
                });
              }),
              HasSubstr("a.fbx: the library that reads it crashes (Segmentation fault)"));
  EXPECT_THAT(fault([] { run([]() -> std::string { std::abort(); }); }),
              HasSubstr("a.fbx: the library that reads it crashes (Aborted)"));
  EXPECT_THAT(fault([] { run([]() -> std::string { ::_exit(0); }); }), HasSubstr("a.fbx: "));
  EXPECT_THAT(fault([] { run([]() -> std::string { throw 7; }); }), HasSubstr("crashes"));
}

TEST(GuardedCall, LimitsTime) {
  GuardLimits limits;
  limits.seconds = 1;
  EXPECT_EQ(fault([&] {
              run(
                  []() -> std::string {
                    for (std::atomic<int> x = 0;;)
                      ++x;
                  },
                  limits);
            }),
            "a.fbx: takes longer than 1 s to read");
}

TEST(GuardedCall, LimitsMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "addresses are not limited beside the sanitizer's";
#endif
  GuardLimits limits;
  limits.memory = 50 << 20;
  EXPECT_EQ(fault([&] {
              // More than tests before it may have left in the heap.
              run([]() -> std::string { return std::string(std::vector<char>(1 << 30).data()); },
                  limits);
            }),
            "a.fbx: takes more than 52428800 bytes of memory to read");
}

TEST(GuardedCall, LimitsWhatIsSaid) {
  GuardLimits limits;
  limits.memory = 1000;
  EXPECT_THAT(fault([&] { run([] { return std::string(2000, 'x'); }, limits); }),
              HasSubstr("a.fbx: takes more than 1000 bytes"));
}

TEST(GuardedCall, KeepsTheWorkFromWritingFiles) {
  TemporaryFolder folder;
  EXPECT_THAT(fault([&] {
                run([&] {
                  folder.write("a", "text");
                  return std::string(folder.read("a").empty() ? "nothing" : "written");
                });
              }),
              HasSubstr("crashes"));
  EXPECT_EQ(folder.read("a"), "");
}

}  // namespace
}  // namespace anicodec::tools
