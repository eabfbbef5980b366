// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// How values of attributes are stored for a host.
#ifndef ANICODEC_SDK_PLAY_VALUE_OUTPUT_H_
#define ANICODEC_SDK_PLAY_VALUE_OUTPUT_H_

#include "format/status.h"

#include <anicodec/anicodec.h>

#include <cstdint>

namespace anicodec {

/// The destination of the next values. Each is written once, at ascending addresses, and nothing is
/// read.
class ValueOutput {
 public:
  /// For `count` elements of an attribute with `components` components. Errors: kArgument,
  /// kBufferSize.
  static Status make(const anic_value_output& out, uint32_t components, uint32_t count,
                     ValueOutput* result);

  /// Stores count x components values.
  void store(const float* values, uint32_t count);

 private:
  unsigned char* at_ = nullptr;
  size_t stride_ = 0;
  anic_value_format format_ = ANIC_VALUE_FLOAT32;
  uint32_t given_ = 0, stored_ = 0;  ///< components
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_VALUE_OUTPUT_H_
