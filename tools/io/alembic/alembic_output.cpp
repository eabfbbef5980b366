// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/alembic_output.h"

#include "codec/sequence/error.h"
#include "codec/sequence/frame_normals.h"
#include "tools/io/alembic/abc_names.h"
#include "tools/io/alembic/abc_output.h"
#include "tools/io/alembic/poly_mesh_output.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

/// The archive's own metadata: nothing that changes from run to run.
std::string archive_metadata(const MeshSequence& clip) {
  const double rate = clip.rate.value();
  return fmt::format(
      "FramesPerTimeUnit={:.6f};_ai_Application=anicodec;_ai_DCC_FPS={};_ai_Description={}", rate,
      rate, metadata_text(clip.name));
}

AbcTime time_of(const MeshSequence& clip) {
  if (clip.times.empty())
    return {static_cast<double>(clip.rate.denominator) / clip.rate.numerator, {clip.start_time}};
  std::vector<double> times;
  for (double t : clip.times)
    times.push_back(clip.start_time + t);
  return {AbcTime::kAcyclic, std::move(times)};
}

AbcObjectOutput& add_xform(AbcObjectOutput& parent, std::string name) {
  AbcObjectOutput& object = parent.child(
      std::move(name), "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform");
  AbcCompoundOutput& xform = object.properties().compound(".xform", "schema=AbcGeom_Xform_v3");
  xform.scalar(".inherits", "", AbcType::kBool, 1, 0).add_one(uint8_t{1});
  return object;
}

/// The object that all others go below: an Xform where positions count from a local origin, or Z is up.
AbcObjectOutput& placed(AbcObjectOutput& top, const MeshSequence& clip) {
  const bool turns = clip.up == UpAxis::kZ, moves = clip.origin != Point();
  if (!turns && !moves)
    return top;
  constexpr uint8_t kTranslate = 1 << 4, kRotateX = 4 << 4;
  std::vector<uint8_t> operations;  // the last comes first
  std::vector<double> values;
  if (turns) {
    operations.push_back(kRotateX);
    values.push_back(-90);
  }
  if (moves) {
    operations.push_back(kTranslate);
    values.insert(values.end(), clip.origin.begin(), clip.origin.end());
  }
  AbcObjectOutput& object = top.child(
      turns ? "y_up" : "origin", "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform");
  AbcCompoundOutput& xform = object.properties().compound(".xform", "schema=AbcGeom_Xform_v3");
  xform.scalar(".inherits", "", AbcType::kBool, 1, 0).add_one(uint8_t{1});
  xform.scalar(".ops", "", AbcType::kUint8, static_cast<uint32_t>(operations.size()), 0)
      .add(std::span<const uint8_t>(operations));
  xform.scalar(".vals", "", AbcType::kFloat64, static_cast<uint32_t>(values.size()), 0)
      .add(std::span<const double>(values));
  xform.scalar("isNotConstantIdentity", "", AbcType::kBool, 1, 0).add_one(uint8_t{1});
  return object;
}

/// The object that a mesh of some path goes below, made where it is missing.
AbcObjectOutput& parent_of(AbcObjectOutput& top, const std::vector<std::string>& steps) {
  AbcObjectOutput* at = &top;
  for (size_t i = 0; i + 1 < steps.size(); ++i) {
    AbcObjectOutput* next = at->find(steps[i]);
    at = next != nullptr ? next : &add_xform(*at, steps[i]);
  }
  return *at;
}

std::string free_name(const AbcObjectOutput& parent, const std::string& name) {
  std::string out = name;
  for (uint64_t n = 2; parent.find(out) != nullptr; ++n)
    out = name + "_" + std::to_string(n);
  return out;
}

bool is_there(const std::vector<FrameRun>& runs, uint32_t frame) {
  return std::ranges::any_of(runs, [&](const FrameRun& run) {
    return frame >= run.first && frame - run.first < run.count;
  });
}

bool overlap(const std::vector<FrameRun>& a, const std::vector<FrameRun>& b) {
  return std::ranges::any_of(a, [&](const FrameRun& x) {
    return std::ranges::any_of(b, [&](const FrameRun& y) {
      return x.first < y.first + y.count && y.first < x.first + x.count;
    });
  });
}

/// An object to be: looks that take turns, each of a track.
struct Plan {
  std::string name;
  std::vector<AbcLook> looks;
  std::vector<size_t> tracks;
  std::vector<FrameRun> present_in;
  bool moving = false;  ///< some track has attributes of its frames
};

/// The meshes of a track, or its parts, by name.
std::vector<std::pair<std::string, AbcLook>> looks_of(const MeshSequence& clip,
                                                      const MeshSequence& mesh) {
  const std::string unnamed = clip.name.empty() ? "mesh" : clip.name;
  std::vector<std::pair<std::string, AbcLook>> out;
  if (!mesh.mesh_name.empty() || mesh.parts.of_polygon.empty() || mesh.polygons.corners.empty()) {
    out.emplace_back(mesh.mesh_name.empty() ? unnamed : mesh.mesh_name, AbcLook(mesh));
    return out;
  }
  for (PartMembers& members : members_of_parts(mesh)) {
    const uint32_t part = members.part;
    out.emplace_back(part == kNoLabel ? unnamed : mesh.parts.names[part],
                     AbcLook(mesh, std::move(members)));
  }
  return out;
}

std::vector<Plan> plan(const MeshSequence& clip, std::span<const AlembicTrack> tracks) {
  std::vector<Plan> plans;
  for (size_t t = 0; t < tracks.size(); ++t) {
    const size_t before = plans.size();
    for (auto& [name, look] : looks_of(clip, tracks[t].mesh)) {
      // Parts of one track are there together.
      auto found =
          std::find_if(plans.begin(), plans.begin() + static_cast<std::ptrdiff_t>(before),
                       [&, &wanted = name](const Plan& p) {
                         return p.name == wanted && !overlap(p.present_in, tracks[t].present_in);
                       });
      if (found == plans.begin() + static_cast<std::ptrdiff_t>(before)) {
        plans.push_back({.name = name, .looks = {}, .tracks = {}, .present_in = {}});
        found = plans.end() - 1;
      }
      found->looks.push_back(std::move(look));
      found->tracks.push_back(t);
      found->moving |= tracks[t].attributes != nullptr;
      found->present_in.insert(found->present_in.end(), tracks[t].present_in.begin(),
                               tracks[t].present_in.end());
    }
  }
  return plans;
}

/// The content of a track in a frame.
struct Moment {
  std::span<const float> positions;
  std::vector<Attribute> attributes;
  std::vector<float> corner_normals;
};

class Tracks {
 public:
  Tracks(std::span<const AlembicTrack> tracks, bool normals) : tracks_(tracks) {
    for (const AlembicTrack& track : tracks) {
      normals_.emplace_back();
      if (normals)
        normals_.back().emplace(track.mesh);
    }
  }

  bool is_there(size_t t, uint32_t frame) const {
    return tools::is_there(tracks_[t].present_in, frame);
  }

  Moment at(size_t t, uint32_t frame) const {
    const AlembicTrack& track = tracks_[t];
    Moment moment;
    moment.positions = track.frames(frame);
    if (moment.positions.size() != size_t{3} * track.mesh.vertex_count)
      throw Error(ErrorKind::kInternal,
                  fmt::format("frame {} has {} coordinates, not 3 x {}", frame,
                              moment.positions.size(), track.mesh.vertex_count));
    if (track.attributes)
      moment.attributes = track.attributes(frame);
    if (normals_[t])
      add_normals(*normals_[t], track.mesh.polygons.corners.size(), moment);
    return moment;
  }

 private:
  static void add_normals(const FrameNormals& normals, size_t corners, Moment& moment) {
    const std::vector<float> values = normals.compute(moment.positions);
    moment.corner_normals.reserve(3 * corners);
    for (uint32_t c = 0; c < corners; ++c) {
      const float* normal = values.data() + size_t{3} * normals.of_corner(c);
      moment.corner_normals.insert(moment.corner_normals.end(), normal, normal + 3);
    }
  }

  std::span<const AlembicTrack> tracks_;
  std::vector<std::optional<FrameNormals>> normals_;
};

/// Objects of the archive for the plans.
std::vector<std::unique_ptr<PolyMeshOutput>> create(const MeshSequence& clip,
                                                    std::vector<Plan>& plans, bool normals,
                                                    AbcArchiveOutput& archive) {
  const uint32_t sampling =
      clip.frame_count == 1 && clip.start_time == 0 ? 0 : archive.shared().sampling(time_of(clip));
  AbcObjectOutput& top = placed(archive.top(), clip);
  std::vector<std::unique_ptr<PolyMeshOutput>> objects;
  for (Plan& p : plans) {
    uint64_t frames = 0;
    for (const FrameRun& run : p.present_in)
      frames += run.count;
    const std::vector<std::string> steps = path_steps(p.name);
    AbcObjectOutput& parent = parent_of(top, steps);
    objects.push_back(std::make_unique<PolyMeshOutput>(
        parent, free_name(parent, steps.back()), sampling, std::move(p.looks),
        AbcMeshOptions{frames < clip.frame_count, normals, p.moving}));
  }
  return objects;
}

}  // namespace

void write_alembic(const AbcSink& sink, const MeshSequence& clip,
                   std::span<const AlembicTrack> tracks, const AlembicWriteOptions& options) {
  AbcArchiveOutput archive(sink, archive_metadata(clip));
  std::vector<Plan> plans = plan(clip, tracks);
  const auto objects = create(clip, plans, options.normals, archive);
  const Tracks players(tracks, options.normals);
  std::vector<std::vector<std::pair<size_t, size_t>>> of_track(tracks.size());  // object, look
  for (size_t o = 0; o < plans.size(); ++o) {
    for (size_t look = 0; look < plans[o].tracks.size(); ++look)
      of_track[plans[o].tracks[look]].emplace_back(o, look);
  }
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    if (options.progress)
      options.progress("writing", static_cast<double>(f) / clip.frame_count);
    std::vector<bool> shown(objects.size());
    for (size_t t = 0; t < tracks.size(); ++t) {
      if (!players.is_there(t, f))
        continue;
      const Moment moment = players.at(t, f);
      const std::span<const Attribute> attributes =
          tracks[t].attributes ? moment.attributes : tracks[t].mesh.attributes;
      for (const auto& [o, look] : of_track[t]) {
        objects[o]->show(look, {moment.positions, attributes, moment.corner_normals});
        shown[o] = true;
      }
    }
    for (size_t o = 0; o < objects.size(); ++o) {
      if (!shown[o])
        objects[o]->hide();
    }
  }
  archive.finish();
}

}  // namespace anicodec::tools
