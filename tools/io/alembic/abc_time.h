// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_TIME_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_TIME_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace anicodec::tools {

/// When the samples of a property stand, in seconds: evenly (one stored time and a step), in cycles
/// (some stored times that repeat), or each as stored (acyclic).
class AbcTime {
 public:
  /// The step of acyclic samplings.
  static constexpr double kAcyclic = 1.7976931348623157e308 / 32;

  AbcTime(double per_cycle, std::vector<double> stored)
      : per_cycle_(per_cycle), stored_(std::move(stored)) {}

  /// The fault of such a sampling; empty if there is none.
  static std::string fault(double per_cycle, const std::vector<double>& stored);

  bool is_acyclic() const { return per_cycle_ == kAcyclic; }

  /// True for the sampling that every archive has for what stands still: from 0 s on, one a second.
  bool is_default() const { return per_cycle_ == 1 && stored_.size() == 1 && stored_[0] == 0; }

  /// How many samples can have a time.
  size_t max_samples() const { return is_acyclic() ? stored_.size() : SIZE_MAX; }

  /// The time of a sample, which is below max_samples().
  double at(size_t sample) const;

  /// Step, number of stored times and these, as an archive has them.
  void append_to(std::string& out) const;

  bool operator==(const AbcTime&) const = default;

  /// The last of `samples` samples that is not after a time, the first if all are.
  uint32_t sample_at(double time, uint32_t samples) const;

 private:
  double per_cycle_;
  std::vector<double> stored_;
};

/// Times closer than this are the same one.
double abc_time_tolerance(double time);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_TIME_H_
