// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/byte_source.h"

#include "tools/io/base/mesh.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

class Descriptor {
 public:
  explicit Descriptor(const std::string& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    struct stat status;
    if (number_ < 0 || ::fstat(number_, &status) != 0)
      fail(path, std::strerror(errno));
    if (S_ISDIR(status.st_mode))
      fail(path, "is a directory, not a file");
    if (!S_ISREG(status.st_mode))
      fail(path, "is not a regular file");
    size_ = static_cast<uint64_t>(status.st_size);
  }

  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  ~Descriptor() { close(); }

  uint64_t size() const { return size_; }

  void read(const std::string& path, uint64_t offset, std::span<char> bytes) const {
    size_t done = 0;
    while (done < bytes.size()) {
      ssize_t n = ::pread(number_, bytes.data() + done, bytes.size() - done,
                          static_cast<off_t>(offset + done));
      if (n < 0 && errno == EINTR)
        continue;
      if (n < 0)
        fail_input(path, std::strerror(errno));
      if (n == 0)
        fail_input(path, "the file became shorter while it was read");
      done += static_cast<size_t>(n);
    }
  }

 private:
  // The destructor does not run when the constructor throws.
  [[noreturn]] void fail(const std::string& path, const std::string& text) {
    close();
    fail_input(path, text);
  }

  void close() {
    if (number_ >= 0)
      ::close(number_);
    number_ = -1;
  }

  int number_;
  uint64_t size_ = 0;
};

}  // namespace

ByteSource memory_source(std::string_view bytes, std::string name) {
  return {std::move(name), bytes.size(), [bytes](uint64_t offset, std::span<char> out) {
            std::copy_n(bytes.data() + offset, out.size(), out.data());
          }};
}

ByteSource file_source(const std::string& path) {
  auto file = std::make_shared<const Descriptor>(path);
  return {path, file->size(),
          [file, path](uint64_t offset, std::span<char> out) { file->read(path, offset, out); }};
}

void read_file(const std::string& path, std::string& bytes) {
  Descriptor file(path);
  bytes.resize(file.size());
  file.read(path, 0, bytes);
}

void read_standard_input(std::string& bytes) {
  constexpr size_t kPiece = size_t{1} << 20;
  bytes.clear();
  for (size_t done = 0;;) {
    bytes.resize(done + kPiece);
    const ssize_t n = ::read(STDIN_FILENO, bytes.data() + done, kPiece);
    if (n < 0 && errno != EINTR)
      fail_input("-", std::strerror(errno));
    if (n == 0) {
      bytes.resize(done);
      return;
    }
    done += n > 0 ? static_cast<size_t>(n) : 0;
  }
}

}  // namespace anicodec::tools
