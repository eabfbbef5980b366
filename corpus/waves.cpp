// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "corpus/build.h"
#include "corpus/clips.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace anicodec::corpus {
namespace {

// All terms are integers times 2^-22 and the sums stay below 4: no bit is lost in float32.
constexpr double kPositionGrid = 1.0 / (1 << 22);
constexpr double kShapeGrid = 1.0 / (1 << 14);
constexpr double kWeightGrid = 1.0 / (1 << 7);
constexpr double kDirectionGrid = 1.0 / 2;
static_assert(kShapeGrid * kWeightGrid * kDirectionGrid == kPositionGrid);

double on_grid(double x, double step) {
  return std::round(x / step) * step;
}

struct Wave {
  double kx, ky, phase;  ///< of the standing wave over the sheet
  double direction[3];
  double amplitude;
};

std::vector<Wave> make_waves(uint32_t shapes) {
  SplitMix64 random(30);
  std::vector<Wave> waves(shapes);
  for (uint32_t s = 0; s < shapes; ++s) {
    Wave& w = waves[s];
    // Finer waves are weaker, as in real motion; the weakest still spans 16 steps of the grid.
    double fineness = 1 + 9.0 * s / shapes;
    double heading = random.uniform(0, 2 * std::numbers::pi);
    w.kx = fineness * std::cos(heading);
    w.ky = fineness * std::sin(heading);
    w.phase = random.uniform(0, 2 * std::numbers::pi);
    w.amplitude = std::max(0.25 / ((1 + 0.5 * s) * (1 + 0.5 * s)), 16 * kShapeGrid);
    for (double& d : w.direction)
      d = on_grid(random.uniform(-1, 1), kDirectionGrid);
    w.direction[s % 3] = 1;
  }
  return waves;
}

/// weights[s * frames + f] in [-1, 1]: sums of two sinusoids of a pseudo-random period.
std::vector<double> make_weights(uint32_t shapes, uint32_t frames) {
  SplitMix64 random(31);
  std::vector<double> weights;
  weights.reserve(size_t{shapes} * frames);
  for (uint32_t s = 0; s < shapes; ++s) {
    double slow = random.uniform(0.05, 0.6), fast = random.uniform(0.6, 2.4);
    double p0 = random.uniform(0, 2 * std::numbers::pi),
           p1 = random.uniform(0, 2 * std::numbers::pi);
    for (uint32_t f = 0; f < frames; ++f) {
      double time = 2 * std::numbers::pi * f / 24.0;
      weights.push_back(on_grid(0.6 * std::sin(slow * time + p0) + 0.4 * std::sin(fast * time + p1),
                                kWeightGrid));
    }
  }
  return weights;
}

}  // namespace

MeshSequence make_wave_grid(uint32_t vertices, uint32_t frames, uint32_t shapes) {
  if (vertices < 4 || vertices >= (1U << 31) || frames < 1 || frames >= (1U << 24) || shapes > 1000)
    throw Error(
        ErrorKind::kUsage,
        "a wave grid has 4 to 2^31 - 1 vertices, 1 to 2^24 - 1 frames and at most 1000 shapes");
  MeshSequence sequence;
  sequence.name = "waves";
  sequence.vertex_count = vertices;
  sequence.frame_count = frames;
  sequence.rate = {24, 1, false};
  sequence.positions.resize(size_t{3} * vertices * frames);

  // Row-major, the last row as long as needed.
  auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(vertices))));
  for (uint32_t v = columns; v < vertices; ++v) {
    if (v % columns == 0)
      continue;
    uint32_t a = v - columns - 1;
    const uint32_t lower[] = {a, a + 1, v}, upper[] = {a, v, v - 1};
    sequence.polygons.add(lower);
    sequence.polygons.add(upper);
  }

  std::vector<Wave> waves = make_waves(shapes);
  std::vector<double> weights = make_weights(shapes, frames);
  // Vertices in blocks that stay in the cache, for all frames.
  constexpr uint32_t kBlock = 512;
  std::vector<double> shape(size_t{kBlock} * shapes);
  for (uint32_t begin = 0; begin < vertices; begin += std::min(kBlock, vertices - begin)) {
    uint32_t count = std::min(kBlock, vertices - begin);
    double side = columns - 1;
    for (uint32_t i = 0; i < count; ++i) {
      double x = (begin + i) % columns / side, y = (begin + i) / columns / side;
      for (uint32_t s = 0; s < shapes; ++s) {
        const Wave& w = waves[s];
        double angle = 2 * std::numbers::pi * (w.kx * x + w.ky * y) + w.phase;
        shape[size_t{i} * shapes + s] = on_grid(w.amplitude * std::sin(angle), kShapeGrid);
      }
    }
    for (uint32_t f = 0; f < frames; ++f) {
      float* out = sequence.positions.data() + (size_t{f} * vertices + begin) * 3;
      for (uint32_t i = 0; i < count; ++i, out += 3) {
        uint32_t v = begin + i;
        double p[3] = {on_grid(v % columns / side, kPositionGrid),
                       on_grid(v / columns / side, kPositionGrid), 0};
        for (uint32_t s = 0; s < shapes; ++s) {
          double moved = weights[size_t{s} * frames + f] * shape[size_t{i} * shapes + s];
          for (size_t axis = 0; axis < 3; ++axis)
            p[axis] += moved * waves[s].direction[axis];
        }
        for (size_t axis = 0; axis < 3; ++axis)
          out[axis] = static_cast<float>(p[axis]);
      }
    }
  }
  return sequence;
}

}  // namespace anicodec::corpus
