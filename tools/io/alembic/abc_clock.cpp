// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_clock.h"

#include "tools/io/base/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace anicodec::tools {
namespace {

// A sample that changes takes 8 bytes of a table at least; what stands still may have more frames.
constexpr uint64_t kBytesPerSample = 8, kFreeFrames = uint64_t{1} << 17;

void check_count(const AbcArchive& archive, double frames) {
  const uint64_t most =
      std::min(kMaxFrames, std::max(kFreeFrames, archive.file.size() / kBytesPerSample));
  if (!(frames <= static_cast<double>(most)))
    archive.file.fail("the times of the samples",
                      "make " + std::to_string(frames) + " frames; at most " +
                          std::to_string(most) + " fit a file of " +
                          std::to_string(archive.file.size()) + " bytes");
}

/// Number of samples by time sampling, of what has more than one.
std::map<uint32_t, uint32_t> samplings_in_use(const AbcArchive& archive,
                                              const std::vector<const AbcProperty*>& properties) {
  std::map<uint32_t, uint32_t> in_use;
  for (const AbcProperty* property : properties) {
    archive.time_of(*property);  // there is one
    if (property->samples > 1) {
      uint32_t& most = in_use[property->sampling];
      most = std::max(most, property->samples);
    }
  }
  const auto is_default = [&](const auto& entry) {
    return archive.samplings[entry.first].is_default();
  };
  if (!std::ranges::all_of(in_use, is_default))
    std::erase_if(in_use, is_default);
  return in_use;
}

/// Ascending, each once.
std::vector<double> joined_times(const AbcArchive& archive,
                                 const std::map<uint32_t, uint32_t>& in_use) {
  std::vector<double> times;
  for (const auto& [sampling, samples] : in_use) {
    check_count(archive, static_cast<double>(times.size()) + samples);
    for (uint32_t i = 0; i < samples; ++i)
      times.push_back(archive.samplings[sampling].at(i));
  }
  std::sort(times.begin(), times.end());
  const auto end = std::unique(times.begin(), times.end(), [](double kept, double next) {
    return next - kept <= abc_time_tolerance(next);
  });
  times.erase(end, times.end());
  return times;
}

/// The time of a scene that stands still.
double only_time(const AbcArchive& archive, const std::vector<const AbcProperty*>& properties) {
  for (const AbcProperty* property : properties) {
    const AbcTime& time = archive.time_of(*property);
    if (property->samples > 0 && !time.is_default())
      return time.at(0);
  }
  return 0;
}

}  // namespace

AbcClock clock_of(const AbcArchive& archive, const std::vector<const AbcProperty*>& properties,
                  const std::optional<FrameRate>& rate) {
  const std::map<uint32_t, uint32_t> in_use = samplings_in_use(archive, properties);
  AbcClock clock;
  clock.times = joined_times(archive, in_use);
  if (clock.times.empty())
    clock.times.push_back(only_time(archive, properties));
  if (rate) {
    constexpr double kRounding = 1e-3;  // of a frame
    const double first = clock.times.front(), last = clock.times.back();
    const double frames = std::floor((last - first) * rate->value() + kRounding) + 1;
    check_count(archive, frames);
    clock.times.resize(static_cast<size_t>(frames));
    for (size_t f = 0; f < clock.times.size(); ++f)
      clock.times[f] = first + static_cast<double>(f) / rate->value();
    clock.timing.rate = *rate;
    clock.timing.start_time = first;
    return clock;
  }
  const double largest = std::max(std::abs(clock.times.front()), std::abs(clock.times.back()));
  clock.timing = timing_of(clock.times, abc_time_tolerance(largest), archive.file.name());
  const bool unknown = std::ranges::all_of(
      in_use, [&](const auto& entry) { return archive.samplings[entry.first].is_default(); });
  if (unknown)
    clock.timing.rate = FrameRate{};
  return clock;
}

}  // namespace anicodec::tools
