// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity_transfer.h"

#include "codec/error.h"
#include "codec/hausdorff.h"
#include "codec/mesh_quality.h"
#include "codec/surface_fit.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;

constexpr double kPolishLambda = 0.2;
constexpr int kPolishRounds = 3;

std::vector<float> floats_of(const Positions& v) {
  std::vector<float> result(static_cast<size_t>(v.size()));
  std::transform(v.data(), v.data() + v.size(), result.begin(),
                 [](double x) { return static_cast<float>(x); });
  return result;
}

double diagonal_of(const Positions& v) {
  return (v.colwise().maxCoeff() - v.colwise().minCoeff()).norm();
}

/// The mesh being carried, since the segment began.
class Carried {
 public:
  explicit Carried(const SurfaceFrame& frame)
      : polygons_(frame.polygons),
        topology_(fan_triangles(frame.polygons), static_cast<uint32_t>(frame.positions.size() / 3)),
        first_(positions_of(frame.positions)),
        shape_(topology_, first_),
        registration_(topology_, shape_),
        weights_(shape_matrix(topology_, first_, ShapeWeights::kMeanValue)),
        fitter_(topology_, weights_),
        last_(first_) {}

  const Polygons& polygons() const { return polygons_; }

  const SurfaceTopology& topology() const { return topology_; }

  const Positions& last() const { return last_; }

  /// Carries the mesh to a surface.
  TransferredFrame try_surface(const SurfaceFrame& frame, const Surface& surface,
                               const TransferOptions& options, int rounds, Positions* v) {
    TransferredFrame report;
    *v = start(surface);
    RegistrationOptions registration;
    registration.rounds = rounds;
    const RegistrationReport end = registration_.run(surface, registration, v);
    SurfaceFitOptions polish;
    polish.lambda = kPolishLambda;
    polish.rounds = kPolishRounds;
    fitter_.run(surface, polish, v);
    report.dropped = 100 * end.residuals.dropped_share;
    const HausdorffDistance distance =
        hausdorff(polygons_, floats_of(*v), frame.polygons, frame.positions);
    report.mean = distance.mean();
    report.max = distance.max();
    report.tried_mean = report.mean;
    report.turned = 100 * static_cast<double>(turned_triangles(topology_, *v, surface).size()) /
                    static_cast<double>(topology_.triangles.size());
    report.conformal = distortion(topology_, first_, *v).conformal_mean;
    auto raise = [&report](TransferAlarm alarm, bool yes) {
      if (yes)
        report.alarms |= static_cast<uint8_t>(alarm);
    };
    const double size = diagonal_of(surface.positions());
    raise(TransferAlarm::kDistance, !(100 * distance.max() <= options.distance * size));
    raise(TransferAlarm::kTurned, !(report.turned <= options.turned));
    raise(TransferAlarm::kDistortion, !(report.conformal <= options.conformal));
    raise(TransferAlarm::kDropped, !(report.dropped <= options.dropped));
    return report;
  }

  void accept(Positions v) {
    before_ = std::move(last_);
    last_ = std::move(v);
  }

 private:
  /// The last frame's positions, or where their last move leads on to if that is closer.
  Positions start(const Surface& surface) const {
    if (!before_)
      return last_;
    Positions led = 2 * last_ - *before_;
    return residual(surface, led) < residual(surface, last_) ? led : last_;
  }

  double residual(const Surface& surface, const Positions& v) const {
    Correspondences correspondences(topology_, surface, false);
    correspondences.update(v, true);
    const Residuals r = correspondences.residuals(v);
    // What disagrees counts as far.
    return r.rms * (1 + 10 * r.dropped_share);
  }

  Polygons polygons_;
  SurfaceTopology topology_;
  Positions first_;
  RigidShape shape_;
  Registration registration_;
  RowMatrix weights_;
  SurfaceFitter fitter_;
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

TransferResult transfer_connectivity(const SurfaceSource& source, uint32_t frame_count,
                                     const TransferOptions& options, const Progress& progress) {
  TransferResult result;
  std::unique_ptr<Carried> carried;
  bool open = false;
  for (uint32_t f = 0; f < frame_count; ++f) {
    if (progress)
      progress("transferring", static_cast<double>(f) / frame_count);
    const SurfaceFrame frame = source(f);
    const SurfaceTopology topology(fan_triangles(frame.polygons),
                                   static_cast<uint32_t>(frame.positions.size() / 3));
    if (topology.triangles.empty())
      throw Error(ErrorKind::kInput, "frame " + std::to_string(f) + " has no triangle");
    if (f == 0)
      open = topology.has_boundary();
    else if (open != topology.has_boundary())
      throw Error(ErrorKind::kInput,
                  "frame " + std::to_string(f) + " is " +
                      (open ? "closed, but frame 0 is open" : "open, but frame 0 is closed") +
                      ": one connectivity cannot serve both");
    Surface surface(topology, positions_of(frame.positions));
    surface.build_index();
    result.diagonal = std::max(result.diagonal, diagonal_of(surface.positions()));
    TransferredFrame report;
    Positions v;
    if (carried) {
      report = carried->try_surface(frame, surface, options, options.rounds, &v);
      report.attempts = 1;
      if (report.alarms) {
        report = carried->try_surface(frame, surface, options, 2 * options.rounds, &v);
        report.attempts = 2;
      }
    }
    if (!carried || report.alarms) {
      carried = std::make_unique<Carried>(frame);
      report.first = true;
      report.mean = report.max = 0;
      TransferSegment segment;
      segment.first_frame = f;
      segment.sequence.polygons = frame.polygons;
      segment.sequence.vertex_count = carried->topology().vertex_count;
      result.segments.push_back(std::move(segment));
      v = carried->last();
    } else {
      carried->accept(v);
    }
    MeshSequence& sequence = result.segments.back().sequence;
    const std::vector<float> floats = floats_of(v);
    sequence.positions.insert(sequence.positions.end(), floats.begin(), floats.end());
    ++sequence.frame_count;
    result.frames.push_back(report);
  }
  return result;
}

}  // namespace anicodec
