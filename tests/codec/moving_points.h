// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_CODEC_MOVING_POINTS_H_
#define ANICODEC_TESTS_CODEC_MOVING_POINTS_H_

#include "codec/sequence/frame_view.h"
#include "tests/random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Dense>

namespace anicodec {

/// Points without connectivity that move; frames x vertices x 3 floats.
struct MovingPoints {
  size_t frame_count = 0;
  size_t vertex_count = 0;
  std::vector<float> positions;

  FrameView view() const { return {positions.data(), frame_count, vertex_count}; }

  float* frame(size_t f) { return positions.data() + 3 * f * vertex_count; }
};

/// Uniform in -1..1, the same everywhere.
class Noise {
 public:
  explicit Noise(uint32_t seed) : random_(seed * 2654435761u + 12345u) {}

  double next() { return random_.symmetric(); }

 private:
  SmallRandom random_;
};

/// Every coordinate of every frame at random, plus an offset.
inline MovingPoints random_points(size_t frames, size_t vertices, uint32_t seed,
                                  double offset = 0) {
  MovingPoints clip{frames, vertices, std::vector<float>(3 * frames * vertices)};
  Noise noise(seed);
  for (float& x : clip.positions) {
    x = static_cast<float>(offset + noise.next());
  }
  return clip;
}

/// Smooth motion: a rest shape and rank shapes more, each swinging at its own pace; plus noise.
inline MovingPoints swinging_points(size_t frames, size_t vertices, size_t rank, uint32_t seed,
                                    double noise_size = 0) {
  Noise noise(seed);
  std::vector<double> shapes((rank + 1) * 3 * vertices);
  for (double& x : shapes) {
    x = noise.next();
  }
  MovingPoints clip{frames, vertices, std::vector<float>(3 * frames * vertices)};
  for (size_t f = 0; f < frames; f++) {
    for (size_t i = 0; i < 3 * vertices; i++) {
      double x = shapes[i] + noise_size * noise.next();
      for (size_t r = 1; r <= rank; r++) {
        const double time = static_cast<double>(f) / static_cast<double>(frames);
        x += std::sin(static_cast<double>(r) * 6.0 * time + static_cast<double>(r)) /
             static_cast<double>(r) * shapes[r * 3 * vertices + i];
      }
      clip.frame(f)[i] = static_cast<float>(x);
    }
  }
  return clip;
}

/// Moves every point of a frame.
inline void move_frame(MovingPoints& clip, size_t f, const Eigen::Matrix3d& rotation,
                       const Eigen::Vector3d& translation) {
  float* p = clip.frame(f);
  for (size_t v = 0; v < clip.vertex_count; v++, p += 3) {
    const Eigen::Vector3d moved = rotation * Eigen::Vector3d(p[0], p[1], p[2]) + translation;
    for (int c = 0; c < 3; c++) {
      p[c] = static_cast<float>(moved[c]);
    }
  }
}

inline Eigen::Matrix3d turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

inline double squared_distance(const float* a, const float* b, size_t vertices) {
  double sum = 0;
  for (size_t i = 0; i < 3 * vertices; i++) {
    const double d = double{a[i]} - double{b[i]};
    sum += d * d;
  }
  return sum;
}

/// Numbers in -1..1.
inline std::vector<float> noise_values(size_t count, uint32_t seed) {
  std::vector<float> out(count);
  SmallRandom random(seed);
  for (float& x : out)
    x = static_cast<float>(random.symmetric());
  return out;
}

/// Frames x vertices x 3 numbers of a cloud that an affine map and a few other functions of time
/// move.
inline std::vector<float> affine_points(size_t frames, size_t vertices) {
  const std::vector<float> shape = noise_values(9 * vertices, 3);
  std::vector<float> out;
  for (size_t f = 0; f < frames; ++f) {
    const float t = static_cast<float>(f);
    for (size_t v = 0; v < vertices; ++v) {
      const float* p = shape.data() + 9 * v;
      for (size_t c = 0; c < 3; ++c)
        out.push_back(100 + 10 * p[c] + 0.3f * t * p[(c + 1) % 3] + 0.1f * p[3 + c] * std::sin(t) +
                      0.05f * p[6 + c] * std::cos(0.3f * t));
    }
  }
  return out;
}

/// 3 frames x vertices, about an origin.
inline Eigen::MatrixXd trajectories(const std::vector<float>& x, size_t frames,
                                    const Eigen::Vector3d& origin) {
  const size_t n = x.size() / 3 / frames;
  using Eigen::Index;
  Eigen::MatrixXd out(static_cast<Index>(3 * frames), static_cast<Index>(n));
  for (size_t f = 0; f < frames; ++f)
    for (size_t v = 0; v < n; ++v)
      for (size_t c = 0; c < 3; ++c)
        out(static_cast<Index>(3 * f + c), static_cast<Index>(v)) =
            static_cast<double>(x[(f * n + v) * 3 + c]) - origin[static_cast<Index>(c)];
  return out;
}

inline Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, uint32_t seed) {
  Noise noise(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return noise.next(); });
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CODEC_MOVING_POINTS_H_
