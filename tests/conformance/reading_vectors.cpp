// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files that tell wrong readings of the specification from the right one where all others decode alike.
#include "tests/conformance/reading_vectors.h"

#include "codec/connectivity/mesh_layout.h"
#include "codec/encode.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/coding/binary_coder.h"
#include "format/coding/time_weights.h"
#include "format/container.h"
#include "sdk/exact/earlier_neighbours.h"
#include "sdk/mesh/faces_coding.h"
#include "sdk/mesh/vertex_walk.h"
#include "sdk/pose/dependent_steps.h"
#include "sdk/pose/pose_coding.h"
#include "sdk/prediction/refit_solver.h"
#include "sdk/segment/keyframe_segment.h"
#include "tests/conformance/vector_recipes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

/// Frames of a mesh at rest, each vertex of which is moved by itself.
void shake(MeshSequence* clip, const std::vector<float>& rest, uint32_t frames) {
  Numbers numbers;
  clip->frame_count = frames;
  for (uint32_t f = 0; f < frames; ++f) {
    for (const float x : rest)
      clip->positions.push_back(x + static_cast<float>(numbers.within(200)) / 4096);
  }
}

/// Triangles whose texture coordinates are below 0 and odd, where rounding down is not rounding towards
/// zero; at one vertex many corners that return to values of long ago.
Bytes corner_values() {
  constexpr uint32_t kBlades = 60, kSingle = 8;
  MeshSequence clip;
  clip.name = "corner values";
  std::vector<float> rest{0, 0, 0};
  const auto vertex = [&](double x, double y, double z) {
    for (const double p : {x, y, z})
      rest.push_back(static_cast<float>(p));
    return static_cast<uint32_t>(rest.size() / 3 - 1);
  };
  Attribute uv;
  uv.name = "uv";
  uv.domain = AttributeDomain::kCorner;
  Numbers numbers;
  const auto value = [&](uint32_t number) {
    uv.values.push_back(static_cast<float>(-1.0 - (2 * number + 1) / 4096.0));
    uv.values.push_back(static_cast<float>((static_cast<int32_t>(number * 7 % 23) - 11) / 4096.0));
  };
  for (uint32_t i = 0; i < kSingle; ++i) {
    clip.polygons.add(
        std::vector<uint32_t>{vertex(i, 5, 0), vertex(i + 0.5, 5, 1), vertex(i, 6, 1)});
    for (uint32_t k = 0; k < 3; ++k)
      value(numbers.below(500));
  }
  uint32_t last = vertex(1, 0, 0);
  for (uint32_t i = 1; i <= kBlades; ++i) {
    const double angle = 6.28 * i / kBlades;
    const uint32_t next = vertex(std::cos(angle), std::sin(angle), 0.1 * (i % 3));
    clip.polygons.add(std::vector<uint32_t>{0, last, next});
    value(i <= 24 ? i : numbers.below(24));
    value(100 + i);
    value(101 + i);
    last = next;
  }
  clip.vertex_count = static_cast<uint32_t>(rest.size() / 3);
  clip.attributes.push_back(std::move(uv));
  shake(&clip, rest, 2);
  EncodeOptions options;
  options.basis = BasisChoice::kKeyframes;
  options.keyframes = 1;
  return encode(clip, options).file;
}

/// Five numbers of each vertex, of which only the last two move: those of the second triple.
Bytes second_triple() {
  MeshSequence clip = corpus::make_scaled("limb", 100, 6);
  Attribute five;
  five.kind = AttributeKind::kCustom;
  five.name = "five";
  five.components = 5;
  five.frames = clip.frame_count;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    for (uint32_t v = 0; v < clip.vertex_count; ++v) {
      for (uint32_t c = 0; c < 5; ++c)
        five.values.push_back(
            static_cast<float>(v % 7 + c + (c < 3 ? 0 : 0.5 * std::sin(f + 0.1 * v))));
    }
  }
  clip.attributes.push_back(std::move(five));
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 1, false};
  options.basis = BasisChoice::kEigentrajectories;
  options.effort = Effort::kFast;
  return encode(clip, options).file;
}

/// A pose that is almost flat, so that its third function is small but not dependent.
Bytes almost_flat() {
  MeshSequence clip = corpus::make_scaled("limb", 100, 8);
  for (size_t i = 0; i < clip.positions.size(); i += 3)
    clip.positions[i + 2] = clip.positions[i] + 0.02F * clip.positions[i + 2];
  Recipe r = recipe(8, BasisKind::kEigentrajectories, 0.0005 * diagonal(clip), 12, 1, 12,
                    RefitSchedule::kSparse);
  return file_of(clip, {r});
}

/// Triangles without order, many of which share a vertex or two.
MeshSequence heap(uint32_t vertices, uint32_t triangles, uint32_t frames) {
  Numbers numbers;
  MeshSequence clip;
  clip.name = "heap";
  clip.vertex_count = vertices;
  for (uint32_t i = 0; i < triangles; ++i) {
    const uint32_t a = numbers.below(vertices), b = (a + 1 + numbers.below(9)) % vertices,
                   c = (a + 10 + numbers.below(9)) % vertices;
    clip.polygons.add(std::vector<uint32_t>{a, b, c});
  }
  std::vector<float> rest;
  for (uint32_t i = 0; i < 3 * vertices; ++i)
    rest.push_back(static_cast<float>(numbers.within(4096)) / 1024);
  shake(&clip, rest, frames);
  return clip;
}

/// A reference pose of numbers at their limits that suit no prediction, under a segment without
/// components; another segment of the same mesh, which may not have such a pose.
Bytes wild_pose() {
  const MeshSequence clip = heap(300, 260, 6);
  const double step = 0.004 * diagonal(clip);
  Recipe wild = recipe(3, BasisKind::kEigentrajectories, step, 12, 1, 12, RefitSchedule::kNone);
  wild.settings.components = {0};
  wild.change = [](EncodedSegment& segment, const EncoderInput& input) {
    auto pose = std::make_shared<EncodedPose>(*segment.reference);
    Numbers numbers;
    size_t state[3] = {0, 0, 0};
    for (size_t i = 0; i < pose->grid.points.size(); ++i) {
      const int32_t half = numbers.within((1 << 21) - 1);
      pose->grid.points[i] = 2 * half + DependentSteps::parity(state[i % 3]);
      state[i % 3] = DependentSteps::next(state[i % 3], half);
    }
    pose->stream =
        encode_pose(CornerTable(input.layout.topology), PoseSteps::kDependent, pose->grid.points);
    segment.reference = std::move(pose);
  };
  Recipe tame = recipe(3, BasisKind::kEigentrajectories, step, 12, 1, 12, RefitSchedule::kNone);
  tame.settings.components = {1};
  return file_of(clip, {wild, tame});
}

/// Native key-frames of vertices at the corners of a cube, in no order and as fine as binary32 allows:
/// predictions beyond +-2^22.
Bytes far_keyframes() {
  MeshSequence clip = heap(400, 700, 2);
  for (float& x : clip.positions)
    x = std::copysign(4 - std::abs(x) / 64, x);
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 2e-6, false};
  options.basis = BasisChoice::kKeyframes;
  options.keyframes = 2;
  return encode(clip, options).file;
}

/// Squares that meet in corners alone, for geometry interpolation: they share joins, no hinges.
Bytes joined_corners() {
  constexpr uint32_t kSquares = 12, kSide = 4, kFrames = 5;
  MeshSequence clip;
  clip.name = "joined corners";
  std::vector<float> rest;
  uint32_t shared = 0;
  for (uint32_t s = 0; s < kSquares; ++s) {
    uint32_t at[kSide][kSide];
    for (uint32_t y = 0; y < kSide; ++y) {
      for (uint32_t x = 0; x < kSide; ++x) {
        if (s > 0 && x == 0 && y == 0) {
          at[y][x] = shared;
          continue;
        }
        at[y][x] = static_cast<uint32_t>(rest.size() / 3);
        for (const double p : {3.0 * s + x, 3.0 * s + y, 0.3 * (x * y % 3)})
          rest.push_back(static_cast<float>(p));
      }
    }
    shared = at[kSide - 1][kSide - 1];
    for (uint32_t y = 0; y + 1 < kSide; ++y) {
      for (uint32_t x = 0; x + 1 < kSide; ++x)
        clip.polygons.add(
            std::vector<uint32_t>{at[y][x], at[y][x + 1], at[y + 1][x + 1], at[y + 1][x]});
    }
  }
  clip.vertex_count = static_cast<uint32_t>(rest.size() / 3);
  clip.frame_count = kFrames;
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (size_t i = 0; i < rest.size(); i += 3) {  // wound up along x
      const double turn = 0.05 * f * rest[i];
      clip.positions.push_back(rest[i]);
      clip.positions.push_back(
          static_cast<float>(rest[i + 1] * std::cos(turn) - rest[i + 2] * std::sin(turn)));
      clip.positions.push_back(
          static_cast<float>(rest[i + 1] * std::sin(turn) + rest[i + 2] * std::cos(turn)));
    }
  }
  EncodeOptions options;
  options.basis = BasisChoice::kKeyframes;
  options.keyframes = 3;
  options.interpolation = InterpolationChoice::kMsgi;
  return encode(clip, options).file;
}

/// Native key-frames none of which has a parent: each names its partners anew.
Bytes keyframe_partners() {
  MeshSequence clip = corpus::make_scaled("limb", 200, 4);
  EncodeOptions options;
  options.basis = BasisChoice::kKeyframes;
  options.keyframes = 3;
  const Bytes file = encode(clip, options).file;
  ContainerReader reader;
  if (!reader.open(file).ok())
    throw Error(ErrorKind::kInternal, "the file cannot be opened");
  const EncoderInput input(std::move(clip));
  const CornerTable table(input.layout.topology);
  ContainerWriter writer;
  for (const Chunk& chunk : reader.chunks()) {
    ByteView payload;
    reader.payload(chunk, &payload);
    SegmentRecord record;
    Bytes parameters, pose, changed(payload.data, payload.data + payload.size);
    if (chunk.type == chunk_type("SEGM")) {
      KeyframeParameters keyframes;
      Limits::Segment sizes;
      sizes.components = 3;
      sizes.frames = 4;
      Vector<Vector<int32_t>> poses;
      if (SegmentRecord::read(payload, &record) != Status::kOk ||
          keyframes.read(record.parameters, sizes) != Status::kOk ||
          decode_poses(record.pose, table, PoseSteps::kAny, keyframes.parents, &poses) !=
              Status::kOk)
        throw Error(ErrorKind::kInternal, "the key-frames cannot be read");
      keyframes.parents.assign(poses.size(), 0);
      Numbers numbers;
      PosePartners partners;
      const uint32_t n = table.vertex_count();
      for (uint32_t v = 0; v < n; ++v) {
        const uint32_t kind = numbers.below(6);
        partners.partner.push_back(kind == 0   ? PosePartners::kNone
                                   : kind == 1 ? v
                                               : v - std::min(v, 1 + v / 7 % 30));
        partners.flips.push_back(static_cast<uint8_t>(numbers.below(8)));
      }
      parameters = keyframes.write();
      pose = encode_poses(table, PoseSteps::kAny, poses, keyframes.parents, &partners);
      record.parameters = parameters;
      record.pose = pose;
      changed = record.write();
    }
    writer.add(chunk, chunk.mesh, chunk.segment, std::move(changed));
  }
  return writer.finish(reader.features());
}

/// Triangles that meet in one vertex each, a hub: as many neighbours as spokes, or half of them on the
/// next level. Both around the limit of 32. Then vertices of 14 to 17 neighbours.
MeshSequence degrees() {
  Numbers numbers;
  MeshSequence clip;
  clip.name = "degrees";
  std::vector<float> rest;
  const auto vertices = [&](uint32_t count, double x) {
    for (uint32_t i = 0; i < count; ++i) {
      rest.push_back(static_cast<float>(x + numbers.within(100) / 64.0));
      rest.push_back(static_cast<float>(numbers.within(100) / 64.0));
      rest.push_back(static_cast<float>(numbers.within(100) / 64.0));
    }
    return static_cast<uint32_t>(rest.size() / 3) - count;
  };
  double x = 0;
  for (const uint32_t spokes : {32U, 33U, 34U, 64U, 66U, 68U}) {
    const uint32_t hub = vertices(1 + spokes, x += 4);
    for (uint32_t i = 1; i < spokes; i += 2)  // the last spoke of an odd number shares one
      clip.polygons.add(std::vector<uint32_t>{hub, hub + i, hub + i + 1});
    if (spokes % 2 != 0)
      clip.polygons.add(std::vector<uint32_t>{hub, hub + spokes - 1, hub + spokes});
  }
  constexpr uint32_t kRing = 120;
  const uint32_t first = vertices(kRing, x + 4);
  const auto ring = [&](uint32_t i) { return first + i % kRing; };
  for (uint32_t i = 0; i < kRing; ++i) {
    for (const auto& [a, b] : {std::pair(1U, 3U), std::pair(1U, 5U), std::pair(1U, 7U)})
      clip.polygons.add(std::vector<uint32_t>{ring(i), ring(i + a), ring(i + b)});
    if (i % 5 == 0)
      clip.polygons.add(
          std::vector<uint32_t>{ring(i), ring(i + 1), ring(i + 20 + numbers.below(40))});
  }
  clip.vertex_count = static_cast<uint32_t>(rest.size() / 3);
  shake(&clip, rest, 3);
  return clip;
}

Bytes limits_of_degrees() {
  return file_of(degrees(),
                 {recipe(3, BasisKind::kEigenshapes, 0.004, 8, 3, 12, RefitSchedule::kSparse)});
}

/// Sixteen vertices that are all neighbours of one another: one in sixteen leaves a level, no less.
Bytes one_in_sixteen() {
  return file_of(cliques(16),
                 {recipe(4, BasisKind::kEigenshapes, 0.004, 8, 2, 12, RefitSchedule::kSparse)});
}

/// Exact positions that are zeros below 0, after others by which a filter learns that neighbours count
/// against a vertex: predictions that are sums of zeros below 0.
Bytes signed_zeros() {
  constexpr uint32_t kTaught = 120;
  MeshSequence clip = heap(kTaught, 240, 1);
  const MeshSequence zeros = heap(60, 100, 1);
  for (size_t p = 0; p < zeros.polygons.size(); ++p) {
    std::vector<uint32_t> polygon(zeros.polygons[p].begin(), zeros.polygons[p].end());
    for (uint32_t& v : polygon)
      v += kTaught;
    clip.polygons.add(polygon);
  }
  clip.vertex_count += zeros.vertex_count;
  for (const float x : zeros.positions)
    clip.positions.push_back(x + 10);
  const MeshLayout layout = lay_out_mesh(clip);
  const EarlierNeighbours neighbours(layout.topology);
  Numbers numbers;
  std::vector<float> y(layout.sizes.coded_vertices);
  for (uint32_t v = 1; v < y.size(); ++v) {
    const uint32_t* near = neighbours.of(v);
    const float o = y[near[0]], others = y[near[1]] + y[near[2]] + y[near[3]];
    const bool zero = layout.coded_source[v] >= kTaught;
    y[v] =
        zero ? -0.0F : o - 0.3F * (others - 3 * o) + static_cast<float>(numbers.within(1000)) / 997;
  }
  for (uint32_t v = 0; v < clip.vertex_count; ++v)
    clip.positions[3 * v + 1] = y[layout.source_coded[v]];
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0, false};
  options.basis = BasisChoice::kEigentrajectories;
  return encode(clip, options).file;
}

/// A coder whose decisions are drawn at random, and written: what it codes, a decoder reads.
class RandomCoder {
 public:
  static constexpr bool kAdapts = true;
  static constexpr bool kDecodes = true;

  /// The first decisions are given.
  RandomCoder(uint64_t seed, std::vector<bool> first) : numbers_(seed), first_(std::move(first)) {
    numbers_.below(2);
  }

  bool bit(uint32_t p, bool = false) {
    return encoder_.bit(
        p, count_ < first_.size() ? first_[count_++] : numbers_.below(kProbabilityOne) < p);
  }

  bool bit(AdaptiveBit& model, bool = false) {
    const bool value = bit(model.probability());
    model.update(value);
    return value;
  }

  uint32_t raw(int count, uint32_t = 0) {
    uint32_t value = 0;
    for (int i = 0; i < count; ++i)
      value = value << 1 | static_cast<uint32_t>(bit(kProbabilityOne / 2));
    return value;
  }

  bool ok() const { return true; }

  void fail() {}

  Bytes finish() { return encoder_.finish(); }

 private:
  Numbers numbers_;
  std::vector<bool> first_;
  size_t count_ = 0;
  BinaryEncoder encoder_;
};

/// Whether a polygon goes from a vertex to another and back, and both have copies.
bool meets_itself(const Topology& topology) {
  std::vector<uint32_t> copies(topology.coded_vertices);
  for (const uint32_t v : topology.vertex_coded)
    ++copies[v];
  for (size_t p = 0; p + 1 < topology.polygon_offsets.size(); ++p) {
    const uint32_t begin = topology.polygon_offsets[p], n = topology.polygon_offsets[p + 1] - begin;
    const auto at = [&](uint32_t i) {
      return topology.vertex_coded[topology.polygon_corners[begin + i % n]];
    };
    for (uint32_t i = 0; i < n; ++i) {
      for (uint32_t k = 0; k < n; ++k) {
        if (at(i) == at(k + 1) && at(i + 1) == at(k) && i != k && copies[at(i)] > 1 &&
            copies[at(k)] > 1)
          return true;
      }
    }
  }
  return false;
}

/// Faces by decisions at random, which have vertices twice and sides in common with themselves.
Bytes self_meeting() {
  MeshLayout layout;
  layout.sizes.coded_vertices = 14;
  layout.sizes.source_vertices = 24;
  layout.sizes.polygons = 16;
  layout.sizes.corners = 64;
  layout.sizes.triangles = layout.sizes.corners - 2 * layout.sizes.polygons;
  for (uint64_t seed = 1;; ++seed) {
    layout.topology = {};
    RandomCoder coder(seed, {true, false});  // no polygon apart, none repeated
    NoMesh none;
    if (FacesCoding<RandomCoder, NoMesh>(coder, none, layout.sizes, &layout.topology).run() ==
            Status::kOk &&
        meets_itself(layout.topology)) {
      layout.faces = coder.finish();
      break;
    }
  }
  MeshSequence clip;
  clip.name = "self meeting";
  clip.vertex_count = layout.sizes.source_vertices;
  clip.frame_count = 3;
  clip.polygons.offsets.assign(layout.topology.polygon_offsets.begin(),
                               layout.topology.polygon_offsets.end());
  clip.polygons.corners.assign(layout.topology.polygon_corners.begin(),
                               layout.topology.polygon_corners.end());
  layout.source_coded.assign(layout.topology.vertex_coded.begin(),
                             layout.topology.vertex_coded.end());
  for (uint32_t v = 0; v < clip.vertex_count; ++v) {
    if (v == 0 || layout.source_coded[v] != layout.source_coded[v - 1])
      layout.coded_source.push_back(v);
    layout.vertex_source.push_back(v);
  }
  BinaryEncoder map;
  VertexWalk(layout.topology).code(map, &layout.vertex_source);
  layout.vertex_map = map.finish();
  Numbers numbers;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    std::vector<float> places(size_t{3} * layout.sizes.coded_vertices);
    for (float& x : places)
      x = static_cast<float>(numbers.within(1000)) / 100;
    for (const uint32_t v : layout.source_coded)
      clip.positions.insert(clip.positions.end(), places.begin() + 3 * v,
                            places.begin() + 3 * v + 3);
  }
  return file_of(clip, {recipe(3, BasisKind::kEigenshapes, 0.01, 8, 1, 12, RefitSchedule::kNone)},
                 {}, &layout);
}

/// Refits of a matrix that binary32 makes singular: a pivot of 0, weights that are not numbers. Three
/// vertices that are neighbours of one another; the first two go alike, but for samples that round up
/// where they are multiplied with one another, and down where with themselves.
class SingularRefits {
 public:
  static constexpr uint32_t kComponents = 25, kChannels = 3;

  /// Whether the weights of some refit are not numbers, if so many samples are left out.
  bool make(const VertexOrder& order, const int32_t* pose, uint32_t left_out) {
    std::vector<float> positions;
    for (const uint32_t v : order.order)
      positions.insert(positions.end(), pose + size_t{3} * v, pose + size_t{3} * v + 3);
    PredictionJob job;
    job.neighbour_count = kM;
    job.positions = positions.data();
    job.neighbours = order.neighbours.data();
    job.radius = 12;
    Solver solvers[3];
    for (size_t r = 0; r < 3; ++r) {
      solvers[r].set_prior(job, r, 1);
      solvers[r].clear();
    }
    constexpr uint32_t kRefits[] = {0, 1, 2, 3, 5, 8, 12, 18};  // of RefitSchedule::kMedium
    residuals_.clear();
    bool found = false;
    uint32_t samples = 0;
    for (uint32_t j = 0; j < kComponents; ++j) {
      for (uint32_t c = 0; c < kChannels; ++c) {
        const bool first = j == 0 && c == 0, small = j > 0 && samples++ >= left_out;
        const float wanted[3] = {first   ? 66000.0F
                                 : small ? 27.0F
                                         : 0,
                                 first   ? 66000.0F
                                 : small ? 15.0F
                                         : 0,
                                 0};
        float y[3] = {};
        for (size_t r = 0; r < 3; ++r)
          y[r] = code(order, r, y, wanted[r], &solvers[r]);
      }
      if (std::ranges::find(kRefits, j) == std::end(kRefits))
        continue;
      for (Solver& solver : solvers)
        solver.refit();
      found = found || (solvers[2].weights[0][0] == 0 && solvers[2].weights[1][0] == 0);
    }
    return found;
  }

  int32_t residual(uint32_t j, uint32_t c, uint32_t r) const {
    return residuals_[(size_t{kChannels} * j + c) * 3 + r];
  }

 private:
  static constexpr size_t kM = 8;
  using Solver = RefitSolver<1, kM>;

  /// A coefficient as near to the wanted one as can be, by the residual that makes it.
  float code(const VertexOrder& order, size_t r, const float* y, float wanted, Solver* solver) {
    Solver::Float x[1][kM], error[1] = {};
    float p = 0, p0 = 0;
    for (size_t a = 0; a < kM; ++a) {
      const int32_t other = order.neighbours[kM * r + a];
      x[0][a] = Solver::splat(other < 0 ? 0 : y[other]);
      p += solver->weights[a][0] * x[0][a][0];
      p0 += solver->prior[a][0] * x[0][a][0];
    }
    const float rounded = (std::clamp(p, -1048576.0F, 1048576.0F) * 64 + 12582912) - 12582912;
    const float residual = std::round(wanted - rounded / 64), made = rounded / 64 + residual,
                omega = 1;
    residuals_.push_back(static_cast<int32_t>(residual));
    error[0] += made - p0;
    solver->accumulate(x, error, &omega, 1);
    return made;
  }

  std::vector<int32_t> residuals_;
};

/// A triangle that shakes.
MeshSequence triangle(const char* name, uint32_t frames) {
  MeshSequence clip;
  clip.name = name;
  clip.vertex_count = 3;
  clip.polygons.add(std::vector<uint32_t>{0, 1, 2});
  shake(&clip, {0, 0, 0, 1, 0, 0, 0.4F, 0.9F, 0}, frames);
  return clip;
}

Bytes singular() {
  const MeshSequence clip = triangle("singular", 60);
  Recipe r = recipe(60, BasisKind::kEigenshapes, 0.0001, 8, 1, 12, RefitSchedule::kMedium);
  r.settings.components = {SingularRefits::kComponents};
  r.change = [](EncodedSegment& segment, const EncoderInput& input) {
    const VertexOrder order = order_of(segment, input.layout.topology);
    auto refits = std::make_shared<SingularRefits>();
    uint32_t left_out = 0;
    while (!refits->make(order, segment.reference->grid.points.data(), left_out)) {
      if (++left_out > 60)
        throw Error(ErrorKind::kInternal, "no refit is singular");
    }
    with_residuals(
        [=](uint32_t j, uint32_t c, uint32_t rank) { return refits->residual(j, c, rank); },
        [](uint32_t) { return uint8_t{128}; })(segment, input);
  };
  return file_of(clip, {r});
}

/// Weights of a run longer than a cosine transform; jumps over the whole range after long rests; to
/// and fro over half of it, where a regression expects more than there is.
Bytes long_run() {
  constexpr uint32_t kFrames = 1101;
  MeshSequence clip;
  clip.name = "long run";
  clip.vertex_count = 4;
  clip.polygons.add(std::vector<uint32_t>{0, 1, 2, 3});
  clip.frame_count = kFrames;
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (uint32_t v = 0; v < 4; ++v) {
      for (uint32_t c = 0; c < 3; ++c)
        clip.positions.push_back(
            static_cast<float>((v >> c & 1) + 0.1 * std::sin(0.01 * f * (v + 1) + c)));
    }
  }
  Recipe r = recipe(kFrames, BasisKind::kEigentrajectories, 0.001, 8, 1, 12, RefitSchedule::kNone);
  r.settings.components = {3};
  r.change = with_weights(
      [](uint32_t j, uint32_t row, uint32_t frame) -> double {
        switch (j % 3) {
          case 0:
            return 200 * std::cos(0.002 * frame * (row + 1)) + (frame % 700 == 0 ? 5000 : 0);
          case 1:
            return frame / 500 % 2 == 0 ? -kWeightLimit / 2 : kWeightLimit / 2;
          default:
            return frame < 40 && frame % 2 == 1 ? kWeightLimit / 2
                   : frame < 40                 ? -kWeightLimit / 2
                                                : row;
        }
      },
      [](uint32_t j) {
        return static_cast<uint32_t>(j % 3 == 0   ? WeightPredictor::kCosine
                                     : j % 3 == 1 ? WeightPredictor::kLine
                                                  : WeightPredictor::kRegression);
      });
  return file_of(clip, {r});
}

/// One component that is 0 everywhere: a stream of fewer decisions than it has states.
Bytes quiet() {
  const MeshSequence clip = triangle("quiet", 3);
  Recipe r = recipe(3, BasisKind::kEigenshapes, 0.001, 8, 1, 12, RefitSchedule::kNone);
  r.settings.components = {1};
  r.change = with_residuals([](uint32_t, uint32_t, uint32_t) { return 0; },
                            [](uint32_t) { return uint8_t{128}; });
  return file_of(clip, {r});
}

/// Exact coordinates of a pose of many parts, with partners: those of the first vertex of a part follow
/// another one without a neighbour that is known.
Bytes islands() {
  constexpr uint32_t kParts = 80;
  MeshSequence clip;
  clip.name = "islands";
  std::vector<float> rest;
  for (uint32_t part = 0; part < kParts; ++part) {
    const auto x = static_cast<float>(3 * (part % 10)), y = static_cast<float>(3 * (part / 10));
    rest.insert(rest.end(), {x, y, 0, x + 1, y, 0, x, y + 2, 1});
    clip.polygons.add(std::vector<uint32_t>{3 * part, 3 * part + 1, 3 * part + 2});
  }
  clip.vertex_count = 3 * kParts;
  shake(&clip, rest, 4);
  Recipe r = recipe(4, BasisKind::kEigenshapes, 0.05, 8, 1, 12, RefitSchedule::kNone);
  r.change = exactly_with_partners;
  return file_of(clip, {r});
}

}  // namespace

const std::vector<SpecialVector>& reading_vectors() {
  static const std::vector<SpecialVector> all = {{"corner_values", corner_values},
                                                 {"second_triple", second_triple},
                                                 {"almost_flat", almost_flat},
                                                 {"wild_pose", wild_pose},
                                                 {"far_keyframes", far_keyframes},
                                                 {"joined_corners", joined_corners},
                                                 {"keyframe_partners", keyframe_partners},
                                                 {"degrees", limits_of_degrees},
                                                 {"one_in_sixteen", one_in_sixteen},
                                                 {"signed_zeros", signed_zeros},
                                                 {"self_meeting", self_meeting},
                                                 {"singular", singular},
                                                 {"long_run", long_run},
                                                 {"quiet", quiet},
                                                 {"islands", islands}};
  return all;
}

}  // namespace anicodec
