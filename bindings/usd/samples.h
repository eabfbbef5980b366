// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_BINDINGS_USD_SAMPLES_H_
#define ANICODEC_BINDINGS_USD_SAMPLES_H_

#include "bindings/usd/decoded_values.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <typeinfo>
#include <utility>
#include <vector>

#include <pxr/vt/value.h>

namespace anicodec::usd {

/// Values of an attribute at time codes, which ascend. Threads may share it.
class Samples {
 public:
  virtual ~Samples() = default;
  virtual size_t size() const = 0;
  virtual double code(size_t i) const = 0;
  virtual pxr::VtValue value(size_t i) const = 0;
  virtual const std::type_info& type(size_t i) const = 0;

  /// The first sample at a code or behind it; size() if there is none. O(log size()).
  size_t find(double code) const;
};

/// A few values.
class ListedSamples : public Samples {
 public:
  explicit ListedSamples(std::vector<std::pair<double, pxr::VtValue>> values)
      : values_(std::move(values)) {}

  size_t size() const override { return values_.size(); }

  double code(size_t i) const override { return values_[i].first; }

  pxr::VtValue value(size_t i) const override { return values_[i].second; }

  const std::type_info& type(size_t i) const override { return values_[i].second.GetTypeid(); }

 private:
  std::vector<std::pair<double, pxr::VtValue>> values_;
};

/// A rate as it is meant: 23.976022856742713 and 23.976 are 24000/1001.
double snapped_rate(double rate);

/// A time code, whole or a whole part where only rounding keeps it from that.
double whole_code(double code);

/// Time codes of the frames of a clip, computed when asked for: a clip of 2^24 frames takes no memory.
class ClipCodes {
 public:
  ClipCodes(std::shared_ptr<const OpenedClip> file, uint32_t clip, double codes_per_second)
      : file_(std::move(file)),
        clip_(file_->clips()[clip]),
        number_(clip),
        per_second_(codes_per_second) {}

  double code(uint32_t frame) const;

  double end() const { return code(clip_.first_frame + clip_.frame_count - 1); }

  /// Whether each code is greater than the one before.
  bool ascend() const;

  const OpenedClip& file() const { return *file_; }

  uint32_t clip() const { return number_; }

  uint32_t first_frame() const { return clip_.first_frame; }

  uint32_t end_frame() const { return clip_.first_frame + clip_.frame_count; }

 private:
  std::shared_ptr<const OpenedClip> file_;
  anic_clip clip_;
  uint32_t number_;
  double per_second_;
};

/// Values that are made for a frame when it is asked for; the last two stay, as a time between frames asks for both. A value
/// block stands at the first frame of each run of frames without the mesh.
class FrameSamples : public Samples {
 public:
  FrameSamples(std::shared_ptr<const ClipCodes> codes, uint32_t mesh, const std::type_info& type,
               MakeValue make);

  size_t size() const override {
    return runs_.empty() ? 0 : runs_.back().first + runs_.back().count;
  }

  double code(size_t i) const override;
  pxr::VtValue value(size_t i) const override;
  const std::type_info& type(size_t i) const override;

 private:
  struct Run {
    size_t first;  ///< sample
    size_t count;
    uint32_t frame;
    bool there;
  };

  const Run& run_of(size_t i) const;

  std::shared_ptr<const ClipCodes> codes_;
  const std::type_info& type_;
  MakeValue make_;
  std::vector<Run> runs_;
  mutable std::mutex mutex_;
  mutable std::pair<size_t, pxr::VtValue> kept_[2];
  mutable int oldest_ = 0;
};

}  // namespace anicodec::usd

#endif  // ANICODEC_BINDINGS_USD_SAMPLES_H_
