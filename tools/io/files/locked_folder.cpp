// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/locked_folder.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRandom = "XXXXXX";
constexpr int kOpenFolder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

/// Whether the folder that is open is the one that has the name now.
bool is_at(int descriptor, const std::string& path) {
  struct stat open, named;
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

bool is_own(int descriptor) {
  struct stat status;
  return ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid();
}

void remove_folder(const std::string& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

/// Another run may have removed the folder before it was locked; then there is none.
int make_and_lock(std::string& path) {
  if (::mkdtemp(path.data()) == nullptr)
    throw std::system_error(errno, std::generic_category());
  const int descriptor = ::open(path.c_str(), kOpenFolder);
  if (descriptor < 0)
    return -1;
  // File systems without locks do without: nothing is removed from them either.
  const bool taken = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!taken && is_at(descriptor, path))
    return descriptor;
  ::close(descriptor);
  return -1;
}

void remove_if_abandoned(const std::string& path,
                         const std::function<bool(const std::string& path)>& finish) {
  const int descriptor = ::open(path.c_str(), kOpenFolder);
  if (descriptor < 0)
    return;
  if (is_own(descriptor) && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 &&
      is_at(descriptor, path) && (!finish || finish(path)))
    remove_folder(path);
  ::close(descriptor);
}

}  // namespace

LockedFolder::LockedFolder(const std::string& parent, const std::string& prefix) {
  while (descriptor_ < 0) {
    path_ = (fs::path(parent) / (prefix + std::string(kRandom))).string();
    descriptor_ = make_and_lock(path_);
  }
}

LockedFolder::~LockedFolder() {
  remove_folder(path_);
  ::close(descriptor_);
}

void remove_abandoned_folders(const std::string& parent, const std::string& prefix,
                              const std::function<bool(const std::string& path)>& finish) {
  std::error_code error;
  std::vector<std::string> found;
  for (fs::directory_iterator entry(parent.empty() ? "." : parent, error), end;
       !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(prefix) && name.size() == prefix.size() + kRandom.size())
      found.push_back(entry->path().string());
  }
  for (const std::string& path : found)
    remove_if_abandoned(path, finish);
}

}  // namespace anicodec::tools
