// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GUARD_GUARDED_CALL_H_
#define ANICODEC_TOOLS_IO_GUARD_GUARDED_CALL_H_

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// The limits of a child process.
struct GuardLimits {
  uint64_t memory = uint64_t{1} << 36;  ///< bytes beyond what this process has
  uint32_t seconds = 60;                ///< of processor time

  /// Limits for reading so many bytes: half a minute, and a second for each megabyte.
  static GuardLimits for_input(uint64_t bytes, uint64_t memory);
};

/// Runs `work` in a child process (fork) and gives what it returns. Errors of the work are thrown
/// here as they are; a crash, too much memory or time become an Error(kInput) "name: reason". The
/// work must not depend on other threads, nor on open files, and cannot write any. Costs a
/// millisecond or two.
std::string run_guarded(std::string_view name, const GuardLimits& limits,
                        const std::function<std::string()>& work);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GUARD_GUARDED_CALL_H_
