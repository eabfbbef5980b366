// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/coefficient_slices.h"

#include "codec/sequence/error.h"
#include "format/coding/binary_coder.h"
#include "format/coding/coefficient_coder.h"
#include "sdk/segment/region_coding.h"
#include "sdk/segment/residual_reader.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>

namespace anicodec {
namespace {

void require(Status status) {
  if (status != Status::kOk)
    throw Error(ErrorKind::kInternal, "the encoded coefficients cannot be read");
}

size_t run_count(const EncodedSegment& segment) {
  return std::max<size_t>(segment.runs.size(), 1);
}

}  // namespace

VertexOrder order_of(const EncodedSegment& segment, const LinearParameters& parameters,
                     const Topology& topology) {
  MeshGraph graph;
  require(graph.init(topology.triangles.data(), topology.triangles.size() / 3,
                     topology.coded_vertices));
  Vector<uint8_t> regions;
  require(read_regions(segment.pose, graph, segment.sizes.regions, &regions));
  VertexOrder order;
  require(make_vertex_order(std::move(graph), segment.reference->grid.points.data(),
                            parameters.neighbours, parameters.colours, &order,
                            regions.empty() ? nullptr : regions.data()));
  return order;
}

bool CoefficientSlices::applies_to(const EncodedSegment& segment) {
  if (segment.sizes.kind == BasisKind::kKeyframes || segment.sizes.components == 0)
    return false;
  LinearParameters parameters;
  require(parameters.read(segment.parameters, segment.sizes.components, run_count(segment),
                          segment.sizes.regions));
  return parameters.coder == CoefficientCoder::kMixing;
}

CoefficientSlices::CoefficientSlices(const EncodedSegment& segment, const MeshLayout& layout)
    : segment_(segment),
      channels_(segment.sizes.kind == BasisKind::kEigentrajectories ? 1 : 3) {
  const uint32_t components = segment.sizes.components;
  require(parameters_.read(segment.parameters, components, run_count(segment),
                           segment.sizes.regions));
  order_ = order_of(segment, parameters_, layout.topology);
  const Vector<ByteView> chunks(segment.layers.begin(), segment.layers.end());
  require(read_layers(chunks, parameters_.slices, components, components, &layers_));
  const size_t of_component = size_t{channels_} * order_.vertex_count();
  wide_.resize(segment.sizes.wide_components * of_component);
  narrow_.resize((components - segment.sizes.wide_components) * of_component);
  require(read_residuals(SegmentContext(), parameters_, order_, channels_, layers_, components,
                         {segment.sizes.wide_components, wide_.data(), narrow_.data()}));
}

EncodedSegment CoefficientSlices::in(uint32_t slices) const {
  EncodedSegment result = segment_;
  LinearParameters parameters = parameters_;
  parameters.slices = static_cast<uint8_t>(slices);
  result.parameters = parameters.write();
  result.layers.clear();
  const auto ranks = static_cast<uint32_t>(order_.vertex_count());
  Vector<int32_t> wide = wide_;
  Vector<int16_t> narrow = narrow_;
  const size_t of_component = size_t{channels_} * ranks;
  const uint32_t wide_components = segment_.sizes.wide_components;
  std::optional<CoefficientModel> model;
  for (BasisLayer layer : layers_) {
    if (!model || parameters.layers_anew)
      model.emplace(ranks, channels_, order_.neighbours.data(),
                    static_cast<uint32_t>(order_.neighbour_count), slices);
    std::vector<BinaryEncoder> encoders(slices);
    for (uint32_t j = layer.first; j < layer.first + layer.count; ++j) {
      BinaryEncoder& encoder = encoders[model->slice()];
      if (j < wide_components)
        model->code_component(encoder, wide.data() + j * of_component);
      else
        model->code_component(encoder, narrow.data() + (j - wide_components) * of_component);
    }
    std::vector<Bytes> streams;
    for (BinaryEncoder& encoder : encoders)
      streams.push_back(encoder.finish());
    std::ranges::copy(streams, layer.slices);
    result.layers.push_back(layer.write(slices));
  }
  return result;
}

EncodedSegment CoefficientSlices::within(double growth) const {
  constexpr uint32_t kCounts[] = {8, 4, 2};
  static_assert(kCounts[0] == kMostSlices);
  std::optional<EncodedSegment> found[std::size(kCounts)];
  std::atomic<size_t> best = std::size(kCounts);
  tbb::parallel_for(
      size_t{0}, std::size(kCounts),
      [&](size_t i) {
        if (best < i)
          return;
        EncodedSegment sliced = in(kCounts[i]);
        if (static_cast<double>(sliced.bytes()) > static_cast<double>(segment_.bytes()) + growth)
          return;
        found[i] = std::move(sliced);
        size_t before = best;
        while (i < before && !best.compare_exchange_weak(before, i)) {
        }
      },
      tbb::simple_partitioner());
  return best < std::size(kCounts) ? std::move(*found[best]) : segment_;
}

}  // namespace anicodec
