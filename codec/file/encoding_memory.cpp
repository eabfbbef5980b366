// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/encoding_memory.h"

#include "codec/sequence/frame_array.h"

#include <algorithm>

namespace anicodec {
namespace {

// Measured by tests/api/encoder_memory_test.cpp, rounded up.
constexpr double kProducts =
    4 * 72;  // of frames squared: products of three axes in double, four times
constexpr double kKeyProducts = 120;                 // where key-frames are all that is tried
constexpr double kFewTrials = 1700, kTrials = 3300;  // for each vertex: at effort 1, and above
constexpr double kAny = 1 << 20;                     // whatever the clip
constexpr double kAttributes = 4;                    // values in memory at a time, of each
constexpr double kFewShapes = 34,
                 kFewTrajectories = 12;             // for each vertex and component: at effort 1
constexpr double kShapes = 80, kTrajectories = 30;  // above

constexpr double kUsual = 24;  // components, which every trial has room for

std::string whole(double bytes) {
  return std::to_string(static_cast<uint64_t>(std::min(bytes, 1e18)));
}

}  // namespace

EncodingMemory EncodingMemory::of(const MeshSequence& sequence, const EncodeOptions& options) {
  EncodingMemory memory;
  memory.vertices = sequence.vertex_count;
  memory.frames = options.part ? options.part->count : sequence.frame_count;
  if (options.attributes.keep) {
    for (const Attribute& attribute : sequence.attributes)
      memory.attribute_values += static_cast<double>(attribute.values.size());
  }
  return memory;
}

double EncodingMemory::kept(const EncodeOptions& options) const {
  const int copies = 1 + (options.root_motion ? 1 : 0) + (is_lossless(options.target) ? 2 : 0);
  const double products = options.basis == BasisChoice::kKeyframes ? kKeyProducts : kProducts;
  const double in_memory =
      std::max(0.0, copies * positions() - static_cast<double>(frame_bytes_on_disk()));
  return in_memory + kAttributes * sizeof(float) * attribute_values + products * frames * frames;
}

double EncodingMemory::thread(const EncodeOptions& options) const {
  return kAny + (options.effort > 1 ? kTrials : kFewTrials) * vertices;
}

double EncodingMemory::regions(double count) const {
  constexpr double kOfRegion = 72;
  return positions() + kOfRegion * count * frames * frames;
}

double EncodingMemory::basis(BasisKind kind, double components, int effort) const {
  const double shapes = effort > 1 ? kShapes : kFewShapes,
               others = effort > 1 ? kTrajectories : kFewTrajectories;
  return (kind == BasisKind::kEigenshapes ? shapes : others) * std::max(0.0, components - kUsual) *
         vertices;
}

MemoryShare MemoryBudget::take(double bytes, const std::string& stage) {
  if (left_.fetch_sub(bytes) < bytes) {
    const double missing = bytes - left_.fetch_add(bytes) - bytes;
    throw OverMemory(stage + " would hold about " + whole(missing) + " bytes more than is allowed");
  }
  return {&left_, bytes};
}

uint64_t most_bytes_beside(double bytes, uint64_t most_bytes) {
  if (most_bytes == 0)
    return 0;
  return static_cast<uint64_t>(std::max(1.0, static_cast<double>(most_bytes) - bytes));
}

MemoryPlan plan_memory(const EncodingMemory& memory, const EncodeOptions& options, size_t threads,
                       double others) {
  const auto most = static_cast<double>(options.most_bytes);
  const double kept = others + memory.kept(options), thread = memory.thread(options);
  if (kept + thread > most)
    throw OverMemory("encoding would hold about " + whole(kept + thread) + " bytes of at most " +
                     whole(most));
  // Half of what one thread leaves stays for the stages that the target decides.
  constexpr double kForThreads = 0.5;
  const double spare = most - kept - thread;
  const double more = std::min(kForThreads * spare / thread, static_cast<double>(threads - 1));
  MemoryPlan plan;
  plan.threads = 1 + static_cast<size_t>(more);
  plan.left = most - kept - static_cast<double>(plan.threads) * thread;
  return plan;
}

}  // namespace anicodec
