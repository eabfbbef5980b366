// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/clip_file.h"

#include "format/container.h"

#include <algorithm>
#include <utility>

namespace anicodec {
namespace {

Bytes pose_record(const EncodedPose& pose) {
  PoseRecord record;
  std::copy_n(pose.grid.origin, 3, record.origin);
  record.step = pose.grid.step;
  record.stream = pose.stream;
  return record.write();
}

/// The boxes of a segment before they are measured: as many bytes as it will have.
Bytes bounds_record(const EncodedSegment& segment) {
  BoundsRecord record = segment.bounds;
  if (record.is_empty())
    record = BoundsRecord::unmeasured(segment.sizes.frames, kFramesOfBox);
  return record.write();
}

/// A segment and the mesh that it is of.
struct PlacedSegment {
  const EncodedSegment* segment;
  Limits::Segment sizes;  ///< in the file
};

/// All segments in the order of the file.
std::vector<PlacedSegment> placed_segments(const std::vector<MeshRun>& runs) {
  std::vector<PlacedSegment> segments;
  for (const MeshRun& run : runs) {
    for (const EncodedSegment* segment : run.segments) {
      PlacedSegment& placed = segments.emplace_back(PlacedSegment{segment, segment->sizes});
      placed.sizes.first_frame += run.first_frame;
      placed.sizes.mesh = run.mesh;
    }
  }
  std::ranges::stable_sort(segments, {}, [](const PlacedSegment& placed) {
    return std::pair(placed.sizes.first_frame, placed.sizes.mesh);
  });
  return segments;
}

bool is_same(const EncodedPose& a, const EncodedPose& b) {
  return &a == &b || pose_record(a) == pose_record(b);
}

/// Adds all chunks. Returns the features that they need.
template <class Writer>
uint64_t add_chunks(const ClipsRecord& record, uint32_t frames, const std::vector<MeshRun>& runs,
                    Writer& file) {
  const std::vector<PlacedSegment> segments = placed_segments(runs);
  const MeshLayout& first = *runs[0].layout;
  Limits limits;
  limits.frames = frames;
  limits.root_frames = first.root_frames;
  std::vector<const MeshLayout*> meshes;
  for (const MeshRun& run : runs) {
    if (run.mesh == meshes.size()) {
      meshes.push_back(run.layout);
      limits.meshes.push_back(run.layout->sizes);
    }
  }
  for (const ClipRecord& clip : record.clips) {
    if (record.clips.size() > 1)
      limits.clip_frames.push_back(clip.frames);
  }
  std::vector<const EncodedPose*> poses(meshes.size());  // the first one, which most segments share
  for (const PlacedSegment& placed : segments) {
    limits.segments.push_back(placed.sizes);
    if (!poses[placed.sizes.mesh])
      poses[placed.sizes.mesh] = placed.segment->reference.get();
  }

  file.add("LIMI", kNoMesh, kNoSegment, limits.write());
  file.add("CLIP", kNoMesh, kNoSegment, record.write());
  if (!first.root.empty())
    file.add("ROOT", kNoMesh, kNoSegment, first.root);
  if (!first.metadata.empty())
    file.add("META", kNoMesh, kNoSegment, Bytes(first.metadata.begin(), first.metadata.end()));
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const auto& [segment, sizes] = segments[i];
    if (meshes[sizes.mesh]->has_bounds && sizes.attribute == kPositions)
      file.add("BNDS", sizes.mesh, i, bounds_record(*segment));
  }
  for (uint16_t m = 0; m < meshes.size(); ++m) {
    const MeshLayout& layout = *meshes[m];
    MeshRecord mesh;
    mesh.name = layout.name;
    mesh.faces = layout.faces;
    file.add("MESH", m, kNoSegment, mesh.write());
    if (record.order != OrderMode::kFree)
      file.add("VMAP", m, kNoSegment, layout.vertex_map);
    if (record.order == OrderMode::kAll)
      file.add("FMAP", m, kNoSegment, layout.face_map);
    if (!layout.attributes.empty())
      file.add("ATTR", m, kNoSegment, layout.attributes);
    if (poses[m])
      file.add("POSE", m, kNoSegment, pose_record(*poses[m]));
  }
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const EncodedSegment& s = *segments[i].segment;
    const uint16_t m = segments[i].sizes.mesh;
    if (s.reference && !is_same(*s.reference, *poses[m]))
      file.add("POSE", m, i, pose_record(*s.reference));
    SegmentRecord segment;
    segment.hash = s.hash;
    segment.continued = s.continued_identity;
    segment.parameters = s.parameters;
    segment.pose = s.pose;
    segment.motion = s.motion;
    segment.weights = s.weights;
    file.add("SEGM", m, i, segment.write());
    for (const Bytes& layer : s.layers)
      file.add("BASI", m, i, layer);
    if (!s.corrections.empty())
      file.add("CORR", m, i, s.corrections);
  }
  // Exact positions come last: streams play before they are there.
  for (uint32_t i = 0; i < segments.size(); ++i) {
    if (!segments[i].segment->exact.empty())
      file.add("DIFF", segments[i].sizes.mesh, i, segments[i].segment->exact);
  }
  return limits.features();
}

/// In place of a ContainerWriter: counts bytes, without checksums and copies.
class ContainerSize {
 public:
  void add(const char (&type)[5], uint16_t mesh, uint32_t segment, const Bytes& payload) {
    Chunk chunk;
    chunk.type = chunk_type(type);
    chunk.mesh = mesh;
    chunk.segment = segment;
    chunk.size = payload.size();
    chunks_.push_back(chunk);
    payloads_ += payload.size();
  }

  size_t finish(uint64_t features) const {
    return container_head(chunks_, features).size() + payloads_;
  }

 private:
  Vector<Chunk> chunks_;
  size_t payloads_ = 0;
};

/// A mesh that is there in all frames.
template <class Writer>
uint64_t add_chunks(const ClipsRecord& record, const MeshLayout& layout,
                    const std::vector<const EncodedSegment*>& segments, Writer& file) {
  uint32_t frames = 0;
  for (const EncodedSegment* segment : segments) {
    if (segment->sizes.attribute == kPositions)
      frames += segment->sizes.frames;
  }
  return add_chunks(record, frames, {{&layout, segments}}, file);
}

}  // namespace

Bytes clip_file(const ClipsRecord& record, const MeshLayout& layout,
                const std::vector<const EncodedSegment*>& segments) {
  ContainerWriter file;
  const uint64_t features = add_chunks(record, layout, segments, file);
  return file.finish(features);
}

size_t clip_file_bytes(const ClipsRecord& record, const MeshLayout& layout,
                       const std::vector<const EncodedSegment*>& segments) {
  ContainerSize file;
  const uint64_t features = add_chunks(record, layout, segments, file);
  return file.finish(features);
}

Bytes scene_file(const ClipsRecord& record, uint32_t frames, const std::vector<MeshRun>& runs) {
  ContainerWriter file;
  const uint64_t features = add_chunks(record, frames, runs, file);
  return file.finish(features);
}

}  // namespace anicodec
