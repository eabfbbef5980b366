// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/frame_array.h"

#include <atomic>
#include <new>

#ifdef __linux__
#include "codec/sequence/error.h"
#include "codec/sequence/machine_memory.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace anicodec {
namespace {

std::atomic<uint64_t> on_disk{0};

#ifdef __linux__

// Smaller blocks are never counted: they come and go often, and a mapping costs some microseconds.
constexpr size_t kSmall = size_t{1} << 20;

// Part of the memory: an encoder takes about twice the frames beside them.
constexpr uint64_t kShare = 3;

std::atomic<uint64_t> frame_limit{half_of_machine() / kShare}, in_memory{0};

/// Counts a block as one in memory, if there is room.
bool takes_memory(uint64_t bytes) {
  const uint64_t most = frame_limit;
  uint64_t taken = in_memory;
  do {
    if (taken > most || bytes > most - taken)
      return false;
  } while (!in_memory.compare_exchange_weak(taken, taken + bytes));
  return true;
}

/// An open file that is closed with the object: a mapping of it stays.
class ScratchFile {
 public:
  explicit ScratchFile(size_t bytes) {
    const char* set = std::getenv("TMPDIR");
    folder_ = set && *set ? set : "/var/tmp";
    file_ = ::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file_ < 0 && (errno == EOPNOTSUPP || errno == EISDIR)) {
      std::string name = folder_ + "/anicodec-XXXXXX";
      file_ = ::mkostemp(name.data(), O_CLOEXEC);
      if (file_ >= 0)
        ::unlink(name.c_str());
    }
    if (file_ < 0)
      fail(bytes, errno);
    // Room for all of it now: a page that finds none later is the end of the process.
    if (const int reason = ::posix_fallocate(file_, 0, static_cast<off_t>(bytes)); reason != 0) {
      ::close(file_);
      fail(bytes, reason);
    }
  }

  ~ScratchFile() { ::close(file_); }

  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  int descriptor() const { return file_; }

  [[noreturn]] void fail(size_t bytes, int reason) const {
    throw Error(ErrorKind::kInternal,
                folder_ + ": " + std::to_string(bytes) +
                    " bytes of frames, more than the memory is to hold, find no place: " +
                    std::generic_category().message(reason));
  }

 private:
  std::string folder_;
  int file_ = -1;
};

// The start of a block that is mapped tells where it lies, for who frees it knows its size alone.
struct alignas(64) Header {
  bool on_disk;
};

}  // namespace

void set_memory_for_frames(uint64_t bytes_of_run) {
  frame_limit = bytes_of_run / kShare;
}

void* detail::allocate_frames(size_t bytes) {
  if (bytes < kSmall)
    return ::operator new(bytes);
  if (bytes > PTRDIFF_MAX - sizeof(Header))
    throw std::bad_alloc();
  const size_t whole = bytes + sizeof(Header);
  constexpr int kAccess = PROT_READ | PROT_WRITE;
  const bool memory = takes_memory(bytes);
  void* block = MAP_FAILED;
  if (memory) {
    block = ::mmap(nullptr, whole, kAccess, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (block == MAP_FAILED)
      in_memory -= bytes;
  } else {
    const ScratchFile file(whole);
    block = ::mmap(nullptr, whole, kAccess, MAP_SHARED, file.descriptor(), 0);
    if (block != MAP_FAILED)
      on_disk += bytes;
  }
  if (block == MAP_FAILED)
    throw std::bad_alloc();
  static_cast<Header*>(block)->on_disk = !memory;
  return static_cast<Header*>(block) + 1;
}

void detail::free_frames(void* block, size_t bytes) noexcept {
  if (bytes < kSmall) {
    ::operator delete(block);
    return;
  }
  Header* header = static_cast<Header*>(block) - 1;
  (header->on_disk ? on_disk : in_memory) -= bytes;
  ::munmap(header, bytes + sizeof(Header));
}

#else  // other systems keep all frames in memory

}  // namespace

void set_memory_for_frames(uint64_t) {}

void* detail::allocate_frames(size_t bytes) {
  return ::operator new(bytes);
}

void detail::free_frames(void* block, size_t) noexcept {
  ::operator delete(block);
}

#endif

uint64_t frame_bytes_on_disk() {
  return on_disk;
}

}  // namespace anicodec
