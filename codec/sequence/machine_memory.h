// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_MACHINE_MEMORY_H_
#define ANICODEC_CODEC_SEQUENCE_MACHINE_MEMORY_H_

#include <cstdint>

#include <unistd.h>

namespace anicodec {

/// Half of the memory that the machine has, in bytes: what a run may take unless told otherwise.
inline uint64_t half_of_machine() {
  const auto pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGE_SIZE);
  return static_cast<uint64_t>(pages) * static_cast<uint64_t>(size) / 2;
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_MACHINE_MEMORY_H_
