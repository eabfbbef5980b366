// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Runs the built examples on clips of the corpus.
#include "build_paths.h"
#include "tests/api/opened.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/wait.h>

namespace anicodec {
namespace {

struct Ended {
  int status = -1;
  std::string out;  ///< and what it said on stderr
};

Ended run(const std::string& example, const std::string& clip) {
  const std::string command =
      std::string(ANICODEC_EXAMPLES) + "/example_" + example + " '" + clip + "' 2>&1";
  Ended result;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe)
    return result;
  std::array<char, 4096> buffer;
  for (size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    result.out.append(buffer.data(), n);
  const int status = pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Clips of every kind, in a folder of their own.
class AnicExamples : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "anicodec_examples_XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    for (const auto& [clip, basis] : cases()) {
      const Bytes& file = encoded_clip(clip, basis);
      std::ofstream(path(clip), std::ios::binary)
          .write(reinterpret_cast<const char*>(file.data()),
                 static_cast<std::streamsize>(file.size()));
    }
  }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& clip) const { return folder_ + "/" + clip + ".anic"; }

  /// Runs an example on all clips, which it must like.
  void expect_runs(const std::string& example, const std::string& says) {
    for (const auto& [clip, basis] : cases()) {
      const Ended result = run(example, path(clip));
      EXPECT_EQ(result.status, 0) << clip << ": " << result.out;
      EXPECT_NE(result.out.find(says), std::string::npos) << clip << ": " << result.out;
    }
    EXPECT_EQ(run(example, folder_ + "/none.anic").status, 1);
    std::ofstream(path("damaged")) << "not a clip";
    EXPECT_EQ(run(example, path("damaged")).status, 1);
  }

  std::string folder_;
};

TEST_F(AnicExamples, PlayInC) {
  expect_runs("play_c", "1.00 s, instance 1: x ");
}

TEST_F(AnicExamples, PlayInCpp) {
  expect_runs("play_cpp", "0.00 s: vertex 0 at ");
}

TEST_F(AnicExamples, Buffers) {
  expect_runs("buffers_c", " ns a vertex for positions");
}

TEST_F(AnicExamples, Stream) {
  expect_runs("stream_c", ": whole, from ");
}

// Fails where a frame computed from the buffers is not the one of the library.
TEST_F(AnicExamples, Gpu) {
  expect_runs("gpu_c", "largest difference ");
}

TEST_F(AnicExamples, StreamShowsCoarseFramesFirst) {
  const Ended result = run("stream_c", path("limb"));
  EXPECT_NE(result.out.find(": coarse, from "), std::string::npos) << result.out;
}

TEST_F(AnicExamples, FrameToObj) {
  uint32_t written = 0;
  for (const auto& [clip, basis] : cases()) {
    SCOPED_TRACE(clip);
    const Asset asset = open(encoded_clip(clip, basis));
    const Ended result = run("frame_to_obj_c", path(clip));
    if (info_of(asset).frame_count <= 10) {
      EXPECT_EQ(result.status, 1);
      continue;
    }
    ++written;
    EXPECT_EQ(result.status, 0) << result.out;
    anic_polygons polygons = ANIC_INIT(anic_polygons);
    ASSERT_EQ(anic_get_polygons(asset.get(), 0, &polygons), ANIC_OK);
    std::vector<float> points;
    std::vector<uint32_t> corners, offsets = {0};
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "v") {
        for (float x; words >> x;)
          points.push_back(x);
      } else {
        EXPECT_EQ(kind, "f");
        for (uint32_t corner; words >> corner;)
          corners.push_back(corner - 1);
        offsets.push_back(static_cast<uint32_t>(corners.size()));
      }
    }
    EXPECT_EQ(points, frame(asset, 10));
    ASSERT_EQ(offsets.size(), polygons.polygon_count + size_t{1});
    EXPECT_TRUE(std::equal(offsets.begin(), offsets.end(), polygons.offsets));
    EXPECT_TRUE(std::equal(corners.begin(), corners.end(), polygons.corners));
  }
  EXPECT_GE(written, 5U);
}

TEST(AnicReadme, ShowsTheProgramThatIsTested) {
  const std::string source = ANICODEC_SOURCE_DIR;
  const std::string readme = text_of(source + "/sdk/README.md");
  std::string program = text_of(source + "/sdk/examples/frame_to_obj.c");
  program = program.substr(program.find("#include"));  // without its licence
  EXPECT_LE(std::count(program.begin(), program.end(), '\n'), 40);
  EXPECT_NE(readme.find("```c\n" + program + "```\n"), std::string::npos);
}

}  // namespace
}  // namespace anicodec
