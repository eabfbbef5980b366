// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/live_queue.h"

#include "codec/parallel/thread_count.h"
#include "codec/plan/encoding_memory.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace anicodec {
namespace {

/// Ends an encoding that nobody waits for.
struct Stopped {};

uint32_t frames_of(const LiveOptions& live, double rate) {
  constexpr double kMost = 1e5;
  const double frames = std::max(1.0, std::round(live.piece * rate));
  if (!(live.piece > 0 && frames <= kMost))
    throw Error(ErrorKind::kUsage,
                "a piece lasts more than 0 seconds, and has at most 100000 frames");
  if (!(live.key_every >= 0))
    throw Error(ErrorKind::kUsage, "the seconds between pieces that begin anew are not negative");
  if (live.most_waiting > 0 && static_cast<double>(live.most_waiting) < frames)
    throw Error(ErrorKind::kUsage, "the frames that may wait are fewer than those of a piece");
  return static_cast<uint32_t>(frames);
}

}  // namespace

LiveQueue::LiveQueue(MeshSequence mesh, const EncodeOptions& options, const LiveOptions& live)
    : mesh_(mesh),
      encoder_(std::move(mesh), options, live.key_every, live.box),
      live_(live),
      frames_of_piece_(frames_of(live, mesh_.rate.value())) {
  if (mesh_.vertex_count == 0)
    throw Error(ErrorKind::kInput, "the mesh has no vertex");
  for (Attribute& attribute : mesh_.attributes) {
    if (attribute.frames == 0)
      moving_.push_back(element_count(mesh_, attribute.domain) * attribute.components);
    attribute.values = {};
  }
  worker_ = std::thread([this] { run(); });
}

LiveQueue::~LiveQueue() {
  stop();
  worker_.join();
}

/// Waits until the condition holds or the encoding has ended with a fault; false where neither came in time.
template <class Condition>
bool LiveQueue::wait_for(std::unique_lock<std::mutex>& lock, double seconds,
                         const Condition& condition) {
  constexpr double kForever = 1e6;
  const auto holds = [&] { return fault_ || stopped_ || condition(); };
  if (!(seconds < kForever)) {
    changed_.wait(lock, holds);
    return true;
  }
  return changed_.wait_for(lock, std::chrono::duration<double>(std::max(seconds, 0.0)), holds);
}

void LiveQueue::check_frame(std::span<const float> positions,
                            std::span<const std::span<const float>> values) const {
  const auto refuse = [&](const std::string& text) {
    throw Error(ErrorKind::kInput, "frame " + std::to_string(state_.pushed_frames) + ": " + text);
  };
  const auto finite = [](float x) { return std::isfinite(x); };
  if (positions.size() != size_t{3} * mesh_.vertex_count)
    refuse("has " + std::to_string(positions.size()) + " coordinates of " +
           std::to_string(size_t{3} * mesh_.vertex_count));
  if (const auto bad = std::ranges::find_if_not(positions, finite); bad != positions.end())
    refuse("vertex " + std::to_string((bad - positions.begin()) / 3) +
           ": the position is not finite");
  if (values.size() != moving_.size())
    refuse("has values of " + std::to_string(values.size()) + " attributes of " +
           std::to_string(moving_.size()) + " that move");
  for (size_t i = 0; i < moving_.size(); ++i) {
    if (values[i].size() != moving_[i])
      refuse("attribute " + std::to_string(i) + " has " + std::to_string(values[i].size()) +
             " numbers of " + std::to_string(moving_[i]));
    if (!std::ranges::all_of(values[i], finite))
      refuse("attribute " + std::to_string(i) + ": a value is not finite");
  }
}

void LiveQueue::add_frame(std::span<const float> positions,
                          std::span<const std::span<const float>> values) {
  if (open_.count == 0) {
    open_.first = state_.pushed_frames;
    open_.values.resize(moving_.size());
    open_.positions.reserve(positions.size() * frames_of_piece_);
    for (size_t i = 0; i < moving_.size(); ++i)
      open_.values[i].reserve(moving_[i] * frames_of_piece_);
  }
  open_.positions.insert(open_.positions.end(), positions.begin(), positions.end());
  for (size_t i = 0; i < moving_.size(); ++i)
    open_.values[i].insert(open_.values[i].end(), values[i].begin(), values[i].end());
  ++open_.count;
  ++state_.pushed_frames;
  ++state_.waiting_frames;
}

void LiveQueue::close_piece() {
  if (open_.count > 0) {
    full_.emplace_back();
    state_.late_frames += open_.count;
    full_.back() = std::exchange(open_, {});
  }
  changed_.notify_all();
}

bool LiveQueue::push(std::span<const float> positions,
                     std::span<const std::span<const float>> values, double wait) {
  std::unique_lock lock(mutex_);
  check_frame(positions, values);
  if (no_more_)
    throw Error(ErrorKind::kUsage, "the stream has ended: no frame follows");
  const bool has_room = wait_for(lock, wait, [&] {
    return live_.most_waiting == 0 || state_.waiting_frames < live_.most_waiting;
  });
  if (fault_)
    std::rethrow_exception(fault_);
  if (stopped_)
    throw Error(ErrorKind::kUsage, "the stream was stopped");
  if (!has_room)
    return false;
  add_frame(positions, values);
  if (open_.count == frames_of_piece_)
    close_piece();
  return true;
}

void LiveQueue::end() {
  const std::lock_guard lock(mutex_);
  no_more_ = true;
  close_piece();
}

std::optional<QueuedPiece> LiveQueue::take(double wait) {
  std::unique_lock lock(mutex_);
  const auto is_over = [&] { return no_more_ && full_.empty() && !encoding_; };
  wait_for(lock, wait, [&] { return !pieces_.empty() || is_over(); });
  if (pieces_.empty()) {
    if (fault_)
      std::rethrow_exception(fault_);
    if (stopped_)
      throw Error(ErrorKind::kUsage, "the stream was stopped");
    return std::nullopt;
  }
  QueuedPiece piece = std::move(pieces_.front());
  pieces_.pop_front();
  return piece;
}

void LiveQueue::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

LiveState LiveQueue::state() const {
  const std::lock_guard lock(mutex_);
  LiveState state = state_;
  state.waiting_pieces = pieces_.size();
  state.ended = no_more_ && full_.empty() && !encoding_ && pieces_.empty();
  return state;
}

QueuedPiece LiveQueue::encode(Frames frames) {
  QueuedPiece piece;
  piece.first_frame = frames.first;
  piece.start_time = encoder_.mesh().start_time;
  const auto begin = std::chrono::steady_clock::now();
  const auto at = [&](const std::exception& e) {
    return "the frames from " + std::to_string(frames.first) + " on: " + e.what();
  };
  try {
    with_threads(live_.threads, [&] {
      static_cast<LivePiece&>(piece) = encoder_.encode(
          std::move(frames.positions), std::move(frames.values), [this](std::string_view, double) {
            const std::lock_guard lock(mutex_);
            if (stopped_)
              throw Stopped();
          });
    });
  } catch (const OverMemory& e) {
    throw OverMemory(at(e));
  } catch (const Error& e) {
    throw Error(e.kind(), at(e));
  }
  piece.encode_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return piece;
}

void LiveQueue::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return stopped_ || !full_.empty(); });
    if (stopped_)
      return;
    Frames frames = std::move(full_.front());
    full_.pop_front();
    const uint32_t count = frames.count;
    state_.late_frames -= count;
    encoding_ = true;
    lock.unlock();
    QueuedPiece piece;
    std::exception_ptr fault;
    try {
      piece = encode(std::move(frames));
    } catch (const Stopped&) {
      return;
    } catch (...) {
      fault = std::current_exception();
    }
    lock.lock();
    encoding_ = false;
    if (fault) {
      fault_ = fault;
      changed_.notify_all();
      return;
    }
    state_.encode_seconds = piece.encode_seconds;
    state_.waiting_frames -= count;
    try {
      pieces_.push_back(std::move(piece));
    } catch (...) {
      fault_ = std::current_exception();
    }
    changed_.notify_all();
    if (fault_)
      return;
  }
}

}  // namespace anicodec
