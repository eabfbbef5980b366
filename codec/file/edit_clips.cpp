// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/edit_clips.h"

#include "codec/file/part_chunks.h"
#include "codec/sequence/error.h"
#include "format/coding/binary_coder.h"
#include "format/container.h"
#include "format/root_record.h"
#include "sdk/clip/clip.h"
#include "sdk/clip/root_coding.h"
#include "sdk/mesh/topology.h"
#include "sdk/pose/reference_pose.h"

#include <algorithm>
#include <set>
#include <utility>

namespace anicodec {
namespace {

std::string text_of(const String& text) {
  return {text.begin(), text.end()};
}

/// A file, its records read.
struct Opened {
  explicit Opened(const ClipPart& part) : file(part) {
    check(reader.open(part.file).status);
    check_known_chunks(*this, part);
    check(Limits::read(payload("LIMI"), &limits));
    check(ClipsRecord::read(payload("CLIP"), limits, &record));
    if (limits.meshes.size() != 1)
      fail(file, ErrorKind::kUnsupported, "has several meshes: its clips stay as they are");
    series.resize(record.clips.size());
    root.resize(record.clips.size());
    if (limits.root_frames > 0)
      read_root();
  }

  void check(Status status) const {
    if (status != Status::kOk)
      fail(file, ErrorKind::kCorrupt, status_string(status));
  }

  ByteView payload(const Chunk& chunk) const {
    ByteView view;
    check(reader.payload(chunk, &view).status);
    return view;
  }

  /// The payload of a chunk that must be there.
  ByteView payload(const char (&type)[5]) const {
    const Chunk* chunk = reader.find(type);
    if (!chunk)
      check(Status::kChunkMissing);
    return payload(*chunk);
  }

  /// The payload of a chunk of the mesh; empty when there is none.
  ByteView of_mesh(const char (&type)[5]) const {
    const Chunk* chunk = reader.find(type, 0);
    return chunk ? payload(*chunk) : ByteView();
  }

  void read_root() {
    RootRecord stored;
    check(RootRecord::read(payload("ROOT"), limits, &stored));
    BinaryDecoder decoder(stored.stream.data, stored.stream.size);
    RootCoding coding;
    for (size_t c = 0; c < root.size(); ++c) {
      root[c] = stored.clips[c];
      if (!coding.code(decoder, root[c].holds, limits.clip_frames[c], &series[c]))
        check(Status::kEntropy);
    }
    if (!decoder.finish())
      check(Status::kEntropy);
  }

  ClipPart file;
  ContainerReader reader;
  Limits limits;
  ClipsRecord record;
  std::vector<RootRecord::Clip> root;
  std::vector<RootSeries> series;
};

/// A segment, where it comes from and where it goes.
struct Moved {
  const Opened* from;
  uint32_t number;
  uint32_t first_frame;
};

/// Clips and segments of one file or two, in the order of frames.
class Edited {
 public:
  explicit Edited(const Opened& base) : base_(base), record_(base.record) { record_.clips = {}; }

  void add_clip(const Opened& from, size_t clip) {
    record_.clips.push_back(from.record.clips[clip]);
    limits_.clip_frames.push_back(from.record.clips[clip].frames);
    root_.clips.push_back(from.root[clip]);
    series_.push_back(from.series[clip]);
    if (from.root[clip].holds != 0)
      limits_.root_frames += from.record.clips[clip].frames;
    limits_.frames += from.record.clips[clip].frames;
  }

  void add_segment(const Moved& segment) { segments_.push_back(segment); }

  uint32_t frames() const { return limits_.frames; }

  Bytes file() {
    std::ranges::stable_sort(segments_, {}, &Moved::first_frame);
    limits_.meshes = base_.limits.meshes;
    const ByteView pose = base_.of_mesh("POSE");
    for (const Moved& s : segments_) {
      Limits::Segment sizes = s.from->limits.segments[s.number];
      sizes.first_frame = s.first_frame;
      limits_.segments.push_back(sizes);
    }
    ContainerWriter out;
    record_.place();
    out.add("LIMI", kNoMesh, kNoSegment, limits_.write());
    out.add("CLIP", kNoMesh, kNoSegment, record_.write());
    if (limits_.root_frames > 0)
      out.add("ROOT", kNoMesh, kNoSegment, root());
    add_copied(base_, kNoMesh, out);
    for (uint32_t i = 0; i < segments_.size(); ++i)
      add_chunks(segments_[i], i, ChunkPlace::kBeforeMeshes, out);
    add_mesh(base_, out);
    for (uint32_t i = 0; i < segments_.size(); ++i) {
      const Moved& s = segments_[i];
      // A segment that leans on the pose of another file brings it along.
      const bool linear = limits_.segments[i].kind != BasisKind::kKeyframes;
      const ByteView own = s.from->of_mesh("POSE");
      if (linear && !s.from->reader.find("POSE", 0, s.number) && !equal(own, pose))
        out.add("POSE", 0, i, copy(own));
      add_chunks(s, i, ChunkPlace::kWithSegment, out);
    }
    for (uint32_t i = 0; i < segments_.size(); ++i)
      add_chunks(segments_[i], i, ChunkPlace::kBehindSegments, out);
    Bytes bytes = out.finish(limits_.features());
    Clip opened;
    Failure failure = opened.open(bytes);
    if (failure.ok())
      failure = opened.check_hashes();
    if (failure.status == Status::kSegmentMissing)
      fail(base_.file, ErrorKind::kUnsupported,
           "has a segment that continues one of a clip that would be gone");
    if (!failure.ok())
      fail(base_.file, ErrorKind::kInternal,
           std::string("the file with other clips is not valid: ") + status_string(failure.status));
    return bytes;
  }

 private:
  /// Adds the chunks of a segment that stand in this place, under its new number.
  static void add_chunks(const Moved& segment, uint32_t number, ChunkPlace place,
                         ContainerWriter& out) {
    for (const Chunk& chunk : segment.from->reader.chunks()) {
      if (goes_along(chunk) && chunk.segment == segment.number && place_of(chunk) == place)
        out.add(chunk, 0, number, copy(segment.from->payload(chunk)));
    }
  }

  Bytes root() {
    BinaryEncoder encoder;
    RootCoding coding;
    for (size_t c = 0; c < series_.size(); ++c)
      coding.code(encoder, root_.clips[c].holds, limits_.clip_frames[c], &series_[c]);
    const Bytes stream = encoder.finish();
    root_.stream = stream;
    return root_.write();
  }

  const Opened& base_;
  ClipsRecord record_;
  Limits limits_;
  RootRecord root_;
  std::vector<RootSeries> series_;
  std::vector<Moved> segments_;
};

}  // namespace

ClipHome clip_home(const ClipPart& part) {
  const Opened file(part);
  ClipHome home;
  home.order = file.record.order;
  home.up = file.record.up;
  home.metres_per_unit = file.record.metres_per_unit;
  std::copy_n(file.record.origin, 3, home.origin.begin());
  home.asked = file.record.clips.back().asked;
  home.asked_value = file.record.clips.back().asked_value;
  for (const ClipRecord& clip : file.record.clips)
    home.names.push_back(text_of(clip.name));
  const ByteView stored = file.of_mesh("POSE");
  if (stored.size == 0)
    return home;
  MeshRecord mesh;
  Topology topology;
  PoseRecord record;
  file.check(MeshRecord::read(file.payload(*file.reader.find("MESH", 0)), &mesh));
  file.check(decode_faces(mesh.faces, file.limits.meshes[0], &topology));
  file.check(PoseRecord::read(stored, &record));
  auto pose = std::make_shared<EncodedPose>();
  file.check(open_pose(record, CornerTable(topology), &pose->grid));
  pose->stream = copy(record.stream);
  home.pose = std::move(pose);
  return home;
}

Bytes add_clips(const ClipPart& file, const ClipPart& added) {
  const Opened base(file), more(added);
  for (const ClipRecord& clip : more.record.clips) {
    if (base.record.find(clip.name.c_str()) < base.record.clips.size())
      fail(file, ErrorKind::kInput, "has a clip '" + text_of(clip.name) + "' already");
  }
  if (more.limits.frames > kMaxFrames - base.limits.frames)
    fail(file, ErrorKind::kInput, "together there are more than 2^24 - 1 frames");
  if (!base.record.same_origin(more.record))
    fail(added, ErrorKind::kInput, "counts positions from another origin than " + file.name);
  const Limits::Mesh &a = base.limits.meshes[0], &b = more.limits.meshes[0];
  bool same = a.source_vertices == b.source_vertices && a.polygons == b.polygons &&
              base.record.order == more.record.order;
  MeshRecord faces, other;
  base.check(MeshRecord::read(base.of_mesh("MESH"), &faces));
  more.check(MeshRecord::read(more.of_mesh("MESH"), &other));
  same = same && equal(faces.faces, other.faces) &&
         equal(base.of_mesh("VMAP"), more.of_mesh("VMAP")) &&
         equal(base.of_mesh("FMAP"), more.of_mesh("FMAP"));
  if (!same)
    fail(added, ErrorKind::kInput,
         "has another connectivity than " + file.name + ", or other vertices at one place");
  Edited edited(base);
  for (const Opened* from : {&base, &more}) {
    const uint32_t begin = edited.frames();
    for (size_t c = 0; c < from->record.clips.size(); ++c)
      edited.add_clip(*from, c);
    for (uint32_t s = 0; s < from->limits.segments.size(); ++s)
      edited.add_segment({from, s, begin + from->limits.segments[s].first_frame});
  }
  return edited.file();
}

Bytes remove_clips(const ClipPart& part, const std::vector<std::string>& names) {
  const Opened file(part);
  std::set<size_t> gone;
  for (const std::string& name : names) {
    const size_t found = file.record.find(name.c_str());
    if (found == file.record.clips.size())
      fail(part, ErrorKind::kUsage, "has no clip '" + name + "'");
    gone.insert(found);
  }
  if (gone.size() == file.record.clips.size())
    fail(part, ErrorKind::kUsage, "the last clip cannot be removed");
  Edited edited(file);
  std::vector<uint32_t> first(file.record.clips.size());  // in the edited file
  for (size_t c = 0; c < first.size(); ++c) {
    first[c] = edited.frames();
    if (!gone.contains(c))
      edited.add_clip(file, c);
  }
  for (uint32_t s = 0; s < file.limits.segments.size(); ++s) {
    const Limits::Segment& sizes = file.limits.segments[s];
    bool stays = false;
    const ClipRecord* leaves = nullptr;
    uint32_t at = 0;
    for (size_t c = 0; c < first.size(); ++c) {
      const ClipRecord& clip = file.record.clips[c];
      if (clip.first_frame >= sizes.first_frame + sizes.frames ||
          sizes.first_frame >= clip.first_frame + clip.frames)
        continue;
      if (gone.contains(c)) {
        leaves = &clip;
      } else {
        if (!stays)
          at = first[c] +
               (sizes.first_frame > clip.first_frame ? sizes.first_frame - clip.first_frame : 0);
        stays = true;
      }
    }
    if (stays && leaves)
      fail(part, ErrorKind::kUsage,
           "clip '" + text_of(leaves->name) +
               "' shares its basis with one that stays: encode the others anew");
    if (stays)
      edited.add_segment({&file, s, at});
  }
  return edited.file();
}

}  // namespace anicodec
