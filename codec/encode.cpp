// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"

#include "codec/encode_mesh.h"
#include "codec/encode_scene.h"
#include "codec/massage/massage.h"
#include "codec/massage_choice.h"
#include "codec/metrics/hausdorff.h"
#include "codec/plan/encoding_memory.h"
#include "codec/plan/mesh_plan.h"
#include "codec/sequence/error.h"

#include <utility>

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

}  // namespace

EncodeResult encode(MeshSequence sequence, const EncodeOptions& options, const Progress& progress) {
  return encode_alone(std::move(sequence), options, progress);
}

EncodeResult encode(Scene scene, const EncodeOptions& options, const Progress& progress) {
  if (scene.meshes.size() != 1 || scene.meshes[0].sequence.frame_count < scene.clip.frame_count)
    return encode_scene(std::move(scene), options, progress);
  MeshSequence sequence = std::move(scene.meshes[0].sequence);
  set_timing(scene.clip, &sequence);
  return encode_alone(std::move(sequence), options, progress);
}

}  // namespace anicodec
