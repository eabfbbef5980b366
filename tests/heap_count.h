// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Counts the global heap: what a library takes from operator new, malloc() and mmap(), wherever it does so.
// Programs that use it are linked with heap_count.cpp.
#ifndef ANICODEC_TESTS_HEAP_COUNT_H_
#define ANICODEC_TESTS_HEAP_COUNT_H_

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// While it lives, counts what this thread takes from the heap and gives back to it. One at a time.
class HeapCount {
 public:
  HeapCount();
  ~HeapCount();
  HeapCount(const HeapCount&) = delete;
  HeapCount& operator=(const HeapCount&) = delete;

  /// The most bytes that were held at a time; as asked for under sanitizers, else as given.
  size_t peak() const { return peak_ > 0 ? static_cast<size_t>(peak_) : 0; }

  /// Bytes held now.
  int64_t held() const { return held_; }

  uint64_t calls() const { return calls_; }

  /// From memory taken (positive) or given back; called by the heap.
  static void note(int64_t bytes);

 private:
  friend class HeapPause;
  int64_t held_ = 0, peak_ = 0;
  uint64_t calls_ = 0;
};

/// While it lives, nothing counts: what a host's own allocator does.
class HeapPause {
 public:
  HeapPause();
  ~HeapPause();
  HeapPause(const HeapPause&) = delete;
  HeapPause& operator=(const HeapPause&) = delete;

 private:
  HeapCount* count_;
};

/// While it lives, counts what all threads take from the heap, and lets that fail: the call of this number, or it and
/// all later ones. Nothing fails under sanitizers.
class HeapFailure {
 public:
  explicit HeapFailure(uint64_t call, bool later_ones = false);
  ~HeapFailure();
  HeapFailure(const HeapFailure&) = delete;
  HeapFailure& operator=(const HeapFailure&) = delete;

  /// How often memory was asked for.
  uint64_t calls() const;
};

}  // namespace anicodec

#endif  // ANICODEC_TESTS_HEAP_COUNT_H_
