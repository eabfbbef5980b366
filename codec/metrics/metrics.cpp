// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/metrics/metrics.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace anicodec {
namespace {

std::span<const float> fetch(const FrameSource& source, const char* clip, uint32_t frame,
                             uint32_t vertices) {
  std::span<const float> positions = source(frame);
  if (positions.size() != size_t{vertices} * 3)
    throw Error(ErrorKind::kInput, std::string("frame ") + std::to_string(frame) + " of the " +
                                       clip + " clip has " + std::to_string(positions.size() / 3) +
                                       " vertices, not " + std::to_string(vertices));
  auto bad =
      std::find_if(positions.begin(), positions.end(), [](float x) { return !std::isfinite(x); });
  if (bad != positions.end())
    throw Error(ErrorKind::kInput, std::string("frame ") + std::to_string(frame) + ", vertex " +
                                       std::to_string((bad - positions.begin()) / 3) + " of the " +
                                       clip + " clip is not finite");
  return positions;
}

struct Box {
  double low[3] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
  double high[3] = {-std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};

  void add(const float* p) {
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], double{p[axis]});
      high[axis] = std::max(high[axis], double{p[axis]});
    }
  }

  double diagonal() const {
    return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  }
};

/// Sum of the squared distances of the points from their mean.
double spread(std::span<const float> positions) {
  double mean[3] = {0, 0, 0};
  for (size_t i = 0; i < positions.size(); i += 3) {
    for (size_t axis = 0; axis < 3; ++axis)
      mean[axis] += double{positions[i + axis]};
  }
  for (double& m : mean)
    m /= static_cast<double>(positions.size() / 3);
  double sum = 0;
  for (size_t i = 0; i < positions.size(); i += 3) {
    for (size_t axis = 0; axis < 3; ++axis) {
      double d = double{positions[i + axis]} - mean[axis];
      sum += d * d;
    }
  }
  return sum;
}

}  // namespace

double Comparison::percent(double length) const {
  return length == 0 ? 0 : 100 * length / diagonal;
}

Comparison compare(const Polygons& polygons, uint32_t vertex_count, uint32_t frame_count,
                   const FrameSource& original, const FrameSource& decoded,
                   const CompareOptions& options) {
  if (frame_count == 0 || vertex_count == 0)
    throw Error(ErrorKind::kInput, "a clip without frames or vertices cannot be compared");
  Comparison result;
  std::optional<StedMeter> sted;
  if (options.sted)
    sted.emplace(polygons, vertex_count);
  Box box;
  double error_sum = 0, spread_sum = 0, displacement_sum = 0, max_square = 0, max_change = 0;
  // Errors are kept in double: the difference of two differences would lose what they agree in.
  std::vector<double> error(size_t{vertex_count} * 3);
  result.frames.reserve(frame_count);
  for (uint32_t f = 0; f < frame_count; ++f) {
    std::span<const float> p = fetch(original, "original", f, vertex_count);
    std::span<const float> q = fetch(decoded, "decoded", f, vertex_count);
    double frame_sum = 0, frame_max = 0;
    FrameError frame;
    for (uint32_t v = 0; v < vertex_count; ++v) {
      size_t i = size_t{3} * v;
      box.add(&p[i]);
      double square = 0, change = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        double e = double{p[i + axis]} - double{q[i + axis]};
        double c = e - error[i + axis];
        square += e * e;
        change += c * c;
        error[i + axis] = e;
      }
      frame_sum += square;
      if (f > 0) {
        displacement_sum += change;
        max_change = std::max(max_change, change);
      }
      if (square > frame_max) {
        frame_max = square;
        frame.max_vertex = v;
      }
    }
    if (frame_max > max_square) {
      max_square = frame_max;
      result.max_frame = f;
      result.max_vertex = frame.max_vertex;
    }
    frame.rmse = std::sqrt(frame_sum / vertex_count);
    frame.max = std::sqrt(frame_max);
    if (sted)
      frame.sted_spatial = sted->add(p, q);
    result.frames.push_back(frame);
    error_sum += frame_sum;
    spread_sum += spread(p);
  }
  double samples = static_cast<double>(vertex_count) * frame_count;
  result.kg = 100 * std::sqrt(error_sum) / (spread_sum == 0 ? 1 : std::sqrt(spread_sum));
  result.rmse = std::sqrt(error_sum / samples);
  result.max_error = std::sqrt(max_square);
  result.max_displacement_error = std::sqrt(max_change);
  result.diagonal = box.diagonal();
  result.psnr = result.rmse == 0 ? std::numeric_limits<double>::infinity()
                                 : 20 * std::log10(result.diagonal / result.rmse);
  if (frame_count > 1)
    result.displacement_error = std::sqrt(displacement_sum / (samples - vertex_count));
  if (sted) {
    result.has_sted = true;
    result.sted = sted->finish();
  }
  return result;
}

Comparison compare(const MeshSequence& original, const MeshSequence& decoded,
                   const CompareOptions& options) {
  if (original.vertex_count != decoded.vertex_count || original.frame_count != decoded.frame_count)
    throw Error(ErrorKind::kInput,
                "the clips differ in size: " + std::to_string(original.vertex_count) +
                    " vertices and " + std::to_string(original.frame_count) + " frames against " +
                    std::to_string(decoded.vertex_count) + " and " +
                    std::to_string(decoded.frame_count));
  return compare(original.polygons, original.vertex_count, original.frame_count,
                 frames_of(original), frames_of(decoded), options);
}

}  // namespace anicodec
