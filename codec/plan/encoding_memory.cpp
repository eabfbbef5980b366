// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/plan/encoding_memory.h"

#include "codec/motion/motion_products.h"
#include "codec/sequence/frame_array.h"

#include <algorithm>
#include <optional>

namespace anicodec {
namespace {

// Measured by tests/api/encoder_memory_test.cpp, rounded up.
constexpr double kProducts =
    4 * 72;  // of the smaller side squared: products of three axes in double, four times
constexpr double kKeyProducts = 120;                 // of frames squared, for key-frames
constexpr double kFewTrials = 1700, kTrials = 3300;  // for each vertex: fast, and with more effort
constexpr double kAny = 1 << 20;                     // whatever the clip
constexpr double kAttributes = 4;                    // values in memory at a time, of each
constexpr double kFewShapes = 34,
                 kFewTrajectories = 12;             // for each vertex and component: fast
constexpr double kShapes = 80, kTrajectories = 30;  // above
constexpr double kTimes = 4000;  // for each frame: trials with the first components
// For each frame and component: of a basis that is kept, and of trials with more than the first components.
constexpr double kTimeOfShapes = 10, kTrialOfShapes = 100;
constexpr double kTimeOfTrajectories = 30, kTrialOfTrajectories = 300;
constexpr double kMultiplied = kMostMultiplied;
constexpr double kFirst = 48;  // components of the first bases

constexpr double kUsual = 24;  // components, which every trial has room for

std::string whole(double bytes) {
  return std::to_string(static_cast<uint64_t>(std::min(bytes, 1e18)));
}

EncodingMemory of_frames(const MeshSequence& sequence, const std::optional<FrameRun>& run,
                         const AttributeOptions& attributes) {
  EncodingMemory memory;
  memory.vertices = sequence.vertex_count;
  memory.frames = run ? run->count : sequence.frame_count;
  if (attributes.keep) {
    for (const Attribute& attribute : sequence.attributes)
      memory.attribute_values += static_cast<double>(attribute.values.size());
  }
  return memory;
}

}  // namespace

EncodingMemory EncodingMemory::of(const MeshSequence& sequence, const EncodeOptions& options) {
  EncodingMemory memory = of_frames(sequence, options.part, options.attributes);
  memory.lossless = is_lossless(options.target);
  return memory;
}

EncodingMemory EncodingMemory::of(const MeshSequence& sequence, const MeshPlan& plan) {
  EncodingMemory memory = of_frames(sequence, plan.run, plan.attributes);
  memory.lossless = plan.is_lossless();
  return memory;
}

/// Inner products of a clip, or of a part of its vertices (MotionProducts).
double EncodingMemory::products(double of_vertices) const {
  const double of_sketch = sketch(of_vertices, kFirst);
  // Beside a sketch, half of the frames at most are multiplied: to see whether a cut pays.
  const double side = std::min({of_sketch > 0 ? frames / 2 : frames, of_vertices, kMultiplied});
  return kProducts * side * side + of_sketch;
}

/// More where both sides are large.
double EncodingMemory::sketch(double of_vertices, double components) const {
  constexpr double kOfFrame = 320, kOfBase = 16, kOfPairs = 24 * 6 * 6;
  if (std::min(frames, of_vertices) <= kMultiplied)
    return 0;
  const double rows = components + kOfBase;
  return kOfFrame * rows * frames + kOfPairs * rows * rows;
}

double EncodingMemory::kept(const CodingOptions& options) const {
  const int copies = 1 + (options.root_motion ? 1 : 0) + (lossless ? 2 : 0);
  const bool keyframes_alone = options.basis == BasisChoice::kKeyframes || options.keyframes;
  const double of_keyframes = kKeyProducts * frames * frames;
  const bool keyframes_too = frames <= kMultiplied && vertices < frames;  // else they take no more
  const double of_all =
      keyframes_alone ? of_keyframes : products(vertices) + (keyframes_too ? of_keyframes : 0);
  const double in_memory =
      std::max(0.0, copies * positions() - static_cast<double>(frame_bytes_on_disk()));
  return in_memory + kAttributes * sizeof(float) * attribute_values + of_all;
}

double EncodingMemory::thread(const SearchOptions& options) const {
  return kAny + (options.effort > Effort::kFast ? kTrials : kFewTrials) * vertices +
         kTimes * frames;
}

double EncodingMemory::regions(double count, double trajectories) const {
  constexpr double kOfFrame = 4 * 24, kOfPair = 4 * 8;
  return positions() + sketch(vertices, trajectories) +
         trajectories * (kOfFrame * frames + count * kOfPair * trajectories);
}

double EncodingMemory::basis(BasisKind kind, double components, Effort effort,
                             double regions) const {
  const bool shapes = kind == BasisKind::kEigenshapes, few = effort <= Effort::kFast;
  const double of_vertex = shapes ? (few ? kFewShapes : kShapes)
                           : few  ? kFewTrajectories
                                  : kTrajectories;
  const double of_frame =
      (shapes ? kTimeOfShapes : kTimeOfTrajectories) * components +
      (shapes ? kTrialOfShapes : kTrialOfTrajectories) * std::max(0.0, components - kFirst);
  const double more = components > kFirst ? sketch(vertices, components) : 0;
  return of_vertex * std::max(0.0, components - kUsual) * vertices + regions * of_frame * frames +
         more;
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

MemoryPlan plan_memory(const EncodingMemory& memory, const CodingOptions& options, size_t threads,
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
