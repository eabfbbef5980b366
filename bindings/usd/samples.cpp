// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/usd/samples.h"

#include <algorithm>
#include <cmath>
#include <new>

#include <pxr/sdf/types.h>
#include <pxr/tf/diagnostic.h>

// Macros of OpenUSD name what is in it without saying so.
using namespace pxr;  // NOLINT

namespace anicodec::usd {

size_t Samples::find(double code) const {
  size_t low = 0;
  size_t high = size();
  while (low < high) {
    const size_t middle = low + (high - low) / 2;
    if (this->code(middle) < code)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

double snapped_rate(double rate) {
  for (const double whole : {24, 30, 48, 60, 96, 120}) {
    const double meant = whole * 1000 / 1001;
    if (std::abs(rate - meant) < 2e-6 * rate)
      return meant;
  }
  return rate;
}

double whole_code(double code) {
  for (const int parts :
       {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 24, 25, 30, 48, 50, 60, 120}) {
    const double near = std::nearbyint(code * parts) / parts;
    // A rate of few digits moves whole codes by more than rounding does.
    if (std::abs(code - near) < std::max(parts == 1 ? 1e-6 : 1e-9, 1e-9 * std::abs(code)))
      return near;
  }
  return code;
}

double ClipCodes::code(uint32_t frame) const {
  return whole_code((clip_.start_time + file_->asset().frame_time(frame)) * per_second_);
}

bool ClipCodes::ascend() const {
  if (!std::isfinite(code(first_frame())) || !std::isfinite(end()))
    return false;
  for (uint32_t frame = first_frame() + 1; frame < end_frame(); ++frame) {
    if (!(code(frame) > code(frame - 1)))
      return false;
  }
  return true;
}

FrameSamples::FrameSamples(std::shared_ptr<const ClipCodes> codes, uint32_t mesh,
                           const std::type_info& type, MakeValue make)
    : codes_(std::move(codes)), type_(type), make_(std::move(make)) {
  uint32_t frame = codes_->first_frame();
  const uint32_t end = codes_->end_frame();
  const auto add = [&](uint32_t first, size_t count, bool there) {
    runs_.push_back({size(), count, first, there});
  };
  for (const FrameRange& range : codes_->file().frames_of(mesh)) {
    const uint32_t from = std::max(range.first, frame);
    const uint32_t to = std::min(range.second, end);
    if (from >= to)
      continue;
    if (from > frame)
      add(frame, 1, false);
    add(from, to - from, true);
    frame = to;
  }
  if (frame < end)
    add(frame, 1, false);
}

const FrameSamples::Run& FrameSamples::run_of(size_t i) const {
  return *std::prev(
      std::upper_bound(runs_.begin(), runs_.end(), i,
                       [](size_t sample, const Run& run) { return sample < run.first; }));
}

double FrameSamples::code(size_t i) const {
  const Run& run = run_of(i);
  return codes_->code(run.frame + static_cast<uint32_t>(i - run.first));
}

pxr::VtValue FrameSamples::value(size_t i) const {
  const Run& run = run_of(i);
  if (!run.there)
    return pxr::VtValue(pxr::SdfValueBlock());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [sample, value] : kept_) {
      if (sample == i && !value.IsEmpty())
        return value;
    }
  }
  pxr::VtValue made;
  try {
    made = make_(run.frame + static_cast<uint32_t>(i - run.first));
  } catch (const std::bad_alloc&) {  // which no host expects of an attribute
    TF_RUNTIME_ERROR(".anic: there is not enough memory for a sample");
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  kept_[oldest_] = {i, made};
  oldest_ = 1 - oldest_;
  return made;
}

const std::type_info& FrameSamples::type(size_t i) const {
  return run_of(i).there ? type_ : typeid(pxr::SdfValueBlock);
}

}  // namespace anicodec::usd
