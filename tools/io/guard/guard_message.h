// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The messages of the work of run_guarded(), as bytes that cross from the child to its parent.
#ifndef ANICODEC_TOOLS_IO_GUARD_GUARD_MESSAGE_H_
#define ANICODEC_TOOLS_IO_GUARD_GUARD_MESSAGE_H_

#include "codec/sequence/error.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace anicodec::tools {

template <typename T>
void append_one(const T& value, std::string& out) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A container of numbers, with its size.
template <typename Values>
void append_values(const Values& values, std::string& out) {
  append_one(uint64_t{values.size()}, out);
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
}

/// Takes a message apart, trusting nothing of it: throws Error(kInput) "name: reason" where it ends early.
class GuardMessage {
 public:
  /// `bytes` must outlive the message.
  GuardMessage(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  bool at_end() const { return bytes_.empty(); }

  template <typename T>
  T one() {
    T value;
    std::memcpy(&value, take(1, sizeof value).data(), sizeof value);
    return value;
  }

  template <typename Values>
  void values(Values& out) {
    const auto count = one<uint64_t>();
    const std::string_view bytes = take(count, sizeof out[0]);
    out.resize(count);
    if (count > 0)
      std::memcpy(out.data(), bytes.data(), bytes.size());
  }

  /// Characters, of the bytes of the message.
  std::string_view text() { return take(one<uint64_t>(), 1); }

  [[noreturn]] void fail() const {
    throw Error(ErrorKind::kInput,
                name_ + ": the process that reads it says nothing that makes sense");
  }

 private:
  std::string_view take(uint64_t count, size_t size) {
    if (count > bytes_.size() / size)
      fail();
    const std::string_view taken = bytes_.substr(0, count * size);
    bytes_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view bytes_;
  std::string name_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GUARD_GUARD_MESSAGE_H_
