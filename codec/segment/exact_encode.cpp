// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/exact_encode.h"

#include "codec/segment/lattice.h"
#include "format/checksum.h"
#include "sdk/base/float_control.h"
#include "sdk/exact/exact_coding.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace anicodec {
namespace {

constexpr uint32_t kLooksBack = 512;    // frames that one may be predicted from
constexpr uint32_t kLooksAt = 256;      // vertices by which frames are compared
constexpr double kFarNearer = 0.25;     // an earlier frame than the last must be so much nearer
constexpr double kTypicalError = 3e-6;  // of the diagonal; tuned on dance, chicken, flag

/// Some vertices of all frames, for comparing frames.
std::vector<float> sample_of(const FrameView& frames) {
  const size_t count = std::min<size_t>(frames.vertex_count, kLooksAt);
  std::vector<float> sample;
  for (size_t f = 0; f < frames.frame_count; ++f) {
    for (size_t i = 0; i < count; ++i)
      sample.insert(sample.end(), frames.frame(f) + 3 * (i * frames.vertex_count / count),
                    frames.frame(f) + 3 * (i * frames.vertex_count / count) + 3);
  }
  return sample;
}

/// The frame that each is predicted from: the one before, unless another is much nearer.
std::vector<uint32_t> references_of(const FrameView& frames) {
  const std::vector<float> sample = sample_of(frames);
  const size_t row = sample.size() / frames.frame_count;
  auto distance = [&](uint32_t a, uint32_t b) {
    double sum = 0;
    for (size_t i = 0; i < row; ++i) {
      const double d =
          static_cast<double>(sample[a * row + i]) - static_cast<double>(sample[b * row + i]);
      sum += d * d;
    }
    return sum;
  };
  std::vector<uint32_t> references(frames.frame_count, 0);
  for (uint32_t f = 1; f < frames.frame_count; ++f) {
    references[f] = f - 1;
    double nearest = kFarNearer * distance(f, f - 1);
    for (uint32_t g = f - 1; g-- > (f > kLooksBack ? f - kLooksBack : 0);) {
      const double d = distance(f, g);
      if (d < nearest) {
        nearest = d;
        references[f] = g;
      }
    }
  }
  return references;
}

std::vector<float> axis_of(const FrameView& frames, size_t axis) {
  std::vector<float> all;
  all.reserve(frames.frame_count * frames.vertex_count);
  for (size_t f = 0; f < frames.frame_count; ++f) {
    for (size_t v = 0; v < frames.vertex_count; ++v)
      all.push_back(frames.frame(f)[3 * v + axis]);
  }
  return all;
}

/// The variance that predictions are expected to miss by.
double noise_of(const FrameView& frames) {
  double squared = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::vector<float> all = axis_of(frames, axis);
    const auto [low, high] = std::ranges::minmax(all);
    squared += std::pow(static_cast<double>(high) - static_cast<double>(low), 2);
  }
  return std::max(squared * kTypicalError * kTypicalError, std::numeric_limits<double>::min());
}

}  // namespace

Bytes encode_exact(const FrameView& frames, const Topology& topology) {
  ExactRecord record;
  record.noise = noise_of(frames);
  for (size_t axis = 0; axis < 3; ++axis)
    record.lattices[axis] =
        find_lattice(axis_of(frames, axis), uint64_t{frames.frame_count} * frames.vertex_count);
  const std::vector<uint32_t> references = references_of(frames);
  const size_t frame = 3 * frames.vertex_count;
  std::vector<float> positions(frames.frame(0), frames.frame(0) + frame * frames.frame_count);
  std::vector<int32_t> bits(frame);
  IntegerHash hash;
  BinaryEncoder encoder;
  const FloatControl control;
  const EarlierNeighbours neighbours(topology);
  ExactCoding coding(record, neighbours, static_cast<uint32_t>(frames.vertex_count));
  for (uint32_t f = 0; f < frames.frame_count; ++f) {
    std::memcpy(bits.data(), frames.frame(f), frame * sizeof(float));
    hash.add(bits.data(), frame);
    coding.code_frame(encoder, f, references[f], positions.data());
  }
  record.hash = hash.digest();
  const Bytes stream = encoder.finish();
  record.stream = stream;
  return record.write();
}

}  // namespace anicodec
