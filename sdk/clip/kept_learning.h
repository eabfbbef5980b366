// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_KEPT_LEARNING_H_
#define ANICODEC_SDK_CLIP_KEPT_LEARNING_H_

#include "format/memory.h"
#include "sdk/segment/learnt_segment.h"

#include <cstdint>

namespace anicodec {

/// Keeps what the last segments of a live stream have learnt, by mesh, for the files that follow, whose segments continue them.
/// Lives in the memory that was current when the object was made. The segments that the file at hand continued stay, too, so that it
/// can be opened again.
class KeptLearning {
 public:
  KeptLearning() : memory_(MemoryScope::current()) {}

  Memory* memory() const { return memory_; }

  /// Finds what the segment of this identity has learnt; null when it is not kept. Valid until keep().
  const LearntSegment* find(uint16_t mesh, uint64_t identity);

  /// Returns what the last segment of a mesh has learnt; null when there is none.
  const LearntSegment* latest(uint16_t mesh) const;

  /// Takes what the last segments of a file have learnt, by mesh, made in memory().
  void keep(Vector<LearntSegment> learnt);

  void clear() {
    before_.clear();
    now_.clear();
  }

 private:
  Memory* memory_;
  Vector<LearntSegment> before_, now_;  ///< of the files before the one at hand; of all so far
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_KEPT_LEARNING_H_
