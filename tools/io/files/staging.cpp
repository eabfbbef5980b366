// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/staging.h"

#include "tools/io/files/commit_record.h"

#include <filesystem>
#include <map>
#include <mutex>

namespace anicodec::tools {
namespace {

constexpr const char* kPrefix = ".anicodec-stage-";

std::string named(const std::string& folder) {
  return folder.empty() ? "." : folder;
}

struct Known {
  std::mutex mutex;
  std::map<std::string, std::weak_ptr<Staging>> folders;  ///< an entry for each that was recovered
};

Known& known() {
  static auto* all = new Known;
  return *all;
}

}  // namespace

Staging::Staging(const std::string& folder)
    : folder_(folder, kPrefix), remove_on_signal_(folder_.descriptor(), folder_.path()) {}

std::shared_ptr<Staging> Staging::in(const std::string& folder) {
  const std::string name = named(folder);
  Known& all = known();
  const std::lock_guard lock(all.mutex);
  const auto [place, is_new] = all.folders.try_emplace(name);
  if (is_new)
    recover_folder(name);
  std::shared_ptr<Staging> staging = place->second.lock();
  if (!staging) {
    // A signal between making the folder and noting it, or the reverse, would leave it behind.
    const HoldSignals hold;
    staging.reset(new Staging(name), [](Staging* unused) {
      const HoldSignals hold_too;
      delete unused;
    });
    place->second = staging;
  }
  return staging;
}

uint32_t Staging::take_number() {
  const uint32_t number = count_.fetch_add(1);
  remove_on_signal_.set_count(number + 1);
  return number;
}

std::vector<std::string> recover_folder(const std::string& folder) {
  std::vector<std::string> pending;
  remove_abandoned_folders(named(folder), kPrefix, [&pending](const std::string& staging) {
    const bool done = finish_commit(staging);
    if (!done) {
      const std::vector<std::string> names = unfinished_names(staging);
      pending.insert(pending.end(), names.begin(), names.end());
    }
    return done;
  });
  return pending;
}

}  // namespace anicodec::tools
