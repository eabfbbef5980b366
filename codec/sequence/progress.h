// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_PROGRESS_H_
#define ANICODEC_CODEC_SEQUENCE_PROGRESS_H_

#include <functional>
#include <string_view>

namespace anicodec {

/// Told by long computations where they are: the stage's name and the part done, 0..1. Called from
/// one thread, at any rate; may throw to cancel. May be empty.
using Progress = std::function<void(std::string_view stage, double done)>;

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_PROGRESS_H_
