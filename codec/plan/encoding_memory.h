// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PLAN_ENCODING_MEMORY_H_
#define ANICODEC_CODEC_PLAN_ENCODING_MEMORY_H_

#include "codec/plan/encode_options.h"
#include "codec/plan/mesh_plan.h"
#include "codec/sequence/error.h"
#include "format/records.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace anicodec {

/// An encoding would hold more memory than CodingOptions::most_bytes.
class OverMemory : public Error {
 public:
  explicit OverMemory(const std::string& text) : Error(ErrorKind::kInput, text) {}
};

/// Bytes that stages of an encoding hold, by the table of docs/memory.md: upper bounds from counts.
struct EncodingMemory {
  double vertices = 0;
  double frames = 0;
  double attribute_values = 0;  ///< of all frames
  bool lossless = false;        ///< exact positions are kept, too

  /// A sequence that is encoded so.
  static EncodingMemory of(const MeshSequence& sequence, const EncodeOptions& options = {});

  /// The same by a plan.
  static EncodingMemory of(const MeshSequence& sequence, const MeshPlan& plan);

  double positions() const { return 12 * vertices * frames; }

  /// The sequence, attributes, and products of all frames: whatever the threads and the target.
  double kept(const CodingOptions& options) const;

  /// More for each thread.
  double thread(const SearchOptions& options) const;

  /// More where surfaces are cut into so many regions: the positions once more, a space of so many trajectories, and
  /// products of each region in it.
  double regions(double count, double trajectories) const;

  /// More for a basis of so many components in each of the regions, with the trials that use it.
  double basis(BasisKind kind, double components, Effort effort, double regions = 1) const;

 private:
  double products(double of_vertices) const;
  double sketch(double of_vertices, double components) const;
};

/// Memory that is taken from a budget until this goes.
class MemoryShare {
 public:
  MemoryShare() = default;

  MemoryShare(std::atomic<double>* left, double bytes) : left_(left), bytes_(bytes) {}

  MemoryShare(MemoryShare&& other) noexcept : left_(other.left_), bytes_(other.bytes_) {
    other.left_ = nullptr;
  }

  MemoryShare& operator=(MemoryShare&& other) noexcept {
    std::swap(left_, other.left_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }

  ~MemoryShare() {
    if (left_)
      left_->fetch_add(bytes_);
  }

 private:
  std::atomic<double>* left_ = nullptr;
  double bytes_ = 0;
};

/// Bytes that stages may still take whose size the target decides. Safe for threads.
class MemoryBudget {
 public:
  explicit MemoryBudget(double bytes) : left_(bytes) {}

  /// Throws OverMemory naming the stage where less is left.
  MemoryShare take(double bytes, const std::string& stage);

 private:
  std::atomic<double> left_;
};

/// How many of the threads may work on an encoding, and what is left for stages whose size the target decides.
struct MemoryPlan {
  size_t threads;
  double left;
};

/// CodingOptions::most_bytes for what is encoded while so many other bytes are held.
uint64_t most_bytes_beside(double bytes, uint64_t most_bytes);

/// Throws OverMemory where even one thread, beside the bytes of others, would take more than options.most_bytes.
MemoryPlan plan_memory(const EncodingMemory& memory, const CodingOptions& options, size_t threads,
                       double others = 0);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PLAN_ENCODING_MEMORY_H_
