// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_API_CRAFTED_FILE_H_
#define ANICODEC_TESTS_API_CRAFTED_FILE_H_

#include "format/coding/binary_coder.h"
#include "format/coding/coefficient_model.h"
#include "format/coding/rans_coder.h"
#include "format/coding/time_weights.h"
#include "format/container.h"
#include "format/records.h"
#include "sdk/clip/clip.h"
#include "sdk/mesh/faces_coding.h"
#include "sdk/pose/exact_pose.h"
#include "sdk/pose/pose_coding.h"
#include "sdk/segment/basis_layer.h"
#include "sdk/segment/correction_coding.h"
#include "sdk/segment/linear_segment.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>
#include <vector>

namespace anicodec {

/// One triangle again and again, from either side: next to no bytes.
struct TwoSidedTriangle : NoMesh {
  bool find(uint32_t a, uint32_t b) {
    turn = {a, b, 3 - a - b};
    return done % 2 == 1;
  }

  void find_seed() { turn = {0, 1, 2}; }

  uint32_t corners() const { return 3; }

  uint32_t vertex(uint32_t k) const { return turn[k] < seen ? turn[k] : WalkedFaces::kNone; }

  void set_vertex(uint32_t, uint32_t) { ++seen; }

  uint32_t finish() {
    ++done;
    return 0;
  }

  std::array<uint32_t, 3> turn{};
  uint32_t seen = 0, done = 0;
};

/// Equal meshes and segments of eigenshapes that are as small as can be.
class CraftedFile {
 public:
  explicit CraftedFile(uint32_t vertices, uint32_t triangles = 0, uint32_t meshes = 1)
      : vertices_(vertices) {
    Limits::Mesh mesh;
    mesh.source_vertices = mesh.coded_vertices = vertices;
    mesh.triangles = mesh.polygons = triangles;
    mesh.corners = 3 * triangles;
    limits_.meshes.assign(meshes, mesh);
    BinaryEncoder encoder;
    TwoSidedTriangle source;
    if (FacesCoding<BinaryEncoder, TwoSidedTriangle>(encoder, source, limits_.meshes[0], &topology_)
            .run() != Status::kOk)
      std::abort();
    faces_ = encoder.finish();
    pose_.assign(size_t{3} * vertices, 0);
    for (uint32_t v = 0; v < std::min(vertices, 3U); ++v)
      pose_[size_t{3} * v + v] = 100;
  }

  /// A segment after the last one. corrected: one vertex is, in its last frame.
  void add_segment(uint32_t frames, uint32_t components, bool own_pose, bool corrected) {
    add_segment_of(0, limits_.frames, frames, components);
    limits_.segments.back().corrections = corrected;
    own_pose_.back() = own_pose;
    limits_.frames += frames;
  }

  /// A segment of any mesh that holds frames which others hold, too.
  void add_segment_of(uint16_t mesh, uint32_t first_frame, uint32_t frames, uint32_t components) {
    Limits::Segment s;
    s.mesh = mesh;
    s.kind = BasisKind::kEigenshapes;
    s.first_frame = first_frame;
    s.frames = frames;
    s.components = components;
    limits_.segments.push_back(s);
    own_pose_.push_back(false);
  }

  /// A clip for each frame.
  void cut_into_clips() { limits_.clip_frames.assign(limits_.frames, 1); }

  /// The corrections of so many frames, one vertex each, of the last segment.
  void correct(uint32_t frames) { limits_.segments.back().corrections = frames; }

  /// Chunks that no reader knows, without a byte.
  void add_unknown_chunks(uint32_t count) { unknown_chunks_ = count; }

  Bytes write() const {
    ContainerWriter out;
    const auto add = [&](const char(&type)[5], uint16_t mesh, uint32_t segment, Bytes payload) {
      out.add(type, true, mesh, segment, std::move(payload));
    };
    add("LIMI", kNoMesh, kNoSegment, limits_.write());
    ClipsRecord clip;
    clip.order = OrderMode::kFree;
    clip.clips.resize(std::max<size_t>(limits_.clip_frames.size(), 1));
    add("CLIP", kNoMesh, kNoSegment, clip.write());
    const bool shared = std::find(own_pose_.begin(), own_pose_.end(), false) != own_pose_.end();
    const Bytes of_mesh =
        shared ? pose(encode_pose(CornerTable(topology_), PoseSteps::kDependent, pose_)) : Bytes();
    for (uint16_t m = 0; m < limits_.meshes.size(); ++m) {
      add("MESH", m, kNoSegment, mesh());
      if (shared)
        add("POSE", m, kNoSegment, of_mesh);
    }
    const Bytes predicted = pose(encode_exact_pose(CornerTable(topology_), pose_));
    for (uint32_t i = 0; i < limits_.segments.size(); ++i) {
      const uint16_t m = limits_.segments[i].mesh;
      add("SEGM", m, i, segment(limits_.segments[i]));
      if (own_pose_[i])
        add("POSE", m, i, predicted);
      if (limits_.segments[i].components > 0)
        add("BASI", m, i, layer(limits_.segments[i]));
      if (limits_.segments[i].corrections > 0)
        add("CORR", m, i, corrections(limits_.segments[i].frames, limits_.segments[i].corrections));
    }
    for (uint32_t i = 0; i < unknown_chunks_; ++i)
      out.add("none", false, kNoMesh, kNoSegment, {});
    return out.finish();
  }

 private:
  Bytes mesh() const {
    MeshRecord record;
    record.faces = faces_;
    return record.write();
  }

  static Bytes pose(const Bytes& stream) {
    PoseRecord record;
    record.stream = stream;
    return record.write();
  }

  static LinearParameters parameters(uint32_t components) {
    LinearParameters p;
    p.affine = false;
    p.omega.assign(components, 128);
    p.sigma.assign(components, 0);
    return p;
  }

  static Bytes segment(const Limits::Segment& s) {
    const Bytes head = parameters(s.components).write();
    SegmentRecord record;
    record.parameters = head;
    return record.write();
  }

  static Bytes weights(const Limits::Segment& s) {
    BinaryEncoder encoder;
    TimeWeightModel model(s.frames);
    const std::vector<double> still(s.frames, 0.0);
    std::vector<int32_t> decoded(s.frames);
    for (uint32_t j = 0; j < s.components; ++j)
      model.encode(encoder, 1, still.data(), 0, decoded.data(), 1);
    return encoder.finish();
  }

  Bytes layer(const Limits::Segment& s) const {
    const uint32_t components = s.components;
    const LinearParameters p = parameters(components);
    VertexOrder order;
    if (make_vertex_order(topology_.triangles.data(), topology_.triangles.size() / 3, pose_.data(),
                          vertices_, p.neighbours, p.colours, &order) != Status::kOk)
      std::abort();
    CoefficientModel model(3, order.neighbours.data(), static_cast<uint32_t>(order.neighbour_count),
                           order.level_start);
    RansEncoder encoder;
    std::vector<int32_t> zeros(size_t{3} * vertices_, 0);
    for (uint32_t j = 0; j < components; ++j)
      model.code_component(encoder, zeros.data());
    const Bytes of_time = weights(s), stream = encoder.finish();
    BasisLayer layer;
    layer.count = components;
    layer.weights = of_time;
    layer.coefficients = stream;
    return layer.write();
  }

  /// One vertex in each of the last `corrected` frames.
  Bytes corrections(uint32_t frames, uint32_t corrected) const {
    BinaryEncoder encoder;
    CorrectionCoding coding(vertices_);
    Vector<IntegerCorrection> none, one(1);
    for (uint32_t f = 0; f < frames; ++f)
      coding.code_frame(encoder, 0, f + corrected < frames ? &none : &one);
    ByteWriter w;
    w.f64(1);
    w.raw(encoder.finish());
    return std::move(w.bytes());
  }

  uint32_t vertices_;
  Limits limits_;
  Topology topology_;
  Bytes faces_;
  Vector<int32_t> pose_;
  std::vector<bool> own_pose_;
  uint32_t unknown_chunks_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_TESTS_API_CRAFTED_FILE_H_
