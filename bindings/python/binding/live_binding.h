// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A live stream, over its C interface.
#ifndef ANICODEC_BINDINGS_PYTHON_BINDING_LIVE_BINDING_H_
#define ANICODEC_BINDINGS_PYTHON_BINDING_LIVE_BINDING_H_

#include "bindings/python/binding/binding.h"

#include <anicodec/encode.h>

#include <memory>
#include <vector>

namespace anicodec::python {

/// One thread may push while another takes; anicodec/live.py sees to it that no more do.
class Live {
 public:
  explicit Live(anic_live* live) : live_(live) {}

  /// vertices x 3, and values of each attribute that moves. False where there is no room.
  bool push(const Array<float>& positions, const std::vector<Array<float>>& values, double wait);
  bool push_doubles(const Array<double>& positions, const std::vector<Array<float>>& values,
                    double wait);

  void end();

  /// The bytes of a file and a dict of what is known of it, or None.
  nb::object take(double wait);

  nb::dict info() const;

 private:
  bool push_frame(anic_live_frame frame, const std::vector<Array<float>>& values, double wait);

  struct Destroy {
    void operator()(anic_live* live) const { anic_destroy_live(live); }
  };

  std::unique_ptr<anic_live, Destroy> live_;
};

}  // namespace anicodec::python

#endif  // ANICODEC_BINDINGS_PYTHON_BINDING_LIVE_BINDING_H_
