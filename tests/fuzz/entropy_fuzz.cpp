// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes through the entropy decoders. The first byte picks the model, the second its size.
// Numbers that a decoder accepts, the encoder writes again, byte for byte.
#include "format/coding/binary_coder.h"
#include "format/coding/coefficient_model.h"
#include "format/coding/rans_coder.h"
#include "format/coding/symbol_model.h"
#include "format/coding/time_weights.h"
#include "tests/fuzz/fuzz_neighbours.h"

#include <cstdlib>
#include <vector>

using namespace anicodec;

namespace {

void require(bool condition) {
  if (!condition)
    std::abort();
}

bool same(const Vector<uint8_t>& bytes, const uint8_t* data, size_t size) {
  return bytes == Vector<uint8_t>(data, data + size);
}

void fuzz_integers(size_t count, const uint8_t* data, size_t size) {
  BinaryDecoder decoder(data, size);
  BinaryEncoder encoder;
  SymbolModel<> read, write;
  for (size_t i = 0; i < count; ++i)
    write.code(encoder, read.code(decoder));
  require(decoder.finish() == same(encoder.finish(), data, size));
}

void fuzz_coefficients(uint32_t channels, uint32_t vertices, const uint8_t* data, size_t size) {
  constexpr uint32_t kStride = FuzzNeighbours::kStride, kComponents = 4;
  const FuzzNeighbours neighbours(vertices);
  RansDecoder decoder({data, size});
  RansEncoder encoder;
  CoefficientModel read(channels, neighbours.ranks.data(), kStride, neighbours.levels);
  CoefficientModel write(channels, neighbours.ranks.data(), kStride, neighbours.levels);
  std::vector<int32_t> q(size_t{vertices} * channels);
  for (uint32_t j = 0; j < kComponents; ++j) {
    read.code_component(decoder, q.data());
    for (const int32_t value : q)
      require(std::abs(value) < kCoefficientLimit);
    if (!decoder.ok())
      return;
    write.code_component(encoder, q.data());
  }
  if (decoder.finish())
    require(same(encoder.finish(), data, size));
}

void fuzz_weights(uint32_t frames, const uint8_t* data, size_t size) {
  constexpr int64_t kLimit = int64_t{kWeightLimit} << kWeightFractionBits;
  BinaryDecoder decoder(data, size);
  TimeWeightModel model(frames);
  std::vector<int32_t> values(size_t{3} * frames);
  for (const uint32_t channels : {3u, 1u, 3u, 1u}) {
    if (model.decode(decoder, channels, values.data()) != Status::kOk)
      return;
    for (const int32_t value : values)
      require(std::abs(int64_t{value}) <= kLimit);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2)
    return 0;
  const uint32_t count = data[1];
  switch (data[0] % 4) {
    case 0:
      fuzz_integers(count, data + 2, size - 2);
      break;
    case 1:
      fuzz_coefficients(1, count, data + 2, size - 2);
      break;
    case 2:
      fuzz_coefficients(3, count, data + 2, size - 2);
      break;
    default:
      fuzz_weights(count, data + 2, size - 2);
      break;
  }
  return 0;
}
