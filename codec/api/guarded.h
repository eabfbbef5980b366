// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The edge of the C interface: what is thrown becomes a status and a text. Internal to codec/api.
#ifndef ANICODEC_CODEC_API_GUARDED_H_
#define ANICODEC_CODEC_API_GUARDED_H_

#include "codec/plan/encoding_memory.h"
#include "codec/sequence/error.h"
#include "sdk/api/versioned.h"

#include <anicodec/encode.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace anicodec {

/// Ends a call: thrown inside the library, never out of it.
class EncoderFailure : public std::exception {
 public:
  EncoderFailure(anic_status status, std::string text) : status_(status), text_(std::move(text)) {}

  anic_status status() const { return status_; }

  const char* what() const noexcept override { return text_.c_str(); }

 private:
  anic_status status_;
  std::string text_;
};

inline anic_status status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
    case ErrorKind::kInput:
      return ANIC_E_ARGUMENT;
    case ErrorKind::kUnsupported:
      return ANIC_E_FEATURE;
    case ErrorKind::kCorrupt:
    case ErrorKind::kInternal:
      break;
  }
  return ANIC_E_INTERNAL;
}

/// Runs what may throw at the edge of the interface: nothing leaves it. `text`: becomes the fault, unless there is no
/// memory for that.
template <class Function>
anic_status guarded(std::string* text, Function function) noexcept {
  const auto keep = [&](const char* fault) {
    try {
      *text = fault;
    } catch (...) {
      text->clear();
    }
  };
  text->clear();
  try {
    function();
    return ANIC_OK;
  } catch (const EncoderFailure& e) {
    keep(e.what());
    return e.status();
  } catch (const OverMemory& e) {
    keep(e.what());
    return ANIC_E_LIMIT;
  } catch (const Error& e) {
    keep(e.what());
    return status_of(e.kind());
  } catch (const std::bad_alloc&) {
    keep("not enough memory");
    return ANIC_E_MEMORY;
  } catch (const std::length_error&) {
    keep("not enough memory");
    return ANIC_E_MEMORY;
  } catch (const std::exception& e) {
    keep(e.what());
    return ANIC_E_INTERNAL;
  } catch (...) {
    keep("an unexpected exception");
    return ANIC_E_INTERNAL;
  }
}

inline void check_argument(bool holds, const char* text) {
  if (!holds)
    throw EncoderFailure(ANIC_E_ARGUMENT, text);
}

/// The host's struct in our version. Throws EncoderFailure.
template <class Struct>
Struct taken(const Struct* host, const char* name) {
  Struct ours;
  if (!take(host, &ours))
    throw EncoderFailure(ANIC_E_ARGUMENT,
                         std::string(name) + ": its struct_size is not set, or a field is unknown");
  return ours;
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_API_GUARDED_H_
