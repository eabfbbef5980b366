// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_FRAME_ARRAY_H_
#define ANICODEC_CODEC_SEQUENCE_FRAME_ARRAY_H_

#include <cstddef>
#include <cstdint>
#include <vector>

namespace anicodec {

/// Sets the memory that this process is to take, half of the machine's until then: a third of it is for
/// frames. Arrays that would go beyond lie in files without a name, in TMPDIR or /var/tmp, whose
/// pages the system brings and takes away; they vanish with the process, however it ends.
/// Arrays that exist stay where they are.
void set_memory_for_frames(uint64_t bytes_of_run);

/// Bytes of frames that lie in files now.
uint64_t frame_bytes_on_disk();

namespace detail {

/// Throws Error(kInternal) naming folder, bytes and reason where a file finds no room, std::bad_alloc
/// where there is no memory.
void* allocate_frames(size_t bytes);
void free_frames(void* block, size_t bytes) noexcept;

}  // namespace detail

/// Allocates from memory or from files, as set_memory_for_frames() has it.
template <class T>
struct FrameAllocator {
  using value_type = T;

  FrameAllocator() = default;

  template <class U>
  FrameAllocator(const FrameAllocator<U>&) {}  // NOLINT(google-explicit-constructor)

  T* allocate(size_t count) { return static_cast<T*>(detail::allocate_frames(count * sizeof(T))); }

  void deallocate(T* block, size_t count) noexcept {
    detail::free_frames(block, count * sizeof(T));
  }

  bool operator==(const FrameAllocator&) const = default;
};

/// Values of many frames, one frame after the other, which may be more than the memory holds: read
/// and write them from frame to frame, or some vertices of all frames at a time.
using FrameArray = std::vector<float, FrameAllocator<float>>;

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_FRAME_ARRAY_H_
