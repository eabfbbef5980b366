// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_API_BOUNDS_H_
#define ANICODEC_SDK_API_BOUNDS_H_

#include "sdk/api/objects.h"
#include "sdk/base/host_progress.h"
#include "sdk/base/parallel_for.h"

namespace anicodec {

/// Fills file->boxes, on the threads of the host; false when the host stops it. Plays all frames
/// once. Throws std::bad_alloc.
bool compute_boxes(OpenedFile* file, const HostThreads& threads, HostProgress* progress);

}  // namespace anicodec

#endif  // ANICODEC_SDK_API_BOUNDS_H_
