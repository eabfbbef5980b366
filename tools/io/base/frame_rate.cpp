// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/frame_rate.h"

#include "codec/sequence/error.h"
#include "tools/io/base/mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <ranges>
#include <string>

namespace anicodec::tools {
namespace {

constexpr double kMaxTerm = std::numeric_limits<uint32_t>::max();

FrameRate rational(uint64_t numerator, uint64_t denominator) {
  uint64_t divisor = std::gcd(numerator, denominator);
  return {static_cast<uint32_t>(numerator / divisor), static_cast<uint32_t>(denominator / divisor),
          false};
}

double relative_distance(const FrameRate& rate, double fps) {
  return std::abs(rate.value() - fps) / fps;
}

/// The NTSC rate nearest to fps.
FrameRate nearest_ntsc(double fps) {
  FrameRate best = rational(24000, 1001);
  for (uint32_t whole : {30U, 48U, 60U, 120U, 240U}) {
    FrameRate rate = rational(whole * 1000, 1001);
    if (relative_distance(rate, fps) < relative_distance(best, fps))
      best = rate;
  }
  return best;
}

/// The first convergent of the continued fraction within the tolerance, or the last that fits.
FrameRate simplest(double fps, double tolerance) {
  double n0 = 1, d0 = 0, n1 = std::floor(fps), d1 = 1, rest = fps - n1;
  while (rest > 0 && (n1 == 0 || std::abs(n1 / d1 - fps) > tolerance * fps)) {
    double term = std::floor(1 / rest);
    double n2 = term * n1 + n0, d2 = term * d1 + d0;
    if (n2 > kMaxTerm || d2 > kMaxTerm)
      break;
    n0 = n1, d0 = d1, n1 = n2, d1 = d2;
    rest = 1 / rest - term;
  }
  if (n1 == 0)
    return rational(1, static_cast<uint64_t>(kMaxTerm));
  return rational(static_cast<uint64_t>(n1), static_cast<uint64_t>(d1));
}

FrameRate snap(double fps, double tolerance) {
  FrameRate ntsc = nearest_ntsc(fps);
  double whole = std::max(1.0, std::round(fps));
  FrameRate nearest = rational(static_cast<uint64_t>(std::min(whole, kMaxTerm)), 1);
  if (relative_distance(ntsc, fps) < relative_distance(nearest, fps))
    nearest = ntsc;
  return relative_distance(nearest, fps) <= tolerance
             ? nearest
             : simplest(std::min(fps, kMaxTerm), tolerance);
}

/// Whether all times, counted from the first, are whole frames.
bool on_grid(std::span<const double> times, double rounding, double fps) {
  return std::ranges::all_of(times, [&](double t) {
    const double frames = (t - times.front()) * fps;
    return std::abs(frames - std::round(frames)) <= 0.01 + 4 * rounding * fps;
  });
}

/// Digits only, all of the text, at most 2^32 - 1.
bool parse_term(std::string_view text, uint64_t& term) {
  auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), term);
  return error == std::errc() && last == text.data() + text.size() &&
         term <= std::numeric_limits<uint32_t>::max();
}

}  // namespace

FrameRate parse_frame_rate(std::string_view text) {
  uint64_t numerator = 0, denominator = 1;
  size_t point = text.find('.');
  bool ok = false;
  if (point == std::string_view::npos) {
    size_t slash = std::min(text.find('/'), text.size());
    ok = parse_term(text.substr(0, slash), numerator) &&
         (slash == text.size() || parse_term(text.substr(slash + 1), denominator));
  } else {
    std::string digits(text.substr(0, point));
    std::string_view decimals = text.substr(point + 1);
    digits += decimals;
    ok = point > 0 && !decimals.empty() && decimals.size() <= 6 && parse_term(digits, numerator);
    for (size_t i = 0; i < decimals.size() && ok; ++i)
      denominator *= 10;
  }
  if (!ok || numerator == 0 || denominator == 0)
    throw Error(ErrorKind::kUsage, "'" + std::string(text) +
                                       "' is not a frame rate; give N or N/D, such as 30000/1001");
  FrameRate rate = rational(numerator, denominator);
  FrameRate ntsc = nearest_ntsc(rate.value());
  constexpr double kTwoDecimals = 2e-4;
  bool abbreviated = point != std::string_view::npos && rate.denominator != 1 &&
                     relative_distance(ntsc, rate.value()) < kTwoDecimals;
  return abbreviated ? ntsc : rate;
}

Timing timing_of(std::span<const float> times, std::string_view name) {
  const std::vector<double> exact(times.begin(), times.end());
  const float largest =
      times.empty() ? 0 : std::max(std::abs(times.front()), std::abs(times.back()));
  const float below = std::nextafter(largest, -std::numeric_limits<float>::infinity());
  return timing_of(exact, static_cast<double>(largest - below), name);
}

Timing timing_of(std::span<const double> times, double rounding, std::string_view name) {
  for (size_t f = 0; f < times.size(); ++f) {
    if (!std::isfinite(times[f]))
      fail_input(name, "the time of frame " + std::to_string(f) + " is not finite");
    if (f > 0 && times[f] <= times[f - 1])
      fail_input(name, "the time of frame " + std::to_string(f) +
                           " is not after that of the frame before; give the frame rate");
  }
  Timing timing;
  if (times.empty())
    return timing;
  const double start = times.front();
  timing.start_time = start;
  if (times.size() == 1)
    return timing;

  const double length = times.back() - start;
  const double step = length / static_cast<double>(times.size() - 1);
  // 23.976 for 24000/1001 is off by a millionth.
  timing.rate = snap(1 / step, std::max(2e-6, 4 * rounding / length));

  bool even = true;
  for (size_t f = 0; f < times.size(); ++f) {
    const double expected = start + step * static_cast<double>(f);
    even &= std::abs(times[f] - expected) <= 0.01 * step + 4 * rounding;
  }
  if (!even) {
    for (double t : times)
      timing.times.push_back(t - start);
  }
  return timing;
}

std::optional<FrameRate> grid_rate(std::span<const double> times, double rounding) {
  constexpr double kLeast = 10, kUsual = 30, kMost = 240;
  double gap = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < times.size(); ++i) {
    const double step = times[i] - times[i - 1];
    if (step > 0.02 / kMost + 4 * rounding)  // else one key
      gap = std::min(gap, step);
  }
  if (!std::isfinite(gap))
    return {};
  const double length = times.back() - times.front();
  const double frames = std::round(length / gap);
  if (frames / length <= kMost && on_grid(times, rounding, frames / length)) {
    FrameRate rate = snap(frames / length, std::max(2e-6, 4 * rounding / length));
    if (rate.value() < kLeast) {
      const double times_finer = std::ceil(kUsual / rate.value());
      rate = snap(times_finer * rate.value(), 2e-6);
    }
    return rate;
  }
  for (double whole : {30, 24, 25, 60, 48, 50, 120, 100}) {
    if (on_grid(times, rounding, whole))
      return rational(static_cast<uint64_t>(whole), 1);
  }
  for (uint64_t whole : {30U, 24U, 60U}) {
    const FrameRate ntsc = rational(whole * 1000, 1001);
    if (on_grid(times, rounding, ntsc.value()))
      return ntsc;
  }
  return {};
}

FrameRate covering_rate(double seconds, double least) {
  constexpr double kRounding = 1e-3;  // of a frame
  const double frames = std::max(1.0, std::ceil(seconds * least - kRounding));
  FrameRate rate = simplest(std::min(frames / seconds, kMaxTerm), kRounding / (2 * frames));
  rate.assumed = false;
  return rate;
}

std::vector<float> times_of(const MeshSequence& clip) {
  std::vector<float> times;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    double t = clip.times.empty() ? f / clip.rate.value() : clip.times[f];
    times.push_back(static_cast<float>(clip.start_time + t));
  }
  return times;
}

}  // namespace anicodec::tools
