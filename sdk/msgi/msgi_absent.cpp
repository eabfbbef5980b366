// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// In builds without multi-scale geometry interpolation.
#include "sdk/msgi/msgi.h"

namespace anicodec {

bool Msgi::is_there() {
  return false;
}

Status Msgi::init(const uint32_t*, size_t, uint32_t, const float* const*, size_t, const Options&) {
  return Status::kFeature;
}

Status Msgi::evaluate(const double*, const float*, void*, float*, const HostThreads&) const {
  return Status::kFeature;
}

size_t Msgi::resident_bytes() const {
  return 0;
}

size_t Msgi::required_bytes() const {
  return 0;
}

size_t Msgi::scratch_bytes() const {
  return 0;
}

}  // namespace anicodec
