// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/cleanup.h"

#include <array>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstring>
#include <deque>
#include <mutex>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, SIGABRT};

/// The data that the handler reads.
struct Place {
  std::atomic<const char*> path{nullptr};  ///< null: the place is free
  std::atomic<int> folder{-1};
  std::atomic<uint32_t> count{0};
};

constexpr size_t kPlaces = 1024;
std::array<Place, kPlaces> g_places;
std::atomic<size_t> g_places_used{0};
std::atomic<int> g_holding{0};
std::atomic<int> g_waiting{0};
static_assert(std::atomic<const char*>::is_always_lock_free &&
              std::atomic<int>::is_always_lock_free);

struct Paths {
  std::mutex mutex;
  std::vector<size_t> free;
  // They stay in memory for good: the handler may be reading one while its place is given up.
  std::deque<std::string> all;
};

Paths& paths() {
  static auto* all = new Paths;  // outlives every static object that owns a file
  return *all;
}

/// Calls nothing but what a signal handler may.
void remove_file(int folder, uint32_t number) {
  char name[16] = {};
  char* end = std::to_chars(name, name + sizeof name, number).ptr;
  ::unlinkat(folder, name, 0);
  std::memcpy(end, ".old", 4);
  ::unlinkat(folder, name, 0);
}

void remove_all() {
  const size_t used = g_places_used.load();
  for (size_t i = 0; i < used; ++i) {
    const Place& place = g_places[i];
    const char* path = place.path.load();
    if (!path)
      continue;
    const uint32_t count = place.count.load();
    for (uint32_t n = 0; n < count; ++n)
      remove_file(place.folder.load(), n);
    ::rmdir(path);
  }
}

void die_of(int signal) {
  std::signal(signal, SIG_DFL);
  ::raise(signal);
}

void handle(int signal) {
  if (g_holding.load() > 0) {
    if (signal == SIGABRT)
      return die_of(signal);
    g_waiting.store(signal);
    return;
  }
  remove_all();
  die_of(signal);
}

}  // namespace

RemoveOnSignal::RemoveOnSignal(int folder, const std::string& path) : place_(kPlaces) {
  Paths& known = paths();
  const std::lock_guard lock(known.mutex);
  if (!known.free.empty()) {
    place_ = known.free.back();
    known.free.pop_back();
  } else if (g_places_used.load() < kPlaces) {
    place_ = g_places_used.fetch_add(1);
  } else {
    return;
  }
  Place& place = g_places[place_];
  place.folder.store(folder);
  place.count.store(0);
  place.path.store(known.all.emplace_back(path).c_str());
}

RemoveOnSignal::~RemoveOnSignal() {
  if (place_ == kPlaces)
    return;
  g_places[place_].path.store(nullptr);
  Paths& known = paths();
  const std::lock_guard lock(known.mutex);
  known.free.push_back(place_);
}

void RemoveOnSignal::set_count(uint32_t count) {
  if (place_ != kPlaces)
    g_places[place_].count.store(count);
}

HoldSignals::HoldSignals() {
  g_holding.fetch_add(1);
}

HoldSignals::~HoldSignals() {
  if (g_holding.fetch_sub(1) != 1)
    return;
  if (const int signal = g_waiting.exchange(0))
    handle(signal);
}

void install_cleanup_on_signal() {
  for (int signal : kSignals) {
    struct sigaction before;
    if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
      continue;
    struct sigaction action = {};
    action.sa_handler = handle;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace anicodec::tools
