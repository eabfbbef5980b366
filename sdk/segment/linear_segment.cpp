// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/linear_segment.h"

#include "format/coding/symbol_model.h"
#include "format/coding/time_weights.h"
#include "sdk/base/bounded_float.h"
#include "sdk/segment/affine_functions.h"
#include "sdk/segment/basis_layer.h"
#include "sdk/segment/learnt_segment.h"
#include "sdk/segment/region_coding.h"
#include "sdk/segment/resident_writer.h"
#include "sdk/segment/residual_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

constexpr uint8_t kAffineFlag = 1, kRunStepsFlag = 2, kLayersAnewFlag = 4, kAlikeFlag = 8;
constexpr uint8_t kFlags = kAffineFlag | kRunStepsFlag | kLayersAnewFlag | kAlikeFlag;
constexpr uint8_t kMaxRunStep = 64;
constexpr size_t kSharedRanks = 64;    // of a level, for a thread; whole batches of every kernel
constexpr size_t kHashedRanks = 1024;  // of a block of the hash

/// The factor of the weight step of each frame.
Vector<double> step_factors(const LinearParameters& parameters, const Vector<uint32_t>& runs) {
  Vector<double> factors;
  for (size_t r = 0; r < runs.size(); ++r)
    factors.insert(factors.end(), runs[r],
                   parameters.run_steps.empty()
                       ? 1.0
                       : LinearParameters::sigma_value(parameters.run_steps[r]));
  return factors;
}

/// The edges of the mesh: those that its segments share, or made now.
Status graph_of(const SegmentContext& context, MeshGraph* own, const MeshGraph** out) {
  *out = context.graph ? context.graph : own;
  if (context.graph)
    return Status::kOk;
  const Vector<uint32_t>& triangles = context.topology->triangles;
  return own->init(triangles.data(), triangles.size() / 3, context.topology->coded_vertices);
}

/// Reads the time weights of a segment.
class WeightReader {
 public:
  WeightReader(const LinearParameters& parameters, const Vector<uint32_t>& runs,
               const Segment& segment)
      : parameters_(parameters), runs_(runs), segment_(segment), model_(runs) {}

  /// Block `weights` of a segment: DecodedBasis::affine_weights.
  Status read_bases(ByteView bytes, Vector<int32_t>* values) {
    BinaryDecoder decoder(bytes.data, bytes.size);
    const size_t of_function = size_t{3} * segment_.frames;
    if (parameters_.affine)
      values->resize(segment_.regions * kAffineFunctions * of_function);
    for (size_t b = 0; parameters_.affine && b < kAffineFunctions; ++b) {
      for (size_t r = 0; r < segment_.regions; ++r) {
        int32_t* to = values->data() + (r * kAffineFunctions + b) * of_function;
        if (Status s = model_.decode(decoder, 3, to); s != Status::kOk)
          return s;
      }
    }
    return decoder.finish() ? Status::kOk : Status::kEntropy;
  }

  /// The first `wanted` components: DecodedBasis::weights, 0 where a region has none.
  Status read_components(const Vector<BasisLayer>& layers, uint32_t wanted,
                         Vector<int32_t>* weights) {
    const size_t of_component =
        size_t{segment_.regions} * segment_.frames * segment_.weight_channels();
    weights->resize(of_component * wanted);
    for (const BasisLayer& layer : layers) {
      const uint32_t count = std::min(layer.count, wanted - layer.first);
      if (Status s = read_layer(layer, count, weights->data() + of_component * layer.first);
          s != Status::kOk)
        return s;
    }
    return Status::kOk;
  }

 private:
  Status read_layer(const BasisLayer& layer, uint32_t count, int32_t* to) {
    if (layer.count == 0)
      return Status::kOk;
    if (parameters_.layers_anew && layer.first > 0)
      model_ = TimeWeightModel(runs_);
    BinaryDecoder decoder(layer.weights.data, layer.weights.size);
    const uint32_t channels = segment_.weight_channels();
    for (uint32_t j = layer.first; j < layer.first + count; ++j) {
      for (uint32_t r = 0; r < segment_.regions; ++r, to += size_t{segment_.frames} * channels) {
        if (!parameters_.has_weights(r, j))
          continue;
        if (Status s = model_.decode(decoder, channels, to); s != Status::kOk)
          return s;
      }
    }
    return count < layer.count || decoder.finish() ? Status::kOk : Status::kEntropy;
  }

  const LinearParameters& parameters_;
  const Vector<uint32_t>& runs_;
  const Segment& segment_;
  TimeWeightModel model_;
};

/// Hashes the weights of components in the order in which they are read.
void add_weights(const Vector<int32_t>& weights, uint32_t wanted,
                 const LinearParameters& parameters, const Segment& segment,
                 DecodedIntegers& integers) {
  const size_t rows = size_t{segment.frames} * segment.weight_channels();
  for (uint32_t j = 0; j < wanted; ++j) {
    for (uint32_t r = 0; r < segment.regions; ++r) {
      if (parameters.has_weights(r, j))
        integers.add("weights", weights.data() + (size_t{j} * segment.regions + r) * rows, rows);
    }
  }
}

Status keep_still(const PoseGrid& pose, Segment* out) {
  Affine still;
  for (size_t i = 0; i < 12; ++i) {
    if (!to_float(i % 4 == 3 ? pose.origin[i / 4] : i % 5 == 0 ? pose.step : 0.0, &still.m[i]))
      return Status::kNonFinite;
  }
  out->pose_maps.assign(out->pose_maps.size(), still);
  return Status::kOk;
}

/// Hashes the weights of the bases, as they are read, and makes the maps of the pose in all frames and
/// regions from them. `factors`: of the weight step, for each frame.
Status set_maps(const LinearParameters& parameters, const Vector<int32_t>& weights,
                const Vector<double>& factors, const PoseGrid& pose, const Vector<uint8_t>& regions,
                DecodedIntegers& integers, Segment* out) {
  const size_t frames = out->frames;
  out->pose_maps.resize(frames * out->regions);
  if (!parameters.affine)
    return keep_still(pose, out);
  for (size_t b = 0; b < kAffineFunctions; ++b) {
    for (size_t r = 0; r < out->regions; ++r)
      integers.add("affine weights", weights.data() + (r * kAffineFunctions + b) * 3 * frames,
                   3 * frames);
  }
  const double unit = parameters.weight_step / (1 << kWeightFractionBits);
  for (uint32_t r = 0; r < out->regions; ++r) {
    const int32_t* values = weights.data() + size_t{r} * kAffineFunctions * 3 * frames;
    const AffineFunctions functions = AffineFunctions::of(
        pose.points.data(), pose.points.size() / 3, regions.empty() ? nullptr : regions.data(), r);
    for (size_t f = 0; f < frames; ++f) {
      double w[3][kAffineFunctions], map[12];
      for (size_t axis = 0; axis < 3; ++axis) {
        for (size_t b = 0; b < kAffineFunctions; ++b)
          w[axis][b] = unit * factors[f] * values[(3 * b + axis) * frames + f];
      }
      functions.map(w, map);
      float* m = out->pose_maps[f * out->regions + r].m;
      for (size_t i = 0; i < 12; ++i) {
        if (!to_float(i % 4 == 3 ? map[i] + pose.origin[i / 4] : map[i], &m[i]))
          return Status::kNonFinite;
      }
    }
  }
  return Status::kOk;
}

/// Components in layers; no more than there can be.
uint32_t components_in(const Vector<ByteView>& layers, uint32_t components) {
  uint32_t count = 0;
  for (ByteView layer : layers)
    count += ByteReader(layer).varint32(components - count);
  return count;
}

void show_residuals(const ResidualRoom& room, size_t of_component, uint32_t components,
                    DecodingTrace* trace) {
  const size_t wide = room.wide_components * of_component;
  Vector<int32_t> all(room.wide, room.wide + wide);
  all.insert(all.end(), room.narrow, room.narrow + components * of_component - wide);
  trace->step("residuals", all.data(), all.size());
}

/// Makes the order of the vertices, unless another segment has made it. `graph`: the edges, where they are known.
Status order_vertices(const SegmentContext& context, const LinearParameters& parameters,
                      MeshGraph graph, const Vector<uint8_t>& regions, SharedOrder* out) {
  if (out->is_of(parameters.neighbours, parameters.colours, regions))
    return Status::kOk;
  *out = SharedOrder();  // before another one takes memory
  if (graph.vertex_count() == 0) {
    const MeshGraph* edges = &graph;
    if (Status s = graph_of(context, &graph, &edges); s != Status::kOk)
      return s;
    if (edges != &graph)
      graph = *edges;
  }
  if (Status s = make_vertex_order(std::move(graph), context.pose->points.data(),
                                   parameters.neighbours, parameters.colours, &out->order,
                                   regions.empty() ? nullptr : regions.data(), context.threads);
      s != Status::kOk)
    return s;
  out->colours = parameters.colours;
  out->regions = regions;
  return Status::kOk;
}

/// Decodes the order and the coefficients of the components of `out`, whose arrays have their sizes.
/// `graph`: see order_vertices().
Status decode_coefficients(const SegmentContext& context, const LinearParameters& parameters,
                           const Vector<BasisLayer>& layers, MeshGraph graph,
                           const Vector<uint8_t>& regions, const DecodedIntegers& integers,
                           Segment* out, DecodedBasis* decoded) {
  const int32_t* pose = context.pose->points.data();
  SharedOrder own;
  SharedOrder& shared = context.order ? *context.order : own;
  if (Status s = order_vertices(context, parameters, std::move(graph), regions, &shared);
      s != Status::kOk)
    return s;
  VertexOrder& order = shared.order;
  show(context.trace, "vertex of each rank", order.order);
  show(context.trace, "first rank of each level", order.level_start);
  integers.show("neighbours", order.neighbours.data(), order.neighbours.size());
  // Residuals lie where the coefficients will: a segment has at least as many vertices as are coded.
  const size_t n = order.vertex_count();
  const uint32_t channels = out->channels();
  const ResidualRoom room = {out->wide_components, out->wide.data(), out->narrow.data()};
  std::optional<CoefficientModel> model;
  if (context.continued) {
    if (!context.continued->suits(out->kind, order))
      return Status::kSegment;
    model = context.continued->coefficients[0];
    model->continue_with(order.neighbours.data(), order.level_start);
  }
  if (Status s = read_residuals(context, parameters.layers_anew, order, channels, layers,
                                out->components, room, &model);
      s != Status::kOk)
    return s;
  if (kTraces && context.trace)
    show_residuals(room, n * channels, out->components, context.trace);

  PredictionParameters prediction;
  prediction.channels = static_cast<int>(channels);
  prediction.radius = parameters.radius;
  prediction.schedule = parameters.schedule;
  prediction.alike = parameters.alike;
  PredictionResiduals input;
  input.components = out->components;
  input.wide_components = room.wide_components;
  input.wide = room.wide;
  input.narrow = room.narrow;
  input.omega = parameters.omega.data();
  const size_t samples = size_t{out->components} * channels;
  decoded->coefficients.resize(coefficient_buffer_size(n, samples));
  PredictionLearning learning;
  if (context.continued)
    learning.continued = &context.continued->prediction;
  if (context.learnt) {
    const MemoryScope scope(context.learnt->prediction.get_allocator().memory());
    learning.learnt = &context.learnt->prediction;
    context.learnt->kind = out->kind;
    context.learnt->order = LearntSegment::hash_of(order);
    context.learnt->coefficients.assign(1, *model);
  }
  CoefficientReconstruction reconstruction;
  if (Status s = reconstruction.init(order, pose, prediction, input, decoded->coefficients.data(),
                                     learning);
      s != Status::kOk)
    return s;
  for (size_t l = 0; l < order.level_count(); ++l) {
    const size_t first = order.level_start[l], last = order.level_start[l + 1];
    for_ranges(context.threads, last - first, kSharedRanks,
               [&](size_t begin, size_t end) { reconstruction.run(first + begin, first + end); });
    if (!context.advance(samples * (last - first)))
      return Status::kCancelled;
  }
  decoded->order = context.order ? order.order : std::move(order.order);
  return Status::kOk;
}

/// Hashes the coefficients exactly, by rank, and finds the largest magnitude of each sample. The hash
/// takes hashes of blocks, which do not wait for one another.
Vector<float> hash_coefficients(const DecodedBasis& decoded, size_t samples,
                                DecodedIntegers& integers) {
  const size_t ranks = decoded.order.size(), stride = coefficient_stride(samples);
  Vector<int32_t> exact(samples);
  Vector<float> largest(samples, 0.F);
  for (size_t first = 0; first < ranks; first += kHashedRanks) {
    IntegerHash block;
    for (size_t i = first; i < std::min(ranks, first + kHashedRanks); ++i) {
      const float* row = decoded.coefficients.data() + i * stride;
      for (size_t s = 0; s < samples; ++s) {
        exact[s] = static_cast<int32_t>(row[s] * (1 << kFractionBits));
        largest[s] = std::max(largest[s], std::fabs(row[s]));
      }
      block.add(exact.data(), samples);
      integers.show("coefficients", exact.data(), samples);
    }
    integers.add_block(block);
  }
  return largest;
}

/// Scales the weights of a component and a region, whose coefficients have so many fraction bits.
/// False: one is too large.
bool set_weights(const Vector<int32_t>& weights, const LinearParameters& parameters,
                 const Vector<double>& factors, uint32_t region, uint32_t component, int bits,
                 Segment* out) {
  const size_t channels = out->weight_channels();
  const size_t place = size_t{component} * out->regions + region;
  const double unit = parameters.weight_step / (1 << kWeightFractionBits) /
                      LinearParameters::sigma_value(parameters.sigma[place]) *
                      parameters.basis_step / (1 << bits);
  const int32_t* w = weights.data() + place * channels * out->frames;
  for (size_t f = 0; f < out->frames; ++f) {
    float* to =
        &out->weights[((f * out->regions + region) * out->components + component) * channels];
    for (size_t c = 0; c < channels; ++c) {
      if (!to_float(unit * factors[f] * w[c * out->frames + f], to + c))
        return false;
    }
  }
  return true;
}

/// Puts the coefficients into the resident blocks, each component with as many fraction bits as
/// fit, and scales its weights accordingly. `largest`: magnitudes by sample.
Status make_resident(const DecodedBasis& decoded, const Vector<float>& largest,
                     const LinearParameters& parameters, const Vector<double>& factors,
                     ResidentWriter& writer, Segment* out) {
  uint32_t channels = out->channels(), weight_channels = out->weight_channels();
  Vector<float> scale(size_t{out->components} * channels);
  out->weights.resize(size_t{out->frames} * out->regions * out->components * weight_channels);
  for (uint32_t j = 0; j < out->components; ++j) {
    const float* of_component = largest.data() + size_t{channels} * j;
    const float most = *std::max_element(of_component, of_component + channels);
    int bits = kFractionBits;
    if (j >= out->wide_components) {
      while (bits > 0 && most * static_cast<float>(1 << bits) > 32767)
        --bits;
      if (most * static_cast<float>(1 << bits) > 32767)
        return Status::kQuantizer;
    }
    for (uint32_t c = 0; c < channels; ++c)
      scale[size_t{j} * channels + c] = static_cast<float>(1 << bits);
    for (uint32_t r = 0; r < out->regions; ++r) {
      if (!set_weights(decoded.weights, parameters, factors, r, j, bits, out))
        return Status::kNonFinite;
    }
  }
  Vector<uint32_t> rank(decoded.order.size());
  for (uint32_t i = 0; i < rank.size(); ++i)
    rank[decoded.order[i]] = i;
  writer.samples(rank, decoded.coefficients.data(), coefficient_stride(scale.size()), scale.data());
  return Status::kOk;
}

}  // namespace

double LinearParameters::sigma_value(int32_t eighths) {
  constexpr double kRoots[8] = {1.0,
                                1.0905077326652577,
                                1.1892071150027210,
                                1.2968395546510096,
                                1.4142135623730951,
                                1.5422108254079407,
                                1.6817928305074290,
                                1.8340080864093424};
  return std::ldexp(kRoots[eighths & 7], eighths >> 3);
}

int32_t LinearParameters::sigma_eighths(double sigma) {
  return static_cast<int32_t>(std::lround(8 * std::log2(sigma)));
}

Bytes LinearParameters::write() const {
  ByteWriter w;
  w.u8(static_cast<uint8_t>((affine ? kAffineFlag : 0) | (run_steps.empty() ? 0 : kRunStepsFlag) |
                            (layers_anew ? kLayersAnewFlag : 0) | (alike ? kAlikeFlag : 0)));
  w.f64(basis_step);
  w.f64(weight_step);
  for (uint8_t x : {neighbours, colours, radius, static_cast<uint8_t>(schedule)})
    w.u8(x);
  if (alike)
    w.u8(alike);
  for (uint8_t step : run_steps)
    w.u8(step);
  // The components' table: what changes little from one to the next.
  BinaryEncoder encoder;
  UnsignedModel fewer_model;
  for (uint32_t count : region_components)
    fewer_model.code(encoder, static_cast<int32_t>(omega.size() - count));
  SymbolModel<> omega_model, sigma_model;
  int32_t last_omega = 128, last_sigma[kMaxRegions] = {};
  for (size_t j = 0; j < omega.size(); ++j) {
    omega_model.code(encoder, omega[j] - last_omega);
    last_omega = omega[j];
    for (uint32_t r = 0; r < regions(); ++r) {
      if (!has_weights(r, j))
        continue;
      const int32_t s = sigma[j * regions() + r];
      sigma_model.code(encoder, s - last_sigma[r]);
      last_sigma[r] = s;
    }
  }
  w.raw(encoder.finish());
  return std::move(w.bytes());
}

Status LinearParameters::read(ByteView bytes, uint32_t components, size_t runs,
                              uint32_t region_count) {
  ByteReader r(bytes);
  uint8_t flags = r.u8();
  affine = flags & kAffineFlag;
  layers_anew = flags & kLayersAnewFlag;
  basis_step = r.f64();
  weight_step = r.f64();
  neighbours = r.u8();
  colours = r.u8();
  radius = r.u8();
  uint8_t id = r.u8();
  schedule = static_cast<RefitSchedule>(id);
  alike = flags & kAlikeFlag ? r.u8() : 0;
  if (!r.ok() || (flags & ~kFlags))
    return Status::kRecord;
  if (!(std::isfinite(basis_step) && basis_step > 0) ||
      !(std::isfinite(weight_step) && weight_step > 0) || neighbours < 8 ||
      neighbours > kMaxNeighbours || neighbours % 4 != 0 || colours == 0 || colours > kMaxColours ||
      radius == 0 || id >= kRefitScheduleCount || ((flags & kAlikeFlag) && alike == 0))
    return Status::kQuantizer;
  run_steps.clear();
  if (flags & kRunStepsFlag) {
    if (r.remaining() < runs)
      return Status::kRecord;
    run_steps.resize(runs);
    for (uint8_t& step : run_steps) {
      step = r.u8();
      if (step > kMaxRunStep)
        return Status::kQuantizer;
    }
  }
  ByteView stream = r.raw(r.remaining());
  BinaryDecoder decoder(stream.data, stream.size);
  UnsignedModel fewer_model;
  region_components.resize(region_count > 1 ? region_count : 0);
  for (uint32_t& count : region_components) {
    const auto fewer = static_cast<uint32_t>(fewer_model.code(decoder));
    if (fewer > components)
      return Status::kQuantizer;
    count = components - fewer;
  }
  SymbolModel<> omega_model, sigma_model;
  int32_t last_omega = 128, last_sigma[kMaxRegions] = {};
  omega.resize(components);
  sigma.clear();
  sigma.resize(size_t{components} * region_count);
  for (uint32_t j = 0; j < components; ++j) {
    const int64_t o = int64_t{last_omega} + omega_model.code(decoder);
    bool in_range = o >= 0 && o <= 255;
    for (uint32_t region = 0; region < region_count; ++region) {
      if (!has_weights(region, j))
        continue;
      int32_t& last = last_sigma[region];
      const int64_t s = int64_t{last} + sigma_model.code(decoder);
      in_range &= s >= -8000 && s <= 8000;
      sigma[size_t{j} * region_count + region] = last = in_range ? static_cast<int32_t>(s) : 0;
    }
    if (!decoder.ok())
      return Status::kEntropy;
    if (!in_range)
      return Status::kQuantizer;
    omega[j] = static_cast<uint8_t>(last_omega = static_cast<int32_t>(o));
  }
  return decoder.finish() ? Status::kOk : Status::kEntropy;
}

Status open_linear_segment(const SegmentRecord& record, const SegmentContext& context,
                           DecodedIntegers& integers, Segment* out) {
  LinearParameters parameters;
  uint32_t components = context.sizes->components;
  const Vector<uint32_t> runs =
      context.runs.empty() ? Vector<uint32_t>(1, out->frames) : context.runs;
  if (Status s =
          parameters.read(record.parameters, components, runs.size(), context.sizes->regions);
      s != Status::kOk)
    return s;
  if (record.motion.size != 0)
    return Status::kRecord;
  const bool learns = context.sizes->learns;
  if (learns && (parameters.layers_anew || parameters.neighbours > kMostLearningNeighbours))
    return Status::kSegment;
  if (!context.pose)
    return Status::kChunkMissing;
  const Topology& topology = *context.topology;
  size_t n = topology.coded_vertices;
  const PoseGrid& pose = *context.pose;
  integers.add("pose", pose.points.data(), pose.points.size());
  uint32_t wanted = learns ? components : wanted_components(context.quality, components);
  if (context.partial)
    wanted = std::min(wanted, components_in(context.layers, components));
  MeshGraph own;
  const MeshGraph* graph = &own;
  if (context.sizes->regions > 1) {
    if (Status s = graph_of(context, &own, &graph); s != Status::kOk)
      return s;
  }
  Vector<uint8_t> regions;
  if (Status s = read_regions(record.pose, *graph, context.sizes->regions, &regions);
      s != Status::kOk)
    return s;
  if (!regions.empty()) {
    Vector<int32_t> hashed(n);
    std::copy_n(regions.data(), n, hashed.data());
    integers.add("regions", hashed.data(), n);
  }

  Vector<BasisLayer> layers;
  if (Status s = read_layers(context.layers, components, wanted, &layers); s != Status::kOk)
    return s;
  const Vector<double> factors = step_factors(parameters, runs);
  const auto use_bases = [&](const Vector<int32_t>& affine_weights) {
    return set_maps(parameters, affine_weights, factors, pose, regions, integers, out);
  };
  DecodedBasis own_decoded;
  Status status = Status::kOk;
  if (context.decoded) {
    status = use_bases(context.decoded->affine_weights);
  } else {
    WeightReader reader(parameters, runs, *out);
    status = reader.read_bases(record.weights, &own_decoded.affine_weights);
    if (status == Status::kOk)
      status = use_bases(own_decoded.affine_weights);
    own_decoded.affine_weights = Vector<int32_t>();  // before others take memory
    if (status == Status::kOk)
      status = reader.read_components(layers, wanted, &own_decoded.weights);
  }
  if (status != Status::kOk)
    return status;
  const DecodedBasis& decoded = context.decoded ? *context.decoded : own_decoded;
  add_weights(decoded.weights, wanted, parameters, *out, integers);
  out->components = wanted;
  out->wide_components = std::min(out->wide_components, wanted);
  if (wanted == 0 && components > 0 && !context.partial)
    return Status::kSegment;
  ResidentWriter writer(context.vertex_coded, out);
  writer.pose(pose.points.data());
  if (!regions.empty())
    writer.regions(regions);
  if (wanted == 0)
    return Status::kOk;
  if (!context.decoded) {
    if (Status s = decode_coefficients(context, parameters, layers, std::move(own), regions,
                                       integers, out, &own_decoded);
        s != Status::kOk)
      return s;
  }
  const Vector<float> largest =
      hash_coefficients(decoded, size_t{wanted} * out->channels(), integers);
  return make_resident(decoded, largest, parameters, factors, writer, out);
}

}  // namespace anicodec
