// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/draco_encode.h"
#include "codec/search/encoder_input.h"
#include "codec/segment/pose_partners.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "sdk/mesh/draco_poses.h"
#include "sdk/pose/pose_coding.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"
#include "tools/peers/draco_frames.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace anicodec::bench {

Table run_static_pose(const BenchOptions& options, double kg, int runs) {
  Table table({{"clip", "clip", ""},
               {"vertices", "coded vertices", ""},
               {"pose", "pose", ""},
               {"partners", "vertices with partners", ""},
               {"by_partners", "by partners", ""},
               {"search_us", "search us", "{:.2f}"},
               {"partners_us", "by partners us", "{:.2f}"},
               {"draco", "Draco pose", ""},
               {"corners_us", "corners us", "{:.2f}"},
               {"pose_us", "pose us", "{:.2f}"},
               {"draco_us", "Draco pose us", "{:.2f}"},
               {"static_us", "faces and pose us", "{:.2f}"},
               {"draco_mesh_us", "Draco mesh us", "{:.2f}"},
               {"ratio", "ours : Draco", "{:.2f}"}});
  for (const std::string& name : options.clips) {
    const MeshSequence sequence = load_clip(name);
    const EncoderInput input(sequence);
    const MeshLayout& layout = input.layout;
    Eigen::Vector3d origin;
    const Eigen::MatrixXd pose = input.centred_first_pose(&origin);
    // A fifth of the squared error is that of the pose, as files have it that the encoder makes.
    const double step = 2 * std::sqrt(0.2) * input.rmse_of_kg(kg);
    const double n = layout.sizes.coded_vertices;
    const CornerTable corners(layout.topology);
    nlohmann::ordered_json row{{"clip", name}, {"vertices", layout.sizes.coded_vertices}};
    // Decodes a pose: microseconds for a vertex.
    const auto decoding = [&](const EncodedPose& encoded) {
      Vector<int32_t> decoded;
      const double seconds = median_thread_seconds(runs, [&] {
        (void)decode_pose(encoded.stream, corners, PoseSteps::kDependent, &decoded);
      });
      if (decoded != encoded.grid.points)
        throw Error(ErrorKind::kInternal, "the pose does not come back");
      return 1e6 * seconds / n;
    };
    const auto alone = encode_pose_by(nullptr, pose, origin, step, corners);
    row["pose"] = alone->stream.size();
    row["pose_us"] = decoding(*alone);
    // Draco rounds to the step that dependent steps stand for.
    Vector<int32_t> rounded;
    for (Eigen::Index i = 0; i < pose.size(); ++i)
      rounded.push_back(static_cast<int32_t>(std::lround(pose(i / 3, i % 3) / step)));
    const DracoPoses draco = encode_draco_poses(layout.topology, {&rounded, 1});
    row["draco"] = draco.bytes.size();
    row["draco_us"] =
        1e6 / n * median_thread_seconds(runs, [&] {
          Vector<Vector<int32_t>> poses;
          (void)decode_draco_poses(draco.bytes, layout.topology, draco.points, 1, &poses);
        });
    PosePartners partners;
    row["search_us"] =
        1e6 / n * median_thread_seconds(runs, [&] { partners = find_partners(pose, corners); });
    row["partners"] = partners.partner.size() - static_cast<size_t>(std::ranges::count(
                                                    partners.partner, PosePartners::kNone));
    if (!partners.partner.empty()) {
      const auto by_partners = encode_pose_by(&partners, pose, origin, step, corners);
      row["by_partners"] = by_partners->stream.size();
      row["partners_us"] = decoding(*by_partners);
    }
    row["corners_us"] =
        1e6 / n * median_thread_seconds(runs, [&] { CornerTable{layout.topology}; });
    // All that a file of free order opens before its motion, as the encoder makes it.
    const auto best = encode_reference_pose(pose, origin, step, layout);
    const double opening = median_thread_seconds(runs, [&] {
      Topology topology;
      Vector<int32_t> decoded;
      if (decode_faces(layout.faces, layout.sizes, &topology) != Status::kOk ||
          decode_pose(best->stream, CornerTable(topology), PoseSteps::kDependent, &decoded) !=
              Status::kOk)
        throw Error(ErrorKind::kInternal, "the mesh cannot be decoded");
    });
    const double extent = (pose.colwise().maxCoeff() - pose.colwise().minCoeff()).maxCoeff();
    const int bits = std::clamp(static_cast<int>(std::ceil(std::log2(extent / step))), 1, 30);
    const std::vector<char> mesh = draco_frame(sequence, fan_triangles(sequence.polygons), 0, bits);
    const double draco_opening = median_thread_seconds(runs, [&] { decode_draco(mesh); });
    row["static_us"] = 1e6 / n * opening;
    row["draco_mesh_us"] = 1e6 / n * draco_opening;
    row["ratio"] = opening / draco_opening;
    table.add(row);
  }
  return table;
}

}  // namespace anicodec::bench
