// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/conformance/vector_recipes.h"

#include "codec/encode.h"
#include "codec/file/clip_file.h"
#include "codec/file/clip_record.h"
#include "codec/metrics/metrics.h"
#include "codec/search/encoder_input.h"
#include "codec/segment/linear_segment_encode.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/bytes.h"
#include "format/coding/binary_coder.h"
#include "format/coding/coefficient_model.h"
#include "format/coding/rans_coder.h"
#include "format/coding/time_weights.h"
#include "sdk/clip/sample.h"
#include "sdk/pose/exact_pose.h"
#include "sdk/pose/pose_coding.h"
#include "sdk/prediction/vertex_order.h"
#include "sdk/segment/basis_layer.h"
#include "sdk/segment/keyframe_segment.h"
#include "sdk/segment/linear_segment.h"
#include "sdk/segment/region_coding.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {

Bytes file_of(MeshSequence clip, const std::vector<Recipe>& recipes,
              const std::function<void(ClipsRecord&)>& describe, const MeshLayout* layout) {
  const double clip_diagonal = diagonal(clip);
  const MeshSequence source = clip;
  ClipsRecord record =
      clips_record(clip, {}, std::vector<ClipGoal>(clips_of(clip).size(), {{}, {}, clip_diagonal}));
  const EncoderInput input(std::move(clip), {}, layout);
  std::vector<EncodedSegment> segments;
  uint32_t first = 0;
  for (const Recipe& recipe : recipes) {
    const FrameView frames = input.frames(first, recipe.frames);
    const LinearAnalysis analysis(frames);
    const bool shapes = recipe.kind == BasisKind::kEigenshapes;
    // The search for few leading ones is quick, whatever the number of frames.
    const size_t most = recipe.frames > 1000 ? std::ranges::max(recipe.settings.components) : 1000;
    const LinearBasis basis =
        recipe.region_of
            ? RegionAnalysis(
                  std::make_shared<const RegionClips>(
                      frames, recipe.region_of(input.layout.sizes.coded_vertices), recipe.regions),
                  std::make_shared<const Eigen::MatrixXd>(analysis.space_of_trajectories(1000)))
                  .basis(analysis, ReferencePose::kRankThree, 1000)
            : analysis.basis(recipe.kind, shapes ? ReferencePose::kMean : ReferencePose::kRankThree,
                             shapes ? Base::kPose : Base::kAffine, most, 0);
    std::optional<EncodedSegment> coded = encode_linear(
        frames, basis, recipe.settings, input.layout,
        encode_pose_by(nullptr, basis.pose, basis.origin, pose_step(recipe.settings, recipe.frames),
                       CornerTable(input.layout.topology)),
        input.runs(first, recipe.frames));
    if (!coded)
      throw Error(ErrorKind::kInternal, "the step is too fine");
    EncodedSegment& segment = segments.emplace_back(std::move(*coded));
    segment.sizes.first_frame = first;
    segment.decoded.reset();  // changes are to be decoded, too
    if (recipe.change)
      recipe.change(segment, input);
    open_encoded(segment, input.layout);
    first += recipe.frames;
  }
  std::vector<const EncodedSegment*> list;
  for (const EncodedSegment& segment : segments)
    list.push_back(&segment);
  if (describe)
    describe(record);
  Clip opened;
  if (Failure f = opened.open(clip_file(record, input.layout, list)); !f.ok())
    throw Error(ErrorKind::kInternal, f.detail);
  MeshSequence shown = source;
  for (uint32_t f = 0; f < source.frame_count; ++f)
    show_positions(opened, 0, f, shown.frame(f).data());
  CompareOptions options;
  options.sted = false;
  const Comparison measured = compare(source, shown, options);
  for (ClipRecord& of_clip : record.clips) {  // of the whole, which every clip then keeps
    of_clip.max_error = measured.max_error;
    of_clip.rmse = measured.rmse;
    of_clip.kg = measured.kg;
  }
  return clip_file(record, input.layout, list);
}

Recipe recipe(uint32_t frames, BasisKind kind, double step, uint8_t neighbours, uint8_t passes,
              uint8_t radius, RefitSchedule schedule) {
  Recipe r;
  r.frames = frames;
  r.kind = kind;
  r.settings.step = step;
  r.settings.neighbours = neighbours;
  r.settings.passes_per_level = passes;
  r.settings.radius = radius;
  r.settings.schedule = schedule;
  return r;
}

MeshSequence hub() {
  constexpr uint32_t kSpokes = 70, kLoose = 90, kFrames = 9;
  MeshSequence clip;
  clip.name = "hub";
  clip.vertex_count = 2 * kSpokes + 1 + kLoose;
  clip.frame_count = kFrames;
  for (uint32_t i = 0; i < kSpokes; ++i) {
    const uint32_t a = 1 + i, b = 1 + (i + 1) % kSpokes;
    clip.polygons.add(std::vector<uint32_t>{0, a, b});
    clip.polygons.add(std::vector<uint32_t>{a, a + kSpokes, b + kSpokes, b});
  }
  Numbers numbers;
  std::vector<float> rest;
  for (uint32_t v = 0; v < clip.vertex_count; ++v) {
    const double angle = 2 * 3.14159265358979 * (v - 1) / kSpokes, r = v == 0        ? 0
                                                                       : v > kSpokes ? 2
                                                                                     : 1;
    const bool loose = v > 2 * kSpokes;
    const double places[3] = {loose ? numbers.within(2000) / 1000.0 : r * std::cos(angle),
                              loose ? numbers.within(2000) / 1000.0 : r * std::sin(angle),
                              loose ? numbers.within(2000) / 1000.0 : 0.25 * r};
    for (const double x : places)
      rest.push_back(static_cast<float>(std::round(x * 4096) / 4096));
  }
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (size_t i = 0; i < rest.size(); ++i) {
      const double swing =
          0.05 * numbers.within(100) / 100.0 + 0.01 * f * static_cast<double>(i % 5);
      clip.positions.push_back(rest[i] + static_cast<float>(std::round(swing * 4096) / 4096));
    }
  }
  return clip;
}

MeshSequence rings() {
  constexpr uint32_t kPairs = 10, kFrames = 7;
  MeshSequence clip;
  clip.name = "rings";
  clip.frame_count = kFrames;
  Numbers numbers;
  std::vector<float> rest;
  const auto vertex = [&](double x, double y, double z) {
    for (const double p : {x, y, z})
      rest.push_back(static_cast<float>(std::round(p * 4096) / 4096));
    return clip.vertex_count++;
  };
  for (uint32_t pair = 0; pair < kPairs; ++pair) {
    const double centre = 4.0 * pair;
    uint32_t hubs[2];
    for (uint32_t& hub : hubs)
      hub = vertex(centre + 0.001 * numbers.within(9), 0.001 * numbers.within(9), 0);
    for (uint32_t side = 0; side < 2; ++side) {
      // Spokes of one hub: 18 to 45, about half of the hubs over each limit of degrees.
      const uint32_t spokes = 18 + (7 * pair + 13 * side) % 28;
      uint32_t first = 0, last = 0;
      for (uint32_t i = 0; i < spokes; ++i) {
        const double angle = 3.14159265358979 * (side + (i + 0.5) / spokes);
        const double radius = 0.5 + 0.01 * numbers.below(100);
        const uint32_t next = vertex(centre + radius * std::cos(angle), radius * std::sin(angle),
                                     0.01 * numbers.within(30));
        if (i == 0)
          first = next;
        else
          clip.polygons.add(std::vector<uint32_t>{hubs[side], last, next});
        last = next;
      }
      clip.polygons.add(std::vector<uint32_t>{hubs[side], last, hubs[1 - side]});
      clip.polygons.add(std::vector<uint32_t>{hubs[side], hubs[1 - side], first});
    }
  }
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (size_t i = 0; i < rest.size(); ++i) {
      const double swing =
          0.05 * numbers.within(100) / 100.0 + 0.01 * f * static_cast<double>(i % 5);
      clip.positions.push_back(rest[i] + static_cast<float>(std::round(swing * 4096) / 4096));
    }
  }
  return clip;
}

MeshSequence cliques(uint32_t size) {
  constexpr uint32_t kCliques = 3, kFrames = 4;
  MeshSequence clip;
  clip.name = "cliques";
  clip.vertex_count = kCliques * size;
  clip.frame_count = kFrames;
  for (uint32_t clique = 0; clique < kCliques; ++clique) {
    const uint32_t first = clique * size;
    for (uint32_t a = 0; a < size; ++a) {
      for (uint32_t b = a + 1; b < size; ++b) {
        uint32_t c = (a + b) % size;
        while (c == a || c == b)
          c = (c + 1) % size;
        clip.polygons.add(std::vector<uint32_t>{first + a, first + b, first + c});
      }
    }
  }
  Numbers numbers;
  std::vector<float> rest;
  for (uint32_t i = 0; i < 3 * clip.vertex_count; ++i)
    rest.push_back(static_cast<float>(numbers.within(4096)) / 4096 +
                   (i % 3 == 0 ? static_cast<float>(i / (3 * size)) * 2 : 0));
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (const float x : rest)
      clip.positions.push_back(x + static_cast<float>(numbers.within(200)) / 4096);
  }
  return clip;
}

MeshSequence turned_pair(uint32_t vertices, uint32_t frames) {
  MeshSequence clip = corpus::make_scaled("limb", vertices, frames);
  const uint32_t n = clip.vertex_count;
  FrameArray both;
  for (uint32_t f = 0; f < frames; ++f) {
    const auto one = clip.frame(f);
    both.insert(both.end(), one.begin(), one.end());
    for (uint32_t v = 0; v < n; ++v) {
      both.push_back(5 - one[3 * v]);
      both.push_back(-one[3 * v + 1]);
      both.push_back(one[3 * v + 2]);
    }
  }
  const size_t polygons = clip.polygons.size();
  for (size_t p = 0; p < polygons; ++p) {
    std::vector<uint32_t> polygon(clip.polygons[p].begin(), clip.polygons[p].end());
    for (uint32_t& v : polygon)
      v += n;
    clip.polygons.add(polygon);
  }
  clip.name = "turned";
  clip.vertex_count = 2 * n;
  clip.positions = both;
  return clip;
}

namespace {

PosePartners random_partners(uint32_t n) {
  Numbers numbers;
  PosePartners partners;
  uint32_t ahead = 1;
  for (uint32_t v = 0; v < n; ++v) {
    if (numbers.below(3) == 0)
      ahead = 1 + numbers.below(n);
    const uint32_t kind = numbers.below(8);
    partners.partner.push_back(kind == 0 ? PosePartners::kNone : kind == 1 ? v : (v + ahead) % n);
    partners.flips.push_back(static_cast<uint8_t>(numbers.below(8)));
  }
  return partners;
}

}  // namespace

void with_partners(EncodedSegment& segment, const EncoderInput& input) {
  auto pose = std::make_shared<EncodedPose>(*segment.reference);
  const PosePartners partners = random_partners(input.layout.topology.coded_vertices);
  pose->stream = encode_pose(CornerTable(input.layout.topology), PoseSteps::kDependent,
                             pose->grid.points, &partners);
  segment.reference = std::move(pose);
}

void exactly_with_partners(EncodedSegment& segment, const EncoderInput& input) {
  auto pose = std::make_shared<EncodedPose>(*segment.reference);
  const PosePartners partners = random_partners(input.layout.topology.coded_vertices);
  pose->stream =
      encode_exact_pose(CornerTable(input.layout.topology), pose->grid.points, &partners);
  segment.reference = std::move(pose);
}

StreamChange with_turned_partners(bool many_strands) {
  return [many_strands](EncodedSegment& segment, const EncoderInput& input) {
    auto pose = std::make_shared<EncodedPose>(*segment.reference);
    const uint32_t n = input.layout.topology.coded_vertices;
    Numbers numbers;
    PosePartners partners;
    for (uint32_t v = 0; v < n; ++v) {
      partners.partner.push_back((v + n / 2) % n);
      partners.flips.push_back(static_cast<uint8_t>(many_strands ? numbers.below(8) : 3));
    }
    pose->stream = encode_pose(CornerTable(input.layout.topology), PoseSteps::kDependent,
                               pose->grid.points, &partners);
    segment.reference = std::move(pose);
  };
}

namespace {

LinearParameters parameters_of(const EncodedSegment& segment) {
  LinearParameters parameters;
  const size_t runs = std::max<size_t>(segment.runs.size(), 1);
  if (parameters.read(segment.parameters, segment.sizes.components, runs, segment.sizes.regions) !=
      Status::kOk)
    throw Error(ErrorKind::kInternal, "the parameters cannot be read");
  return parameters;
}

/// Layers of a segment, views of `chunks`.
Vector<BasisLayer> layers_of(const std::vector<Bytes>& chunks, const LinearParameters& parameters) {
  Vector<BasisLayer> layers;
  const auto components = static_cast<uint32_t>(parameters.sigma.size());
  if (read_layers(Vector<ByteView>(chunks.begin(), chunks.end()), components, components,
                  &layers) != Status::kOk)
    throw Error(ErrorKind::kInternal, "the layers cannot be read");
  return layers;
}

/// Puts other streams into layers: those of the weights.
void set_weights(EncodedSegment& segment, const std::vector<Bytes>& streams) {
  const LinearParameters parameters = parameters_of(segment);
  const std::vector<Bytes> chunks = std::move(segment.layers);
  segment.layers.clear();
  size_t l = 0;
  for (BasisLayer layer : layers_of(chunks, parameters)) {
    layer.weights = streams[l++];
    segment.layers.push_back(layer.write());
  }
}

}  // namespace

VertexOrder order_of(const EncodedSegment& segment, const Topology& topology) {
  const LinearParameters parameters = parameters_of(segment);
  MeshGraph graph;
  anicodec::Vector<uint8_t> regions;
  VertexOrder order;
  if (graph.init(topology.triangles.data(), topology.triangles.size() / 3,
                 topology.coded_vertices) != Status::kOk ||
      read_regions(segment.pose, graph, segment.sizes.regions, &regions) != Status::kOk ||
      make_vertex_order(std::move(graph), segment.reference->grid.points.data(),
                        parameters.neighbours, parameters.colours, &order,
                        regions.empty() ? nullptr : regions.data()) != Status::kOk)
    throw Error(ErrorKind::kInternal, "the order of the vertices cannot be made");
  return order;
}

StreamChange with_weights(
    const std::function<double(uint32_t j, uint32_t row, uint32_t frame)>& weight,
    const std::function<uint32_t(uint32_t j)>& predictor) {
  return [=](EncodedSegment& segment, const EncoderInput&) {
    const uint32_t frames = segment.sizes.frames;
    const bool affine = segment.sizes.kind == BasisKind::kEigentrajectories;
    const uint32_t base = affine ? 4 : 0, rows = affine ? 3 : 1;
    const LinearParameters parameters = parameters_of(segment);
    const anicodec::Vector<uint32_t> runs =
        segment.runs.empty() ? anicodec::Vector<uint32_t>(1, frames) : segment.runs;
    TimeWeightModel model(runs);
    std::vector<int32_t> decoded(size_t{3} * frames);
    const auto code = [&](BinaryEncoder& encoder, uint32_t j) {
      const uint32_t channels = j < base ? 3 : rows;
      std::vector<double> x(size_t{channels} * frames);
      for (size_t i = 0; i < x.size(); ++i)
        x[i] = weight(j, static_cast<uint32_t>(i / frames), static_cast<uint32_t>(i % frames));
      model.encode(encoder, channels, x.data(), 0, decoded.data(), 1U << predictor(j));
    };
    BinaryEncoder of_base;
    for (uint32_t j = 0; j < base; ++j)
      code(of_base, j);
    segment.weights = of_base.finish();
    std::vector<Bytes> streams;
    for (const BasisLayer& layer : layers_of(segment.layers, parameters)) {
      if (parameters.layers_anew && layer.first > 0)
        model = TimeWeightModel(runs);
      BinaryEncoder encoder;
      for (uint32_t j = layer.first; j < layer.first + layer.count; ++j)
        code(encoder, base + j);
      streams.push_back(encoder.finish());
    }
    set_weights(segment, streams);
  };
}

void scramble_weights(EncodedSegment& segment, const EncoderInput& input) {
  auto numbers = std::make_shared<Numbers>();
  const uint32_t frames = segment.sizes.frames;
  with_weights(
      [=](uint32_t j, uint32_t row, uint32_t frame) {
        const size_t i = size_t{row} * frames + frame;
        return 300 * std::sin(0.05 * frame * (1 + j % 3) + j) + numbers->within(10 << (j % 7)) +
               (i % 41 == 0 ? 20000 : 0);
      },
      [](uint32_t j) { return j % kWeightPredictors; })(segment, input);
}

StreamChange with_residuals(
    const std::function<int32_t(uint32_t j, uint32_t c, uint32_t r)>& residual,
    const std::function<uint8_t(uint32_t j)>& omega) {
  return [=](EncodedSegment& segment, const EncoderInput& input) {
    LinearParameters parameters = parameters_of(segment);
    for (uint32_t j = 0; j < parameters.omega.size(); ++j)
      parameters.omega[j] = omega(j);
    segment.parameters = parameters.write();
    const VertexOrder order = order_of(segment, input.layout.topology);
    const uint32_t channels = segment.sizes.kind == BasisKind::kEigentrajectories ? 1 : 3,
                   ranks = input.layout.topology.coded_vertices;
    const auto stride = static_cast<uint32_t>(order.neighbour_count);
    std::optional<CoefficientModel> model;
    std::vector<int32_t> q(size_t{channels} * ranks);
    const std::vector<Bytes> chunks = std::move(segment.layers);
    segment.layers.clear();
    for (BasisLayer layer : layers_of(chunks, parameters)) {
      if (!model || parameters.layers_anew)
        model.emplace(channels, order.neighbours.data(), stride, order.level_start);
      RansEncoder encoder;
      for (uint32_t j = layer.first; j < layer.first + layer.count; ++j) {
        for (size_t i = 0; i < q.size(); ++i)
          q[i] = residual(j, static_cast<uint32_t>(i / ranks), static_cast<uint32_t>(i % ranks));
        model->code_component(encoder, q.data());
      }
      const Bytes stream = encoder.finish();
      layer.coefficients = stream;
      segment.layers.push_back(layer.write());
    }
    segment.sizes.wide_components = segment.sizes.components;
  };
}

void scramble_coefficients(EncodedSegment& segment, const EncoderInput& input) {
  auto numbers = std::make_shared<Numbers>();
  with_residuals(
      [=](uint32_t j, uint32_t, uint32_t) {
        return j % 3 == 0 ? numbers->within(3) : numbers->within(1 << (j * 2 % 24));
      },
      [=](uint32_t) { return static_cast<uint8_t>(numbers->below(256)); })(segment, input);
}

}  // namespace anicodec
