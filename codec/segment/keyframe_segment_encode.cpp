// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/keyframe_segment_encode.h"

#include "codec/sequence/error.h"
#include "sdk/mesh/plain_coding.h"
#include "sdk/segment/keyframe_segment.h"
#include "sdk/segment/series_coding.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Pose = Vector<int32_t>;

constexpr double kWeightShare = 0.3;  // of the key-frames' rounding error, in squares
constexpr int32_t kLargest = 1 << 28;

/// Root of the mean squared distance of points from the origin.
double rms_radius(const std::vector<float>& points) {
  double s = 0;
  for (float x : points)
    s += static_cast<double>(x) * static_cast<double>(x);
  return std::sqrt(3 * s / static_cast<double>(std::max<size_t>(points.size(), 1)));
}

double rms_distance(const std::vector<float>& a, const std::vector<float>& b) {
  double s = 0;
  for (size_t i = 0; i < a.size(); ++i)
    s += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
  return std::sqrt(3 * s / static_cast<double>(std::max<size_t>(a.size(), 1)));
}

Pose quantised(const std::vector<float>& points, const Eigen::Vector3d& origin, double step) {
  Pose pose(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    double q =
        std::round((static_cast<double>(points[i]) - origin[static_cast<int>(i % 3)]) / step);
    if (!(std::abs(q) < kLargest))
      throw TooFine();
    pose[i] = static_cast<int32_t>(q);
  }
  return pose;
}

/// About the bits that a mesh coder spends on a pose, or on a difference of poses: how much
/// neighbours differ, over a sample of edges.
double edge_cost(const MeshLayout& layout, const Pose& pose, const Pose* parent) {
  const Vector<uint32_t>& triangles = layout.topology.triangles;
  size_t stride = 3 * std::max<size_t>(1, triangles.size() / 3 / 2000);
  double bits = 0;
  for (size_t t = 0; t + 2 < triangles.size(); t += stride) {
    for (size_t c = 0; c < 3; ++c) {
      size_t a = size_t{3} * triangles[t] + c, b = size_t{3} * triangles[t + 1] + c;
      double d = double{static_cast<double>(pose[a])} - pose[b];
      if (parent)
        d -= static_cast<double>((*parent)[a]) - (*parent)[b];
      bits += std::log2(1 + std::abs(d));
    }
  }
  return bits;
}

/// For each key-frame 0, or one more than the earlier one it is cheapest to code against.
Vector<uint32_t> choose_parents(const MeshLayout& layout, const std::vector<Pose>& poses) {
  Vector<uint32_t> parents(poses.size(), 0);
  for (uint32_t j = 0; j < poses.size(); ++j) {
    double least = edge_cost(layout, poses[j], nullptr);
    for (uint32_t p = 0; p < j; ++p) {
      double cost = edge_cost(layout, poses[j], &poses[p]);
      if (cost < least) {
        least = cost;
        parents[j] = p + 1;
      }
    }
  }
  return parents;
}

void code_series(BinaryEncoder& encoder, SeriesCoding& coding, Vector<int32_t>& series) {
  if (!coding.code(encoder, series.size(), SeriesCoding::best_order(series), &series))
    throw TooFine();
}

int32_t rounded(double x) {
  return static_cast<int32_t>(std::clamp(std::round(x), -double{kLargest}, double{kLargest}));
}

/// Quaternions with no jump of sign, then translations, as integers.
Bytes code_motions(const std::vector<RigidMotion>& motions, const KeyframeParameters& parameters) {
  Vector<int32_t> series[7];
  Eigen::Vector4d before(0, 0, 0, 1);
  for (const RigidMotion& motion : motions) {
    Eigen::Vector4d q = Eigen::Quaterniond(motion.rotation).coeffs();
    if (q.dot(before) < 0)
      q = -q;
    before = q;
    for (int i = 0; i < 4; ++i)
      series[i].push_back(rounded(std::ldexp(q[i], parameters.rotation_bits)));
    for (int i = 0; i < 3; ++i)
      series[4 + i].push_back(rounded(motion.translation[i] / parameters.translation_step));
  }
  BinaryEncoder encoder;
  SeriesCoding coding;
  for (Vector<int32_t>& s : series)
    code_series(encoder, coding, s);
  return encoder.finish();
}

}  // namespace

double step_for_rounding_error(const KeyframeFit& fit, double rms) {
  // A key-frame's coordinate is off by step^2 / 12 on average, a frame's by the sum over its
  // weights.
  double gain = fit.weights.squaredNorm() / static_cast<double>(fit.weights.rows());
  return rms / std::sqrt((1 + kWeightShare) * gain * 3 / 12);
}

EncodedSegment encode_keyframes(const FrameView& clip, const KeyframeFit& fit, KeyframeWeights kind,
                                const Eigen::Vector3d& mean_position, double step,
                                const MeshLayout& layout, uint32_t leaf_faces) {
  size_t k = fit.keyframes.size();
  KeyframeParameters parameters;
  parameters.sum_to_one = kind != KeyframeWeights::kLinear;
  parameters.rigid = kind == KeyframeWeights::kRigid;
  parameters.coder = layout.coder;
  parameters.leaf_faces = static_cast<uint8_t>(leaf_faces);
  parameters.step = step;
  parameters.frames.assign(fit.keyframes.begin(), fit.keyframes.end());
  Eigen::Vector3d origin = parameters.rigid ? Eigen::Vector3d::Zero().eval() : mean_position;
  std::copy_n(origin.data(), 3, parameters.origin);

  std::vector<Pose> poses;
  std::vector<float> first;
  double spread = 0;  // how far a unit of each weight moves a frame, squared and summed
  double radius = 0;
  for (uint32_t f : fit.keyframes) {
    std::vector<float> points =
        parameters.rigid ? aligned_frame(clip, f, fit.motions[f])
                         : std::vector<float>(clip.frame(f), clip.frame(f) + 3 * clip.vertex_count);
    poses.push_back(quantised(points, origin, step));
    radius = std::max(radius, rms_radius(points));
    if (first.empty())
      first = points;
    double length = parameters.sum_to_one ? rms_distance(points, first) : rms_radius(points);
    spread += length * length;
  }
  double unit = step * std::sqrt(kWeightShare * 3 / std::max(spread, step * step));
  parameters.weight_bits = static_cast<uint8_t>(std::clamp(std::ceil(-std::log2(unit)), 1.0, 24.0));
  double angle = 0.3 * step / std::max(radius, step);
  parameters.rotation_bits =
      static_cast<uint8_t>(std::clamp(std::ceil(-std::log2(angle)), 4.0, 27.0));
  parameters.translation_step = 0.3 * step;

  EncodedSegment encoded;
  encoded.sizes.kind = BasisKind::kKeyframes;
  if (leaf_faces > 0)
    encoded.sizes.reconstruction = Reconstruction::kMsgi;
  encoded.sizes.frames = static_cast<uint32_t>(clip.frame_count);
  encoded.sizes.components = static_cast<uint32_t>(k);
  int32_t largest = 0;
  for (const Pose& pose : poses) {
    for (int32_t q : pose)
      largest = std::max(largest, std::abs(q));
  }
  encoded.sizes.wide_components = largest > INT16_MAX ? encoded.sizes.components : 0;

  parameters.parents = choose_parents(layout, poses);
  for (size_t j = k; j-- > 0;) {
    if (uint32_t parent = parameters.parents[j]; parent != 0) {
      for (size_t i = 0; i < poses[j].size(); ++i)
        poses[j][i] -= poses[parent - 1][i];
    }
  }
  Pose plain;
  size_t loose_from = 0;  // the first coded vertex that Draco does not hold
  if (parameters.coder == CoderId::kDraco) {
    for (uint32_t c : layout.topology.point_vertex)
      loose_from = std::max<size_t>(loose_from, c + 1);
  }
  for (const Pose& pose : poses)
    plain.insert(plain.end(), pose.begin() + static_cast<ptrdiff_t>(3 * loose_from), pose.end());
  encoded.pose = encode_plain_integers(plain, 3);
  if (parameters.coder == CoderId::kDraco)
    encoded.draco_poses = std::move(poses);

  BinaryEncoder encoder;
  SeriesCoding coding;
  for (size_t j = parameters.sum_to_one ? 1 : 0; j < k; ++j) {
    Vector<int32_t> series(clip.frame_count);
    for (size_t f = 0; f < clip.frame_count; ++f)
      series[f] = rounded(
          std::ldexp(fit.weights(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(j)),
                     parameters.weight_bits));
    code_series(encoder, coding, series);
  }
  encoded.weights = encoder.finish();
  if (parameters.rigid)
    encoded.motion = code_motions(fit.motions, parameters);
  encoded.parameters = parameters.write();
  return encoded;
}

}  // namespace anicodec
