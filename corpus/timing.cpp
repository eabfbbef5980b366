// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/build.h"
#include "corpus/generators.h"

#include <algorithm>
#include <cmath>

namespace anicodec::corpus {
namespace {

/// The sequence whose frame i is frame order[i] of the source.
MeshSequence picked(const MeshSequence& source, const std::vector<uint32_t>& order) {
  MeshSequence result = source;
  result.frame_count = static_cast<uint32_t>(order.size());
  result.positions.clear();
  for (uint32_t f : order) {
    auto frame = source.frame(f);
    result.positions.insert(result.positions.end(), frame.begin(), frame.end());
  }
  return result;
}

}  // namespace

MeshSequence cuts(ClipSize size) {
  MeshSequence first = limb({size.vertices, size.frames});
  std::vector<uint32_t> order;
  // A motion, the same body upside down and moved, and the first again from elsewhere.
  uint32_t third = size.frames / 3;
  for (uint32_t f = 0; f < size.frames; ++f)
    order.push_back(f < 2 * third ? f : size.frames - 1 - (f - 2 * third));
  MeshSequence result = picked(first, order);
  for (uint32_t f = third; f < 2 * third; ++f) {
    auto frame = result.frame(f);
    for (size_t i = 0; i < frame.size(); i += 3) {
      float x = frame[i];
      frame[i] = 2 - frame[i + 1];
      frame[i + 1] = x;
      frame[i + 2] = 1 - frame[i + 2];
    }
  }
  return result;
}

MeshSequence repeats(ClipSize size) {
  std::vector<uint32_t> order;
  for (uint32_t f = 0; f < size.frames; ++f) {
    // Animated on twos, with a hold in the middle and the first frame at the end.
    bool hold = f >= size.frames / 2 && f < size.frames / 2 + 8;
    order.push_back(hold ? size.frames / 4 : f / 2);
  }
  order.back() = 0;
  return picked(face(size), order);
}

MeshSequence motionless(ClipSize size) {
  return picked(limb({size.vertices, 20}), std::vector<uint32_t>(size.frames, 19));
}

MeshSequence one_frame(ClipSize size) {
  return picked(limb({size.vertices, 11}), {10});
}

MeshSequence uneven(ClipSize size) {
  MeshSequence all = cloth({size.vertices, size.frames * 4});
  std::vector<uint32_t> order;
  uint32_t at = 0;
  for (uint32_t f = 0; f < size.frames; ++f) {
    order.push_back(at);
    at += 1 + (f * 5) % 4;
  }
  MeshSequence result = picked(all, order);
  for (uint32_t f : order)
    result.times.push_back(f / 24.0);
  return result;
}

}  // namespace anicodec::corpus
