// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The thesis' ways to interpolate: errors half way between two poses, in-betweens of a clip, speed.
#include "codec/algebra/rigid_motion.h"
#include "codec/encode.h"
#include "codec/interpolation/deformation_gradients.h"
#include "codec/interpolation/interpolation.h"
#include "codec/keyframes/keyframe_fit.h"
#include "codec/metrics/metrics.h"
#include "codec/surface/closest_point.h"
#include "codec/surface/edge_network.h"
#include "corpus/poses.h"
#include "sdk/msgi/face_graph.h"
#include "sdk/msgi/msgi.h"
#include "sdk/msgi/patch_hierarchy.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace anicodec::bench {
namespace {

using Inputs = std::vector<std::span<const float>>;

/// Frames looked at for the two poses of a clip that are farthest apart.
constexpr uint32_t kCandidates = 16;

struct PosePair {
  std::string name;
  MeshSequence clip;
  uint32_t a = 0, b = 1;

  Inputs inputs() const { return {clip.frame(a), clip.frame(b)}; }
};

EdgeError error_halfway(const EdgeNetwork& network, const std::vector<Points>& points,
                        const Points& x) {
  const double half[] = {0.5, 0.5};
  return edge_error(
      network, x, blend_edges(measure_edges(network, points), half),
      (enclosed_volume(network, points[0]) + enclosed_volume(network, points[1])) / 2);
}

/// The poses of the corpus of that name, else the two frames of a clip between which straight lines
/// do worst.
PosePair find_poses(const std::string& word) {
  const auto& names = corpus::pose_names();
  if (std::find(names.begin(), names.end(), word) != names.end())
    return {word, corpus::make_poses(word), 0, 1};
  PosePair pair{word, load_clip(word), 0, 0};
  const EdgeNetwork network(fan_triangles(pair.clip.polygons), pair.clip.vertex_count);
  const uint32_t step = std::max(1U, pair.clip.frame_count / kCandidates);
  double worst = -1;
  for (uint32_t a = 0; a < pair.clip.frame_count; a += step) {
    for (uint32_t b = a + step; b < pair.clip.frame_count; b += step) {
      const std::vector<Points> points{to_points(std::as_const(pair.clip).frame(a)),
                                       to_points(std::as_const(pair.clip).frame(b))};
      const double error = error_halfway(network, points, (points[0] + points[1]) / 2).length;
      if (error > worst) {
        worst = error;
        pair.a = a;
        pair.b = b;
      }
    }
  }
  pair.name += fmt::format(" {}-{}", pair.a, pair.b);
  return pair;
}

/// Largest distance from the inputs at their own weights, in diagonals of the clip.
double reproduction(Interpolation& interpolation, const Inputs& inputs, double diagonal) {
  double largest = 0;
  for (size_t i = 0; i < inputs.size(); ++i) {
    std::vector<double> weights(inputs.size(), 0.0);
    weights[i] = 1;
    const Points x = to_points(interpolation.evaluate(weights));
    largest = std::max(largest, (x - to_points(inputs[i])).colwise().norm().maxCoeff());
  }
  return largest / diagonal;
}

}  // namespace

Table run_poses(const std::vector<std::string>& words) {
  Table table({{"poses", "poses", ""},
               {"method", "method", ""},
               {"length_percent", "length %", "{:.3f}"},
               {"largest_percent", "largest %", "{:.1f}"},
               {"angle_degrees", "angle deg", "{:.3f}"},
               {"volume_percent", "volume %", "{:.3f}"},
               {"folded", "folded", ""},
               {"collapsed", "collapsed", ""},
               {"reproduction", "inputs off by", "{:.1e}"}});
  for (const std::string& word : words) {
    const PosePair pair = find_poses(word);
    const Inputs inputs = pair.inputs();
    const std::vector<uint32_t> triangles = fan_triangles(pair.clip.polygons);
    const EdgeNetwork network(triangles, pair.clip.vertex_count);
    const std::vector<Points> points{to_points(inputs[0]), to_points(inputs[1])};
    const double half[] = {0.5, 0.5};
    for (InterpolationMethod method : interpolation_methods()) {
      InterpolationOptions options;
      options.method = method;
      auto interpolation = make_interpolation(triangles, pair.clip.vertex_count, inputs, options);
      const EdgeError e = error_halfway(network, points, to_points(interpolation->evaluate(half)));
      nlohmann::ordered_json row;
      row["poses"] = pair.name;
      row["vertices"] = pair.clip.vertex_count;
      row["method"] = name_of(method);
      row["length_percent"] = 100 * e.length;
      row["largest_percent"] = 100 * e.largest_length;
      row["angle_degrees"] = 180 / std::numbers::pi * e.angle;
      row["volume_percent"] = 100 * e.volume;
      row["folded"] = e.folded;
      row["collapsed"] = e.collapsed;
      row["reproduction"] = reproduction(*interpolation, inputs, diagonal(pair.clip));
      table.add(std::move(row));
    }
  }
  return table;
}

Table run_between(const std::vector<std::string>& clips, uint32_t step) {
  Table table({{"clip", "clip", ""},
               {"method", "method", ""},
               {"kg", "KG %", "{:.3f}"},
               {"kg_rigid", "KG % moved rigidly", "{:.3f}"}});
  for (const std::string& word : clips) {
    MeshSequence clip = load_clip(word);
    // Up to the last key-frame.
    clip.frame_count = (clip.frame_count - 1) / step * step + 1;
    clip.positions.resize(3 * size_t{clip.vertex_count} * clip.frame_count);
    const std::vector<uint32_t> triangles = fan_triangles(clip.polygons);
    for (InterpolationMethod method :
         {InterpolationMethod::kLinear, InterpolationMethod::kPml, InterpolationMethod::kMsgi}) {
      InterpolationOptions options;
      options.method = method;
      options.leaf_faces = 8;
      MeshSequence built = clip, moved = clip;
      for (uint32_t first = 0; first + step < clip.frame_count; first += step) {
        const Inputs inputs{std::as_const(clip).frame(first),
                            std::as_const(clip).frame(first + step)};
        auto interpolation = make_interpolation(triangles, clip.vertex_count, inputs, options);
        for (uint32_t f = 1; f < step; ++f) {
          const double t = static_cast<double>(f) / step;
          const double weights[] = {1 - t, t};
          std::span<const float> x = interpolation->evaluate(weights);
          std::copy(x.begin(), x.end(), built.frame(first + f).begin());
          const RigidMotion motion = fit_rigid_motion(x, std::as_const(clip).frame(first + f));
          const Points turned = (motion.rotation * to_points(x)).colwise() + motion.translation;
          Eigen::Map<Eigen::Matrix3Xf>(moved.frame(first + f).data(), 3, turned.cols()) =
              turned.cast<float>();
        }
      }
      CompareOptions no_sted;
      no_sted.sted = false;
      nlohmann::ordered_json row;
      row["clip"] = word;
      row["step"] = step;
      row["method"] = name_of(method);
      row["kg"] = compare(clip, built, no_sted).kg;
      row["kg_rigid"] = compare(clip, moved, no_sted).kg;
      table.add(std::move(row));
    }
  }
  return table;
}

Table run_keyframes(const BenchOptions& options, const std::vector<uint32_t>& counts) {
  Table table({{"clip", "clip", ""},
               {"keyframes", "key-frames", ""},
               {"free", "KG % free weights", "{:.3f}"},
               {"linear", "linear", "{:.3f}"},
               {"msgi", "msgi", "{:.3f}"},
               {"auto", "auto", "{:.3f}"},
               {"linear_bytes", "linear bytes", ""},
               {"msgi_bytes", "msgi bytes", ""},
               {"msgi_seconds", "msgi CPU s", "{:.1f}"}});
  for (const std::string& clip : options.clips) {
    const MeshSequence sequence = load_clip(clip);
    KeyframeFitter fitter{FrameView(sequence)};
    for (uint32_t count : counts) {
      nlohmann::ordered_json row{{"clip", clip}, {"keyframes", count}};
      row["free"] = fitter.kg(fitter.fit(count, KeyframeMethod::kPivot, KeyframeWeights::kLinear));
      for (auto [name, choice] : {std::pair{"linear", InterpolationChoice::kLinear},
                                  std::pair{"msgi", InterpolationChoice::kMsgi},
                                  std::pair{"auto", InterpolationChoice::kAuto}}) {
        EncodeOptions encoding;
        encoding.basis = BasisChoice::kKeyframes;
        encoding.keyframes = count;
        encoding.interpolation = choice;
        const Stopwatch watch(CLOCK_PROCESS_CPUTIME_ID);
        const EncodeResult result = encode(sequence, encoding);
        row[name] = result.kg;
        row[fmt::format("{}_bytes", name)] = result.file.size();
        row[fmt::format("{}_seconds", name)] = watch.seconds();
      }
      table.add(std::move(row));
    }
  }
  return table;
}

Table run_msgi_speed(const std::vector<uint32_t>& vertex_counts, int runs) {
  Table table({{"vertices", "vertices", ""},
               {"leaf", "leaf", ""},
               {"hierarchy_us", "hierarchy us per vertex", "{:.2f}"},
               {"init_ms", "set up ms", "{:.1f}"},
               {"frame_ms", "frame ms", "{:.2f}"},
               {"gradients_ms", "DG frame ms", "{:.2f}"},
               {"ratio", "DG : ours", "{:.2f}"},
               {"resident_bytes", "resident bytes", ""}});
  for (uint32_t vertices : vertex_counts) {
    const MeshSequence clip = corpus::make_poses("bend", vertices);
    const std::vector<uint32_t> triangles = fan_triangles(clip.polygons);
    const float* inputs[] = {clip.frame(0).data(), clip.frame(1).data()};
    const std::vector<Points> points{to_points(std::as_const(clip).frame(0)),
                                     to_points(std::as_const(clip).frame(1))};
    const EdgeNetwork network(triangles, clip.vertex_count);
    const GradientInterpolation gradients(network, points, RotationTracking::kPrioritized);
    for (uint32_t leaf : {8U, 16U}) {
      Msgi msgi;
      Msgi::Options options;
      options.leaf_faces = leaf;
      nlohmann::ordered_json row;
      row["vertices"] = clip.vertex_count;
      row["leaf"] = leaf;
      row["init_ms"] = 1e3 * median_thread_seconds(1, [&] {
                         msgi.init(triangles.data(), triangles.size() / 3, clip.vertex_count,
                                   inputs, 2, options);
                       });
      std::vector<double> scratch((msgi.scratch_bytes() + 7) / 8);
      std::vector<float> out(3 * size_t{clip.vertex_count});
      const double half[] = {0.5, 0.5};
      row["hierarchy_us"] =
          1e6 / clip.vertex_count * median_thread_seconds(1, [&] {
            make_patch_hierarchy(
                make_face_graph(triangles.data(), triangles.size() / 3, clip.vertex_count), leaf);
          });
      // In turns, so that both meet the same neighbours on the machine.
      std::vector<double> own, others;
      for (int run = 0; run < runs; ++run) {
        own.push_back(median_thread_seconds(
            1, [&] { msgi.evaluate(half, nullptr, scratch.data(), out.data()); }));
        others.push_back(median_thread_seconds(1, [&] { gradients.evaluate(half); }));
      }
      row["frame_ms"] = 1e3 * median(own);
      row["gradients_ms"] = 1e3 * median(others);
      row["ratio"] = median(others) / median(own);
      row["resident_bytes"] = msgi.resident_bytes();
      table.add(std::move(row));
    }
  }
  return table;
}

}  // namespace anicodec::bench
