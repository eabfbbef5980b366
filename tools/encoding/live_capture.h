// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_ENCODING_LIVE_CAPTURE_H_
#define ANICODEC_TOOLS_ENCODING_LIVE_CAPTURE_H_

#include "tools/inputs/encode_arguments.h"
#include "tools/program/command.h"

namespace anicodec::tools {

/// encode --live: frames from the standard input become a live stream, a file for every few of
/// them. The output has each file as soon as it is encoded, and keeps it whatever happens to later
/// ones.
void encode_live(const EncodeArguments& command, const CommonOptions& common);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_ENCODING_LIVE_CAPTURE_H_
