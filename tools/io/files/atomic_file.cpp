// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/atomic_file.h"

#include "codec/sequence/error.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

constexpr size_t kBufferSize = size_t{1} << 18;

[[noreturn]] void fail_usage(const std::string& path, const std::string& text) {
  throw Error(ErrorKind::kUsage, path + ": " + text);
}

/// A name in the same folder, so that the rename stays within one file system.
std::string temporary_name(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  std::string name =
      ".anicodec-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp";
  return (target.parent_path() / name).string();
}

}  // namespace

void check_output(const std::string& path, bool overwrite) {
  std::error_code error;
  fs::file_status status = fs::status(path, error);
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status))
      fail_usage(path, fs::is_directory(status) ? "is a directory" : "is not a regular file");
    if (!overwrite)
      fail_usage(path, "the file exists already");
  } else if (fs::is_symlink(fs::symlink_status(path, error))) {
    fail_usage(path, "is a symbolic link to nothing");
  }
}

struct AtomicFile::Descriptor {
  explicit Descriptor(int n) : number(n) {}

  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  ~Descriptor() {
    if (number >= 0)
      ::close(number);
  }

  int number;
};

AtomicFile::AtomicFile(const std::string& path, bool overwrite)
    : path_(path), target_(path), overwrite_(overwrite) {
  check_output(path, overwrite);
  if (std::error_code error; fs::exists(path, error))
    target_ = fs::canonical(path).string();
  int number = -1;
  do {
    temporary_ = temporary_name(target_);
    // Registered first: a signal must not come between.
    remove_on_signal_ = std::make_unique<RemoveOnSignal>(temporary_);
    number = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (number < 0 && errno == EEXIST);
  if (number < 0)
    fail_usage(path, "cannot be created: " + std::string(std::strerror(errno)));
  file_ = std::make_unique<Descriptor>(number);
}

AtomicFile::AtomicFile(AtomicFile&&) noexcept = default;

AtomicFile::~AtomicFile() {
  if (remove_on_signal_)
    ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > kBufferSize) {
    write_all(buffer_);
    buffer_.clear();
  }
  if (bytes.size() > kBufferSize)
    write_all(bytes);
  else
    buffer_ += bytes;
}

void AtomicFile::write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    ssize_t n = ::write(file_->number, bytes.data(), bytes.size());
    if (n < 0 && errno != EINTR)
      fail_writing();
    if (n > 0)
      bytes.remove_prefix(static_cast<size_t>(n));
  }
}

void AtomicFile::fail_writing() const {
  throw Error(ErrorKind::kInternal, path_ + ": cannot be written: " + std::strerror(errno));
}

void AtomicFile::close() {
  if (!file_)
    return;
  write_all(buffer_);
  std::string().swap(buffer_);
  // Some file systems report a full disk only now.
  int number = file_->number;
  file_->number = -1;
  if (::close(number) != 0)
    fail_writing();
  file_.reset();
}

void AtomicFile::commit() {
  close();
  std::error_code error;
  if (!overwrite_ && fs::exists(fs::symlink_status(target_, error)))
    fail_usage(path_, "the file exists already");
  if (::rename(temporary_.c_str(), target_.c_str()) != 0)
    fail_writing();
  remove_on_signal_.reset();
}

void AtomicFile::undo() {
  if (!remove_on_signal_)
    ::unlink(target_.c_str());
}

void commit_all(std::vector<AtomicFile>& files) {
  for (AtomicFile& file : files)
    file.close();
  size_t done = 0;
  try {
    for (; done < files.size(); ++done)
      files[done].commit();
  } catch (...) {
    for (size_t i = 0; i < done; ++i)
      files[i].undo();
    throw;
  }
}

}  // namespace anicodec::tools
