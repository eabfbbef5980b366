// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/residual_reader.h"

#include "format/batch_coefficient_coder.h"
#include "format/coefficient_coder.h"
#include "format/rans_coder.h"

#include <optional>

namespace anicodec {
namespace {

/// Streams of CoefficientModel, which has the channels of a vertex side by side.
class MixingReader {
 public:
  using Decoder = BinaryDecoder;

  MixingReader(const VertexOrder& order, uint32_t channels)
      : n_(static_cast<uint32_t>(order.vertex_count())),
        channels_(channels),
        model_(n_, channels, order.neighbours.data(), static_cast<uint32_t>(order.neighbour_count)),
        interleaved_(channels == 1 ? 0 : size_t{channels} * n_) {}

  static Decoder begin(ByteView stream) { return {stream.data, stream.size}; }

  void read(Decoder& decoder, int32_t* to) {
    if (channels_ == 1) {
      model_.code_component(decoder, to);
      return;
    }
    model_.code_component(decoder, interleaved_.data());
    for (uint32_t i = 0; i < n_; ++i)
      for (uint32_t c = 0; c < channels_; ++c)
        to[size_t{c} * n_ + i] = interleaved_[size_t{i} * channels_ + c];
  }

 private:
  uint32_t n_, channels_;
  CoefficientModel model_;
  Vector<int32_t> interleaved_;
};

/// Streams of BatchCoefficientModel.
class BatchReader {
 public:
  using Decoder = RansDecoder;

  BatchReader(const VertexOrder& order, uint32_t channels)
      : model_(channels, order.neighbours.data(), static_cast<uint32_t>(order.neighbour_count),
               order.level_start) {}

  static Decoder begin(ByteView stream) { return Decoder(stream); }

  void read(Decoder& decoder, int32_t* to) { model_.code_component(decoder, to); }

 private:
  BatchCoefficientModel model_;
};

template <class Reader>
Status read_layers(const SegmentContext& context, bool anew, const VertexOrder& order,
                   uint32_t channels, uint32_t components, uint32_t wanted, int32_t* residuals) {
  const size_t of_component = size_t{channels} * order.vertex_count();
  std::optional<Reader> reader;
  uint32_t j = 0;
  for (ByteView layer : context.layers) {
    ByteReader bytes(layer);
    const uint32_t count = bytes.varint32(components - j);
    if (!bytes.ok())
      return Status::kRecord;
    if (!reader || anew)
      reader.emplace(order, channels);
    typename Reader::Decoder decoder = Reader::begin(bytes.raw(bytes.remaining()));
    for (uint32_t end = j + count; j < end; ++j) {
      if (j == wanted)
        return Status::kOk;
      reader->read(decoder, residuals + j * of_component);
      if (!decoder.ok())
        return Status::kEntropy;
      if (!context.advance(of_component))
        return Status::kCancelled;
    }
    if (!decoder.finish())
      return Status::kEntropy;
  }
  return j == wanted ? Status::kOk : Status::kChunkMissing;
}

}  // namespace

Status read_residuals(const SegmentContext& context, const LinearParameters& parameters,
                      const VertexOrder& order, uint32_t channels, uint32_t components,
                      uint32_t wanted, Vector<int32_t>* residuals) {
  residuals->resize(size_t{wanted} * channels * order.vertex_count());
  const auto read = parameters.coder == CoefficientCoder::kBatches ? read_layers<BatchReader>
                                                                   : read_layers<MixingReader>;
  return read(context, parameters.layers_anew, order, channels, components, wanted,
              residuals->data());
}

}  // namespace anicodec
