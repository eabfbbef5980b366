// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/atomic_file.h"

#include "codec/sequence/error.h"
#include "tools/io/base/mesh.h"
#include "tools/io/files/commit_record.h"
#include "tools/io/files/synchronize.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

constexpr size_t kBufferSize = size_t{1} << 18;

/// Renames only if nothing has the name yet; false if something has.
bool rename_new(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0)
    return true;
  if (errno == EEXIST)
    return false;
  if (errno != EINVAL && errno != ENOSYS)
    throw std::system_error(errno, std::generic_category());
  // A file system that cannot check and rename in one step.
  if (fs::exists(fs::symlink_status(to)))
    return false;
  fs::rename(from, to);
  return true;
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
  } else if (error == std::errc::filename_too_long) {
    throw Error(ErrorKind::kInput, path + ": the name is too long");
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
  folder_ = std::make_unique<OutputFolder>(target_);
  try {
    staging_ = Staging::in(fs::path(target_).parent_path().string());
  } catch (const std::system_error& e) {
    fail_usage(path, "cannot be created: " + e.code().message());
  }
  number_ = staging_->take_number();
  temporary_ = staging_->file(number_);
  const int number = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (number < 0)
    fail_usage(path, "cannot be created: " + std::string(std::strerror(errno)));
  file_ = std::make_unique<Descriptor>(number);
  keep_mode();
}

AtomicFile::AtomicFile(AtomicFile&&) noexcept = default;

AtomicFile::~AtomicFile() {
  if (staging_ && !temporary_.empty())
    ::unlink(temporary_.c_str());
}

void AtomicFile::keep_mode() {
  struct stat old;
  if (::stat(target_.c_str(), &old) != 0)
    return;
  constexpr mode_t kPermissions = 0777;
  // Who may not give files away owns the new one.
  [[maybe_unused]] const int ignored = ::fchown(file_->number, old.st_uid, old.st_gid);
  ::fchmod(file_->number, old.st_mode & kPermissions);
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

void AtomicFile::rewrite(uint64_t offset, std::string_view bytes) {
  write_all(buffer_);
  buffer_.clear();
  while (!bytes.empty()) {
    const ssize_t n =
        ::pwrite(file_->number, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno != EINTR)
      fail_writing();
    if (n > 0) {
      bytes.remove_prefix(static_cast<size_t>(n));
      offset += static_cast<uint64_t>(n);
    }
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
  // A name must never lead to bytes that the disk does not have.
  if (!synchronize(file_->number))
    fail_writing();
  // Some file systems report a full disk only now.
  int number = file_->number;
  file_->number = -1;
  if (::close(number) != 0)
    fail_writing();
  file_.reset();
}

void AtomicFile::place() {
  try {
    if (overwrite_)
      fs::rename(temporary_, target_);
    else if (!rename_new(temporary_, target_))
      fail_usage(path_, "the file exists already");
  } catch (const std::system_error& e) {
    throw Error(ErrorKind::kInternal, path_ + ": cannot be replaced: " + e.code().message());
  }
}

void AtomicFile::commit() {
  close();
  const HoldSignals hold;
  place();
  temporary_.clear();
  synchronize_folder(fs::path(target_).parent_path().string());
}

/// Describes what place() will do, and sees to it that it can be undone.
void AtomicFile::keep_old(Replacement& replacement) const {
  replacement.number = number_;
  replacement.name = fs::path(target_).filename().string();
  replacement.before = identity_of(target_);
  replacement.after = identity_of(temporary_);
  if (replacement.before.empty())
    return;
  if (!overwrite_)
    fail_usage(path_, "the file exists already");
  const std::string kept = temporary_ + ".old";
  if (::link(target_.c_str(), kept.c_str()) == 0)
    return;
  try {
    fs::copy_file(target_, kept);
  } catch (const std::system_error& e) {
    throw Error(ErrorKind::kInternal, path_ + ": cannot be kept aside: " + e.code().message());
  }
}

/// Several files on their way to their names.
class CommitAll {
 public:
  explicit CommitAll(std::vector<AtomicFile>& files) : files_(files) {
    for (AtomicFile& file : files_)
      file.close();
    for (const AtomicFile& file : files_)
      file.keep_old(records_[file.staging_.get()].emplace_back());
  }

  void run() {
    const HoldSignals hold;
    try {
      for (const auto& [staging, files] : records_)
        write_commit_record(staging->path(), files);
      for (AtomicFile& file : files_)
        file.place();
    } catch (const std::system_error& e) {
      put_all_back();
      throw Error(ErrorKind::kInternal, files_[0].path() + ": " + e.code().message());
    } catch (...) {
      put_all_back();
      throw;
    }
    for (const auto& [staging, files] : records_)
      remove_commit_record(staging->path());
    for (AtomicFile& file : files_)
      file.temporary_.clear();
  }

  ~CommitAll() {
    for (const auto& [staging, files] : records_) {
      for (const Replacement& file : files)
        ::unlink((staging->file(file.number) + ".old").c_str());
    }
  }

  CommitAll(const CommitAll&) = delete;
  CommitAll& operator=(const CommitAll&) = delete;

 private:
  void put_all_back() {
    for (const auto& [staging, files] : records_)
      turn_commit_record(staging->path());
    for (const auto& [staging, files] : records_) {
      put_back(staging->path(), files);
      remove_commit_record(staging->path());
    }
  }

  std::vector<AtomicFile>& files_;
  std::map<Staging*, std::vector<Replacement>> records_;
};

void commit_all(std::vector<AtomicFile>& files) {
  if (files.size() == 1)
    return files[0].commit();
  CommitAll(files).run();
}

}  // namespace anicodec::tools
