// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_ERROR_H_
#define ANICODEC_CODEC_SEQUENCE_ERROR_H_

#include <stdexcept>
#include <string>

namespace anicodec {

/// Who is to blame, and so the exit status of the command.
enum class ErrorKind : int {
  kUsage = 1,        ///< impossible option, or an output that exists
  kInput = 2,        ///< input that cannot be read or encoded
  kCorrupt = 3,      ///< an .anic file that is damaged
  kUnsupported = 4,  ///< a feature this build does not have
  kInternal = 5,     ///< a fault of ours, or a full disk
};

/// The exception of codec/ and tools/. The text is one line that names file, place and reason.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}

  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_ERROR_H_
