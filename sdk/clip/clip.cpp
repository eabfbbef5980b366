// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/clip.h"

#include "format/continuation.h"
#include "sdk/clip/attribute_surface.h"
#include "sdk/clip/file_checks.h"
#include "sdk/clip/kept_learning.h"
#include "sdk/clip/kept_meshes.h"
#include "sdk/clip/memory_estimate.h"
#include "sdk/exact/exact_positions.h"
#include "sdk/play/play.h"
#include "sdk/segment/keep_frames.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

double mesh_work(const Limits::Mesh& mesh) {
  return static_cast<double>(uint64_t{mesh.source_vertices} + mesh.corners);
}

/// The approximate cost of opening a clip, in coefficients to decode.
double opening_work(const Limits& limits, const OpenOptions& options) {
  double work = 0;
  for (const Limits::Mesh& mesh : limits.meshes)
    work += mesh_work(mesh);
  for (const Limits::Segment& s : limits.segments)
    work += segment_work(s, s.coded_over(limits.meshes[s.mesh]), options.quality) +
            (s.exact && options.opens_exact()
                 ? 3.0 * kExactWork * s.frames * limits.meshes[s.mesh].coded_vertices
                 : 0);
  return work;
}

struct FrameRange {
  uint32_t first = 0, count = 0;
};

/// The frames of a segment, counted within it, from the first to the last that a wanted clip has.
FrameRange wanted_frames(const ClipsRecord& record, const Vector<uint8_t>& wanted,
                         const Limits::Segment& s) {
  uint32_t begin = s.frames, end = 0;
  for (size_t c = 0; c < wanted.size(); ++c) {
    const ClipRecord& clip = record.clips[c];
    const uint32_t from = std::max(clip.first_frame, s.first_frame);
    const uint32_t to = std::min(clip.first_frame + clip.frames, s.first_frame + s.frames);
    if (wanted[c] && from < to) {
      begin = std::min(begin, from - s.first_frame);
      end = std::max(end, to - s.first_frame);
    }
  }
  return {begin, end > begin ? end - begin : 0};
}

/// Makes containers that stay when the clip is gone.
template <class Make>
auto made_in(Memory* memory, Make make) {
  const MemoryScope scope(memory);
  return make();
}

Failure stopped() {
  return {Status::kCancelled, 0, 0, "the host stopped the opening"};
}

Failure read_pose(const ContainerReader& file, const Chunk& chunk, const Topology& topology,
                  MeshWork& work, PoseGrid* out) {
  ByteView payload;
  if (Failure f = file.payload(chunk, &payload); !f.ok())
    return f;
  PoseRecord record;
  Status s = PoseRecord::read(payload, &record);
  if (s == Status::kOk)
    s = open_pose(record, work.corner_table(topology), out);
  work.end_pose();
  return s == Status::kOk ? Failure{} : failure_in(chunk, s, "the reference pose is damaged");
}

/// Whether memory allows to keep meshes beside the opening.
bool has_room_for_kept(const Limits& limits, const OpenOptions& options) {
  const MemoryEstimate estimate = estimate_memory(limits, options.quality, options.opens_exact());
  const uint64_t allowed = options.limits.resident_bytes;
  return estimate.opening <= allowed && estimate.kept <= allowed - estimate.opening;
}

/// Whether what a segment cannot do without is there: its record and its pose, and the attribute that it moves.
bool has_arrived(const ContainerReader& file, const Limits::Segment& sizes, uint32_t number) {
  const Chunk* attributes = file.find("ATTR", sizes.mesh);
  if (sizes.attribute != kPositions && attributes && !file.has(*attributes))
    return false;
  const Chunk* record = file.find("SEGM", sizes.mesh, number);
  const Chunk* pose = file.find("POSE", sizes.mesh, number);
  if (!pose)
    pose = file.find("POSE", sizes.mesh);
  return !(record && !file.has(*record)) && !(pose && !file.has(*pose));
}

}  // namespace

Failure Clip::open(ByteView bytes, const OpenOptions& options) {
  ContainerReader file;
  if (Failure failure = options.prefix ? file.open_prefix(bytes) : file.open(bytes);
      !failure.ok()) {
    *this = Clip();
    return failure;
  }
  return open(file, options);
}

Failure Clip::open(const ContainerReader& file, const OpenOptions& wanted) {
  *this = Clip();
  OpenOptions options = wanted;
  if (Failure failure = read_limits(file, options, &limits_); !failure.ok())
    return failure;
  if (options.kept && !has_room_for_kept(limits_, options)) {
    options.kept->clear();
    options.kept = nullptr;
  }
  const Chunk* chunk;
  ByteView payload;
  if (Failure f = required_payload(file, "CLIP", kNoMesh, kNoSegment, &chunk, &payload); !f.ok())
    return f;
  if (Status s = ClipsRecord::read(payload, limits_, &record_); s != Status::kOk)
    return failure_in(*chunk, s, "the record of the clips is malformed");
  if (Failure f = wanted_clips(record_, options.clips, &wanted_); !f.ok())
    return f;
  if (Failure f = check_places(file, limits_, record_.order); !f.ok())
    return f;
  if (Failure f = open_root(file); !f.ok())
    return f;
  in_place_ = options.in_place;
  if (kTraces && options.trace)
    root_.each_series([&](const int32_t* values, size_t count) {
      options.trace->step("root motion", values, count);
    });
  if (options.any_order)
    record_.order = OrderMode::kFree;
  if (options.progress) {
    options.progress->begin(opening_work(limits_, options), options.progress_end);
    if (!options.progress->advance(0))
      return stopped();
  }

  work_ = Vector<MeshWork>(limits_.meshes.size());
  const Vector<uint32_t> predicted = predicted_segments(limits_);
  for (size_t m = 0; m < work_.size(); ++m)
    work_[m].predicted_segments = predicted[m];
  list_tracks();
  Failure failure = open_meshes(file, options);
  if (failure.ok())
    failure = open_segments(file, options);
  if (failure.ok() && has_root())
    turn_corrections();
  if (failure.ok() && options.kept && has_attributes())
    options.kept->keep(limits_.meshes, record_.order, meshes_, poses_);
  work_ = Vector<MeshWork>();
  poses_ = Vector<MeshPose>();
  for (Mesh& mesh : meshes_) {
    mesh.topology.triangles = Vector<uint32_t>();
    for (MeshAttribute& attribute : mesh.attributes)
      attribute.surface.triangles = Vector<uint32_t>();
  }
  if (!failure.ok())
    *this = Clip();
  return failure;
}

Failure wanted_clips(const ClipsRecord& record, const ClipNames& names, Vector<uint8_t>* out) {
  out->assign(record.clips.size(), names.count == 0);
  for (uint32_t i = 0; i < names.count; ++i) {
    const size_t found = record.find(names.names[i]);
    if (found == out->size())
      return {Status::kAbsent, 0, chunk_type("CLIP"), "the file has no clip of a name asked for"};
    (*out)[found] = 1;
  }
  return {};
}

Failure Clip::open_root(const ContainerReader& file) {
  if (limits_.root_frames == 0)
    return {};
  const Chunk* chunk;
  ByteView payload;
  if (Failure f = required_payload(file, "ROOT", kNoMesh, kNoSegment, &chunk, &payload); !f.ok())
    return f;
  const Status s = root_.open(payload, limits_, record_.up, wanted_);
  return s == Status::kOk ? Failure{} : failure_in(*chunk, s, "the motion of the whole is damaged");
}

/// Corrections come last: the motion of the whole turns them along.
void Clip::turn_corrections() {
  for (Segment& segment : segments_) {
    if (segment.attribute != kPositions || segment.correction_begin.empty())
      continue;
    for (uint32_t f = 0; f < segment.frames; ++f) {
      const Affine root = root_at(segment.first_frame + f).affine(root_.axes());
      for (uint32_t i = segment.correction_begin[f]; i < segment.correction_begin[f + 1]; ++i) {
        float* d = segment.corrections[i].delta;
        float turned[3];
        for (size_t c = 0; c < 3; ++c)
          turned[c] = root.m[4 * c] * d[0] + root.m[4 * c + 1] * d[1] + root.m[4 * c + 2] * d[2];
        std::copy_n(turned, 3, d);
      }
    }
  }
}

void move_whole(const Affine& root, FrameState* state) {
  // The origin of key-frames is added before any motion.
  state->motion = state->moves ? after(root, state->motion) : root;
  state->moves = true;
}

RootState Clip::root_at(uint32_t frame) const {
  if (root_.empty())
    return {};
  const uint32_t clip = clip_at(frame);
  return root_.at(clip, frame - clips()[clip].first_frame);
}

FrameState Clip::state_of(const Segment& segment, uint32_t frame) const {
  FrameState state = frame_state(segment, frame);
  if (!shows_exact(segment.first_frame + frame))
    state.exact = nullptr;
  if (has_root())
    move_whole(root_at(segment.first_frame + frame).affine(root_.axes()), &state);
  return state;
}

uint32_t Clip::clip_at(uint32_t frame) const {
  const auto after = std::partition_point(
      clips().begin(), clips().end(), [&](const ClipRecord& c) { return c.first_frame <= frame; });
  return static_cast<uint32_t>(after - clips().begin()) - 1;
}

Failure Clip::open_meshes(const ContainerReader& file, const OpenOptions& options) {
  const size_t count = limits_.meshes.size();
  const bool kept = options.kept &&
                    options.kept->take(limits_.meshes, record_.order, &meshes_, &poses_) &&
                    has_surfaces();
  if (!kept) {
    meshes_ = Vector<Mesh>(count);
    poses_ = Vector<MeshPose>(count);
  }
  for (size_t m = 0; m < count; ++m) {
    if (Failure f = kept ? Failure{} : open_mesh(file, static_cast<uint16_t>(m), options); !f.ok())
      return f;
    if (options.progress && !options.progress->advance(mesh_work(limits_.meshes[m])))
      return stopped();
  }
  return {};
}

Failure Clip::open_mesh(const ContainerReader& file, uint16_t mesh, const OpenOptions& options) {
  const Limits::Mesh& sizes = limits_.meshes[mesh];
  const Chunk* chunk;
  ByteView payload;
  if (Failure f = required_payload(file, "MESH", mesh, kNoSegment, &chunk, &payload); !f.ok())
    return f;
  MeshRecord record;
  if (Status s = MeshRecord::read(payload, &record); s != Status::kOk)
    return failure_in(*chunk, s, "the mesh record is malformed");
  Mesh& out = meshes_[mesh];
  out.name = record.name;
  if (Status s = decode_faces(record.faces, sizes, &out.topology); s != Status::kOk)
    return failure_in(*chunk, s, "the faces are damaged");
  show(options.trace, "polygon offsets", out.topology.polygon_offsets);
  show(options.trace, "polygon corners", out.topology.polygon_corners);
  show(options.trace, "coded vertex of each vertex", out.topology.vertex_coded);
  if (Failure f = open_attributes(file, mesh, options); !f.ok())
    return f;
  if (record_.order == OrderMode::kFree)
    return {};
  if (Failure f = required_payload(file, "VMAP", mesh, kNoSegment, &chunk, &payload); !f.ok())
    return f;
  Vector<uint32_t> map;
  if (Status s = decode_vertex_map(payload, out.topology, &map); s != Status::kOk)
    return failure_in(*chunk, s, "the vertex map is damaged");
  show(options.trace, "vertex map", map);
  if (record_.order == OrderMode::kAll) {
    if (Failure f = required_payload(file, "FMAP", mesh, kNoSegment, &chunk, &payload); !f.ok())
      return f;
    Vector<uint32_t> place, first;
    if (Status s = decode_face_map(payload, out.topology, &place, &first); s != Status::kOk)
      return failure_in(*chunk, s, "the face map is damaged");
    show(options.trace, "face map", place);
    apply_face_map(place, first, out.topology, &out.attributes);
    apply_face_map(place, first, &out.topology);
  }
  apply_vertex_map(map, &out.topology);
  apply_vertex_map(map, &out.attributes);
  return {};
}

Failure Clip::open_attributes(const ContainerReader& file, uint16_t mesh,
                              const OpenOptions& options) {
  if (limits_.meshes[mesh].attributes == 0)
    return {};
  const Chunk* chunk = file.find("ATTR", mesh);
  if (options.prefix && chunk && !file.has(*chunk)) {
    partial_ = true;
    return {};
  }
  ByteView payload;
  if (Failure f = required_payload(file, "ATTR", mesh, kNoSegment, &chunk, &payload); !f.ok())
    return f;
  AttributeRecord record;
  Status s = AttributeRecord::read(payload, limits_.meshes[mesh], &record);
  Vector<uint8_t> moving(kMaxAttributes, 0);
  for (uint32_t a = 0; a < moving.size(); ++a) {
    const auto [first, last] = attribute_tracks(mesh, a);
    if (first != last)
      moving[a] =
          1 + static_cast<uint8_t>(limits_.segments[by_frame_[tracks_[first].begin]].domain);
  }
  if (s == Status::kOk)
    s = decode_attributes(record, limits_.meshes[mesh], meshes_[mesh].topology, moving,
                          &meshes_[mesh].attributes);
  return s == Status::kOk ? Failure{} : failure_in(*chunk, s, "the attributes are damaged");
}

/// Whether the attributes of all meshes are there.
bool Clip::has_attributes() const {
  for (size_t m = 0; m < meshes_.size(); ++m) {
    if (limits_.meshes[m].attributes > 0 && meshes_[m].attributes.empty())
      return false;
  }
  return true;
}

/// Whether the attributes that move, where they are there, have what their segments are over.
bool Clip::has_surfaces() const {
  for (size_t t = meshes_.size(); t < tracks_.size(); ++t) {
    const Track& track = tracks_[t];
    const Vector<MeshAttribute>& attributes = meshes_[track.mesh].attributes;
    if (track.attribute < attributes.size() &&
        attributes[track.attribute].surface.coded_vertices == 0)
      return false;
  }
  return true;
}

void Clip::list_tracks() {
  segments_ = Vector<Segment>(limits_.segments.size());
  for (uint32_t i = 0; i < segments_.size(); ++i) {
    const Limits::Segment& sizes = limits_.segments[i];
    segments_[i].mesh = sizes.mesh;
    segments_[i].attribute = sizes.attribute;
    segments_[i].first_component = sizes.first_component;
    segments_[i].first_frame = sizes.first_frame;
  }
  by_frame_ = limits_.segments_by_frame();
  tracks_.resize(limits_.meshes.size());
  for (uint32_t m = 0; m < tracks_.size(); ++m)
    tracks_[m].mesh = m;
  for (uint32_t i = 0; i < by_frame_.size(); ++i) {
    const Limits::Segment& s = limits_.segments[by_frame_[i]];
    const bool is_new = i == 0 || !s.same_track(limits_.segments[by_frame_[i - 1]]);
    if (is_new && s.attribute != kPositions)
      tracks_.push_back({s.mesh, s.attribute, s.first_component, i, i});
    Track& track = s.attribute == kPositions ? tracks_[s.mesh] : tracks_.back();
    if (is_new)
      track.begin = i;
    track.end = i + 1;
  }
}

Failure Clip::open_segments(const ContainerReader& file, const OpenOptions& options) {
  // Layers by segment, in file order, in one pass.
  Vector<Vector<const Chunk*>> layers(segments_.size());
  for (const Chunk& chunk : file.chunks()) {
    if (chunk.type == chunk_type("BASI") && chunk.segment < layers.size())
      layers[chunk.segment].push_back(&chunk);
  }
  for (size_t m = 0; m < meshes_.size(); ++m) {
    const Chunk* chunk = file.find("POSE", static_cast<uint16_t>(m));
    PoseGrid& pose = poses_[m].grid;
    if (!chunk || (options.prefix && !file.has(*chunk)) || !pose.points.empty())
      continue;
    if (Failure f = read_pose(file, *chunk, meshes_[m].topology, work_[m], &pose); !f.ok())
      return f;
  }
  Vector<LearntSegment> learnt =
      made_in(options.learning ? options.learning->memory() : MemoryScope::current(),
              [&] { return Vector<LearntSegment>(meshes_.size()); });
  const Vector<uint8_t> needed = needed_segments(file);
  for (uint32_t i = 0; i < segments_.size(); ++i) {
    if (!needed[i])
      continue;
    if (options.prefix && !has_arrived(file, limits_.segments[i], i)) {
      partial_ = true;
      continue;
    }
    if (Failure f = open_segment(file, i, layers[i], options, &learnt); !f.ok())
      return f;
  }
  if (options.learning)
    options.learning->keep(std::move(learnt));
  return {};
}

/// By segment: whether a wanted clip has frames of it, or a segment that is needed continues it.
Vector<uint8_t> Clip::needed_segments(const ContainerReader& file) const {
  constexpr uint32_t kNone = UINT32_MAX;
  const auto count = static_cast<uint32_t>(segments_.size());
  Vector<uint32_t> last(limits_.meshes.size(), kNone), before(count);  // that may be continued
  for (uint32_t i = 0; i < count; ++i) {
    const Limits::Segment& sizes = limits_.segments[i];
    before[i] = last[sizes.mesh];
    if (sizes.learns && sizes.components > 0)
      last[sizes.mesh] = i;
  }
  Vector<uint8_t> needed(count, 0);
  for (uint32_t i = count; i-- > 0;) {
    const Limits::Segment& sizes = limits_.segments[i];
    needed[i] |= static_cast<uint8_t>(wanted_frames(record_, wanted_, sizes).count > 0);
    if (!needed[i] || !sizes.learns || before[i] == kNone)
      continue;
    const Chunk* chunk = file.find("SEGM", sizes.mesh, i);
    SegmentRecord record;
    if (chunk && file.has(*chunk) &&
        SegmentRecord::read(file.unchecked(*chunk), &record) == Status::kOk &&
        record.continued != 0)
      needed[before[i]] = 1;
  }
  return needed;
}

/// The work that the segments of an attribute share, made for the first. kIndexRange: there is no such attribute;
/// kChunkMissing: the mesh has no pose.
Status Clip::attribute_work(const Limits::Segment& sizes, AttributeWork** out) {
  const Mesh& mesh = meshes_[sizes.mesh];
  if (sizes.attribute >= mesh.attributes.size())
    return Status::kIndexRange;
  const MeshAttribute& attribute = mesh.attributes[sizes.attribute];
  const AttributeDomain domain = attribute.header.domain;
  if (domain != sizes.domain || sizes.first_component >= attribute.header.components() ||
      attribute.surface.coded_vertices != sizes.entries)
    return Status::kIndexRange;
  const PoseGrid& pose = poses_[sizes.mesh].grid;
  if (pose.points.empty())
    return Status::kChunkMissing;
  Vector<AttributeWork>& all = work_[sizes.mesh].attributes;
  auto found = std::find_if(all.begin(), all.end(),
                            [&](const AttributeWork& w) { return w.attribute == sizes.attribute; });
  if (found == all.end()) {
    all.emplace_back();
    found = all.end() - 1;
    found->attribute = sizes.attribute;
    found->sizes = sizes.coded_over(limits_.meshes[sizes.mesh]);
    found->pose = surface_pose(pose, mesh.topology, domain, attribute.surface);
    const Vector<uint32_t>& links = attribute.surface.triangles;
    if (Status s = found->graph.init(links.data(), links.size() / 3, sizes.entries);
        s != Status::kOk)
      return s;
  }
  *out = &*found;
  return Status::kOk;
}

Failure Clip::open_segment(const ContainerReader& file, uint32_t number,
                           const Vector<const Chunk*>& layers, const OpenOptions& options,
                           Vector<LearntSegment>* learnt_of_meshes) {
  const Limits::Segment& sizes = limits_.segments[number];
  const Chunk* chunk;
  ByteView payload;
  if (Failure f = required_payload(file, "SEGM", sizes.mesh, number, &chunk, &payload); !f.ok())
    return f;
  SegmentRecord record;
  Status s = SegmentRecord::read(payload, &record);
  if (s != Status::kOk)
    return failure_in(*chunk, s, "the segment record is malformed");
  SegmentContext context;
  LearntSegment learnt =
      made_in(learnt_of_meshes->get_allocator().memory(), [] { return LearntSegment(); });
  if (record.continued != 0) {
    if (!sizes.learns)
      return failure_in(*chunk, Status::kRecord,
                        "the limits announce no segment that continues another");
    LearntSegment& last = (*learnt_of_meshes)[sizes.mesh];
    if (last.identity == record.continued)
      context.continued = &last;
    else if (last.identity == 0 && options.learning)
      context.continued = options.learning->find(sizes.mesh, record.continued);
    if (!context.continued)
      return failure_in(*chunk, Status::kSegmentMissing,
                        "the segment continues one that is missing before it");
  }
  context.sizes = &sizes;
  context.mesh_sizes = &limits_.meshes[sizes.mesh];
  context.topology = &meshes_[sizes.mesh].topology;
  context.vertex_coded = &context.topology->vertex_coded;
  MeshWork& work = work_[sizes.mesh];
  PoseGrid segment_pose;
  MeshPose& mesh_pose = poses_[sizes.mesh];
  context.pose = &mesh_pose.grid;
  if (work.is_shared() || options.kept)
    context.order = &mesh_pose.order;
  if (const Chunk* of_pose = file.find("POSE", sizes.mesh, number)) {
    if (Failure f = read_pose(file, *of_pose, *context.topology, work, &segment_pose); !f.ok())
      return f;
    context.pose = &segment_pose;
    context.order = nullptr;
  }
  if (context.pose->points.empty())
    context.pose = nullptr;
  if (sizes.attribute != kPositions) {
    AttributeWork* shared = nullptr;
    if (s = attribute_work(sizes, &shared); s != Status::kOk)
      return failure_in(*chunk, s,
                        s == Status::kIndexRange
                            ? "the segment is of no attribute of the mesh"
                            : "the attribute has nothing to be predicted over");
    context.mesh_sizes = &shared->sizes;
    context.topology = &meshes_[sizes.mesh].attributes[sizes.attribute].surface;
    context.vertex_coded = &context.topology->vertex_coded;
    context.pose = &shared->pose;
    context.graph = &shared->graph;
    context.order = &shared->order;
  }
  context.quality = options.quality;
  for (const Chunk* layer : layers) {
    if (options.prefix && !file.has(*layer)) {
      context.partial = true;
      break;
    }
    ByteView bytes;
    if (Failure f = file.payload(*layer, &bytes); !f.ok())
      return f;
    context.layers.push_back(bytes);
  }
  const Chunk* corrections = file.find("CORR", sizes.mesh, number);
  if (corrections && options.prefix && !file.has(*corrections)) {
    context.partial = true;
  } else if (corrections) {
    if (Failure f = file.payload(*corrections, &context.corrections); !f.ok())
      return f;
  }
  partial_ |= context.partial;
  if (sizes.learns && !context.partial)
    context.learnt = &learnt;
  context.runs = limits_.runs(sizes.first_frame, sizes.frames);
  context.trace = options.trace;
  context.progress = options.progress;
  context.threads = options.threads;
  if (sizes.attribute == kPositions && sizes.kind != BasisKind::kKeyframes)
    s = work.shared_graph(*context.topology, &context.graph);
  else if (is_predicted(sizes) && work.is_shared())
    context.corners = &work.corner_table(*context.topology);
  Segment unopened(segments_[number]);
  if (s == Status::kOk)
    s = anicodec::open_segment(record, context, &segments_[number]);
  if (s == Status::kOk && sizes.exact && options.opens_exact()) {
    if (Failure f = open_exact(file, number, context, options); !f.ok())
      return f;
  }
  if (s == Status::kOk && !learnt.coefficients.empty()) {
    learnt.identity = segment_identity(payload, context.layers);
    (*learnt_of_meshes)[sizes.mesh] = std::move(learnt);
  }
  const FrameRange kept = wanted_frames(record_, wanted_, sizes);
  if (s == Status::kOk && kept.count == 0)
    segments_[number] = std::move(unopened);
  else if (s == Status::kOk && kept.count < sizes.frames)
    keep_frames(kept.first, kept.count, &segments_[number]);
  if (s == Status::kCancelled)
    return stopped();
  if (s == Status::kLimit && sizes.reconstruction == Reconstruction::kMsgi)
    return failure_in(*chunk, s, "geometry interpolation of this mesh takes too much memory");
  return s == Status::kOk ? Failure{} : failure_in(*chunk, s, "the segment cannot be opened");
}

Failure Clip::open_exact(const ContainerReader& file, uint32_t number,
                         const SegmentContext& context, const OpenOptions& options) {
  const uint16_t mesh = context.sizes->mesh;
  const Chunk* chunk = file.find("DIFF", mesh, number);
  if (chunk && options.prefix && !file.has(*chunk)) {
    partial_ = true;
    return {};
  }
  ByteView payload;
  if (Failure f = required_payload(file, "DIFF", mesh, number, &chunk, &payload); !f.ok())
    return f;
  const Status s = open_exact_positions(payload, context, &segments_[number]);
  if (s == Status::kCancelled)
    return stopped();
  if (s == Status::kFeature)
    return failure_in(*chunk, s, "the positions are exact, and this build is without");
  return s == Status::kOk ? Failure{} : failure_in(*chunk, s, "the exact positions are damaged");
}

std::pair<uint32_t, uint32_t> Clip::attribute_tracks(uint32_t mesh, uint32_t attribute) const {
  const std::pair wanted(mesh, attribute);
  const auto begin = tracks_.begin() + static_cast<ptrdiff_t>(meshes_.size());
  const auto first = std::partition_point(begin, tracks_.end(), [&](const Track& t) {
    return std::pair(t.mesh, t.attribute) < wanted;
  });
  const auto last = std::partition_point(first, tracks_.end(), [&](const Track& t) {
    return std::pair(t.mesh, t.attribute) == wanted;
  });
  return {static_cast<uint32_t>(first - tracks_.begin()),
          static_cast<uint32_t>(last - tracks_.begin())};
}

const Segment* Clip::segment_at(uint32_t track, uint32_t frame) const {
  // The last segment of the track that begins at the frame or before.
  const Track& t = tracks_[track];
  const uint32_t* const begin = by_frame_.data() + t.begin;
  const uint32_t* const after =
      std::partition_point(begin, by_frame_.data() + t.end,
                           [&](uint32_t i) { return segments_[i].first_frame <= frame; });
  if (after == begin)
    return nullptr;
  const Segment& s = segments_[*(after - 1)];
  return frame - s.first_frame < s.frames ? &s : nullptr;
}

size_t Clip::resident_bytes() const {
  size_t total = 0;
  for (const Mesh& m : meshes_) {
    total += 4 * (m.topology.vertex_coded.size() + m.topology.polygon_offsets.size() +
                  m.topology.polygon_corners.size());
    for (const MeshAttribute& a : m.attributes)
      total += 4 * a.surface.vertex_coded.size();
  }
  for (const auto& m : limits_.meshes)
    total += static_cast<size_t>(attribute_bytes(m));
  for (const Segment& s : segments_)
    total += s.resident_bytes();
  return total + root_.resident_bytes();
}

Failure Clip::check_hashes() const {
  for (const Segment& s : segments_) {
    if (s.stored_hash != s.decoded_hash)
      return {Status::kHash, 0, chunk_type("SEGM"), "a segment decodes to other integers"};
    if (s.stored_exact_hash != s.decoded_exact_hash)
      return {Status::kHash, 0, chunk_type("DIFF"), "a segment decodes to other positions"};
  }
  return {};
}

}  // namespace anicodec
