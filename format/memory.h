// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Containers whose memory comes from the host that called.
#ifndef ANICODEC_FORMAT_MEMORY_H_
#define ANICODEC_FORMAT_MEMORY_H_

#include <cstddef>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

namespace anicodec {

/// A source of memory, and how much of it is held.
struct Memory {
  void* user = nullptr;
  void* (*allocate)(void* user, size_t size, size_t alignment) = nullptr;
  void (*release)(void* user, void* memory, size_t size) = nullptr;
  size_t held = 0;  ///< bytes
  size_t peak = 0;  ///< the most that was ever held

  /// Throws std::bad_alloc when there is none. size > 0.
  void* take(size_t size, size_t alignment);
  void give_back(void* memory, size_t size);
};

/// For its lifetime, containers that this thread constructs take their memory from `memory`, which
/// must outlive them; null: from operator new.
class MemoryScope {
 public:
  explicit MemoryScope(Memory* memory) : before_(current_) { current_ = memory; }

  ~MemoryScope() { current_ = before_; }

  MemoryScope(const MemoryScope&) = delete;
  MemoryScope& operator=(const MemoryScope&) = delete;

  static Memory* current() { return current_; }

 private:
  static inline thread_local Memory* current_ = nullptr;
  Memory* before_;
};

/// Allocates from the memory that was current when it, and so its container, was constructed.
template <class T>
class HostAllocator {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_copy_assignment = std::false_type;
  using propagate_on_container_swap = std::true_type;
  using is_always_equal = std::false_type;

  HostAllocator() noexcept : memory_(MemoryScope::current()) {}

  template <class U>
  HostAllocator(const HostAllocator<U>& other) noexcept  // NOLINT: implicit as the standard wants
      : memory_(other.memory()) {}

  HostAllocator select_on_container_copy_construction() const { return {}; }

  T* allocate(size_t count) {
    if (count > static_cast<size_t>(-1) / 2 / sizeof(T))
      return no_memory();
    size_t size = count * sizeof(T);
    if (memory_)
      return static_cast<T*>(memory_->take(size, alignof(T)));
    if constexpr (kOverAligned)
      return static_cast<T*>(::operator new (size, std::align_val_t{alignof(T)}));
    else
      return static_cast<T*>(::operator new(size));
  }

  void deallocate(T* memory, size_t count) noexcept {
    if (memory_)
      memory_->give_back(memory, count * sizeof(T));
    else if constexpr (kOverAligned)
      ::operator delete (memory, std::align_val_t{alignof(T)});
    else
      ::operator delete(memory);
  }

  Memory* memory() const { return memory_; }

  template <class U>
  bool operator==(const HostAllocator<U>& other) const {
    return memory_ == other.memory();
  }

  template <class U>
  bool operator!=(const HostAllocator<U>& other) const {
    return memory_ != other.memory();
  }

 private:
  static_assert(alignof(T) <= 16, "a host's allocator need not align it");

  /// On WebAssembly and 32-bit machines plain operator new aligns to 8 bytes.
  static constexpr bool kOverAligned = alignof(T) > __STDCPP_DEFAULT_NEW_ALIGNMENT__;

  static T* no_memory();

  Memory* memory_;
};

[[noreturn]] void throw_bad_alloc();

template <class T>
T* HostAllocator<T>::no_memory() {
  throw_bad_alloc();
}

template <class T>
using Vector = std::vector<T, HostAllocator<T>>;

using String = std::basic_string<char, std::char_traits<char>, HostAllocator<char>>;

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_MEMORY_H_
