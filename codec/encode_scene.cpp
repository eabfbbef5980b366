// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_scene.h"

#include "codec/check_file.h"
#include "codec/encode_mesh.h"
#include "codec/file/clip_file.h"
#include "codec/file/clip_record.h"
#include "codec/file/metadata_json.h"
#include "codec/parallel/parallel.h"
#include "codec/parallel/thread_count.h"
#include "codec/plan/encoding_memory.h"
#include "codec/plan/mesh_plan.h"
#include "codec/scene_goals.h"
#include "codec/sequence/error.h"
#include "format/container.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

/// Bytes that the encoding of a small mesh holds; stages whose size the target decides are not counted.
constexpr double kSmall = 8 << 20;
/// Bytes that each of them may hold, where memory is limited.
constexpr double kRoomOfSmall = 4 * kSmall;
constexpr size_t kMostTogether = 1024;

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
    all_.meshes = static_cast<uint32_t>(scene.meshes.size());
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

/// Metadata of the file.
std::string metadata_of(const Scene& scene, const EncodeOptions& options) {
  if (!options.attributes.keep)
    return options.metadata;
  std::vector<const Attribute*> attributes;
  for (const SceneMesh& mesh : scene.meshes) {
    for (const Attribute& attribute : mesh.sequence.attributes)
      attributes.push_back(&attribute);
  }
  return with_fields(options.metadata, attributes);
}

/// Encodes the meshes of a scene in their order: small ones together, one by a thread, others one after the other.
class MeshEncoder {
 public:
  /// `goal`: of each mesh. The meshes are used up.
  MeshEncoder(Scene& scene, const EncodeOptions& options, const ClipGoal& goal,
              const Progress& progress)
      : meshes_(scene.meshes),
        options_(options),
        metadata_(metadata_of(scene, options)),
        goal_(goal),
        progress_(progress) {
    options_.metadata.clear();
    for (const SceneMesh& mesh : meshes_)
      waiting_ += EncodingMemory::of(mesh.sequence).positions();
  }

  bool done() const { return next_ == meshes_.size(); }

  /// The runs of the next meshes, of one at least.
  std::vector<std::vector<EncodedMesh>> take() {
    const size_t small = count_small();
    std::vector<std::vector<EncodedMesh>> encoded(std::max<size_t>(small, 1));
    if (small > 1) {
      encode_together(encoded);
    } else {
      const double own = EncodingMemory::of(meshes_[next_].sequence).positions();
      // A mesh that is there at several times stays until the last of them is encoded.
      const double beside = waiting_ - (meshes_[next_].present_in.size() > 1 ? 0 : own);
      waiting_ -= own;
      encoded[0] =
          encode(next_, most_bytes_beside(beside, options_.most_bytes),
                 progress_ ? [this](std::string_view, double done) { tell(done); } : Progress());
    }
    next_ += encoded.size();
    return encoded;
  }

 private:
  /// The number of small meshes that come next, 0 if memory does for one only.
  size_t count_small() const {
    const uint64_t left = most_bytes_beside(waiting_, options_.most_bytes);
    if (left > 0 && static_cast<double>(left) < kRoomOfSmall * static_cast<double>(thread_count()))
      return 0;
    size_t count = 0;
    while (count < kMostTogether && next_ + count < meshes_.size() &&
           is_small(meshes_[next_ + count].sequence))
      ++count;
    return count;
  }

  bool is_small(const MeshSequence& mesh) const {
    const EncodingMemory memory = EncodingMemory::of(mesh, options_);
    return memory.kept(options_) + memory.thread(options_) <= kSmall;
  }

  void encode_together(std::vector<std::vector<EncodedMesh>>& encoded) {
    const uint64_t left = most_bytes_beside(waiting_, options_.most_bytes);
    const uint64_t most_bytes = left / thread_count();
    for (size_t i = 0; i < encoded.size(); ++i)
      waiting_ -= EncodingMemory::of(meshes_[next_ + i].sequence).positions();
    const std::thread::id caller = std::this_thread::get_id();
    std::vector<std::exception_ptr> errors(encoded.size());
    std::atomic<size_t> first_error = encoded.size(), finished = 0;
    parallel_tasks(encoded.size(), [&](size_t i) {
      if (i > first_error)
        return;
      try {
        isolated([&] { encoded[i] = encode(next_ + i, most_bytes, {}); });
      } catch (const ParallelCancelled&) {
        throw;
      } catch (...) {
        errors[i] = std::current_exception();
        for (size_t known = first_error; i < known && !first_error.compare_exchange_weak(known, i);)
          continue;
      }
      ++finished;
      if (progress_ && std::this_thread::get_id() == caller)
        tell(static_cast<double>(finished));
    });
    if (first_error < errors.size())
      std::rethrow_exception(errors[first_error]);
  }

  /// `done`: meshes of those at work.
  void tell(double done) const {
    progress_("encoding",
              (static_cast<double>(next_) + done) / static_cast<double>(meshes_.size()));
  }

  std::vector<EncodedMesh> encode(size_t number, uint64_t most_bytes, const Progress& progress) {
    SceneMesh& mesh = meshes_[number];
    EncodeOptions options = options_;
    options.most_bytes = most_bytes;
    if (number == 0)  // the file has that of its first mesh
      options.metadata = metadata_;
    const std::vector<FrameRun> present_in = mesh.present_in;
    const std::string name = mesh.sequence.mesh_name;
    return naming(name, present_in,
                  [&] { return encode_runs(std::move(mesh), options, goal_, progress); });
  }

  std::vector<SceneMesh>& meshes_;
  EncodeOptions options_;
  const std::string metadata_;
  const ClipGoal& goal_;
  const Progress& progress_;
  size_t next_ = 0;
  double waiting_ = 0;  ///< bytes of positions of those to come
};

}  // namespace

EncodeResult encode_scene(Scene scene, const EncodeOptions& options, const Progress& progress) {
  check_scene(scene, options);
  const SceneExtent extent = extent_of(scene);
  const ClipGoal goal = shared_goal(options.target, options.cap, extent);
  const bool closed = is_closed(scene);
  std::vector<std::vector<FrameRun>> present_in;
  for (const SceneMesh& mesh : scene.meshes)
    present_in.push_back(mesh.present_in);
  SceneResult all(scene, extent);
  std::vector<EncodedMesh> encoded;
  std::vector<MeshRun> placed;
  MeshEncoder encoder(scene, options, goal, progress);
  for (uint16_t m = 0; !encoder.done();) {
    for (std::vector<EncodedMesh>& runs : encoder.take()) {
      for (size_t r = 0; r < runs.size(); ++r) {
        const FrameRun& run = present_in[m][r];
        all.add(runs[r], m, run);
        runs[r].result = {};
        placed.push_back({nullptr, {}, m, run.first});
        encoded.push_back(std::move(runs[r]));
      }
      ++m;
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

}  // namespace anicodec
