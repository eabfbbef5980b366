// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Numbers as the command line takes and prints them.
#ifndef ANICODEC_TOOLS_WORDS_QUANTITY_H_
#define ANICODEC_TOOLS_WORDS_QUANTITY_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// A length in scene units, in a unit of its own, or in per cent of the diagonal.
struct Length {
  double value = 0;
  bool percent = false;
  double metres = 0;  ///< of the unit of its own; 0: scene units

  /// The length in scene units of so many metres (0: unknown) where it has a unit of its own.
  /// Throws Error(kUsage) "option: ..." where that is unknown.
  Length in_scene_units(double metres_per_unit, std::string_view option) const;
};

/// A number of things or a share of all.
struct Count {
  uint32_t number = 0;
  double percent = 0;  ///< counts if number is 0

  /// At least 1.
  uint32_t of(uint32_t all) const;
};

/// Every parser throws Error(kUsage) "option: ..." for anything but the whole text.

/// A finite number greater than 0.
double parse_positive(std::string_view text, std::string_view option);

/// A finite number greater than 0 of per cent, with or without the sign.
double parse_percent(std::string_view text, std::string_view option);

/// A number above 0 and up to 1.
double parse_share(std::string_view text, std::string_view option);

/// "0.02", "0.05%" or "5mm" (with a unit of parse_unit()), greater than 0.
Length parse_length(std::string_view text, std::string_view option);

/// "500" or "25%", greater than 0, less than 2^31 and at most 100 000 %.
Count parse_count(std::string_view text, std::string_view option);

/// A number of bytes: "40000", "40k", "1.5M", "2G" (powers of 1000); at least 1.
uint64_t parse_size(std::string_view text, std::string_view option);

/// Metres per scene unit: a number or one of m, cm, mm, km, in, ft.
double parse_unit(std::string_view text, std::string_view option);

/// Numbers separated by commas, each at least 1; returned ascending, each once.
std::vector<size_t> parse_counts(std::string_view text, std::string_view option);

/// Frames first, first + step, ... below end.
struct FrameRange {
  uint32_t first = 0;
  uint32_t end = 0;
  uint32_t step = 1;

  uint32_t size() const { return (end - first + step - 1) / step; }
};

/// "A:B" or "A:B:STEP", A to B - 1 as in Python, both may be left out; "A" is one frame. At least
/// one frame, none beyond the clip's.
FrameRange parse_frames(std::string_view text, std::string_view option, uint32_t frame_count);

/// "1 frame", "2 frames"; `many` where an s does not make it.
std::string counted(uint64_t number, std::string_view one, std::string_view many = {});

/// 1234567 -> "1 234 567".
std::string grouped(uint64_t number);

/// A short text for people: "312 bytes", "45.1 kB", "1.25 MB".
std::string readable_bytes(uint64_t bytes);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_QUANTITY_H_
