// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/heap_count.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <utility>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ANICODEC_HEAP_OF_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ANICODEC_HEAP_OF_SANITIZER
#endif
#endif

namespace anicodec {
namespace {

thread_local HeapCount* current = nullptr;
std::atomic<uint64_t> all_calls = 0;
std::atomic<uint64_t> first_failure = 0, last_failure = 0;  // numbers of calls; 0: none fails

[[maybe_unused]] bool fails() {
  const uint64_t call = ++all_calls;
  return call >= first_failure && call <= last_failure;
}

}  // namespace

HeapCount::HeapCount() {
  current = this;
}

HeapCount::~HeapCount() {
  current = nullptr;
}

void HeapCount::note(int64_t bytes) {
  if (!current)
    return;
  current->calls_ += bytes > 0;
  current->held_ += bytes;
  current->peak_ = std::max(current->peak_, current->held_);
}

HeapFailure::HeapFailure(uint64_t call, bool later_ones) {
  all_calls = 0;
  first_failure = call;
  last_failure = later_ones ? UINT64_MAX : call;
}

HeapFailure::~HeapFailure() {
  last_failure = 0;
}

uint64_t HeapFailure::calls() const {
  return all_calls;
}

HeapPause::HeapPause() : count_(std::exchange(current, nullptr)) {}

HeapPause::~HeapPause() {
  current = count_;
}

}  // namespace anicodec

using anicodec::HeapCount;

#if defined(ANICODEC_HEAP_OF_SANITIZER)

extern "C" {

size_t __sanitizer_get_allocated_size(const volatile void* memory);

/// Called by the sanitizer's heap; weak there.
void __sanitizer_malloc_hook(const volatile void*, size_t size) {
  HeapCount::note(static_cast<int64_t>(size));
}

void __sanitizer_free_hook(const volatile void* memory) {
  if (memory)
    HeapCount::note(-static_cast<int64_t>(__sanitizer_get_allocated_size(memory)));
}

}  // extern "C"

#elif defined(__GLIBC__)

// In place of those of the C library, which all others come to.
#include <malloc.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

extern "C" {

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* memory);

}  // extern "C"

namespace {

using anicodec::fails;

void* noted(void* memory) {
  if (memory)
    HeapCount::note(static_cast<int64_t>(malloc_usable_size(memory)));
  return memory;
}

void note_release(void* memory) {
  if (memory)
    HeapCount::note(-static_cast<int64_t>(malloc_usable_size(memory)));
}

}  // namespace

extern "C" {

void* malloc(size_t size) noexcept {
  return fails() ? nullptr : noted(__libc_malloc(size));
}

void* calloc(size_t count, size_t size) noexcept {
  return fails() ? nullptr : noted(__libc_calloc(count, size));
}

void* realloc(void* memory, size_t size) noexcept {
  if (fails())
    return nullptr;
  note_release(memory);
  return noted(__libc_realloc(memory, size));
}

void* memalign(size_t alignment, size_t size) noexcept {
  return fails() ? nullptr : noted(__libc_memalign(alignment, size));
}

void* aligned_alloc(size_t alignment, size_t size) noexcept {
  return fails() ? nullptr : noted(__libc_memalign(alignment, size));
}

int posix_memalign(void** out, size_t alignment, size_t size) noexcept {
  *out = fails() ? nullptr : noted(__libc_memalign(alignment, size));
  return *out ? 0 : ENOMEM;
}

void free(void* memory) noexcept {
  note_release(memory);
  __libc_free(memory);
}

// Only calls of the program come here: the heap maps its own by other names.
void* mmap(void* address, size_t size, int protection, int flags, int file, off_t offset) noexcept {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): so the system gives it
  void* const block =
      reinterpret_cast<void*>(::syscall(SYS_mmap, address, size, protection, flags, file, offset));
  if (block != MAP_FAILED)
    HeapCount::note(static_cast<int64_t>(size));
  return block;
}

int munmap(void* address, size_t size) noexcept {
  HeapCount::note(-static_cast<int64_t>(size));
  return static_cast<int>(::syscall(SYS_munmap, address, size));
}

}  // extern "C"

#endif
