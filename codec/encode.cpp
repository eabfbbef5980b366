// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"

#include "codec/check_file.h"
#include "codec/encode_mesh.h"
#include "codec/file/clip_file.h"
#include "codec/file/clip_record.h"
#include "codec/file/metadata_json.h"
#include "codec/massage/massage.h"
#include "codec/massage_choice.h"
#include "codec/metrics/hausdorff.h"
#include "codec/plan/encoding_memory.h"
#include "codec/plan/mesh_plan.h"
#include "codec/scene_goals.h"
#include "codec/sequence/error.h"
#include "format/container.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

EncodeResult encode_plain(MeshSequence sequence, const EncodeOptions& options,
                          const Progress& progress) {
  const MeshPlan plan = plan_mesh(sequence, options);
  EncodedMesh mesh = encode_mesh(std::move(sequence), plan, progress);
  mesh.result.file = mesh.file();
  mesh.result.massage.change = options.surface_change;
  return std::move(mesh.result);
}

/// Encodes a mesh that is there alone and always, after massage() if the options say so.
EncodeResult encode_alone(MeshSequence sequence, const EncodeOptions& options,
                          const Progress& progress) {
  MassageMode mode = options.massage.mode;
  if (mode != MassageMode::kOff && is_lossless(options.target))
    throw Error(ErrorKind::kUsage, "lossless goes without massage, which moves the vertices");
  if (mode != MassageMode::kOff && !sequence.clips.empty())
    throw Error(ErrorKind::kUsage, "several clips are not massaged together");
  check(sequence);
  MassageVerdict verdict;
  if (mode == MassageMode::kAuto && !massage_pays(sequence, options, progress, &verdict))
    mode = MassageMode::kOff;
  EncodeResult result;
  if (mode == MassageMode::kOff) {
    result = encode_plain(std::move(sequence), options, progress);
  } else {
    const double source = EncodingMemory::of(sequence).positions();
    MeshSequence massaged = massage(sequence, options.massage.options, progress).sequence;
    check(massaged);
    const HausdorffDistance moved = compare_surfaces(sequence, massaged).total;
    EncodeOptions changed = options;
    changed.most_bytes = most_bytes_beside(source, options.most_bytes);
    changed.surface_change = SurfaceChange{moved.mean(), moved.max()};
    result = encode_plain(std::move(massaged), changed, progress);
    const ErrorMetric metric = options.target.metric;
    if (mode == MassageMode::kAuto && !is_size(metric) && metric != ErrorMetric::kNone) {
      EncodeResult plain = encode_plain(std::move(sequence), options, progress);
      verdict.plain_bytes = plain.file.size();
      if (plain.file.size() <= result.file.size())
        result = std::move(plain);
    }
  }
  verdict.change = result.massage.change;
  result.massage = verdict;
  return result;
}

/// Does something with a mesh; errors name it, or its frames.
template <class Work>
auto naming(const std::string& mesh, const std::vector<FrameRun>& present_in, const Work& work) {
  const FrameRun &first = present_in.front(), &last = present_in.back();
  const std::string name = mesh.empty() ? "frames " + std::to_string(first.first) + ":" +
                                              std::to_string(last.first + last.count)
                                        : "mesh '" + mesh + "'";
  try {
    return work();
  } catch (const OverMemory& e) {
    throw OverMemory(name + ": " + e.what());
  } catch (const Error& e) {
    throw Error(e.kind(), name + ": " + e.what());
  }
}

/// Encodes the runs of frames of a mesh. One that is there in fewer frames than there shall be key-frames
/// has all of them.
std::vector<EncodedMesh> encode_runs(SceneMesh mesh, EncodeOptions options, const ClipGoal& goal,
                                     const Progress& progress) {
  std::vector<EncodedMesh> encoded;
  if (options.keyframes)
    options.keyframes = std::min(*options.keyframes, mesh.sequence.frame_count);
  const double size = diagonal(mesh.sequence);
  if (mesh.present_in.size() == 1) {
    const MeshPlan plan = plan_mesh(mesh.sequence, options, {goal}, size);
    encoded.push_back(encode_mesh(std::move(mesh.sequence), plan, progress));
    return encoded;
  }
  FrameRun part;
  for (const FrameRun& run : mesh.present_in) {
    part = {part.first + part.count, run.count};
    options.part = part;
    const MeshPlan plan = plan_mesh(mesh.sequence, options, {goal}, size);
    encoded.push_back(encode_mesh(mesh.sequence, plan, progress));
  }
  return encoded;
}

/// The results of meshes as one.
class SceneResult {
 public:
  SceneResult(const Scene& scene, const SceneExtent& extent) : extent_(extent) {
    all_.frames = scene.clip.frame_count;
    all_.rate = scene.clip.rate;
    all_.diagonal = extent.diagonal;
    vertices_.resize(all_.frames);
    faces_.resize(all_.frames);
  }

  /// Adds a run of frames of a mesh.
  void add(const EncodedMesh& mesh, uint16_t number, const FrameRun& run) {
    const EncodeResult& result = mesh.result;
    if (runs_++ == 0)
      all_.kind = result.kind;
    all_.components = std::max(all_.components, result.components);
    all_.max_error = std::max(all_.max_error, result.max_error);
    all_.max_displacement_error =
        std::max(all_.max_displacement_error, result.max_displacement_error);
    squared_ += result.rmse * result.rmse * static_cast<double>(result.positions);
    all_.positions += result.positions;
    all_.attributes.insert(all_.attributes.end(), result.attributes.begin(),
                           result.attributes.end());
    all_.trials.insert(all_.trials.end(), result.trials.begin(), result.trials.end());
    all_.search_notes.insert(all_.search_notes.end(), result.search_notes.begin(),
                             result.search_notes.end());
    all_.rmse = result.rmse;
    all_.kg = result.kg;
    for (uint32_t f = run.first; f < run.first + run.count; ++f) {
      vertices_[f] += result.vertices;
      faces_[f] += result.faces;
    }
    for (const AttributeError& e : mesh.record.clips[0].attribute_errors) {
      AttributeSum& sum = attributes_[{number, e.attribute}];
      sum.max = std::max(sum.max, e.max_error);
      sum.squared += e.rmse * e.rmse * run.count;
      sum.frames += run.count;
    }
  }

  /// Numbers of a single run are as they were measured, not rounded twice.
  EncodeResult finish() {
    all_.vertices = *std::ranges::max_element(vertices_);
    all_.faces = *std::ranges::max_element(faces_);
    if (runs_ > 1) {
      all_.rmse = std::sqrt(squared_ / extent_.positions);
      all_.kg = 100 * std::sqrt(squared_ / (extent_.spread > 0 ? extent_.spread : 1));
    }
    return std::move(all_);
  }

  Vector<AttributeError> attribute_errors() const {
    Vector<AttributeError> errors;
    for (const auto& [key, sum] : attributes_)
      errors.push_back({key.first, key.second, sum.max, std::sqrt(sum.squared / sum.frames)});
    return errors;
  }

 private:
  struct AttributeSum {
    double max = 0, squared = 0, frames = 0;
  };

  const SceneExtent& extent_;
  EncodeResult all_;
  size_t runs_ = 0;
  double squared_ = 0;
  std::vector<uint32_t> vertices_, faces_;                            ///< of each frame
  std::map<std::pair<uint16_t, uint16_t>, AttributeSum> attributes_;  ///< by mesh and attribute
};

void check_scene(const Scene& scene, const EncodeOptions& options) {
  if (scene.meshes.size() > kMaxMeshes)
    throw Error(ErrorKind::kInput,
                std::to_string(scene.meshes.size()) + " meshes; at most 65535 are possible");
  if (scene.meshes.empty())
    throw Error(ErrorKind::kInput, "there is no mesh");
  for (const SceneMesh& mesh : scene.meshes) {
    if (mesh.present_in.empty())
      throw Error(ErrorKind::kInput, "mesh '" + mesh.sequence.mesh_name + "' is in no frame");
    naming(mesh.sequence.mesh_name, mesh.present_in, [&] { check(mesh.sequence); });
  }
  if (!scene.clip.clips.empty())
    throw Error(ErrorKind::kUsage, "several clips of several meshes are not encoded together");
  if (options.root_motion)
    throw Error(ErrorKind::kUsage,
                "the motion of the whole can be apart in clips of one mesh only");
  if (options.massage.mode != MassageMode::kOff)
    throw Error(ErrorKind::kUsage, "massage is for one mesh that is always there");
  if (options.part)
    throw Error(ErrorKind::kUsage, "a part is of one mesh that is always there");
}

/// The options of each mesh.
EncodeOptions options_of_meshes(const Scene& scene, const EncodeOptions& options) {
  EncodeOptions of_mesh = options;
  std::vector<const Attribute*> attributes;
  for (const SceneMesh& mesh : scene.meshes) {
    for (const Attribute& attribute : mesh.sequence.attributes)
      attributes.push_back(&attribute);
  }
  if (options.attributes.keep)
    of_mesh.metadata = with_fields(options.metadata, attributes);
  return of_mesh;
}

EncodeResult encode_meshes(Scene scene, const EncodeOptions& options, const Progress& progress) {
  check_scene(scene, options);
  const SceneExtent extent = extent_of(scene);
  const ClipGoal goal = shared_goal(options.target, options.cap, extent);
  EncodeOptions of_mesh = options_of_meshes(scene, options);
  const bool closed = is_closed(scene);
  SceneResult all(scene, extent);
  std::vector<EncodedMesh> encoded;
  std::vector<MeshRun> placed;
  double waiting = 0;  // bytes of positions
  for (const SceneMesh& mesh : scene.meshes)
    waiting += EncodingMemory::of(mesh.sequence).positions();
  for (uint16_t m = 0; m < scene.meshes.size(); ++m) {
    SceneMesh& mesh = scene.meshes[m];
    const std::vector<FrameRun> present_in = mesh.present_in;
    const std::string name = mesh.sequence.mesh_name;
    const double own = EncodingMemory::of(mesh.sequence).positions();
    waiting -= own;
    // A mesh that is there at several times stays until the last of them is encoded.
    of_mesh.most_bytes =
        most_bytes_beside(waiting + (present_in.size() > 1 ? own : 0), options.most_bytes);
    std::vector<EncodedMesh> runs = naming(
        name, present_in, [&] { return encode_runs(std::move(mesh), of_mesh, goal, progress); });
    for (size_t r = 0; r < runs.size(); ++r) {
      all.add(runs[r], m, present_in[r]);
      runs[r].result = {};
      of_mesh.metadata.clear();  // the file has that of its first mesh
      placed.push_back({nullptr, {}, m, present_in[r].first});
      encoded.push_back(std::move(runs[r]));
    }
  }
  for (size_t i = 0; i < encoded.size(); ++i) {
    placed[i].layout = &encoded[i].layout;
    placed[i].segments = encoded[i].list();
  }
  EncodeResult result = all.finish();
  ClipsRecord record =
      clips_record(scene.clip, options,
                   clip_goals(options.target, options.cap, {extent.diagonal}, extent.diagonal));
  ClipRecord& clip = record.clips[0];
  clip.max_error = result.max_error;
  clip.max_displacement_error = result.max_displacement_error;
  clip.rmse = result.rmse;
  clip.kg = result.kg;
  clip.closed = closed;
  clip.attribute_errors = all.attribute_errors();
  result.file = scene_file(record, scene.clip.frame_count, placed);
  check_hashes(result.file);
  return result;
}

}  // namespace

EncodeResult encode(MeshSequence sequence, const EncodeOptions& options, const Progress& progress) {
  return encode_alone(std::move(sequence), options, progress);
}

EncodeResult encode(Scene scene, const EncodeOptions& options, const Progress& progress) {
  if (scene.meshes.size() != 1 || scene.meshes[0].sequence.frame_count < scene.clip.frame_count)
    return encode_meshes(std::move(scene), options, progress);
  MeshSequence sequence = std::move(scene.meshes[0].sequence);
  set_timing(scene.clip, &sequence);
  return encode_alone(std::move(sequence), options, progress);
}

}  // namespace anicodec
