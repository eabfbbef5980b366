// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_NATURAL_ORDER_H_
#define ANICODEC_TOOLS_IO_FILES_NATURAL_ORDER_H_

#include <string_view>

namespace anicodec::tools {

/// Orders names as people count frames: runs of digits by value (frame_2 before frame_10), all else
/// by byte. Numbers of equal value go by their leading zeros, fewer first. A strict weak order.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_NATURAL_ORDER_H_
