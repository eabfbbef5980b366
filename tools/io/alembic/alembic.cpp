// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/alembic.h"

#include "tools/io/alembic/alembic_bake.h"
#include "tools/io/base/frame_attributes.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"

#include <algorithm>
#include <new>
#include <utility>

namespace anicodec::tools {
namespace {

std::string counts(const AbcTopology& topology) {
  return std::to_string(topology.vertex_count) + " vertices and " +
         std::to_string(topology.polygons.size()) + " faces";
}

/// Throws where a mesh changes its faces.
void check_one_topology(const ByteSource& source, const AlembicBake& bake) {
  for (const AbcShown& shown : bake.shown()) {
    const uint32_t first = shown.topology[shown.first_frame()];
    for (size_t f = 0; f < shown.topology.size(); ++f) {
      const uint32_t now = shown.topology[f];
      if (now == first || now == kAbcNone)
        continue;
      const std::vector<AbcTopology>& all = shown.mesh->topologies();
      fail_input(source.name, printable(bake.path(shown)) + ": its faces change at frame " +
                                  std::to_string(f) + ", from " + counts(all[first]) + " to " +
                                  counts(all[now]) + "; --topology-changes keep takes each");
    }
  }
}

void reserve_positions(AlembicBake& bake, MeshSequence& out) {
  bake.take_memory(static_cast<double>(out.vertex_count), static_cast<double>(out.frame_count));
  const size_t numbers = size_t{3} * out.vertex_count * out.frame_count;
  try {
    out.positions.resize(numbers);
  } catch (const std::exception&) {
    fail_input(bake.archive().file.name(), "not enough memory for " +
                                               std::to_string(out.vertex_count) + " vertices x " +
                                               std::to_string(out.frame_count) + " frames");
  }
}

/// The attributes of all meshes that move in some, in one frame: as they were where a mesh has
/// none.
std::vector<Attribute> moving_attributes(const AlembicBake& bake, size_t frame,
                                         const std::vector<Attribute>& before) {
  std::vector<Attribute> out;
  size_t first_vertex = 0, first_corner = 0;
  for (const AbcShown& shown : bake.shown()) {
    const bool is_shown = shown.topology[frame] != kAbcNone;
    for (const Attribute& now :
         is_shown ? bake.moving_attributes(shown, frame) : std::vector<Attribute>()) {
      const auto same = [&](const Attribute& a) {
        return a.kind == now.kind && a.name == now.name && a.domain == now.domain &&
               a.components == now.components;
      };
      const auto all = std::ranges::find_if(before, same);
      if (all == before.end())
        continue;
      auto own = std::ranges::find_if(out, same);
      if (own == out.end()) {
        own = out.insert(out.end(), *all);
        own->values.assign(
            all->values.end() - static_cast<std::ptrdiff_t>(all->values.size() / all->frames),
            all->values.end());
        own->frames = 1;
      }
      const size_t first = now.per_corner() ? first_corner : first_vertex;
      std::ranges::copy(now.values,
                        own->values.begin() + static_cast<std::ptrdiff_t>(first * now.components));
    }
    const auto& topology = shown.mesh->topologies()[shown.topology[shown.first_frame()]];
    first_vertex += topology.vertex_count;
    first_corner += topology.polygons.corners.size();
  }
  return out;
}

void report(const AlembicOptions& options, size_t done, size_t all) {
  if (options.progress)
    options.progress("reading", static_cast<double>(done) / static_cast<double>(all));
}

/// The meshes as one: what stands beside the positions.
MeshSequence merged(AlembicBake& bake) {
  std::vector<MeshSequence> meshes;
  uint64_t vertices = 0;
  for (const AbcShown& shown : bake.shown()) {
    const uint32_t first = shown.first_frame();
    vertices += shown.mesh->topologies()[shown.topology[first]].vertex_count;
    bake.check_memory(static_cast<double>(vertices), static_cast<double>(bake.frame_count()));
    if (vertices > kMaxVertices)
      fail_input(bake.archive().file.name(), "the meshes have more than 2^31 - 1 vertices");
    meshes.push_back(bake.describe(shown, first));
  }
  return merge_meshes(meshes);
}

void fill_frame(AlembicBake& bake, size_t frame, std::span<float> positions) {
  const std::vector<AbcPlace> places = bake.places(frame);
  for (const AbcShown& shown : bake.shown()) {
    const uint32_t topology = shown.topology[shown.first_frame()];
    const std::span<float> own =
        positions.first(size_t{3} * shown.mesh->topologies()[topology].vertex_count);
    positions = positions.subspan(own.size());
    if (shown.topology[frame] != kAbcNone) {
      bake.read_positions(shown, places[shown.node], frame, own);
      continue;
    }
    const Eigen::Vector3f origin = (places[shown.node].world.col(3) - bake.origin()).cast<float>();
    const bool finite = origin.allFinite();
    for (size_t i = 0; i < own.size(); ++i)
      own[i] = finite ? origin[static_cast<Eigen::Index>(i % 3)] : 0.0F;
  }
}

/// One connectivity of a mesh in the frames that have it.
SceneMesh mesh_of(AlembicBake& bake, const AbcShown& shown, uint32_t topology) {
  SceneMesh out;
  const uint32_t first = shown.first_frame(topology);
  out.sequence = bake.describe(shown, first);
  for (uint32_t f = first; f < shown.topology.size(); ++f) {
    if (shown.topology[f] != topology)
      continue;
    if (out.present_in.empty() || out.present_in.back().first + out.present_in.back().count != f)
      out.present_in.push_back({f, 0});
    ++out.present_in.back().count;
    ++out.sequence.frame_count;
  }
  reserve_positions(bake, out.sequence);
  uint32_t own = 0;
  double numbers = 0;
  for (const FrameRun& run : out.present_in) {
    for (uint32_t f = run.first; f < run.first + run.count; ++f, ++own) {
      bake.read_positions(shown, bake.place(shown, f), f, out.sequence.frame(own));
      if (own > 0 && AlembicBake::has_moving_attributes(shown))
        add_frame(bake.moving_attributes(shown, f), own, out.sequence.attributes);
      numbers = bake.take_memory(out.sequence.attributes, numbers);
    }
  }
  return out;
}

}  // namespace

MeshSequence read_alembic(const ByteSource& source, const AlembicOptions& options) {
  AlembicBake bake(source, options);
  check_one_topology(source, bake);
  MeshSequence out = merged(bake);
  bake.set_timing(out);
  reserve_positions(bake, out);
  const bool moving = std::ranges::any_of(bake.shown(), AlembicBake::has_moving_attributes);
  double numbers = 0;
  for (uint32_t f = 0; f < out.frame_count; ++f) {
    fill_frame(bake, f, out.frame(f));
    if (moving && f > 0)
      add_frame(moving_attributes(bake, f, out.attributes), f, out.attributes);
    numbers = bake.take_memory(out.attributes, numbers);
    report(options, f + 1, out.frame_count);
  }
  return out;
}

Scene read_alembic_meshes(const ByteSource& source, const AlembicOptions& options) {
  AlembicBake bake(source, options);
  Scene scene;
  bake.set_timing(scene.clip);
  for (size_t s = 0; s < bake.shown().size(); ++s) {
    const AbcShown& shown = bake.shown()[s];
    std::vector<uint32_t> used;  // in the order of their first frames
    std::vector<bool> seen(shown.mesh->topologies().size());
    for (uint32_t topology : shown.topology) {
      if (topology == kAbcNone || seen[topology])
        continue;
      seen[topology] = true;
      used.push_back(topology);
    }
    for (uint32_t topology : used)
      scene.meshes.push_back(mesh_of(bake, shown, topology));
    report(options, s + 1, bake.shown().size());
  }
  return scene;
}

}  // namespace anicodec::tools
