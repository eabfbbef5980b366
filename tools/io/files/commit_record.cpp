// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/commit_record.h"

#include "tools/io/files/synchronize.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCommit = "commit";
constexpr const char* kBack = "back";

std::string file_in(const std::string& staging, const std::string& name) {
  return (fs::path(staging) / name).string();
}

std::string waiting(const std::string& staging, const Replacement& file) {
  return file_in(staging, std::to_string(file.number));
}

std::string kept(const std::string& staging, const Replacement& file) {
  return waiting(staging, file) + ".old";
}

std::string parent_of(const std::string& staging) {
  return fs::path(staging).parent_path().string();
}

std::string target(const std::string& staging, const Replacement& file) {
  return (fs::path(parent_of(staging)) / file.name).string();
}

/// Puts on disk the bytes of the record and all files that it names, then its name, then that of its folder.
void write_record(const std::string& staging, std::string_view bytes) {
  const std::string part = file_in(staging, "record");
  std::FILE* file = std::fopen(part.c_str(), "wb");
  if (!file)
    throw std::system_error(errno, std::generic_category());
  bool ok = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() &&
            std::fflush(file) == 0 && synchronize(::fileno(file));
  ok = std::fclose(file) == 0 && ok;
  if (!ok)
    throw std::system_error(errno, std::generic_category());
  synchronize_folder(staging);
  fs::rename(part, file_in(staging, kCommit));
  synchronize_folder(staging);
  synchronize_folder(parent_of(staging));
}

/// Takes the text up to the next zero byte; none at the end.
std::optional<std::string> take_field(std::string_view& text) {
  const size_t end = text.find('\0');
  if (end == std::string_view::npos)
    return std::nullopt;
  std::string field(text.substr(0, end));
  text.remove_prefix(end + 1);
  return field;
}

bool is_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

/// The files of a record; nothing where there is none or it is damaged.
std::vector<Replacement> read_record(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  std::vector<Replacement> out;
  for (std::string_view text = bytes; !text.empty();) {
    Replacement& one = out.emplace_back();
    const std::optional<std::string> number = take_field(text), name = take_field(text),
                                     before = take_field(text), after = take_field(text);
    if (!after || !is_name(*name))
      return {};
    const char* end = number->data() + number->size();
    const auto [last, error] = std::from_chars(number->data(), end, one.number);
    if (error != std::errc() || last != end)
      return {};
    one.name = *name;
    one.before = *before;
    one.after = *after;
  }
  return out;
}

bool is_waiting(const std::string& staging, const Replacement& file) {
  return !file.after.empty() && identity_of(waiting(staging, file)) == file.after;
}

}  // namespace

std::string identity_of(const std::string& path) {
  struct stat status;
  if (::lstat(path.c_str(), &status) != 0)
    return {};
  return std::to_string(status.st_ino) + " " + std::to_string(status.st_size) + " " +
         std::to_string(status.st_mtim.tv_sec) + "." + std::to_string(status.st_mtim.tv_nsec);
}

void write_commit_record(const std::string& staging, const std::vector<Replacement>& files) {
  std::string bytes;
  for (const Replacement& file : files) {
    for (const std::string& field :
         {std::to_string(file.number), file.name, file.before, file.after})
      bytes += field + '\0';
  }
  write_record(staging, bytes);
}

void turn_commit_record(const std::string& staging) {
  ::rename(file_in(staging, kCommit).c_str(), file_in(staging, kBack).c_str());
  synchronize_folder(staging);  // before the first file goes back
}

void remove_commit_record(const std::string& staging) {
  synchronize_folder(parent_of(staging));  // the new names, before the record goes
  ::unlink(file_in(staging, kCommit).c_str());
  ::unlink(file_in(staging, kBack).c_str());
}

void put_back(const std::string& staging, const std::vector<Replacement>& files) {
  for (const Replacement& file : files) {
    const std::string to = target(staging, file);
    if (identity_of(to) != file.after)
      continue;  // it was not renamed
    if (file.before.empty())
      ::rename(to.c_str(), waiting(staging, file).c_str());
    else
      ::rename(kept(staging, file).c_str(), to.c_str());
  }
}

bool finish_commit(const std::string& staging) {
  const std::vector<Replacement> replaced = read_record(file_in(staging, kBack));
  put_back(staging, replaced);
  std::vector<Replacement> files = read_record(file_in(staging, kCommit));
  std::erase_if(files, [&](const Replacement& file) { return !is_waiting(staging, file); });
  const bool changed = std::ranges::any_of(files, [&](const Replacement& file) {
    return identity_of(target(staging, file)) != file.before;
  });
  if (changed)
    return true;
  for (const Replacement& file : files) {
    if (::rename(waiting(staging, file).c_str(), target(staging, file).c_str()) != 0)
      return false;
  }
  if (!files.empty() || !replaced.empty())
    remove_commit_record(staging);
  return true;
}

std::vector<std::string> unfinished_names(const std::string& staging) {
  std::vector<std::string> names;
  for (const Replacement& file : read_record(file_in(staging, kCommit))) {
    if (is_waiting(staging, file) && identity_of(target(staging, file)) == file.before)
      names.push_back(file.name);
  }
  return names;
}

}  // namespace anicodec::tools
