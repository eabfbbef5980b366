// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The most work that few bytes announce, for each stage of opening (spec/14-security.md, section 2): files made by hand,
// and clips without motion where the encoder writes no less. Prints what opening takes for each announced unit, at some
// size and at four times that size: a ratio far above 1 is a stage that is not linear.
//
// usage: worst_work [STAGE]
#include "codec/encode.h"
#include "codec/sequence/mesh_sequence.h"
#include "tests/api/crafted_file.h"

#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>

using namespace anicodec;

namespace {

Bytes chunks(uint32_t n) {
  CraftedFile file(3, 1);
  file.add_segment(1, 0, false, false);
  file.add_unknown_chunks(n);
  return file.write();
}

Bytes segments(uint32_t n) {
  CraftedFile file(3, 1);
  for (uint32_t i = 0; i < n; ++i)
    file.add_segment(1, 0, false, false);
  return file.write();
}

Bytes meshes(uint32_t n) {
  CraftedFile file(1, 0, n);
  file.add_segment(1, 0, false, false);
  for (uint32_t m = 1; m < n; ++m)
    file.add_segment_of(static_cast<uint16_t>(m), 0, 1, 0);
  return file.write();
}

Bytes clips(uint32_t n) {
  CraftedFile file(3, 1);
  file.add_segment(n, 0, false, false);
  file.cut_into_clips();
  return file.write();
}

Bytes frames(uint32_t n) {
  CraftedFile file(3, 1);
  file.add_segment(n, 0, false, false);
  return file.write();
}

Bytes faces(uint32_t n) {
  CraftedFile file(3, n);
  file.add_segment(1, 0, false, false);
  return file.write();
}

Bytes poses(uint32_t n) {
  CraftedFile file(n);
  file.add_segment(1, 0, true, false);
  return file.write();
}

constexpr uint32_t kComponents = 32;

Bytes coefficients(uint32_t n) {
  CraftedFile file(n, n);
  file.add_segment(1, kComponents, false, false);
  return file.write();
}

Bytes weights(uint32_t n) {
  CraftedFile file(3, 1);
  file.add_segment(n, kComponents, false, false);
  return file.write();
}

constexpr uint32_t kCorrected = 64;

Bytes corrections(uint32_t n) {
  CraftedFile file(n);
  file.add_segment(kCorrected, 0, false, true);
  file.correct(kCorrected);
  return file.write();
}

/// A sheet of n vertices without motion, in so many frames.
MeshSequence sheet(uint32_t n, uint32_t frame_count) {
  constexpr uint32_t kWidth = 100;
  MeshSequence clip;
  clip.vertex_count = n;
  clip.frame_count = frame_count;
  for (uint32_t v = 0; v + kWidth + 1 < n; ++v) {
    if (v % kWidth + 1 < kWidth)
      clip.polygons.add(std::vector<uint32_t>{v, v + 1, v + kWidth + 1, v + kWidth});
  }
  for (uint32_t f = 0; f < frame_count; ++f) {
    for (uint32_t v = 0; v < n; ++v)
      clip.positions.insert(clip.positions.end(),
                            {static_cast<float>(v % kWidth), static_cast<float>(v / kWidth), 0});
  }
  return clip;
}

Bytes encoded(const MeshSequence& clip, const std::function<void(EncodeOptions&)>& set) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.01, true};
  set(options);
  return encode(clip, options).file;
}

Bytes maps(uint32_t n) {
  MeshSequence clip = sheet(n, 1);
  for (uint32_t v = 0; v < n; ++v) {  // all vertices at few places: copies
    clip.positions[size_t{3} * v] = static_cast<float>(v % 3);
    clip.positions[size_t{3} * v + 1] = static_cast<float>(v % 5);
  }
  return encoded(clip, [](EncodeOptions& options) { options.order = OrderMode::kAll; });
}

constexpr uint32_t kAttributes = 8;

Bytes attributes(uint32_t n) {
  MeshSequence clip = sheet(n, 1);
  for (uint32_t a = 0; a < kAttributes; ++a) {
    Attribute uv;
    uv.name = std::to_string(a);
    uv.domain = AttributeDomain::kCorner;
    uv.values.assign(2 * clip.polygons.corners.size(), 0.5F);
    clip.attributes.push_back(uv);
  }
  return encoded(clip, [](EncodeOptions&) {});
}

constexpr uint32_t kFrames = 16;

Bytes exact(uint32_t n) {
  return encoded(sheet(n, kFrames), [](EncodeOptions& options) {
    options.target = {ErrorMetric::kMaxError, 0, false};
  });
}

constexpr uint32_t kKeyframes = 4;

Bytes keyframes(uint32_t n, KeyframePoses poses, InterpolationChoice interpolation) {
  return encoded(sheet(n, kFrames), [&](EncodeOptions& options) {
    options.target = {};
    options.basis = BasisChoice::kKeyframes;
    options.keyframes = kKeyframes;
    options.keyframe_poses = poses;
    options.interpolation = interpolation;
  });
}

Bytes native(uint32_t n) {
  return keyframes(n, KeyframePoses::kNative, InterpolationChoice::kLinear);
}

Bytes draco(uint32_t n) {
  return keyframes(n, KeyframePoses::kDraco, InterpolationChoice::kLinear);
}

Bytes msgi(uint32_t n) {
  return keyframes(n, KeyframePoses::kNative, InterpolationChoice::kMsgi);
}

/// A stage, and how many units of its cost a file of size n announces, for each of n.
struct Stage {
  const char* name;
  const char* unit;
  Bytes (*make)(uint32_t n);
  uint32_t n;
  uint32_t units = 1;
};

constexpr Stage kStages[] = {
    {"table", "chunk", chunks, 200000},
    {"LIMI, segments", "segment", segments, 5000},
    {"LIMI, meshes", "mesh", meshes, 5000},
    {"CLIP, clips", "clip", clips, 50000},
    {"CLIP, frames", "frame", frames, 1000000},
    {"faces", "corner", faces, 100000, 3},
    {"pose", "vertex", poses, 200000},
    {"order, coefficients", "coefficient", coefficients, 20000, kComponents},
    {"time weights", "weight", weights, 20000, kComponents},
    {"corrections", "block", corrections, 500000, kCorrected / 16},
    {"copies and maps", "corner", maps, 20000, 4},
    {"attributes", "value", attributes, 10000, 4 * kAttributes},
    {"exact positions", "position", exact, 10000, kFrames},
    {"key-frames", "coefficient", native, 20000, kKeyframes},
    {"key-frames by Draco", "coefficient", draco, 20000, kKeyframes},
    {"interpolation", "coefficient", msgi, 5000, kKeyframes}};

/// Seconds of the processor that opening takes: the least of some tries; below 0 if it is refused.
double seconds(const Bytes& file) {
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    Clip clip;
    const std::clock_t start = std::clock();
    const Failure failure = clip.open(file);
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    if (!failure.ok()) {
      std::printf("refused with status %d: ", static_cast<int>(failure.status));
      return -1;
    }
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-20s %10s %12s %9s %9s %12s %6s\n", "stage", "bytes", "announced", "ms", "ns/unit",
              "ns/byte", "ratio");
  for (const Stage& stage : kStages) {
    if (argc > 1 && std::strstr(stage.name, argv[1]) == nullptr)
      continue;
    constexpr uint32_t kTimes = 4;
    const double small = seconds(stage.make(stage.n));
    const Bytes file = stage.make(kTimes * stage.n);
    const double large = seconds(file), units = static_cast<double>(kTimes) * stage.n * stage.units;
    std::printf("%-20s %10zu %12.0f %9.2f %9.2f %12.1f %6.2f  a %s\n", stage.name, file.size(),
                units, 1e3 * large, 1e9 * large / units,
                1e9 * large / static_cast<double>(file.size()), large / (kTimes * small),
                stage.unit);
    std::fflush(stdout);
  }
}
