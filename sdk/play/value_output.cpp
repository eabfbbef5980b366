// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/value_output.h"

#include "format/records.h"
#include "sdk/base/half_float.h"
#include "sdk/base/lanes.h"

#include <cstring>

namespace anicodec {
namespace {

uint32_t value_size(anic_value_format format) {
  switch (format) {
    case ANIC_VALUE_FLOAT32:
      return 4;
    case ANIC_VALUE_UNORM8:
      return 1;
    default:
      return 2;
  }
}

/// round(largest x) for x clamped to 0 .. 1.
uint32_t normalised(float x, float largest) {
  x = x > 0 ? x : 0;
  x = x < 1 ? x : 1;
  return static_cast<uint32_t>(x * largest + 0.5F);
}

void store_value(float x, anic_value_format format, unsigned char* to) {
  switch (format) {
    case ANIC_VALUE_FLOAT32:
      std::memcpy(to, &x, sizeof x);
      break;
    case ANIC_VALUE_UNORM8:
      *to = static_cast<unsigned char>(normalised(x, 255));
      break;
    case ANIC_VALUE_UNORM16:
    case ANIC_VALUE_FLOAT16: {
      const auto bits = static_cast<uint16_t>(
          format == ANIC_VALUE_UNORM16 ? normalised(x, 65535)
                                       : static_cast<uint32_t>(half_bits<float, int32_t>(x)));
      std::memcpy(to, &bits, sizeof bits);
      break;
    }
  }
}

}  // namespace

Status ValueOutput::make(const anic_value_output& out, uint32_t components, uint32_t count,
                         ValueOutput* result) {
  if (out.format < ANIC_VALUE_FLOAT32 || out.format > ANIC_VALUE_UNORM16 ||
      (!out.data && count > 0) || out.components > kMaxAttributeComponents)
    return Status::kArgument;
  result->given_ = components;
  result->stored_ = out.components == 0 ? components : out.components;
  result->format_ = out.format;
  const size_t element = size_t{value_size(out.format)} * result->stored_;
  result->stride_ = out.stride == 0 ? element : out.stride;
  if (result->stride_ < element)
    return Status::kArgument;
  // size >= stride * (count - 1) + element, without wrapping
  if (count > 0 &&
      (out.size < element || (out.size - element) / result->stride_ < size_t{count} - 1))
    return Status::kBufferSize;
  if (count <= 1)
    result->stride_ = element;  // no step is taken: a huge one would lead past every address
  result->at_ = static_cast<unsigned char*>(out.data);
  return Status::kOk;
}

void ValueOutput::store(const float* values, uint32_t count) {
  constexpr uint32_t kAlpha = 3;
  const uint32_t size = value_size(format_);
  for (uint32_t i = 0; i < count; ++i, at_ += stride_, values += given_) {
    for (uint32_t c = 0; c < stored_; ++c) {
      const float missing = c == kAlpha ? 1 : 0;
      store_value(c < given_ ? values[c] : missing, format_, at_ + size_t{size} * c);
    }
  }
}

}  // namespace anicodec
