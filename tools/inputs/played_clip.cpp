// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/played_clip.h"

#include "codec/sequence/error.h"
#include "codec/sequence/scene.h"
#include "tools/inputs/clip_input.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

/// A file may take more than a host allows that knows nothing of it: its user asked for it.
constexpr uint64_t kMostBytes = uint64_t{16} << 30;

Failure failure_of(const anic_failure& failure) {
  uint32_t chunk = 0;
  for (int i = 0; i < 4; ++i)
    chunk |= uint32_t{static_cast<unsigned char>(failure.chunk[i])} << (8 * i);
  return {static_cast<anicodec::Status>(failure.status), failure.offset, chunk, failure.detail};
}

MaterialLook look_of(const anic_material& material) {
  MaterialLook look;
  look.known = true;
  std::ranges::copy(material.base_colour, look.base_colour.begin());
  look.metallic = material.metallic;
  look.roughness = material.roughness;
  std::ranges::copy(material.emissive, look.emissive.begin());
  look.alpha = static_cast<AlphaMode>(material.alpha);
  look.alpha_cutoff = material.alpha_cutoff;
  look.double_sided = material.double_sided != 0;
  look.texture(TextureSlot::kBaseColour) = material.base_colour_texture;
  look.texture(TextureSlot::kMetallicRoughness) = material.metallic_roughness_texture;
  look.texture(TextureSlot::kNormal) = material.normal_texture;
  look.texture(TextureSlot::kOcclusion) = material.occlusion_texture;
  look.texture(TextureSlot::kEmissive) = material.emissive_texture;
  return look;
}

/// The names of an attribute of polygons, with their looks.
PolygonLabels labels_of(const anic::Asset& asset, uint32_t mesh, uint32_t number,
                        const anic_attribute& attribute) {
  PolygonLabels labels;
  bool known = false;
  for (uint32_t l = 0; l < attribute.label_count; ++l) {
    labels.names.emplace_back(asset.label_name(number, l, mesh));
    anic_material material = ANIC_INIT(anic_material);
    const auto has_look = static_cast<bool>(asset.material(number, l, &material, mesh));
    labels.looks.push_back(has_look ? look_of(material) : MaterialLook());
    known = known || has_look;
  }
  if (!known)
    labels.looks.clear();
  for (uint32_t i = 0; i < attribute.count; ++i)
    labels.of_polygon.push_back(attribute.labels[i] == 0 ? kNoLabel : attribute.labels[i] - 1);
  return labels;
}

/// The first material and part attribute into fields of their own, which corners share normals into shared_normals.
void restore_attributes(const anic::Asset& asset, uint32_t mesh, MeshSequence* sequence) {
  for (uint32_t a = 0; a < asset.mesh(mesh).attribute_count; ++a) {
    const anic_attribute stored = asset.attribute(a, mesh);
    const auto kind = static_cast<AttributeKind>(stored.kind);
    if (kind == AttributeKind::kMaterial) {
      sequence->materials = labels_of(asset, mesh, a, stored);
    } else if (kind == AttributeKind::kPart) {
      sequence->parts = labels_of(asset, mesh, a, stored);
    } else if (stored.components == 0) {
      sequence->shared_normals.assign(stored.labels, stored.labels + stored.count);
    } else {
      Attribute& attribute = sequence->attributes.emplace_back();
      attribute.kind = kind;
      attribute.name = stored.name;
      attribute.domain = static_cast<AttributeDomain>(stored.domain);
      attribute.components = stored.components;
      attribute.values.assign(stored.values,
                              stored.values + size_t{stored.count} * stored.components);
    }
  }
}

FrameRate rate_of(const anic_clip& clip) {
  return {clip.rate_numerator, clip.rate_denominator, clip.rate_assumed != 0};
}

/// Times of an uneven clip, from its first frame on.
std::vector<double> times_of(const anic::Asset& asset, const anic_clip& clip) {
  std::vector<double> times;
  for (uint32_t f = 0; clip.uneven && f < clip.frame_count; ++f)
    times.push_back(asset.frame_time(clip.first_frame + f));
  return times;
}

/// The frame, or where it does not show a mesh the last one before that does, or the first. O(log runs).
uint32_t shown_frame(const std::vector<FrameRun>& present_in, uint32_t frame) {
  const auto after = std::ranges::upper_bound(present_in, frame, {}, &FrameRun::first);
  if (after == present_in.begin())
    return present_in.empty() ? frame : present_in[0].first;
  const FrameRun& run = *(after - 1);
  return std::min(frame, run.first + run.count - 1);
}

}  // namespace

std::vector<FrameRun> runs_in(const std::vector<FrameRun>& runs, const FrameRange& range) {
  // the number of the range's first frame from one on
  const auto number = [&range](uint32_t frame) {
    const uint32_t from_first = std::max(frame, range.first) - range.first;
    return std::min(range.size(), from_first / range.step + (from_first % range.step != 0));
  };
  std::vector<FrameRun> counted;
  for (const FrameRun& run : runs) {
    const uint32_t first = number(run.first), end = number(run.first + run.count);
    if (first == end)
      continue;
    if (counted.empty() || counted.back().first + counted.back().count != first)
      counted.push_back({first, 0});
    counted.back().count += end - first;
  }
  return counted;
}

PlayedClip::PlayedClip(const std::string& path, ByteView bytes, Topologies allowed, double quality)
    : path_(path), player_(std::make_unique<Player>()) {
  anic_options options = ANIC_INIT(anic_options);
  options.max_bytes = kMostBytes;
  options.quality = quality;
  anic_failure failure = ANIC_INIT(anic_failure);
  anic::Status status = asset_.open({bytes.data, bytes.size}, &options, &failure);
  if (!status && status != anic::Status(ANIC_E_MEMORY))
    fail_clip(path, failure_of(failure));
  if (status)
    status = player_->context.create(asset_);
  if (!status)
    throw std::bad_alloc();
  info_ = asset_.info();
  for (uint32_t c = 0; c < anic_get_clip_count(asset_.get()); ++c) {
    anic_clip& clip = clips_.emplace_back(ANIC_INIT(anic_clip));
    anic_get_clip(asset_.get(), c, &clip);
  }
  frame_count_ = info_.frame_count;
  list_frames();
  if (allowed == Topologies::kOne && takes_turns())
    throw Error(ErrorKind::kUnsupported,
                fmt::format("{}: {} meshes that take turns, where the frames must have one; decode "
                            "makes files of the frames",
                            path, info_.mesh_count));
}

void PlayedClip::verify() const {
  if (const anic::Status status = asset_.verify(); !status)
    throw Error(error_kind(static_cast<anicodec::Status>(status.code())),
                fmt::format("{}: {}", path_, status.text()));
}

void PlayedClip::choose(const std::string& name) {
  if (name == "all" || (name.empty() && clips_.size() == 1))
    return;
  uint32_t chosen = 0;
  if (name.empty() || anic_find_clip(asset_.get(), name.c_str(), &chosen) != ANIC_OK) {
    std::string names;
    for (const anic_clip& clip : clips_)
      names += fmt::format("{}'{}'", names.empty() ? "" : ", ", clip.name);
    throw Error(ErrorKind::kUsage,
                name.empty()
                    ? fmt::format("{}: has several clips, one of them must be chosen, or all: {}",
                                  path_, names)
                    : fmt::format("{}: there is no clip '{}'; it has {}", path_, name, names));
  }
  clips_ = {clips_[chosen]};
  first_clip_ = chosen;
  frame_count_ = clips_[0].frame_count;
  list_frames();
}

/// Finds the frames of each mesh, within the clips at hand.
void PlayedClip::list_frames() {
  present_in_.assign(info_.mesh_count, {});
  const uint32_t first = clips_[0].first_frame, end = first + frame_count_;
  for (uint32_t s = 0; s < info_.segment_count; ++s) {
    anic_basis basis = ANIC_INIT(anic_basis);
    if (!asset_.basis(s, &basis) || basis.target != ANIC_TARGET_POSITIONS)
      continue;
    const uint32_t from = std::max(first, basis.first_frame);
    const uint32_t to = std::min(end, basis.first_frame + basis.frame_count);
    if (from < to)
      present_in_[basis.mesh].push_back({from - first, to - from});
  }
  for (std::vector<FrameRun>& runs : present_in_) {
    std::ranges::sort(runs, {}, &FrameRun::first);
    std::vector<FrameRun> joined;
    for (const FrameRun& run : runs) {
      if (!joined.empty() && joined.back().first + joined.back().count == run.first)
        joined.back().count += run.count;
      else
        joined.push_back(run);
    }
    runs = std::move(joined);
  }
}

std::vector<ClipTiming> PlayedClip::timings() const {
  std::vector<ClipTiming> timings;
  for (const anic_clip& clip : clips_) {
    ClipTiming& timing = timings.emplace_back();
    timing.name = clip.name;
    timing.frame_count = clip.frame_count;
    timing.rate = rate_of(clip);
    timing.start_time = clip.start_time;
    timing.times = times_of(asset_, clip);
    timing.loop = clip.loop != 0;
    const auto number = first_clip_ + static_cast<uint32_t>(timings.size()) - 1;
    for (uint32_t e = 0; e < anic_get_event_count(asset_.get(), number); ++e) {
      anic_event event = ANIC_INIT(anic_event);
      anic_get_event(asset_.get(), number, e, &event);
      timing.events.push_back({event.name, event.seconds});
    }
  }
  return timings;
}

std::vector<uint32_t> PlayedClip::meshes() const {
  std::vector<uint32_t> meshes(info_.mesh_count);
  std::iota(meshes.begin(), meshes.end(), 0U);
  return meshes;
}

/// The runs of each mesh, ascending by first frame.
std::vector<FrameRun> PlayedClip::runs_of_all() const {
  std::vector<FrameRun> runs;
  for (const std::vector<FrameRun>& own : present_in_)
    runs.insert(runs.end(), own.begin(), own.end());
  std::ranges::sort(runs, {}, &FrameRun::first);
  return runs;
}

void PlayedClip::check_empty_frames(const FrameRange& range) const {
  constexpr uint32_t kMost = 1'000'000;
  uint32_t empty = range.size(), end = 0;
  for (const FrameRun& run : runs_of_all()) {
    for (const FrameRun& taken : runs_in({run}, range)) {
      const uint32_t first = std::max(taken.first, end);
      end = std::max(end, taken.first + taken.count);
      empty -= end - first;
    }
  }
  if (empty > kMost)
    throw Error(ErrorKind::kInput,
                fmt::format("{}: {} of {} frames show nothing; take some of the frames only", path_,
                            empty, range.size()));
}

bool PlayedClip::takes_turns() const {
  const std::vector<FrameRun> runs = runs_of_all();
  for (size_t i = 1; i < runs.size(); ++i) {
    if (runs[i].first < runs[i - 1].first + runs[i - 1].count)
      return false;
  }
  return present_in_.size() > 1;
}

std::vector<MeshSequence> PlayedClip::describe_meshes(const std::vector<uint32_t>& meshes) const {
  std::vector<MeshSequence> described;
  for (uint32_t m : meshes) {
    const anic_mesh mesh = asset_.mesh(m);
    const anic_polygons polygons = asset_.polygons(m);
    MeshSequence& out = described.emplace_back();
    out.mesh_name = mesh.name;
    out.polygons.offsets.assign(polygons.offsets, polygons.offsets + polygons.polygon_count + 1);
    out.polygons.corners.assign(polygons.corners, polygons.corners + mesh.corner_count);
    out.vertex_count = mesh.vertex_count;
    restore_attributes(asset_, m, &out);
  }
  return described;
}

MeshSequence PlayedClip::describe(const std::vector<uint32_t>& meshes) const {
  std::vector<MeshSequence> described = describe_meshes(meshes);
  MeshSequence sequence = described.size() == 1 && described[0].mesh_name.empty()
                              ? std::move(described[0])
                              : merge_meshes(described);
  const anic_clip& clip = clips_[0];
  sequence.name = clip.name;
  sequence.frame_count = frame_count_;
  sequence.rate = rate_of(clip);
  sequence.start_time = clip.start_time;
  sequence.loop = clip.loop != 0;
  if (clips_.size() == 1)
    sequence.times = times_of(asset_, clip);
  sequence.up = up();
  sequence.metres_per_unit = info_.metres_per_unit;
  std::ranges::copy(info_.origin, sequence.origin.begin());
  return sequence;
}

/// Seeks a frame of the clips at hand.
anic::Status PlayedClip::show(uint32_t frame) const {
  if (frame >= frame_count_)
    return ANIC_E_FRAME_RANGE;
  if (player_->frame == frame)
    return ANIC_OK;
  player_->frame = frame;
  return player_->context.seek_frame(clips_[0].first_frame + frame);
}

void PlayedClip::check_played(anic::Status status, uint32_t frame) const {
  if (!status)
    throw Error(error_kind(static_cast<anicodec::Status>(status.code())),
                fmt::format("{}: frame {}: {}", path_, frame, status.text()));
}

FrameSource PlayedClip::play(const std::vector<uint32_t>& meshes) const {
  struct Part {
    uint32_t mesh;
    size_t first, count;         // floats
    uint32_t away = UINT32_MAX;  // the frame whose first vertex all are at, if they are
  };

  struct Parts {
    std::vector<Part> parts;
    std::vector<float> positions;
  };

  auto all = std::make_shared<Parts>();
  size_t count = 0;
  for (uint32_t m : meshes) {
    all->parts.push_back({m, count, size_t{3} * vertex_count(m)});
    count += all->parts.back().count;
  }
  all->positions.resize(count);
  return [this, all](uint32_t frame) -> std::span<const float> {
    for (Part& part : all->parts) {
      const uint32_t shown = shown_frame(present_in_[part.mesh], frame);
      if (shown != frame && part.away == shown)
        continue;
      part.away = shown != frame ? shown : UINT32_MAX;
      const std::span<float> own(all->positions.data() + part.first, part.count);
      anic::Status status = show(shown);
      if (status)
        status = player_->context.write_positions(anic::output(own), 0,
                                                  static_cast<uint32_t>(own.size() / 3),
                                                  ANIC_WHEN_CURRENT, part.mesh);
      check_played(status, frame);
      for (size_t i = 3; shown != frame && i < own.size(); ++i)
        own[i] = own[i - 3];
    }
    return all->positions;
  };
}

AttributeSource PlayedClip::play_attributes(const std::vector<uint32_t>& meshes) const {
  bool moves = false;
  for (uint32_t m : meshes) {
    for (uint32_t a = 0; a < asset_.mesh(m).attribute_count; ++a)
      moves = moves || asset_.attribute(a, m).moves;
  }
  if (!moves)
    return {};
  return [this, meshes, described = describe_meshes(meshes)](uint32_t frame) mutable {
    for (size_t m = 0; m < meshes.size(); ++m) {
      const uint32_t mesh = meshes[m];
      check_played(show(shown_frame(present_in_[mesh], frame)), frame);
      size_t restored = 0;
      for (uint32_t a = 0; a < asset_.mesh(mesh).attribute_count; ++a) {
        const anic_attribute stored = asset_.attribute(a, mesh);
        if (stored.components == 0)
          continue;
        FrameArray& values = described[m].attributes[restored++].values;
        check_played(
            player_->context.write_attribute(a, anic::value_output({values.data(), values.size()}),
                                             0, stored.count, ANIC_WHEN_CURRENT, mesh),
            frame);
      }
    }
    return described.size() == 1 ? described[0].attributes : merge_meshes(described).attributes;
  };
}

}  // namespace anicodec::tools
