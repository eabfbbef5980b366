// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_time.h"

#include "tools/io/base/byte_order.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace anicodec::tools {

std::string AbcTime::fault(double per_cycle, const std::vector<double>& stored) {
  if (stored.empty())
    return "has no time";
  if (!(per_cycle > 0) || !std::isfinite(per_cycle))
    return "takes " + std::to_string(per_cycle) + " s per cycle";
  for (size_t i = 0; i < stored.size(); ++i) {
    if (!std::isfinite(stored[i]) || std::abs(stored[i]) > kAcyclic)
      return "time " + std::to_string(i) + " is not finite";
    if (i > 0 && stored[i] < stored[i - 1])
      return "time " + std::to_string(i) + " is before that of the sample before";
  }
  if (per_cycle != kAcyclic && stored.back() - stored.front() > per_cycle)
    return "a cycle is shorter than its times";
  return {};
}

void AbcTime::append_to(std::string& out) const {
  append(per_cycle_, std::endian::little, out);
  append(static_cast<uint32_t>(stored_.size()), std::endian::little, out);
  for (double t : stored_)
    append(t, std::endian::little, out);
}

double AbcTime::at(size_t sample) const {
  if (is_acyclic())
    return stored_[sample];
  const size_t n = stored_.size();
  return stored_[sample % n] + per_cycle_ * static_cast<double>(sample / n);
}

uint32_t AbcTime::sample_at(double time, uint32_t samples) const {
  const double limit = time + abc_time_tolerance(time);
  uint32_t low = 0, high = samples;  // the samples before low are not after the limit
  while (low < high) {
    const uint32_t middle = low + (high - low) / 2;
    if (at(middle) <= limit)
      low = middle + 1;
    else
      high = middle;
  }
  return low == 0 ? 0 : low - 1;
}

double abc_time_tolerance(double time) {
  return 1e-7 + 1e-9 * std::abs(time);
}

}  // namespace anicodec::tools
