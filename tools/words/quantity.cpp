// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/words/quantity.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

[[noreturn]] void fail(std::string_view option, std::string_view text, std::string_view expected) {
  throw Error(ErrorKind::kUsage, fmt::format("{}: '{}' is not {}", option, text, expected));
}

/// Takes a number off the front of the text; false if there is none.
template <typename Number>
bool take(std::string_view& text, Number& x) {
  const char* end = text.data() + text.size();
  auto [at, error] = std::from_chars(text.data(), end, x);
  if (error != std::errc())
    return false;
  text.remove_prefix(static_cast<size_t>(at - text.data()));
  return true;
}

bool is_positive(double x) {
  return std::isfinite(x) && x > 0;
}

/// Metres of a unit's name, 0 for what is none.
double metres_of(std::string_view unit) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"km", 1000}, {"in", 0.0254}, {"ft", 0.3048}};
  for (auto [name, metres] : kUnits) {
    if (unit == name)
      return metres;
  }
  return 0;
}

}  // namespace

double parse_positive(std::string_view text, std::string_view option) {
  std::string_view rest = text;
  double x = 0;
  if (!take(rest, x) || !rest.empty() || !is_positive(x))
    fail(option, text, "a number greater than 0");
  return x;
}

double parse_percent(std::string_view text, std::string_view option) {
  std::string_view number = text;
  if (number.ends_with('%'))
    number.remove_suffix(1);
  double x = 0;
  if (!take(number, x) || !number.empty() || !is_positive(x))
    fail(option, text, "a number of per cent greater than 0, such as 0.1 or 0.1%");
  return x;
}

double parse_share(std::string_view text, std::string_view option) {
  const double share = parse_positive(text, option);
  if (share > 1)
    fail(option, text, "above 0 and at most 1");
  return share;
}

Length parse_length(std::string_view text, std::string_view option) {
  std::string_view rest = text;
  Length length;
  bool number = take(rest, length.value);
  length.percent = rest == "%";
  length.metres = metres_of(rest);
  const bool known = rest.empty() || length.percent || length.metres > 0;
  if (number && length.value == 0 && known)
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: an error of 0 is asked for by --lossless", option));
  if (!number || !known || !is_positive(length.value))
    fail(option, text,
         "a length greater than 0 such as 0.02 (scene units), 5mm or 0.05% (of the diagonal)");
  return length;
}

Length Length::in_scene_units(double metres_per_unit, std::string_view option) const {
  if (metres == 0)
    return *this;
  if (metres_per_unit == 0)
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: the input does not say how long a scene unit is; give scene units "
                            "or per cent (encode --unit says it)",
                            option));
  return {value * metres / metres_per_unit, false, 0};
}

uint32_t Count::of(uint32_t all) const {
  constexpr double kMost = std::numeric_limits<int32_t>::max();
  return number > 0
             ? number
             : static_cast<uint32_t>(std::clamp(std::round(percent / 100 * all), 1.0, kMost));
}

Count parse_count(std::string_view text, std::string_view option) {
  constexpr double kMostPercent = 1e5;
  std::string_view rest = text;
  double x = 0;
  const bool is_number = take(rest, x) && is_positive(x);
  Count count;
  if (is_number && rest == "%" && x <= kMostPercent)
    count.percent = x;
  else if (is_number && rest.empty() && x == std::floor(x) &&
           x <= std::numeric_limits<int32_t>::max())
    count.number = static_cast<uint32_t>(x);
  else
    fail(option, text, "a number such as 500, or a share such as 25%");
  return count;
}

uint64_t parse_size(std::string_view text, std::string_view option) {
  std::string_view rest = text;
  double size = 0;
  bool good = take(rest, size);
  if (rest == "k" || rest == "K")
    size *= 1e3;
  else if (rest == "M")
    size *= 1e6;
  else if (rest == "G")
    size *= 1e9;
  else
    good = good && rest.empty();
  if (!good || !std::isfinite(size) || size < 1 || size > 1e18)
    fail(option, text, "a size such as 40000, 40k or 1.5M bytes");
  return static_cast<uint64_t>(size);
}

double parse_unit(std::string_view text, std::string_view option) {
  double x = metres_of(text);
  if (x > 0)
    return x;
  std::string_view rest = text;
  if (!take(rest, x) || !rest.empty() || !is_positive(x))
    fail(option, text, "a length in metres or one of m, cm, mm, km, in, ft");
  return x;
}

std::vector<size_t> parse_counts(std::string_view text, std::string_view option) {
  std::vector<size_t> counts;
  std::string_view rest = text;
  for (bool more = true; more;) {
    size_t count = 0;
    if (!take(rest, count) || count == 0)
      fail(option, text, "a list of numbers such as 5,10,20");
    counts.push_back(count);
    more = rest.starts_with(',');
    rest.remove_prefix(more);
  }
  if (!rest.empty())
    fail(option, text, "a list of numbers such as 5,10,20");
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

FrameRange parse_frames(std::string_view text, std::string_view option, uint32_t frame_count) {
  std::string_view rest = text;
  FrameRange range{0, frame_count, 1};
  auto skip_colon = [&rest] {
    bool colon = rest.starts_with(':');
    rest.remove_prefix(colon);
    return colon;
  };
  bool has_first = take(rest, range.first);
  if (!skip_colon()) {
    if (!has_first || range.first >= UINT32_MAX)
      fail(option, text, "a range of frames such as 0:100, 10:, :50:2");
    range.end = range.first + 1;
  } else {
    take(rest, range.end);
    if (skip_colon() && !take(rest, range.step))
      fail(option, text, "a range of frames such as 0:100, 10:, :50:2");
  }
  if (!rest.empty() || range.step == 0)
    fail(option, text, "a range of frames such as 0:100, 10:, :50:2");
  if (range.end > frame_count || range.first >= range.end)
    throw Error(ErrorKind::kUsage, fmt::format("{}: '{}' does not fit a clip of {} frames (0:{})",
                                               option, text, frame_count, frame_count));
  range.step = std::min(range.step, frame_count);
  return range;
}

std::string counted(uint64_t number, std::string_view one, std::string_view many) {
  if (number == 1)
    return fmt::format("1 {}", one);
  return many.empty() ? fmt::format("{} {}s", number, one) : fmt::format("{} {}", number, many);
}

std::string grouped(uint64_t number) {
  if (number < 1000)
    return fmt::format("{}", number);
  return fmt::format("{} {:03}", grouped(number / 1000), number % 1000);
}

std::string readable_bytes(uint64_t bytes) {
  auto x = static_cast<double>(bytes);
  if (bytes < 1000)
    return fmt::format("{} bytes", bytes);
  if (x < 1e6)
    return fmt::format("{:.1f} kB", x / 1e3);
  if (x < 1e9)
    return fmt::format("{:.2f} MB", x / 1e6);
  return fmt::format("{:.2f} GB", x / 1e9);
}

}  // namespace anicodec::tools
