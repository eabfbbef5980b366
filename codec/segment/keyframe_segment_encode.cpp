// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/keyframe_segment_encode.h"

#include "codec/connectivity/draco_encode.h"
#include "codec/segment/pose_partners.h"
#include "sdk/mesh/plain_coding.h"
#include "sdk/pose/pose_coding.h"
#include "sdk/segment/keyframe_segment.h"
#include "sdk/segment/series_coding.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Nothing if a coordinate is too large in steps.
std::optional<Pose> quantised(const std::vector<float>& points, const Eigen::Vector3d& origin,
                              double step) {
  Pose pose(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    double q =
        std::round((static_cast<double>(points[i]) - origin[static_cast<int>(i % 3)]) / step);
    if (!(std::abs(q) <= kMaxPoseCoordinate))
      return std::nullopt;
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
      double d = static_cast<double>(pose[a]) - pose[b];
      if (parent)
        d -= static_cast<double>((*parent)[a]) - (*parent)[b];
      bits += std::log2(1 + std::abs(d));
    }
  }
  return bits;
}

/// For each key-frame 0, or one more than the earlier one it is cheapest to code against.
Vector<uint32_t> choose_parents(const MeshLayout& layout, const Vector<Pose>& poses) {
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

/// False if the series leaves the range that the format holds.
bool code_series(BinaryEncoder& encoder, SeriesCoding& coding, Vector<int32_t>& series) {
  return coding.code(encoder, series.size(), SeriesCoding::best_order(series), &series);
}

int32_t rounded(double x) {
  return static_cast<int32_t>(std::clamp(std::round(x), -double{kLargest}, double{kLargest}));
}

/// Quaternions with no jump of sign, then translations, as integers. Nothing if one is too large.
std::optional<Bytes> code_motions(const std::vector<RigidMotion>& motions,
                                  const KeyframeParameters& parameters) {
  Vector<int32_t> series[7];
  Eigen::Vector4d last(0, 0, 0, 1);
  for (const RigidMotion& motion : motions) {
    Eigen::Vector4d q = Eigen::Quaterniond(motion.rotation).coeffs();
    if (q.dot(last) < 0)
      q = -q;
    last = q;
    for (int i = 0; i < 4; ++i)
      series[i].push_back(rounded(std::ldexp(q[i], parameters.rotation_bits)));
    for (int i = 0; i < 3; ++i)
      series[4 + i].push_back(rounded(motion.translation[i] / parameters.translation_step));
  }
  BinaryEncoder encoder;
  SeriesCoding coding;
  for (Vector<int32_t>& s : series) {
    if (!code_series(encoder, coding, s))
      return std::nullopt;
  }
  return encoder.finish();
}

/// The weights of each key-frame over time; those of the first are left out where the sum is one.
std::optional<Bytes> code_weights(const Eigen::MatrixXd& weights,
                                  const KeyframeParameters& parameters) {
  BinaryEncoder encoder;
  SeriesCoding coding;
  for (Eigen::Index j = parameters.sum_to_one ? 1 : 0; j < weights.cols(); ++j) {
    Vector<int32_t> series;
    for (Eigen::Index f = 0; f < weights.rows(); ++f)
      series.push_back(rounded(std::ldexp(weights(f, j), parameters.weight_bits)));
    if (!code_series(encoder, coding, series))
      return std::nullopt;
  }
  return encoder.finish();
}

/// Key-frames on their grid, and the steps of what moves them.
struct QuantisedKeyframes {
  Vector<Pose> poses;
  /// How far a unit of each weight moves a frame, squared and summed.
  double spread = 0;
  double radius = 0;  ///< the largest root mean square distance of a key-frame from the origin
};

std::optional<QuantisedKeyframes> quantise(const FrameView& clip, const KeyframeFit& fit,
                                           const KeyframeParameters& parameters) {
  const Eigen::Vector3d origin(parameters.origin);
  QuantisedKeyframes result;
  std::vector<float> first;
  for (uint32_t f : fit.keyframes) {
    std::vector<float> points =
        parameters.rigid ? aligned_frame(clip, f, fit.motions[f])
                         : std::vector<float>(clip.frame(f), clip.frame(f) + 3 * clip.vertex_count);
    std::optional<Pose> pose = quantised(points, origin, parameters.step);
    if (!pose)
      return std::nullopt;
    result.poses.push_back(std::move(*pose));
    result.radius = std::max(result.radius, rms_radius(points));
    if (first.empty())
      first = points;
    double length = parameters.sum_to_one ? rms_distance(points, first) : rms_radius(points);
    result.spread += length * length;
  }
  return result;
}

/// Steps of weights and motions that go with that of the coordinates.
void choose_steps(const QuantisedKeyframes& keyframes, KeyframeParameters& parameters) {
  const double step = parameters.step;
  double unit = step * std::sqrt(kWeightShare * 3 / std::max(keyframes.spread, step * step));
  parameters.weight_bits = static_cast<uint8_t>(std::clamp(std::ceil(-std::log2(unit)), 1.0, 24.0));
  double angle = 0.3 * step / std::max(keyframes.radius, step);
  parameters.rotation_bits =
      static_cast<uint8_t>(std::clamp(std::ceil(-std::log2(angle)), 4.0, 27.0));
  parameters.translation_step = 0.3 * step;
}

/// Whether the key-frames take 32 bits a coordinate in memory.
bool are_wide(const Vector<Pose>& poses) {
  int32_t largest = 0;
  for (const Pose& pose : poses) {
    for (int32_t q : pose)
      largest = std::max(largest, std::abs(q));
  }
  return largest > INT16_MAX;
}

/// By Draco: differences from parents, then the vertices in no triangle. False if Draco holds none.
bool code_by_draco(const MeshLayout& layout, const Vector<uint32_t>& parents, Vector<Pose> poses,
                   EncodedSegment* encoded) {
  for (size_t j = poses.size(); j-- > 0;) {
    if (uint32_t parent = parents[j]; parent != 0) {
      for (size_t i = 0; i < poses[j].size(); ++i)
        poses[j][i] -= poses[parent - 1][i];
    }
  }
  DracoPoses draco = encode_draco_poses(layout.topology, poses);
  if (draco.bytes.empty())
    return false;
  Pose rest;
  for (const Pose& pose : poses)
    rest.insert(rest.end(),
                pose.begin() + static_cast<ptrdiff_t>(3 * layout.topology.vertices_in_triangles),
                pose.end());
  const Bytes loose = encode_plain_integers(rest, 3);
  encoded->sizes.draco_bytes = static_cast<uint32_t>(draco.bytes.size());
  encoded->sizes.draco_points = draco.points;
  encoded->pose = std::move(draco.bytes);
  encoded->pose.insert(encoded->pose.end(), loose.begin(), loose.end());
  return true;
}

Bytes code_natively(const MeshLayout& layout, const Vector<uint32_t>& parents,
                    const Vector<Pose>& poses) {
  const CornerTable table(layout.topology);
  Bytes best = encode_poses(table, PoseSteps::kAny, poses, parents);
  Eigen::MatrixXd first(layout.topology.coded_vertices, 3);
  for (Eigen::Index i = 0; i < first.size(); ++i)
    first(i / 3, i % 3) = poses[0][static_cast<size_t>(i)];
  const PosePartners partners = find_partners(first, table);
  if (!partners.partner.empty()) {
    Bytes by_partners = encode_poses(table, PoseSteps::kAny, poses, parents, &partners);
    if (by_partners.size() < best.size())
      best = std::move(by_partners);
  }
  return best;
}

/// Codes key-frames.
void code_poses(const MeshLayout& layout, KeyframePoses coder, const Vector<uint32_t>& parents,
                const Vector<Pose>& poses, EncodedSegment* encoded) {
  const bool draco =
      coder != KeyframePoses::kNative && code_by_draco(layout, parents, poses, encoded);
  if (draco && coder == KeyframePoses::kDraco)
    return;
  Bytes native = code_natively(layout, parents, poses);
  if (draco && encoded->pose.size() <= native.size())
    return;
  encoded->sizes.draco_bytes = encoded->sizes.draco_points = 0;
  encoded->pose = std::move(native);
}

}  // namespace

double step_for_rounding_error(const KeyframeFit& fit, double rms) {
  // A key-frame's coordinate is off by step^2 / 12 on average, a frame's by the sum over its
  // weights.
  return rms / std::sqrt((1 + kWeightShare) * fit.noise_gain() * 3 / 12);
}

std::optional<EncodedSegment> encode_keyframes(const FrameView& clip, const KeyframeFit& fit,
                                               KeyframeWeights kind,
                                               const Eigen::Vector3d& mean_position, double step,
                                               const MeshLayout& layout, KeyframePoses coder,
                                               uint32_t leaf_faces) {
  KeyframeParameters parameters;
  parameters.sum_to_one = kind != KeyframeWeights::kLinear;
  parameters.rigid = kind == KeyframeWeights::kRigid;
  parameters.leaf_faces = static_cast<uint8_t>(leaf_faces);
  parameters.step = step;
  parameters.frames.assign(fit.keyframes.begin(), fit.keyframes.end());
  if (!parameters.rigid)
    std::copy_n(mean_position.data(), 3, parameters.origin);
  std::optional<QuantisedKeyframes> keyframes = quantise(clip, fit, parameters);
  if (!keyframes)
    return std::nullopt;
  choose_steps(*keyframes, parameters);

  Vector<Pose>& poses = keyframes->poses;
  EncodedSegment encoded;
  encoded.sizes.kind = BasisKind::kKeyframes;
  if (leaf_faces > 0)
    encoded.sizes.reconstruction = Reconstruction::kMsgi;
  encoded.sizes.frames = static_cast<uint32_t>(clip.frame_count);
  encoded.sizes.components = static_cast<uint32_t>(poses.size());
  encoded.sizes.wide_components = are_wide(poses) ? encoded.sizes.components : 0;
  parameters.parents = choose_parents(layout, poses);
  code_poses(layout, coder, parameters.parents, poses, &encoded);

  std::optional<Bytes> weights = code_weights(fit.weights, parameters);
  std::optional<Bytes> motion = parameters.rigid ? code_motions(fit.motions, parameters) : Bytes();
  if (!weights || !motion)
    return std::nullopt;
  encoded.weights = std::move(*weights);
  encoded.motion = std::move(*motion);
  encoded.parameters = parameters.write();
  return encoded;
}

}  // namespace anicodec
