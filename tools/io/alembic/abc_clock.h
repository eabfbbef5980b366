// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_CLOCK_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_CLOCK_H_

#include "tools/io/alembic/abc_archive.h"
#include "tools/io/base/frame_rate.h"

#include <optional>
#include <vector>

namespace anicodec::tools {

/// When the frames of a clip stand: the times at which to sample the archive, and what the clip
/// says of them.
struct AbcClock {
  std::vector<double> times;  ///< seconds, ascending, at least one
  Timing timing;
};

/// All times at which one of the properties has a sample, those that nearly coincide once. A
/// property with a single sample stands still and asks for no time, nor does a property with the
/// archive's default sampling beside others; if all have the default sampling, the rate is unknown.
/// With a rate, frames stand at multiples of its step from the first time to the last. Throws
/// Error(kInput) for more frames than are possible, or than the bytes of the file can back.
AbcClock clock_of(const AbcArchive& archive, const std::vector<const AbcProperty*>& properties,
                  const std::optional<FrameRate>& rate);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_CLOCK_H_
