// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_BASE_HOST_PROGRESS_H_
#define ANICODEC_SDK_BASE_HOST_PROGRESS_H_

#include <algorithm>

namespace anicodec {

/// Tells a host how much of a long call is done, and asks it whether to go on. One thread.
class HostProgress {
 public:
  using Report = int (*)(void* user, double done);

  /// `report` gets the share that is done and returns anything but 0 to stop; null: nobody listens.
  HostProgress(Report report, void* user) : report_(report), user_(user) {}

  /// Begins a stage of `work` units (any unit) that ends when a share `to` of the call is done.
  void begin(double work, double to = 1) {
    from_ = share();
    to_ = to;
    work_ = work;
    done_ = 0;
  }

  /// More work of the stage is done. False, from then on, when the host wants to stop.
  bool advance(double work) {
    done_ += work;
    if (report_ && !stopped_)
      stopped_ = report_(user_, share()) != 0;
    return !stopped_;
  }

 private:
  double share() const {
    return work_ > 0 ? from_ + (to_ - from_) * std::min(done_ / work_, 1.0) : from_;
  }

  Report report_;
  void* user_;
  double from_ = 0, to_ = 0, work_ = 0, done_ = 0;
  bool stopped_ = false;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_HOST_PROGRESS_H_
