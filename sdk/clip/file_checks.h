// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_FILE_CHECKS_H_
#define ANICODEC_SDK_CLIP_FILE_CHECKS_H_

#include "format/container.h"
#include "format/records.h"
#include "format/status.h"

#include <cstdint>

namespace anicodec {

struct OpenOptions;

/// Checks the chunks of a file, reads its limits and checks them against the host's and against
/// what a file of its size can hold. The first step of opening it. Cost: O(chunks + meshes +
/// segments).
Failure read_limits(const ContainerReader& file, const OpenOptions& options, Limits* out);

/// Checks that every required chunk is known, and that only layers of a basis occur twice.
Failure check_chunks(const ContainerReader& file);

/// Checks that known chunks are where the limits and the order of the vertices want them, and nowhere else.
Failure check_places(const ContainerReader& file, const Limits& limits, OrderMode order);

/// A failure at a chunk.
Failure failure_in(const Chunk& chunk, Status status, const char* detail);

/// The payload of a chunk that must be there.
Failure required_payload(const ContainerReader& file, const char (&type)[5], uint16_t mesh,
                         uint32_t segment, const Chunk** chunk, ByteView* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_FILE_CHECKS_H_
