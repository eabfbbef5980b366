// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_HASH_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_HASH_H_

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// 128 bits, the lower half first.
using AbcHash = std::array<uint64_t, 2>;

/// MurmurHash3 of Austin Appleby (x64, 128 bits, seed 0): what a sample begins with.
AbcHash murmur3(std::string_view bytes);

/// SpookyHash V2 of Bob Jenkins (seeds 0): of objects and of the headers of properties.
AbcHash spooky(std::string_view bytes);

/// The end of a short SpookyHash with `next` as the other half of its state: how the samples of a
/// property are gathered in one hash.
AbcHash gather(const AbcHash& so_far, const AbcHash& next);

/// Its 16 bytes, little-endian.
std::string bytes_of(const AbcHash& hash);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_HASH_H_
