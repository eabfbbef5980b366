// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Archives that the reference library wrote, against what it reads back from them.
#include "codec/sequence/error.h"
#include "tests/real_data.h"
#include "tests/tools/io_testing.h"
#include "tools/io/alembic/abc_clock.h"
#include "tools/io/alembic/abc_mesh.h"
#include "tools/io/alembic/abc_scene.h"
#include "tools/io/alembic/alembic.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

fs::path archives() {
  return fs::path(real_data_folder()) / "other/abc";
}

/// The archive of a JSON file: beside it or one folder up.
std::string archive_of(const fs::path& json) {
  const fs::path beside = fs::path(json).replace_extension(".abc");
  return (fs::exists(beside) ? beside : json.parent_path().parent_path() / beside.filename())
      .string();
}

/// Blocks of bytes and the SHA-256 that each should have, checked by sha256sum all at once.
class Hashes {
 public:
  template <typename T>
  void expect(std::span<const T> values, const Json& hash, const std::string& label) {
    const std::string file = std::to_string(expected_.size());
    folder_.write(file, {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
    expected_.emplace_back(hash.get<std::string>(), label);
  }

  void check() const {
    for (size_t i = 0; i < expected_.size(); ++i) {
      const std::string command = "sha256sum " + folder_ / std::to_string(i);
      FILE* pipe = ::popen(command.c_str(), "r");
      ASSERT_NE(pipe, nullptr);
      std::array<char, 65> hash = {};
      EXPECT_EQ(std::fread(hash.data(), 1, 64, pipe), 64U);
      ::pclose(pipe);
      EXPECT_EQ(hash.data(), expected_[i].first) << expected_[i].second;
    }
  }

 private:
  TemporaryFolder folder_;
  std::vector<std::pair<std::string, std::string>> expected_;
};

/// The value of a sample if the list has one for each; otherwise the one of all.
const Json& at_sample(const Json& value, size_t sample) {
  return value.is_array() ? value[sample] : value;
}

std::vector<int32_t> sizes_of(const Polygons& polygons) {
  std::vector<int32_t> sizes;
  for (size_t p = 0; p < polygons.size(); ++p)
    sizes.push_back(static_cast<int32_t>(polygons[p].size()));
  return sizes;
}

void expect_near(const std::vector<double>& found, const Json& expected, const char* what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (size_t i = 0; i < found.size(); ++i) {
    const double e = expected[i];
    EXPECT_NEAR(found[i], e, 1e-6 * std::max(1.0, std::abs(e))) << what << " " << i;
  }
}

/// The rows of a matrix for row vectors.
std::vector<double> rows_of(const AbcTransform& t) {
  std::vector<double> rows;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row)
      rows.push_back(t(row, column));
    rows.push_back(column == 3 ? 1 : 0);
  }
  return rows;
}

std::vector<double> box_of(std::span<const float> positions) {
  std::vector<double> box{INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < positions.size(); ++i) {
    const auto x = static_cast<double>(positions[i]);
    box[i % 3] = std::min(box[i % 3], x);
    box[3 + i % 3] = std::max(box[3 + i % 3], x);
  }
  return box;
}

void check_param(const AbcMesh& mesh, AttributeKind kind, const Json& expected, double time,
                 const AbcTopology& topology, const char* hash, Hashes& hashes) {
  if (expected.is_null())
    return;
  for (const AbcGeomParam& param : mesh.params().all()) {
    if (param.kind != kind || (kind == AttributeKind::kColour && param.name != expected["name"]))
      continue;
    const AbcValues values =
        mesh.params().values_at(param, time, topology.polygons, topology.vertex_count);
    EXPECT_EQ(param.scope, expected["scope"]);
    EXPECT_EQ(param.indices.has_value(), expected["indexed"]);
    hashes.expect(std::span<const float>(values.values), expected[hash], param.name + hash);
    return;
  }
  ADD_FAILURE() << "there is no such param";
}

void check_samples(const AbcArchive& archive, AbcMesh& mesh, const Json& expected, Hashes& hashes) {
  const AbcProperty& property = mesh.positions().property();
  ASSERT_EQ(property.samples, expected["samples"]);
  EXPECT_EQ(property.is_constant(), expected["positions_constant"]);
  const AbcTime& time = archive.time_of(property);
  for (uint32_t s = 0; s < property.samples; ++s) {
    const std::string sample = "sample " + std::to_string(s);
    SCOPED_TRACE(sample);
    EXPECT_NEAR(time.at(s), expected["times"][s], 1e-12);
    const AbcTopology& topology = mesh.topologies()[mesh.topology_at(time.at(s))];
    EXPECT_EQ(topology.vertex_count, at_sample(expected["vertices"], s));
    EXPECT_EQ(topology.polygons.size(), at_sample(expected["faces"], s));
    const std::vector<float> positions = mesh.positions().floats(s);
    hashes.expect(std::span<const float>(positions), expected["positions_sha256"][s],
                  sample + " positions");
    const std::vector<int32_t> sizes = sizes_of(topology.polygons);
    hashes.expect(std::span<const int32_t>(sizes), at_sample(expected["face_counts_sha256"], s),
                  sample + " face counts");
    hashes.expect(std::span<const uint32_t>(topology.polygons.corners),
                  at_sample(expected["face_indices_sha256"], s), sample + " face indices");
  }
  const double first = time.at(0), last = time.at(property.samples - 1);
  const AbcTopology& start = mesh.topologies()[mesh.topology_at(first)];
  const AbcTopology& end = mesh.topologies()[mesh.topology_at(last)];
  for (const auto& [kind, values] : {std::pair{AttributeKind::kUv, &expected["uv"]},
                                     std::pair{AttributeKind::kNormal, &expected["normals"]}}) {
    check_param(mesh, kind, *values, first, start, "expanded_sha256_first", hashes);
    check_param(mesh, kind, *values, last, end, "expanded_sha256_last", hashes);
  }
  for (const Json& param : expected["arb_geom_params"]) {
    if (param["interpretation"] == "rgb")
      check_param(mesh, AttributeKind::kColour, param, first, start, "sha256_first", hashes);
  }
  const PolygonLabels sets =
      mesh.face_sets(first, start.polygons.size(), [](const std::string&) {});
  ASSERT_EQ(sets.names.size(), expected["face_sets"].size());
  for (uint32_t i = 0; i < sets.names.size(); ++i) {
    EXPECT_EQ(sets.names[i], expected["face_sets"][i]["name"]);
    EXPECT_EQ(std::ranges::count(sets.of_polygon, i), expected["face_sets"][i]["faces"]);
  }
}

/// Compares a clip of one mesh with the archive evaluated at its times.
void check_clip(const ByteSource& source, const std::string& path, const Json& expected) {
  const Scene scene = read_alembic_meshes(source, {.mesh = path});
  const Json &times = expected["eval_times"], &visible = expected["eval_visible"];
  ASSERT_EQ(scene.clip.frame_count, times.size());
  const bool never = std::ranges::find(visible, Json(true)) == visible.end();
  std::vector<bool> seen(times.size());
  for (const SceneMesh& mesh : scene.meshes) {
    EXPECT_EQ(mesh.sequence.mesh_name, path);
    uint32_t own = 0;
    for (const FrameRun& run : mesh.present_in) {
      for (uint32_t f = run.first; f < run.first + run.count; ++f, ++own) {
        const std::string frame = "frame " + std::to_string(f);
        SCOPED_TRACE(frame);
        seen[f] = true;
        EXPECT_TRUE(never || visible[f]);
        expect_near(box_of(mesh.sequence.frame(own)), expected["world_bbox"][f], "box");
      }
    }
    EXPECT_EQ(own, mesh.sequence.frame_count);
  }
  for (size_t f = 0; f < times.size(); ++f) {
    const double expected_time = times[f];
    const double time = scene.clip.times.empty() ? static_cast<double>(f) / scene.clip.rate.value()
                                                 : scene.clip.times[f];
    EXPECT_NEAR(scene.clip.start_time + time, expected_time, 1e-5);
    EXPECT_EQ(seen[f], (never || visible[f]) && !expected["world_bbox"][f].is_null()) << f;
  }
}

/// Six times the volume inside; positive where faces are counter-clockwise seen from outside.
double volume(const MeshSequence& clip) {
  double sum = 0;
  const std::span<const float> p = clip.frame(0);
  auto at = [&](uint32_t v) -> Eigen::Vector3d {
    return Eigen::Vector3f(p[3 * v], p[3 * v + 1], p[3 * v + 2]).cast<double>();
  };
  for (size_t f = 0; f < clip.polygons.size(); ++f) {
    const std::span<const uint32_t> corners = clip.polygons[f];
    for (size_t c = 2; c < corners.size(); ++c)
      sum += at(corners[0]).dot(at(corners[c - 1]).cross(at(corners[c])));
  }
  return sum;
}

void check_archive(const std::string& path, const Json& expected) {
  const ByteSource source = file_source(path);
  if (expected.contains("refused")) {
    EXPECT_THROW(AbcArchive archive(source), Error);
    return;
  }
  AbcArchive archive(source);
  std::vector<std::string> notes;
  AbcScene scene(archive, [&](const std::string& note) { notes.push_back(note); });
  ASSERT_EQ(archive.samplings.size(), expected["time_samplings"].size());
  ASSERT_EQ(scene.nodes().size(), expected["objects"].size() + 1);
  Hashes hashes;
  for (size_t n = 1; n < scene.nodes().size(); ++n) {
    const AbcNode& node = scene.nodes()[n];
    const auto same_path = [&](const Json& entry) { return entry["path"] == node.path; };
    SCOPED_TRACE(node.path);
    const auto object = std::ranges::find_if(expected["objects"], same_path);
    ASSERT_NE(object, expected["objects"].end());
    EXPECT_EQ(node.instance_of, object->value("instance_of", std::string()));
    const auto xform = std::ranges::find_if(expected["xforms"], same_path);
    if (xform != expected["xforms"].end()) {
      AbcXform own(archive, scene.object(node));
      expect_near(rows_of(own.at(-1e9)), (*xform)["local_matrix_first"], "first matrix");
      expect_near(rows_of(own.at(1e9)), (*xform)["local_matrix_last"], "last matrix");
      EXPECT_EQ(own.inherits(0), (*xform)["inherits"]);
    }
    const auto mesh = std::ranges::find_if(expected["meshes"], same_path);
    if (mesh == expected["meshes"].end())
      continue;
    AbcMesh own(archive, scene.object(node), [](const std::string&) {});
    check_samples(archive, own, *mesh, hashes);
    check_clip(source, node.path, *mesh);
  }
  EXPECT_EQ(notes, std::vector<std::string>());
  hashes.check();
}

TEST(RealDataAlembic, AgreesWithTheReferenceLibrary) {
  if (!fs::exists(archives()))
    GTEST_SKIP() << archives() << " is not there";
  int checked = 0;
  for (const auto& entry : fs::directory_iterator(archives())) {
    if (entry.path().extension() != ".json")
      continue;
    SCOPED_TRACE(entry.path());
    std::ifstream in(entry.path());
    check_archive(archive_of(entry.path()), Json::parse(in));
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

TEST(RealDataAlembic, ClosedMeshesTurnOutwards) {
  for (const char* name : {"cesium.abc", "horse24.abc", "../Bone_Anim.abc"}) {
    const std::string path = (archives() / name).string();
    if (!fs::exists(path))
      GTEST_SKIP() << path << " is not there";
    EXPECT_GT(volume(read_alembic(file_source(path))), 0) << name;
  }
}

TEST(RealDataAlembic, HostileArchivesAreRefusedInOneLine) {
  const fs::path folder = fs::path(real_data_folder()) / "other/abc_hostile";
  if (!fs::exists(folder))
    GTEST_SKIP() << folder << " is not there";
  for (const auto& entry : fs::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    try {
      const MeshSequence clip =
          read_alembic(file_source(entry.path().string()), {.memory_limit = uint64_t{1} << 26});
      EXPECT_LE(clip.positions.size(), size_t{1} << 24);
    } catch (const Error& e) {
      EXPECT_TRUE(e.kind() == ErrorKind::kInput || e.kind() == ErrorKind::kUnsupported);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace anicodec::tools
