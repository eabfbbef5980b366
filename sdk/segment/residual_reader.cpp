// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/residual_reader.h"

#include "format/coding/batch_coefficient_coder.h"
#include "format/coding/coefficient_coder.h"
#include "format/coding/rans_coder.h"
#include "sdk/base/wavefront.h"

#include <algorithm>
#include <optional>

namespace anicodec {
namespace {

/// Calls read(place of component j in a room).
template <class Read>
bool read_into(const ResidualRoom& room, uint32_t j, size_t of_component, const Read& read) {
  return j < room.wide_components ? read(room.wide + j * of_component)
                                  : read(room.narrow + (j - room.wide_components) * of_component);
}

/// Streams of CoefficientModel, one for each slice.
class MixingReader {
 public:
  MixingReader(const SegmentContext& context, const VertexOrder& order, uint32_t channels,
               uint32_t slices)
      : context_(context),
        ranks_(static_cast<uint32_t>(order.vertex_count())),
        channels_(channels),
        slices_(slices),
        model_(ranks_, channels, order.neighbours.data(),
               static_cast<uint32_t>(order.neighbour_count), slices) {}

  /// Reads the first `count` components of a layer. Threads meet after a few components of each
  /// slice, so that the host hears of it.
  Status read(const BasisLayer& layer, uint32_t count, const ResidualRoom& room) {
    Vector<BinaryDecoder> decoders;
    for (uint32_t s = 0; s < slices_; ++s)
      decoders.emplace_back(layer.slices[s].data, layer.slices[s].size);
    const size_t of_component = size_t{channels_} * ranks_;
    const bool shared = slices_ > 1 && context_.threads.run;
    const uint32_t together = shared ? kTogether * slices_ : 1;
    for (uint32_t done = 0; done < count; done += together) {
      const uint32_t rows = std::min(together, count - done);
      const auto work = [&](uint32_t row, uint32_t first, uint32_t last) {
        const uint32_t j = model_.component() + row;
        BinaryDecoder& stream = decoders[j % slices_];
        BinaryDecoder local = stream;  // a copy that nothing else points to stays in registers
        const bool good =
            read_into(room, layer.first + done + row, of_component,
                      [&](auto* to) { return model_.code_ranks(local, j, first, last, to); });
        stream = local;
        return good;
      };
      if (!Wavefront(slices_, rows, ranks_, shared ? kRanks : ranks_, work).run(context_.threads))
        return Status::kEntropy;
      model_.end_components(rows);
      if (!context_.advance(rows * of_component))
        return Status::kCancelled;
    }
    if (count == layer.count) {
      for (const BinaryDecoder& decoder : decoders) {
        if (!decoder.finish())
          return Status::kEntropy;
      }
    }
    return Status::kOk;
  }

 private:
  static constexpr uint32_t kTogether = 4;  ///< components of a slice
  static constexpr uint32_t kRanks = 256;   ///< by which slices follow one another

  const SegmentContext& context_;
  uint32_t ranks_, channels_, slices_;
  CoefficientModel model_;
};

/// Streams of BatchCoefficientModel.
class BatchReader {
 public:
  BatchReader(const SegmentContext& context, const VertexOrder& order, uint32_t channels, uint32_t)
      : context_(context),
        of_component_(size_t{channels} * order.vertex_count()),
        model_(channels, order.neighbours.data(), static_cast<uint32_t>(order.neighbour_count),
               order.level_start) {}

  Status read(const BasisLayer& layer, uint32_t count, const ResidualRoom& room) {
    RansDecoder decoder(layer.slices[0]);
    for (uint32_t j = layer.first; j < layer.first + count; ++j) {
      const bool good = read_into(room, j, of_component_, [&](auto* to) {
        model_.code_component(decoder, to);
        return decoder.ok();
      });
      if (!good)
        return Status::kEntropy;
      if (!context_.advance(of_component_))
        return Status::kCancelled;
    }
    return count < layer.count || decoder.finish() ? Status::kOk : Status::kEntropy;
  }

 private:
  const SegmentContext& context_;
  size_t of_component_;
  BatchCoefficientModel model_;
};

template <class Reader>
Status read_by(const SegmentContext& context, const LinearParameters& parameters,
               const VertexOrder& order, uint32_t channels, const Vector<BasisLayer>& layers,
               uint32_t wanted, const ResidualRoom& room) {
  std::optional<Reader> reader;
  for (const BasisLayer& layer : layers) {
    if (layer.count == 0)
      continue;
    if (!reader || parameters.layers_anew)
      reader.emplace(context, order, channels, parameters.slices);
    if (Status s = reader->read(layer, std::min(layer.count, wanted - layer.first), room);
        s != Status::kOk)
      return s;
  }
  return Status::kOk;
}

}  // namespace

Status read_residuals(const SegmentContext& context, const LinearParameters& parameters,
                      const VertexOrder& order, uint32_t channels,
                      const Vector<BasisLayer>& layers, uint32_t wanted, const ResidualRoom& room) {
  const auto read = parameters.coder == CoefficientCoder::kBatches ? read_by<BatchReader>
                                                                   : read_by<MixingReader>;
  return read(context, parameters, order, channels, layers, wanted, room);
}

}  // namespace anicodec
