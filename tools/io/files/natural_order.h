// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILES_NATURAL_ORDER_H_
#define ANICODEC_TOOLS_IO_FILES_NATURAL_ORDER_H_

#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// Orders names as people count frames: runs of digits by value (frame_2 before frame_10), with the minus
/// before them that follows no letter or digit (sim.-10 before sim.-9), all else by byte. With `fractions`
/// digits behind a number and a point are its decimals. Numbers of equal value go by their length, shorter
/// first. A strict weak order.
bool natural_less(std::string_view a, std::string_view b, bool fractions = false);

/// Whether the numbers at the ends of these names, before their extensions, have decimals: some have none
/// (sim.1, sim.1.25), or their whole parts differ and their decimals have various lengths without zeros at
/// the end (sim.1.5, sim.2.25). Numbers of takes and their frames (take.1.9, take.1.10) have none.
bool have_fractions(const std::vector<std::string>& names);

/// Sorts by natural_less(), with decimals where have_fractions().
void sort_naturally(std::vector<std::string>& names);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILES_NATURAL_ORDER_H_
