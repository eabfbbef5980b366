// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_scene.h"

#include "codec/file/clip_record.h"
#include "codec/file/encoding_memory.h"
#include "codec/file/join_clips.h"
#include "codec/file/metadata_json.h"
#include "codec/file/target.h"
#include "codec/sequence/error.h"
#include "format/container.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

/// Length of the diagonal of the box around all meshes.
double diagonal_of(const Scene& scene) {
  MeshSequence corners;  // two vertices: of the box around each
  for (const SceneMesh& mesh : scene.meshes) {
    const FrameArray& positions = mesh.sequence.positions;
    std::array<float, 3> low{positions[0], positions[1], positions[2]}, high = low;
    for (size_t i = 0; i < positions.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], positions[i]);
      high[i % 3] = std::max(high[i % 3], positions[i]);
    }
    corners.positions.insert(corners.positions.end(), low.begin(), low.end());
    corners.positions.insert(corners.positions.end(), high.begin(), high.end());
  }
  return diagonal(corners);
}

/// How far positions are from the mean of their frame.
struct Spread {
  double squared = 0;    ///< summed
  double positions = 0;  ///< how many there are
};

Spread spread_of(const Scene& scene) {
  struct Frame {
    std::array<double, 3> origin{}, sum{};  // sums are from there, to stay exact far off
    double squared = 0, count = 0;
  };

  std::vector<Frame> frames(scene.clip.frame_count);
  for (const SceneMesh& mesh : scene.meshes) {
    uint32_t mesh_frame = 0;
    for (const FrameRun& run : mesh.present_in) {
      for (uint32_t f = run.first; f < run.first + run.count; ++f) {
        const std::span<const float> positions = mesh.sequence.frame(mesh_frame++);
        Frame& frame = frames[f];
        if (frame.count == 0)
          std::copy_n(positions.begin(), 3, frame.origin.begin());
        frame.count += mesh.sequence.vertex_count;
        for (size_t i = 0; i < positions.size(); ++i) {
          const double x = static_cast<double>(positions[i]) - frame.origin[i % 3];
          frame.sum[i % 3] += x;
          frame.squared += x * x;
        }
      }
    }
  }
  Spread spread;
  for (const Frame& frame : frames) {
    if (frame.count == 0)
      continue;
    double of_mean = 0;
    for (double x : frame.sum)
      of_mean += x * x / frame.count;
    spread.squared += std::max(0.0, frame.squared - of_mean);
    spread.positions += frame.count;
  }
  return spread;
}

/// Counts of what each frame shows.
struct Counts {
  explicit Counts(uint32_t frames) : vertices(frames), faces(frames) {}

  void add(const std::vector<FrameRun>& present_in, uint32_t more_vertices, uint32_t more_faces) {
    for (const FrameRun& run : present_in) {
      for (uint32_t f = run.first; f < run.first + run.count; ++f) {
        vertices[f] += more_vertices;
        faces[f] += more_faces;
      }
    }
  }

  std::vector<uint32_t> vertices, faces;
};

/// The target of every mesh, such that the scene keeps its own.
Target shared(const Target& target, const Spread& spread, double length) {
  if (target.metric == ErrorMetric::kSize)
    throw Error(ErrorKind::kUsage, "a target size cannot be shared out among meshes");
  if (is_lossless(target))
    return target;
  if (target.metric == ErrorMetric::kKg && spread.squared > 0)
    return {ErrorMetric::kRmse, target.value / 100 * std::sqrt(spread.squared / spread.positions),
            false};
  return in_scene_units(target, length);
}

/// Does something with a mesh; errors name it, or its frames.
template <class Work>
auto naming(const SceneMesh& mesh, const Work& work) {
  const FrameRun &first = mesh.present_in.front(), &last = mesh.present_in.back();
  const std::string name =
      mesh.sequence.mesh_name.empty()
          ? "frames " + std::to_string(first.first) + ":" + std::to_string(last.first + last.count)
          : "mesh '" + mesh.sequence.mesh_name + "'";
  try {
    return work();
  } catch (const OverMemory& e) {
    throw OverMemory(name + ": " + e.what());
  } catch (const Error& e) {
    throw Error(e.kind(), name + ": " + e.what());
  }
}

/// Encodes the runs of frames of a mesh, each to a file. One that is there in fewer frames than there shall be key-frames
/// has all of them.
std::vector<EncodeResult> encode_runs(SceneMesh mesh, EncodeOptions options,
                                      const Progress& progress) {
  std::vector<EncodeResult> results;
  if (options.keyframes)
    options.keyframes = std::min(*options.keyframes, mesh.sequence.frame_count);
  if (mesh.present_in.size() == 1) {
    results.push_back(encode(std::move(mesh.sequence), options, progress));
    return results;
  }
  FrameRun part;
  for (const FrameRun& run : mesh.present_in) {
    part = {part.first + part.count, run.count};
    options.part = part;
    results.push_back(encode(mesh.sequence, options, progress));
  }
  return results;
}

}  // namespace

EncodeResult encode_scene(Scene scene, const EncodeOptions& options, const Progress& progress) {
  if (scene.meshes.size() > kMaxMeshes)
    throw Error(ErrorKind::kInput,
                std::to_string(scene.meshes.size()) + " meshes; at most 65535 are possible");
  for (const SceneMesh& mesh : scene.meshes)
    naming(mesh, [&] { check(mesh.sequence); });
  if (!scene.clip.clips.empty())
    throw Error(ErrorKind::kUsage, "several clips of several meshes are not encoded together");
  const double length = diagonal_of(scene);
  const Spread spread = spread_of(scene);
  if (options.root_motion)
    throw Error(ErrorKind::kUsage,
                "the motion of the whole can be apart in clips of one mesh only");
  EncodeOptions of_mesh = options;
  of_mesh.target = shared(options.target, spread, length);
  if (options.cap)
    of_mesh.cap = in_scene_units(*options.cap, length);

  std::vector<const Attribute*> attributes;
  for (const SceneMesh& mesh : scene.meshes) {
    for (const Attribute& attribute : mesh.sequence.attributes)
      attributes.push_back(&attribute);
  }
  if (options.attributes.keep)
    of_mesh.metadata = with_fields(options.metadata, attributes);

  EncodeResult all;
  all.frames = scene.clip.frame_count;
  all.rate = scene.clip.rate;
  all.diagonal = length;
  Counts counts(all.frames);
  double squared = 0;
  std::vector<std::pair<EncodeResult, PlacedPart>> parts;
  double waiting = 0;  // bytes of positions
  for (const SceneMesh& mesh : scene.meshes)
    waiting += EncodingMemory::of(mesh.sequence, {}).positions();
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    SceneMesh& mesh = scene.meshes[m];
    const std::vector<FrameRun> present_in = mesh.present_in;
    const std::string name = mesh.sequence.mesh_name;
    const double own = EncodingMemory::of(mesh.sequence, {}).positions();
    waiting -= own;
    // A mesh that is there at several times stays until the last of them is encoded.
    of_mesh.most_bytes =
        most_bytes_beside(waiting + (present_in.size() > 1 ? own : 0), options.most_bytes);
    std::vector<EncodeResult> results =
        naming(mesh, [&] { return encode_runs(std::move(mesh), of_mesh, progress); });
    counts.add(present_in, results[0].vertices, results[0].faces);
    for (size_t r = 0; r < results.size(); ++r) {
      EncodeResult& result = results[r];
      if (parts.empty())
        all.kind = result.kind;
      all.components = std::max(all.components, result.components);
      all.max_error = std::max(all.max_error, result.max_error);
      all.max_displacement_error =
          std::max(all.max_displacement_error, result.max_displacement_error);
      squared += result.rmse * result.rmse * static_cast<double>(result.positions);
      all.positions += result.positions;
      all.attributes.insert(all.attributes.end(), result.attributes.begin(),
                            result.attributes.end());
      all.trials.insert(all.trials.end(), result.trials.begin(), result.trials.end());
      all.search_notes.insert(all.search_notes.end(), result.search_notes.begin(),
                              result.search_notes.end());
      parts.push_back(
          {std::move(result), {{name, {}}, static_cast<uint16_t>(m), present_in[r].first}});
    }
  }
  all.vertices = *std::ranges::max_element(counts.vertices);
  all.faces = *std::ranges::max_element(counts.faces);
  all.rmse = parts.size() == 1 ? parts[0].first.rmse : std::sqrt(squared / spread.positions);
  // Numbers measured of a single part are not rounded twice: its file is that of a plain clip.
  all.kg = parts.size() == 1 ? parts[0].first.kg
                             : 100 * std::sqrt(squared / (spread.squared > 0 ? spread.squared : 1));

  ClipsRecord record =
      clips_record(scene.clip, options, clip_goals(options.target, options.cap, {length}, length));
  ClipRecord& clip = record.clips[0];
  clip.max_error = all.max_error;
  clip.max_displacement_error = all.max_displacement_error;
  clip.rmse = all.rmse;
  clip.kg = all.kg;
  std::vector<PlacedPart> placed;
  for (auto& [result, part] : parts) {
    part.part.file = result.file;
    placed.push_back(part);
  }
  all.file = join_meshes(placed, scene.clip.frame_count, record);
  return all;
}

}  // namespace anicodec
