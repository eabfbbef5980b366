// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_WORDS_PROGRESS_LINE_H_
#define ANICODEC_TOOLS_WORDS_PROGRESS_LINE_H_

#include "codec/sequence/progress.h"

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// Shows stage, per cent and time left on one line of a terminal, once the work has lasted a
/// second; removes the line at the end. Silent when the stream is no terminal.
class ProgressLine {
 public:
  /// Seconds from any fixed time on.
  using Clock = std::function<double()>;

  /// On stderr with the machine's clock; `quiet` silences it.
  explicit ProgressLine(bool quiet);

  /// For tests: any stream, taken for a terminal, and any clock.
  ProgressLine(std::FILE* terminal, Clock clock);

  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  void show(std::string_view stage, double done);

  /// Removes the line, so that something else can be printed.
  void clear();

  /// To be called by long computations; empty when nothing will be shown.
  Progress callback();

 private:
  std::FILE* stream_;  // null when silent
  Clock clock_;
  double start_ = 0;
  double stage_start_ = 0;
  double last_shown_ = 0;
  bool visible_ = false;
  std::string stage_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_PROGRESS_LINE_H_
