// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/mesh_layout.h"
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"
#include "tests/bench/joined_quads.h"
#include "tests/bench/stopwatch.h"
#include "tools/peers/draco_frames.h"

namespace anicodec::bench {

Table run_mesh(const BenchOptions& options, int runs) {
  constexpr int kBits = 11;
  Table table({{"clip", "clip", ""},
               {"vertices", "vertices", ""},
               {"coded_vertices", "coded", ""},
               {"polygons", "polygons", ""},
               {"faces_bytes", "faces bytes", ""},
               {"faces_us", "faces us", "{:.2f}"},
               {"order_bytes", "order bytes", ""},
               {"order_us", "order us", "{:.2f}"},
               {"quads", "joined quads", ""},
               {"quad_bytes", "quads' faces bytes", ""},
               {"draco_bytes", "Draco mesh bytes", ""},
               {"draco_us", "Draco mesh us", "{:.2f}"}});
  for (const std::string& word : options.clips) {
    const MeshSequence sequence = load_clip(word);
    const MeshLayout layout = lay_out_mesh(sequence);
    const auto require = [](Status status) {
      if (status != Status::kOk)
        throw Error(ErrorKind::kInternal, "the mesh cannot be decoded");
    };
    const double faces = median_thread_seconds(runs, [&] {
      Topology topology;
      require(decode_faces(layout.faces, layout.sizes, &topology));
    });
    const double order = median_thread_seconds(runs, [&] {
      Vector<uint32_t> map;
      require(decode_vertex_map(layout.vertex_map, layout.topology, &map));
    });
    MeshSequence quads = sequence;
    quads.polygons = join_triangles(sequence);
    const MeshLayout quad_layout = lay_out_mesh(quads);
    const std::vector<char> draco =
        draco_frame(sequence, fan_triangles(sequence.polygons), 0, kBits);
    const double mesh = median_thread_seconds(runs, [&] { decode_draco(draco); });
    const double us = 1e6 / layout.sizes.coded_vertices;
    table.add({{"clip", word},
               {"vertices", sequence.vertex_count},
               {"coded_vertices", layout.sizes.coded_vertices},
               {"polygons", layout.sizes.polygons},
               {"faces_bytes", layout.faces.size()},
               {"faces_us", us * faces},
               {"order_bytes", layout.vertex_map.size()},
               {"order_us", us * order},
               {"quads", sequence.polygons.size() - quads.polygons.size()},
               {"quad_bytes", quad_layout.faces.size()},
               {"draco_bits", kBits},
               {"draco_bytes", draco.size()},
               {"draco_us", us * mesh}});
  }
  return table;
}

}  // namespace anicodec::bench
