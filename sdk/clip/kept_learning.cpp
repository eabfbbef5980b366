// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/kept_learning.h"

#include <algorithm>
#include <utility>

namespace anicodec {

const LearntSegment* KeptLearning::find(uint16_t mesh, uint64_t identity) {
  const MemoryScope scope(memory_);
  if (mesh >= now_.size())
    return nullptr;
  if (now_[mesh].identity == identity) {
    before_[mesh] = LearntSegment();  // nothing before it is asked for any more
    return &now_[mesh];
  }
  return before_[mesh].identity == identity ? &before_[mesh] : nullptr;
}

const LearntSegment* KeptLearning::latest(uint16_t mesh) const {
  return mesh < now_.size() && now_[mesh].identity != 0 ? &now_[mesh] : nullptr;
}

void KeptLearning::keep(Vector<LearntSegment> learnt) {
  const MemoryScope scope(memory_);
  if (std::none_of(learnt.begin(), learnt.end(),
                   [](const LearntSegment& s) { return s.identity != 0; }))
    return;
  if (learnt.size() != now_.size()) {
    before_ = Vector<LearntSegment>(learnt.size());
    now_ = Vector<LearntSegment>(learnt.size());
  }
  for (size_t m = 0; m < learnt.size(); ++m) {
    if (learnt[m].identity == 0 || learnt[m].identity == now_[m].identity)
      continue;
    before_[m] = std::move(now_[m]);
    now_[m] = std::move(learnt[m]);
  }
}

}  // namespace anicodec
