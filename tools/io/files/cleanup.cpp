// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/cleanup.h"

#include <atomic>
#include <csignal>
#include <deque>
#include <mutex>
#include <vector>

#include <unistd.h>

namespace anicodec::tools {
namespace {

constexpr size_t kPlaces = 65536;

// What the handler reads. A path stays in memory for good: the handler may be reading it in another
// thread while its place is given up.
std::atomic<const char*> g_paths[kPlaces];
std::atomic<size_t> g_places_used{0};
static_assert(std::atomic<const char*>::is_always_lock_free);

struct Places {
  std::mutex mutex;
  std::vector<size_t> free;
  std::deque<std::string> paths;
};

Places& places() {
  static auto* all = new Places;  // outlives every static object that owns a file
  return *all;
}

void remove_files_and_die(int signal) {
  size_t used = g_places_used.load();
  for (size_t i = 0; i < used; ++i) {
    if (const char* path = g_paths[i].load())
      ::unlink(path);
  }
  // SA_RESETHAND has restored the default action; it is taken when this handler returns.
  ::raise(signal);
}

}  // namespace

RemoveOnSignal::RemoveOnSignal(const std::string& path) : place_(kPlaces) {
  Places& all = places();
  std::lock_guard lock(all.mutex);
  if (!all.free.empty()) {
    place_ = all.free.back();
    all.free.pop_back();
  } else if (g_places_used.load() < kPlaces) {
    place_ = g_places_used.fetch_add(1);
  } else {
    return;
  }
  g_paths[place_].store(all.paths.emplace_back(path).c_str());
}

RemoveOnSignal::~RemoveOnSignal() {
  if (place_ == kPlaces)
    return;
  g_paths[place_].store(nullptr);
  Places& all = places();
  std::lock_guard lock(all.mutex);
  all.free.push_back(place_);
}

void install_cleanup_on_signal() {
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before;
    if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
      continue;
    struct sigaction action = {};
    action.sa_handler = remove_files_and_die;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace anicodec::tools
