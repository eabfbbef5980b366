// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/draco_encode.h"
#include "codec/search/encoder_input.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/sequence/error.h"
#include "sdk/mesh/draco_poses.h"
#include "sdk/pose/pose_coding.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"

#include <cmath>
#include <utility>

namespace anicodec::bench {

Table run_static_pose(const BenchOptions& options, double kg, int runs) {
  Table table({{"clip", "clip", ""},
               {"vertices", "coded vertices", ""},
               {"rounded", "rounded", ""},
               {"exact", "exact", ""},
               {"dependent", "dependent steps", ""},
               {"draco", "Draco pose", ""},
               {"surface_us", "surface us", "{:.2f}"},
               {"pose_us", "pose us", "{:.2f}"},
               {"draco_us", "Draco pose us", "{:.2f}"}});
  for (const std::string& name : options.clips) {
    const EncoderInput input(load_clip(name));
    const MeshLayout& layout = input.layout;
    Eigen::Vector3d origin;
    const Eigen::MatrixXd pose = input.centred_first_pose(&origin);
    // A fifth of the squared error is that of the pose, as files have it that the encoder makes.
    const double step = 2 * std::sqrt(0.2) * input.rmse_of_kg(kg);
    const double n = layout.sizes.coded_vertices;
    const PoseSurface surface(layout.topology);
    nlohmann::ordered_json row{{"clip", name}, {"vertices", layout.sizes.coded_vertices}};
    const std::pair<const char*, PoseCoding> codings[] = {{"rounded", PoseCoding::kRounded},
                                                          {"exact", PoseCoding::kExact},
                                                          {"dependent", PoseCoding::kDependent}};
    for (const auto& [key, coding] : codings) {
      const auto encoded = encode_pose_as(coding, pose, origin, step, surface);
      row[key] = encoded->stream.size();
      Vector<int32_t> decoded;
      const double seconds = median_thread_seconds(
          runs, [&] { (void)decode_pose(encoded->stream, surface, coding, &decoded); });
      if (decoded != encoded->grid.points)
        throw Error(ErrorKind::kInternal, "the pose does not come back");
      row["pose_us"] = 1e6 * seconds / n;
      if (coding != PoseCoding::kRounded)
        continue;
      const DracoPoses draco = encode_draco_poses(layout.topology, {&encoded->grid.points, 1});
      row["draco"] = draco.bytes.size();
      row["draco_us"] =
          1e6 / n * median_thread_seconds(runs, [&] {
            Vector<Vector<int32_t>> poses;
            (void)decode_draco_poses(draco.bytes, layout.topology, draco.points, 1, &poses);
          });
    }
    row["surface_us"] =
        1e6 / n * median_thread_seconds(runs, [&] { PoseSurface{layout.topology}; });
    table.add(row);
  }
  return table;
}

}  // namespace anicodec::bench
