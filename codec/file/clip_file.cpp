// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/clip_file.h"

#include "format/container.h"

#include <algorithm>

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

}  // namespace

Bytes clip_file(const ClipsRecord& record, const MeshLayout& layout,
                const std::vector<const EncodedSegment*>& segments) {
  constexpr uint16_t kMesh = 0;
  MeshRecord mesh;
  mesh.name = layout.name;
  mesh.faces = layout.faces;
  Limits limits;
  limits.meshes.push_back(layout.sizes);
  limits.root_frames = layout.root_frames;
  for (const ClipRecord& clip : record.clips) {
    if (record.clips.size() > 1)
      limits.clip_frames.push_back(clip.frames);
  }
  for (const EncodedSegment* segment : segments) {
    if (segment->sizes.attribute == kPositions)
      limits.frames += segment->sizes.frames;
    limits.segments.push_back(segment->sizes);
  }

  ContainerWriter file;
  file.add("LIMI", kNoMesh, kNoSegment, limits.write());
  file.add("CLIP", kNoMesh, kNoSegment, record.write());
  if (!layout.root.empty())
    file.add("ROOT", kNoMesh, kNoSegment, layout.root);
  if (!layout.metadata.empty())
    file.add("META", kNoMesh, kNoSegment, Bytes(layout.metadata.begin(), layout.metadata.end()));
  for (uint32_t i = 0; i < segments.size(); ++i) {
    if (layout.has_bounds && segments[i]->sizes.attribute == kPositions)
      file.add("BNDS", kMesh, i, bounds_record(*segments[i]));
  }
  file.add("MESH", kMesh, kNoSegment, mesh.write());
  if (record.order != OrderMode::kFree)
    file.add("VMAP", kMesh, kNoSegment, layout.vertex_map);
  if (record.order == OrderMode::kAll)
    file.add("FMAP", kMesh, kNoSegment, layout.face_map);
  if (!layout.attributes.empty())
    file.add("ATTR", kMesh, kNoSegment, layout.attributes);
  const EncodedPose* of_mesh = nullptr;  // the first one, which most segments share
  for (const EncodedSegment* segment : segments) {
    if (!of_mesh)
      of_mesh = segment->reference.get();
  }
  if (of_mesh)
    file.add("POSE", kMesh, kNoSegment, pose_record(*of_mesh));
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const EncodedSegment& s = *segments[i];
    if (s.reference && s.reference.get() != of_mesh)
      file.add("POSE", kMesh, i, pose_record(*s.reference));
    SegmentRecord segment;
    segment.hash = s.hash;
    segment.continued = s.continued_identity;
    segment.parameters = s.parameters;
    segment.pose = s.pose;
    segment.motion = s.motion;
    segment.weights = s.weights;
    file.add("SEGM", kMesh, i, segment.write());
    for (const Bytes& layer : s.layers)
      file.add("BASI", kMesh, i, layer);
    if (!s.corrections.empty())
      file.add("CORR", kMesh, i, s.corrections);
  }
  // Exact positions come last: streams play before they are there.
  for (uint32_t i = 0; i < segments.size(); ++i) {
    if (!segments[i]->exact.empty())
      file.add("DIFF", kMesh, i, segments[i]->exact);
  }
  return file.finish(limits.features());
}

}  // namespace anicodec
