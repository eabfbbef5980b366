// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/words/progress_line.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

constexpr double kDelay = 1.0;     // seconds before anything is shown
constexpr double kInterval = 0.1;  // and between two updates

double machine_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string minutes(double seconds) {
  auto whole = static_cast<uint64_t>(std::ceil(std::min(seconds, 359999.0)));
  if (whole < 3600)
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet)
    : ProgressLine(!quiet && ::isatty(STDERR_FILENO) != 0 ? stderr : nullptr, machine_seconds) {}

ProgressLine::ProgressLine(std::FILE* terminal, Clock clock)
    : stream_(terminal), clock_(std::move(clock)), start_(clock_()) {
  last_shown_ = start_ + kDelay - kInterval;
}

ProgressLine::~ProgressLine() {
  clear();
}

void ProgressLine::show(std::string_view stage, double done) {
  if (!stream_)
    return;
  double now = clock_();
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
  }
  if (now - last_shown_ < kInterval)
    return;
  last_shown_ = now;
  visible_ = true;
  // Rounded down: nothing says 100 % while something is left.
  done = std::floor(100 * std::clamp(done, 0.0, 1.0) + 1e-9) / 100;
  std::string left;
  if (double spent = now - stage_start_; done > 0.01 && done < 1 && spent > 0.5)
    left = fmt::format(", {} left", minutes(spent * (1 - done) / done));
  // "\r" returns to the start of the line, "\033[K" clears what is right of the cursor.
  fmt::print(stream_, "\r{} {:3.0f} %{}\033[K", stage_, 100 * done, left);
  std::fflush(stream_);
}

void ProgressLine::clear() {
  if (!visible_)
    return;
  visible_ = false;
  std::fputs("\r\033[K", stream_);
  std::fflush(stream_);
}

Progress ProgressLine::callback() {
  if (!stream_)
    return {};
  return [this](std::string_view stage, double done) { show(stage, done); };
}

}  // namespace anicodec::tools
