// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_live.h"

#include "codec/file/edit_clips.h"
#include "codec/sequence/error.h"
#include "format/continuation.h"

#include <algorithm>
#include <cmath>
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

LiveEncoder::LiveEncoder(MeshSequence mesh, const EncodeOptions& options, double key_every,
                         double box)
    : mesh_(std::move(mesh)), options_(options), box_(box), key_every_(key_every) {
  if (!(std::isfinite(box) && box >= 0))
    throw Error(ErrorKind::kUsage,
                "the diagonal that percentages are of must be finite and not negative");
  options_.effort = less(options.effort);
  const ErrorMetric metric = options.target.metric;
  if (is_size(metric) || metric == ErrorMetric::kNone || is_lossless(options.target))
    throw Error(ErrorKind::kUsage, "a live stream needs an error to keep, and cannot be lossless");
  if (options.keyframes || options.basis == BasisChoice::kKeyframes || options.root_motion ||
      options.massage.mode != MassageMode::kOff)
    throw Error(ErrorKind::kUsage,
                "key-frames, massage and the motion of the whole need all frames, which a live "
                "stream does not have");
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
  return std::ranges::all_of(*stored_, [&](const StoredAttribute& stored) {
    const Attribute& attribute = sequence.attributes[stored.source];
    return !stored.moves || moves_as_stored(attribute, stored);
  });
}

/// Lays out the mesh; no trajectory is known, so that every vertex is on its own.
void LiveEncoder::begin(const MeshSequence& sequence) {
  auto layout =
      std::make_shared<MeshLayout>(lay_out_mesh(sequence, no_weld(sequence.vertex_count)));
  stored_ = std::make_shared<const std::vector<StoredAttribute>>(
      encode_attributes(sequence, options_.attributes, layout.get()));
  layout_ = std::move(layout);
  options_.bounds = false;  // pieces are short, and played as they come
  options_.pose.reset();
  if (!goal_) {
    const double size = box_ > 0 ? box_ : diagonal(sequence);
    goal_ = clip_goals(options_.target, options_.cap, {size}, size)[0];
  }
  // Its pose is one that all that follows can lean on.
  options_.part = FrameRun{0, sequence.frame_count};
}

MeshPlan LiveEncoder::plan(const MeshSequence& sequence) {
  ClipGoal goal = *goal_;
  goal.diagonal = diagonal(sequence);
  MeshPlan plan = plan_mesh(sequence, options_, {goal}, goal.diagonal);
  plan.layout = layout_;
  plan.stored = stored_;
  plan.learning = key_every_ > 0 ? &learning_ : nullptr;
  return plan;
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
  const MeshPlan planned = plan(sequence);
  EncodedMesh encoded = encode_mesh(std::move(sequence), planned, progress);
  static_cast<EncodeResult&>(piece) = std::move(encoded.result);
  piece.file = encoded.file();
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
