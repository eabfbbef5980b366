// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/connectivity_transfer.h"

#include "codec/metrics/hausdorff.h"
#include "codec/sequence/error.h"
#include "codec/surface/mesh_quality.h"
#include "codec/surface/surface_match.h"
#include "codec/transfer/distance_fit.h"
#include "codec/transfer/geodesic_landmarks.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;

constexpr double kUnposedStiffness = 10, kPosedStiffness = 0.5;
constexpr double kStiffFit = 0.1, kSoftFit = 0.003;
constexpr int kFitRounds = 14;  // these halve the largest distance at best
constexpr int kMostAttempts = 7;
constexpr int kFewestRounds = 2,
              kKindsOfRounds = 3;  // of geodesic_landmarks(): attempts differ in them
constexpr double kReversed = 50;   // per cent of the correspondences that disagree
// Limits for a vertex that counts as carried well.
constexpr double kSlow = 1.5;        // of the median move
constexpr double kNearEdges = 0.25;  // mean edges from the surface
constexpr double kAgreement = 0.7;   // of unit normals
constexpr double kStretch = 0.2;     // of an edge
constexpr double kSamePlace = 0.05;  // of the diagonal: as well as landmarks know

std::vector<float> floats_of(const Positions& v) {
  std::vector<float> result(static_cast<size_t>(v.size()));
  std::transform(v.data(), v.data() + v.size(), result.begin(),
                 [](double x) { return static_cast<float>(x); });
  return result;
}

double diagonal_of(const Positions& v) {
  return (v.colwise().maxCoeff() - v.colwise().minCoeff()).norm();
}

/// How a frame was tried.
struct Attempt {
  /// Brought to the surface as a rigid mesh and, in `fitted`, as close as its shapes allow.
  Positions carried, fitted;
  TransferredFrame report;  ///< of `fitted`
};

/// The mesh being carried, since the segment began.
class CarriedMesh {
 public:
  explicit CarriedMesh(const SurfaceFrame& frame)
      : polygons_(frame.polygons),
        topology_(fan_triangles(frame.polygons), static_cast<uint32_t>(frame.positions.size() / 3)),
        first_(positions_of(frame.positions)),
        shape_(topology_, first_),
        registration_(topology_, shape_),
        first_edge_(mean_edge(topology_, first_)),
        last_(first_) {}

  const Polygons& polygons() const { return polygons_; }

  const SurfaceTopology& topology() const { return topology_; }

  const Positions& last() const { return last_; }

  /// Carries the mesh to a surface; it is posed by `landmarks` first. If the softer fit raises an
  /// alarm and the stiffer one does not, the stiffer one counts.
  Attempt try_surface(const SurfaceFrame& frame, const Surface& surface,
                      const TransferOptions& options, const std::vector<Landmark>& landmarks) {
    Attempt attempt;
    Positions& v = attempt.carried;
    v = start(surface);
    double dropped = 100 * residuals(surface, v).dropped_share;
    // A surface inside out is not followed: the mesh would be turned inside out as well.
    if (dropped > kReversed) {
      attempt.fitted = v;
      attempt.report = judge(frame, surface, options, dropped, v);
      return attempt;
    }
    // Posed without the surface: it would hold back what lies on the wrong part of it.
    RegistrationOptions registration;
    registration.first_stiffness = landmarks.empty() ? kUnposedStiffness : kPosedStiffness;
    registration.rounds = options.rounds;
    registration.trust_near = false;
    if (!landmarks.empty()) {
      registration_.pose(landmarks, &v);
      // Landmarks are right to some per cent of the diagonal: what they distort is undone from close by.
      registration_.run(surface, registration, &v);
      registration.first_stiffness = kUnposedStiffness;
    }
    dropped = 100 * registration_.run(surface, registration, &v).residuals.dropped_share;
    fit(surface, kStiffFit, kStiffFit, &v);
    attempt.fitted = v;
    fit(surface, kStiffFit, kSoftFit, &attempt.fitted);
    attempt.report = judge(frame, surface, options, dropped, attempt.fitted);
    if (attempt.report.alarms) {
      const TransferredFrame stiff = judge(frame, surface, options, dropped, v);
      if (!stiff.alarms) {
        attempt.fitted = v;
        attempt.report = stiff;
      }
    }
    return attempt;
  }

  /// The next frame starts from the stiffer fit: what a softer one loses of the shapes would add
  /// up.
  void accept(Positions carried) {
    before_ = std::move(last_);
    last_ = std::move(carried);
  }

  /// Landmarks on a surface that the mesh has been carried to, to `v`, perhaps wrongly in parts.
  /// Anchors are those parts that moved no faster than most, lie on the surface and have kept their
  /// lengths. Landmarks that lie well and about where the anchors say stay at the
  /// place that they have, which is known better.
  std::vector<Landmark> landmarks(const Surface& surface, const Positions& v, int rounds) const {
    const Positions normals = vertex_normals(topology_, v);
    const Eigen::VectorXd moved = (v - last_).rowwise().norm();
    std::vector<double> sorted(moved.data(), moved.data() + moved.size());
    const auto middle = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    std::vector<Anchor> anchors;
    for (uint32_t i = 0; i < topology_.vertex_count; ++i) {
      if (topology_.star[i].empty() || moved[static_cast<Index>(i)] > kSlow * *middle)
        continue;
      const std::optional<SurfacePoint> point = place(i, surface, v, normals);
      if (!point)
        continue;
      Index corner = 0;
      point->weights.maxCoeff(&corner);
      anchors.push_back(
          {i, surface.topology().triangles[point->triangle][static_cast<size_t>(corner)]});
    }
    std::vector<Landmark> result =
        geodesic_landmarks(GeodesicGraph(topology_, first_), anchors,
                           GeodesicGraph(surface.topology(), surface.positions()), surface, rounds);
    const double unsure = kSamePlace * diagonal_of(surface.positions());
    for (Landmark& landmark : result) {
      if ((landmark.position - row(v, landmark.vertex)).norm() > unsure)
        continue;
      if (const auto point = place(landmark.vertex, surface, v, normals))
        landmark.position = point->position;
    }
    return result;
  }

 private:
  TransferredFrame judge(const SurfaceFrame& frame, const Surface& surface,
                         const TransferOptions& options, double dropped, const Positions& v) const {
    TransferredFrame report;
    report.dropped = dropped;
    const HausdorffDistance distance =
        hausdorff(polygons_, floats_of(v), frame.polygons, frame.positions);
    report.mean = distance.mean();
    report.max = distance.max();
    report.tried_mean = report.mean;
    report.turned = 100 * static_cast<double>(turned_triangles(topology_, v, surface).size()) /
                    static_cast<double>(topology_.triangles.size());
    report.conformal = distortion(topology_, first_, v).conformal_mean;
    auto raise = [&report](TransferAlarm alarm, bool yes) {
      if (yes)
        report.alarms |= static_cast<uint8_t>(alarm);
    };
    const double size = diagonal_of(surface.positions());
    const double far = std::max(options.distance / 100 * size,
                                options.edges * mean_edge(surface.topology(), surface.positions()));
    raise(TransferAlarm::kDistance, !(distance.max() <= far));
    raise(TransferAlarm::kTurned, !(report.turned <= options.turned));
    raise(TransferAlarm::kDistortion, !(report.conformal <= options.conformal));
    raise(TransferAlarm::kDropped, !(report.dropped <= options.dropped));
    return report;
  }

  void fit(const Surface& surface, double first_stiffness, double last_stiffness,
           Positions* v) const {
    DistanceFitOptions options;
    options.first_stiffness = first_stiffness;
    options.last_stiffness = options.least_stiffness = last_stiffness;
    options.last_along = options.first_along;  // what slides here would add up over the frames
    options.rounds = kFitRounds;
    fit_distance(topology_, shape_, surface, options, v);
  }

  /// The place of a vertex on the surface, if it lies well: near, facing as the surface does, at its
  /// own distance from its neighbours.
  std::optional<SurfacePoint> place(uint32_t i, const Surface& surface, const Positions& v,
                                    const Positions& normals) const {
    if (is_stretched(i, v))
      return {};
    const SurfacePoint point = surface.closest(row(v, i));
    const double near = kNearEdges * first_edge_;
    if (point.square_distance > near * near ||
        surface.normal(point).dot(row(normals, i)) < kAgreement)
      return {};
    return point;
  }

  bool is_stretched(uint32_t i, const Positions& v) const {
    const auto ring = topology_.ring[i];
    return std::any_of(ring.begin(), ring.end(), [&](uint32_t j) {
      const double was = (row(first_, i) - row(first_, j)).norm();
      return std::abs((row(v, i) - row(v, j)).norm() - was) > kStretch * was;
    });
  }

  /// The last frame's positions, or where their last move leads on to if that is closer.
  Positions start(const Surface& surface) const {
    if (!before_)
      return last_;
    Positions led = 2 * last_ - *before_;
    return residual(surface, led) < residual(surface, last_) ? led : last_;
  }

  Residuals residuals(const Surface& surface, const Positions& v) const {
    Correspondences correspondences(topology_, surface, false);
    correspondences.update(v, true);
    return correspondences.residuals(v);
  }

  double residual(const Surface& surface, const Positions& v) const {
    const Residuals r = residuals(surface, v);
    // A vertex that disagrees counts as far.
    return r.rms * (1 + 10 * r.dropped_share);
  }

  Polygons polygons_;
  SurfaceTopology topology_;
  Positions first_;
  RigidShape shape_;
  Registration registration_;
  double first_edge_;
  std::optional<Positions> before_;
  Positions last_;
};

}  // namespace

std::string alarm_names(uint8_t alarms) {
  std::string text;
  for (const auto& [alarm, name] : {std::pair(TransferAlarm::kDistance, "distance"),
                                    std::pair(TransferAlarm::kTurned, "turned"),
                                    std::pair(TransferAlarm::kDistortion, "distortion"),
                                    std::pair(TransferAlarm::kDropped, "dropped")}) {
    if (alarms & static_cast<uint8_t>(alarm))
      text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text;
}

namespace {

void check_can_carry(const CarriedMesh& mesh, const Surface& surface, uint32_t frame) {
  try {
    check_openings(mesh.topology(), mesh.last(), surface);
  } catch (const Error& e) {
    throw Error(e.kind(), "frame " + std::to_string(frame) + ": " + e.what() +
                              "; one connectivity cannot serve both");
  }
}

}  // namespace

TransferResult transfer_connectivity(const SurfaceSource& source, uint32_t frame_count,
                                     const TransferOptions& options, const Progress& progress) {
  TransferResult result;
  std::unique_ptr<CarriedMesh> carried;
  for (uint32_t f = 0; f < frame_count; ++f) {
    if (progress)
      progress("transferring", static_cast<double>(f) / frame_count);
    const SurfaceFrame frame = source(f);
    const SurfaceTopology topology(fan_triangles(frame.polygons),
                                   static_cast<uint32_t>(frame.positions.size() / 3));
    if (topology.triangles.empty())
      throw Error(ErrorKind::kInput, "frame " + std::to_string(f) + " has no triangle");
    Surface surface(topology, positions_of(frame.positions));
    if (carried)
      check_can_carry(*carried, surface, f);
    surface.build_index();
    result.diagonal = std::max(result.diagonal, diagonal_of(surface.positions()));
    Attempt attempt;
    TransferredFrame& report = attempt.report;
    if (carried) {
      attempt = carried->try_surface(frame, surface, options, {});
      report.attempts = 1;
      // From the attempt that has distorted least, so that one that went astray does not lead others there.
      for (int k = 1, failed = 0; report.alarms && k < kMostAttempts && failed < kKindsOfRounds;
           ++k) {
        const int rounds = kFewestRounds + (k - 1) % kKindsOfRounds;
        const std::vector<Landmark> landmarks = carried->landmarks(surface, attempt.fitted, rounds);
        if (landmarks.empty())
          break;
        Attempt next = carried->try_surface(frame, surface, options, landmarks);
        ++failed;
        if (!next.report.alarms || next.report.conformal < attempt.report.conformal) {
          attempt = std::move(next);
          failed = 0;
        }
        report.attempts = k + 1;
      }
    }
    if (!carried || report.alarms) {
      const SurfaceFrame first = options.first_mesh ? options.first_mesh(frame) : frame;
      carried = std::make_unique<CarriedMesh>(first);
      report.first = true;
      const HausdorffDistance distance =
          options.first_mesh
              ? hausdorff(first.polygons, first.positions, frame.polygons, frame.positions)
              : HausdorffDistance{};
      report.mean = distance.mean();
      report.max = distance.max();
      TransferSegment segment;
      segment.first_frame = f;
      segment.sequence.polygons = first.polygons;
      segment.sequence.vertex_count = carried->topology().vertex_count;
      result.segments.push_back(std::move(segment));
      attempt.fitted = carried->last();
    } else {
      carried->accept(std::move(attempt.carried));
    }
    MeshSequence& sequence = result.segments.back().sequence;
    const std::vector<float> floats = floats_of(attempt.fitted);
    sequence.positions.insert(sequence.positions.end(), floats.begin(), floats.end());
    ++sequence.frame_count;
    result.frames.push_back(report);
  }
  return result;
}

}  // namespace anicodec
