// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_live.h"

#include "codec/encode.h"
#include "codec/file/edit_clips.h"
#include "codec/sequence/error.h"
#include "format/continuation.h"

#include <algorithm>
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
  options_.effort = less(options.effort);
  const ErrorMetric metric = options.target.metric;
  if (metric == ErrorMetric::kSize || metric == ErrorMetric::kBpfv ||
      metric == ErrorMetric::kNone || is_lossless(options.target))
    throw Error(ErrorKind::kUsage, "a live stream needs an error to keep, and cannot be lossless");
  if (options.keyframes || options.basis == BasisChoice::kKeyframes || options.root_motion)
    throw Error(ErrorKind::kUsage,
                "key-frames and the motion of the whole need all frames, which a live stream "
                "does not have");
  for (Attribute& attribute : mesh_.attributes) {
    if (attribute.frames == 0) {
      options_.attributes.moving.push_back(
          static_cast<uint32_t>(&attribute - mesh_.attributes.data()));
      continue;
    }
    attribute.values.resize(attribute.values.size() / attribute.frames);
    attribute.frames = 1;
  }
  mesh_.clips.clear();
  mesh_.times.clear();
  mesh_.events.clear();
  mesh_.loop = false;
}

/// Frames with what stands beside them: attributes that rest belong to the mesh, and are in files that bring it alone.
MeshSequence LiveEncoder::sequence_of(FrameArray positions, std::vector<FrameArray> values) const {
  MeshSequence sequence = mesh_;
  const size_t frame = size_t{3} * mesh_.vertex_count;
  sequence.frame_count = static_cast<uint32_t>(positions.size() / std::max<size_t>(frame, 1));
  sequence.positions = std::move(positions);
  size_t moving = 0;
  for (Attribute& attribute : sequence.attributes) {
    if (attribute.frames > 0)
      continue;
    const size_t wanted =
        element_count(mesh_, attribute.domain) * attribute.components * sequence.frame_count;
    if (moving == values.size() || values[moving].size() != wanted)
      throw Error(ErrorKind::kInput,
                  attribute.name + ": moves, and has no values for these frames");
    attribute.frames = sequence.frame_count;
    attribute.values = std::move(values[moving++]);
  }
  if (moving != values.size())
    throw Error(ErrorKind::kInput, "there are values of more attributes than move");
  check(sequence);
  return sequence;
}

/// Whether what moves is still coded once where the mesh says so.
bool LiveEncoder::fits(const MeshSequence& sequence) const {
  return std::ranges::all_of(*options_.stored, [&](const StoredAttribute& stored) {
    const Attribute& attribute = sequence.attributes[stored.source];
    return !stored.moves || moves_as_stored(attribute, stored);
  });
}

/// Lays out the mesh; no trajectory is known, so that every vertex is on its own.
void LiveEncoder::begin(const MeshSequence& sequence) {
  auto layout =
      std::make_shared<MeshLayout>(lay_out_mesh(sequence, no_weld(sequence.vertex_count)));
  options_.stored = std::make_shared<const std::vector<StoredAttribute>>(
      encode_attributes(sequence, options_.attributes, layout.get()));
  options_.bounds = false;  // pieces are short, and played as they come
  options_.layout = std::move(layout);
  options_.pose.reset();
  const double size = diagonal(sequence);
  options_.target = in_scene_units(options_.target, size);
  if (options_.cap)
    options_.cap = in_scene_units(*options_.cap, size);
  // Its pose is one that all that follows can lean on.
  options_.part = FrameRun{0, sequence.frame_count};
}

LivePiece LiveEncoder::encode(FrameArray positions, std::vector<FrameArray> values,
                              const Progress& progress) {
  MeshSequence sequence = sequence_of(std::move(positions), std::move(values));
  if (!base_.empty() && !fits(sequence)) {
    options_.attributes.share = false;
    base_.clear();
    learning_.clear();
    since_key_ = 0;
  }
  if (base_.empty())
    begin(sequence);
  const double seconds = sequence.frame_count / mesh_.rate.value();
  const double half_a_frame = 0.5 / mesh_.rate.value();
  if (since_key_ + half_a_frame >= key_every_) {
    learning_.clear();
    since_key_ = 0;
  }
  LivePiece piece;
  piece.is_key = since_key_ == 0;
  piece.has_mesh = true;
  options_.learning = key_every_ > 0 ? &learning_ : nullptr;
  static_cast<EncodeResult&>(piece) = anicodec::encode(std::move(sequence), options_, progress);
  mesh_.start_time += seconds;
  since_key_ += seconds;
  if (base_.empty()) {
    base_ = piece.file;
    options_.pose = clip_home({"the first file", base_}).pose;
    options_.part.reset();
    return piece;
  }
  // A file that leans on no pose is no continuation, but one with a mesh of its own.
  piece.has_mesh = mesh_hash(container_of(piece.file)) != mesh_hash(container_of(base_));
  if (piece.has_mesh)
    base_ = piece.file;
  else
    piece.file = without_meshes(container_of(piece.file));
  return piece;
}

}  // namespace anicodec
