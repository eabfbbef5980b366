// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Structs of the C interface that begin with struct_size, in the host's version and in ours: they
// may be of different length. A field that is added begins behind the end of the struct before it,
// never in its padding.
#ifndef ANICODEC_SDK_API_VERSIONED_H_
#define ANICODEC_SDK_API_VERSIONED_H_

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace anicodec {

/// A larger struct_size was never set by a host.
inline constexpr size_t kMostStructBytes = 4096;

/// The host's size of a struct, which may be shorter than ours.
template <class Struct>
size_t host_size(const Struct* host) {
  size_t size;
  std::memcpy(&size, host, sizeof size);
  return size;
}

/// Whether a host's struct is there and says how long it is.
template <class Struct>
bool is_sized(const Struct* host) {
  static_assert(std::is_trivially_copyable_v<Struct> && offsetof(Struct, struct_size) == 0);
  return host && host_size(host) >= sizeof(size_t) && host_size(host) <= kMostStructBytes;
}

/// Copies a struct that the host gives; null and fields that it does not have are 0. False when it
/// is not sized, or holds something that this version does not know.
template <class Struct>
bool take(const Struct* host, Struct* ours) {
  *ours = {};
  ours->struct_size = sizeof(Struct);
  if (!host)
    return true;
  if (!is_sized(host))
    return false;
  const size_t size = host_size(host);
  const auto* from = reinterpret_cast<const unsigned char*>(host);
  std::memcpy(ours, from, std::min(size, sizeof(Struct)));
  ours->struct_size = sizeof(Struct);
  return size <= sizeof(Struct) || std::all_of(from + sizeof(Struct), from + size,
                                               [](unsigned char byte) { return byte == 0; });
}

/// Fills a sized struct of the host: what both know from ours, the rest with 0.
template <class Struct>
void give(const Struct& ours, Struct* host) {
  const size_t size = host_size(host), both = std::min(size, sizeof(Struct));
  auto* to = reinterpret_cast<unsigned char*>(host);
  std::memcpy(to + sizeof size, reinterpret_cast<const unsigned char*>(&ours) + sizeof size,
              both - sizeof size);
  std::memset(to + both, 0, size - both);
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_API_VERSIONED_H_
