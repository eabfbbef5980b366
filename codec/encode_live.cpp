// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_live.h"

#include "codec/encode.h"
#include "codec/file/edit_clips.h"
#include "codec/sequence/error.h"
#include "format/continuation.h"

#include <memory>
#include <utility>

namespace anicodec {
namespace {

ContainerReader container_of(const Bytes& file) {
  ContainerReader reader;
  if (!reader.open(file).ok())
    throw Error(ErrorKind::kInternal, "a file of the stream cannot be opened");
  return reader;
}

}  // namespace

LiveEncoder::LiveEncoder(MeshSequence mesh, const EncodeOptions& options, double key_every)
    : mesh_(std::move(mesh)), options_(options), key_every_(key_every) {
  options_.effort = options.effort - 1;
  const ErrorMetric metric = options.target.metric;
  if (metric == ErrorMetric::kSize || metric == ErrorMetric::kBpfv || metric == ErrorMetric::kNone ||
      is_lossless(options.target))
    throw Error(ErrorKind::kUsage, "a live stream needs an error to keep, and cannot be lossless");
  if (options.keyframes || options.basis == BasisChoice::kKeyframes || options.root_motion)
    throw Error(ErrorKind::kUsage, "key-frames and the motion of the whole need all frames, which a live stream "
                                   "does not have");
  for (Attribute& attribute : mesh_.attributes) {
    attribute.values.resize(attribute.values.size() / attribute.frames);
    attribute.frames = 1;
  }
  mesh_.clips.clear();
  mesh_.times.clear();
  mesh_.events.clear();
  mesh_.loop = false;
}

/// Lays out the mesh; no trajectory is known, so that every vertex is on its own.
void LiveEncoder::begin(const MeshSequence& sequence) {
  auto layout = std::make_shared<MeshLayout>(lay_out_mesh(sequence, no_weld(sequence.vertex_count)));
  encode_attributes(sequence, options_.attributes, layout.get());
  options_.bounds = false;  // pieces are short, and played as they come
  options_.layout = std::move(layout);
  const double size = diagonal(sequence);
  options_.target = in_scene_units(options_.target, size);
  if (options_.cap)
    options_.cap = in_scene_units(*options_.cap, size);
  // Its pose is one that all that follows can lean on.
  options_.part = FrameRun{0, sequence.frame_count};
}

EncodeResult LiveEncoder::encode(FrameArray positions) {
  MeshSequence sequence = mesh_;
  sequence.frame_count = static_cast<uint32_t>(positions.size() / 3 / mesh_.vertex_count);
  sequence.positions = std::move(positions);
  check(sequence);
  if (base_.empty())
    begin(sequence);
  const double seconds = sequence.frame_count / mesh_.rate.value();
  const double half_a_frame = 0.5 / mesh_.rate.value();
  if (since_key_ + half_a_frame >= key_every_) {
    learning_.clear();
    since_key_ = 0;
  }
  since_key_ += seconds;
  options_.learning = key_every_ > 0 ? &learning_ : nullptr;
  EncodeResult result = anicodec::encode(std::move(sequence), options_);
  mesh_.start_time += seconds;
  if (base_.empty()) {
    base_ = result.file;
    options_.pose = clip_home({"the first file", base_}).pose;
    options_.part.reset();
    mesh_.attributes.clear();
    return result;
  }
  // A file that leans on no pose is no continuation, but one with a mesh of its own.
  if (mesh_hash(container_of(result.file)) == mesh_hash(container_of(base_)))
    result.file = without_meshes(container_of(result.file));
  else
    base_ = result.file;
  return result;
}

}  // namespace anicodec
