// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Writes inputs to start the fuzz targets of the format from: FOLDER/TARGET/NAME, as each target's
// source says what its bytes are. The same ones in every run.
//
// usage: format_seeds FOLDER
#include "format/coding/binary_coder.h"
#include "format/coding/coefficient_model.h"
#include "format/coding/rans_coder.h"
#include "format/coding/symbol_model.h"
#include "format/coding/time_weights.h"
#include "sdk/mesh/topology.h"
#include "tests/fuzz/fuzz_files.h"
#include "tests/fuzz/fuzz_neighbours.h"
#include "tests/random.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <initializer_list>

using namespace anicodec;

namespace {

class Seeds {
 public:
  explicit Seeds(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void add(const char* target, const std::string& name, const Bytes& head, ByteView rest,
           const Bytes& tail = {}) {
    std::filesystem::create_directories(folder_ / target);
    std::ofstream out(folder_ / target / name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(head.data()),
              static_cast<std::streamsize>(head.size()));
    out.write(reinterpret_cast<const char*>(rest.data), static_cast<std::streamsize>(rest.size));
    out.write(reinterpret_cast<const char*>(tail.data()),
              static_cast<std::streamsize>(tail.size()));
    good_ = good_ && out.flush();
  }

  bool good() const { return good_; }

 private:
  std::filesystem::path folder_;
  bool good_ = true;
};

Bytes bytes_of(std::initializer_list<size_t> values) {
  Bytes result;
  for (const size_t value : values)
    result.push_back(static_cast<uint8_t>(value));
  return result;
}

constexpr size_t kDependentSteps = 1;  // of pose_fuzz

/// Faces, and poses over them, where counts and corners fit bytes.
void add_mesh(Seeds& seeds, const FuzzFile& file) {
  Limits limits;
  Topology topology;
  for (const FuzzPart& part : file.parts) {
    const std::string type = chunk_name(part.chunk.type);
    if (type == "LIMI" && Limits::read(part.payload, &limits) != Status::kOk)
      std::abort();
    MeshRecord mesh;
    if (type == "MESH" && MeshRecord::read(part.payload, &mesh) == Status::kOk) {
      const Limits::Mesh& sizes = limits.meshes[0];
      if (decode_faces(mesh.faces, sizes, &topology) != Status::kOk)
        std::abort();
      const size_t eights = std::min<size_t>((sizes.coded_vertices - 1) / 8, 255);
      size_t times = 1;
      while (times < 9 && (sizes.polygons % times != 0 || sizes.polygons / times > 255))
        ++times;
      const size_t more = sizes.corners - size_t{3} * sizes.polygons;
      if (sizes.polygons / times <= 255 && more < 64)
        seeds.add("faces", file.name,
                  bytes_of({sizes.coded_vertices - 1 - 8 * eights, eights,
                            sizes.source_vertices - sizes.coded_vertices, sizes.polygons / times,
                            times - 1, more}),
                  mesh.faces);
    }
    PoseRecord pose;
    const size_t triangles = topology.triangles.size() / 3;
    if (type == "POSE" && triangles <= 255 && topology.coded_vertices <= 256 &&
        PoseRecord::read(part.payload, &pose) == Status::kOk) {
      Bytes head = bytes_of({topology.coded_vertices - 1, kDependentSteps, 0, triangles});
      for (const uint32_t v : topology.triangles)
        head.push_back(static_cast<uint8_t>(v));
      seeds.add("pose", file.name + std::to_string(part.chunk.segment), head, pose.stream);
    }
  }
}

/// Mostly small ones, some as large as `limit` allows.
std::vector<int32_t> residuals(size_t count, int32_t limit, Random& random) {
  std::vector<int32_t> q(count);
  for (int32_t& x : q) {
    const int32_t bits = static_cast<int32_t>(random() % 8);
    x = bits < 5   ? 0
        : bits < 7 ? static_cast<int32_t>(random() % 5) - 2
                   : static_cast<int32_t>(random() % static_cast<uint32_t>(limit)) - limit / 2;
  }
  return q;
}

constexpr uint32_t kComponents = 4, kStride = FuzzNeighbours::kStride;

void add_coefficients(Seeds& seeds) {
  Random random(1);
  for (const size_t vertices : {1, 40, 255}) {
    for (const size_t channels : {1, 3}) {
      for (const int32_t limit : {3, 40, 1 << 20}) {
        const std::string name =
            std::to_string(vertices) + "_" + std::to_string(channels) + "_" + std::to_string(limit);
        const FuzzNeighbours levels(static_cast<uint32_t>(vertices));
        RansEncoder encoder;
        CoefficientModel model(static_cast<uint32_t>(channels), levels.ranks.data(), kStride,
                               levels.levels);
        for (uint32_t j = 0; j < kComponents; ++j) {
          auto q = residuals(channels * vertices, limit, random);
          model.code_component(encoder, q.data());
        }
        seeds.add("entropy", "coefficients_" + name, bytes_of({channels == 1 ? 1U : 2U, vertices}),
                  encoder.finish());
      }
    }
  }
}

void add_weights(Seeds& seeds) {
  for (const size_t frames : {1, 30, 150}) {
    for (uint32_t predictor = 0; predictor < kWeightPredictors; ++predictor) {
      BinaryEncoder encoder;
      TimeWeightModel model(static_cast<uint32_t>(frames));
      for (const uint32_t channels : {3u, 1u, 3u, 1u}) {
        std::vector<double> x(channels * frames);
        for (size_t i = 0; i < x.size(); ++i)
          x[i] = 300.0 / channels * std::sin(0.2 * static_cast<double>(i * (predictor + 1)));
        std::vector<int32_t> values(x.size());
        model.encode(encoder, channels, x.data(), 0.1, values.data(), 1U << predictor);
      }
      seeds.add("entropy", "weights_" + std::to_string(predictor) + "_" + std::to_string(frames),
                bytes_of({3, frames}), encoder.finish());
    }
  }
}

void add_integers(Seeds& seeds) {
  BinaryEncoder encoder;
  SymbolModel<> model;
  for (const int32_t x : {0, 1, -1, 0, 100, -5000, 1 << 20, 0, 0, 7})
    model.code(encoder, x);
  seeds.add("entropy", "integers", bytes_of({0, 10}), encoder.finish());
  for (size_t kind = 0; kind < 4; ++kind) {
    seeds.add("entropy", "zeros_" + std::to_string(kind), bytes_of({kind, 60}), Bytes(60, 0));
    seeds.add("entropy", "ones_" + std::to_string(kind), bytes_of({kind, 60}), Bytes(60, 0xFF));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2)
    return 2;
  Seeds seeds(argv[1]);
  Random random(2);
  Bytes script(24);
  const std::vector<FuzzFile> files = fuzz_files();
  for (size_t number = 0; number < files.size(); ++number) {
    const FuzzFile& file = files[number];
    for (size_t i = 0; i < file.parts.size(); ++i)
      seeds.add("chunk", file.name + "_" + std::to_string(i), bytes_of({number, i}),
                file.parts[i].payload);
    add_mesh(seeds, file);
    for (uint8_t& byte : script)
      byte = static_cast<uint8_t>(random());
    for (size_t more = 0; more < 8; more += 7) {
      script[0] = static_cast<uint8_t>(number);
      script[1] = static_cast<uint8_t>(more);
      seeds.add("api", file.name + std::to_string(more), {}, file.bytes, script);
      seeds.add("stream", file.name + std::to_string(more), {}, file.bytes, script);
    }
  }
  // A file that half of another one follows.
  const Bytes& other = files[1].bytes;
  seeds.add("stream", "half_of_another", files[0].bytes, {other.data(), other.size() / 2}, script);
  add_coefficients(seeds);
  add_weights(seeds);
  add_integers(seeds);
  // Poses over vertices without triangles.
  for (size_t steps = 0; steps < 2; ++steps)
    seeds.add("pose", "no_triangles" + std::to_string(steps), bytes_of({8, steps, 0x3F, 0}),
              Bytes(40, 0xFF));
  // Clips and options at random.
  for (int number = 0; number < 100; ++number) {
    Bytes decisions(4096);
    for (uint8_t& byte : decisions)
      byte = static_cast<uint8_t>(random());
    seeds.add("encode", std::to_string(number), {}, decisions);
  }
  if (!seeds.good())
    std::fprintf(stderr, "cannot write %s\n", argv[1]);
  return seeds.good() ? 0 : 1;
}
