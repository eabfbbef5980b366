// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_SORT_H_
#define ANICODEC_FORMAT_SORT_H_

#include <algorithm>
#include <functional>

namespace anicodec {

/// Sorts first .. last - 1 ascending by `less`; equal elements come in any order. With ANICODEC_SMALL
/// by a heap, which takes a sixth of the code that std::sort() is for each type, and up to twice its
/// time. Cost: O(n log n), in the worst case too.
template <class Iterator, class Less = std::less<>>
void sort_ascending(Iterator first, Iterator last, Less less = {}) {
#ifdef ANICODEC_SMALL
  std::make_heap(first, last, less);
  std::sort_heap(first, last, less);
#else
  std::sort(first, last, less);
#endif
}

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_SORT_H_
