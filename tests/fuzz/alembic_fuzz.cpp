// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/fuzz/fuzz_mesh.h"
#include "tests/tools/io/alembic/alembic_testing.h"

#include <cmath>

using namespace anicodec;
using namespace anicodec::tools;

namespace {

constexpr uint64_t kMemory = uint64_t{1} << 20;
constexpr uint32_t kMostFrames = 256;

/// Whether names and times are such that no rounding or limit makes one of two.
bool is_ordinary(const Scene& scene) {
  constexpr size_t kLongestPath = 4000;
  constexpr double kLatest = 1e5, kLeastGap = 1e-5;
  for (const SceneMesh& mesh : scene.meshes) {
    if (mesh.sequence.mesh_name.size() > kLongestPath)
      return false;
  }
  const MeshSequence& clip = scene.clip;
  bool ordinary = std::abs(clip.start_time) < kLatest && clip.rate.value() < 1 / kLeastGap &&
                  clip.frame_count / clip.rate.value() < kLatest;
  for (size_t f = 1; f < clip.times.size(); ++f)
    ordinary &= clip.times[f] - clip.times[f - 1] > kLeastGap && clip.times[f] < kLatest;
  return ordinary;
}

/// An accepted scene is valid, and an archive of it reads back with the same positions.
void round_trip(Scene scene) {
  for (const SceneMesh& mesh : scene.meshes)
    check(mesh.sequence);
  if (scene.clip.frame_count > kMostFrames || !is_ordinary(scene))
    return;
  const std::string written = archive_of_scene(scene, true);
  AlembicOptions options;
  options.memory_limit = 4 * kMemory;
  const Scene again = read_alembic_meshes(memory_source(written, "again"), options);
  size_t before = 0, after = 0;
  for (const SceneMesh& mesh : scene.meshes)
    before += mesh.sequence.positions.size();
  for (const SceneMesh& mesh : again.meshes)
    after += mesh.sequence.positions.size();
  require(before == after);
}

template <typename Read>
void attempt(Read read) {
  try {
    read();
  } catch (const Error& error) {
    require(error.kind() != ErrorKind::kInternal && *error.what() != '\0');
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ByteSource source = memory_source(as_text(data, size), "fuzz");
  AlembicOptions options;
  options.memory_limit = kMemory;
  options.note = [](const std::string& text) { require(!text.empty()); };
  attempt([&] { check(read_alembic(source, options)); });
  Scene scene;
  bool is_read = false;
  attempt([&] {
    scene = read_alembic_meshes(source, options);
    is_read = true;
  });
  if (is_read)
    round_trip(std::move(scene));
  return 0;
}
