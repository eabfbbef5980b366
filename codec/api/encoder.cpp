// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The functions of encode.h.
#include "codec/api/encoder_objects.h"
#include "codec/api/guarded.h"
#include "codec/parallel/thread_count.h"
#include "codec/plan/encoding_memory.h"
#include "codec/sequence/error.h"
#include "codec/sequence/position_box.h"
#include "sdk/api/versioned.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <stdexcept>

namespace anicodec {
namespace {

/// Refuses what would hold more than max_bytes before positions are read.
void check_memory(const anic_encoder& encoder, const EncodeOptions& options) {
  double others = 0;  // meshes that wait or are read
  for (const SourceMesh& source : encoder.meshes)
    others += EncodingMemory::of(source.mesh.sequence, options).positions();
  for (const SourceMesh& source : encoder.meshes) {
    const EncodingMemory memory = EncodingMemory::of(source.mesh.sequence, options);
    plan_memory(memory, options, 1, others - memory.positions());
  }
}

Progress progress_of(const anic_encode_progress& host) {
  if (!host.report)
    return {};
  return [host](std::string_view stage, double done) {
    if (host.report(host.user, std::string(stage).c_str(), std::clamp(done, 0.0, 1.0)) != 0)
      throw EncoderFailure(ANIC_E_CANCELLED, "the host stopped the encoding");
  };
}

/// A copy of the meshes with their positions from an origin.
std::vector<SceneMesh> read_meshes(const anic_encoder& encoder, const Point& origin,
                                   const Progress& progress) {
  double frames = 0, read = 0;
  for (const SourceMesh& source : encoder.meshes)
    frames += source.mesh.sequence.frame_count;
  std::vector<SceneMesh> meshes;
  for (const SourceMesh& source : encoder.meshes) {
    SceneMesh mesh = source.mesh;
    mesh.sequence.origin = origin;
    read_positions(
        source,
        [&](uint32_t) {
          if (progress)
            progress("reading", read++ / frames);
        },
        &mesh.sequence);
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

/// The meshes from the origin of the clip, which is found if the host wants that.
std::vector<SceneMesh> read_near(const anic_encoder& encoder, const Progress& progress,
                                 MeshSequence* clip) {
  std::vector<SceneMesh> meshes = read_meshes(encoder, clip->origin, progress);
  const bool at_addresses = std::ranges::none_of(
      encoder.meshes, [](const SourceMesh& source) { return source.host.read; });
  if (!encoder.find_origin || !at_addresses)
    return meshes;
  PositionBox box;
  for (const SceneMesh& mesh : meshes)
    box.add(mesh.sequence.positions);
  if (!box.is_far())
    return meshes;
  clip->origin = box.middle();
  meshes.clear();
  return read_meshes(encoder, clip->origin, progress);
}

/// The meshes that were added, with positions.
Scene read_scene(const anic_encoder& encoder, const Progress& progress) {
  Scene scene;
  scene.clip = encoder.clip;
  scene.meshes = read_near(encoder, progress, &scene.clip);
  return scene;
}

void deliver(const Bytes& file, const anic_writer& writer) {
  if (writer.write && writer.write(writer.user, file.data(), file.size()) != 0)
    throw EncoderFailure(ANIC_E_READ, "the callback did not take the file");
}

void run_encoding(anic_encoder* encoder, const anic_encode_options& host, anic_encoding* out) {
  if (encoder->meshes.empty())
    throw EncoderFailure(ANIC_E_STATE, "there is no mesh to encode");
  if (encoder->clip.frame_count == 0)
    throw EncoderFailure(ANIC_E_STATE,
                         "the clip has no frame: it is a live one, for anic_begin_live()");
  const EncodeOptions options = options_of(host);
  check_argument(!options.keyframes || *options.keyframes <= encoder->clip.frame_count,
                 "more key-frames are asked for than the clip has frames");
  if (host.max_bytes > 0)
    check_memory(*encoder, options);
  constexpr uint32_t kMostThreads = 1024;
  check_argument(host.threads <= kMostThreads, "at most 1024 threads are possible");
  encoder->result = {};
  const Progress progress = progress_of(host.progress);
  with_threads(host.threads, [&] {
    encoder->result = encode(read_scene(*encoder, progress), options, progress);
  });
  EncodeResult& result = encoder->result;
  deliver(result.file, host.writer);
  out->size = result.file.size();
  if (host.writer.write)
    result.file = {};
  else
    out->file = result.file.data();
  out->max_error = result.max_error;
  out->rmse = result.rmse;
  out->kg = result.kg;
  out->max_displacement_error = result.max_displacement_error;
  out->diagonal = result.diagonal;
  out->components = result.components;
  out->basis = static_cast<anic_basis_kind>(result.kind);
  out->massaged = result.massage.change.has_value();
  out->surface_error = result.massage.change ? result.massage.change->max : 0;
}

constexpr uint32_t kMostFrames = (1U << 24) - 1;

MeshSequence clip_of(const anic_source_clip& host) {
  check_argument(host.frame_count <= kMostFrames, "at most 2^24 - 1 frames are possible");
  check_argument(host.up >= ANIC_UP_UNKNOWN && host.up <= ANIC_UP_Z, "there is no such axis");
  check_argument(std::isfinite(host.start_time), "the start is not finite");
  check_argument(std::isfinite(host.metres_per_unit) && host.metres_per_unit >= 0,
                 "the unit must be finite and not negative");
  MeshSequence clip;
  clip.name = host.name ? host.name : "";
  clip.frame_count = host.frame_count;
  if (host.rate_numerator > 0) {
    const uint32_t denominator = std::max<uint32_t>(host.rate_denominator, 1);
    const uint32_t common = std::gcd(host.rate_numerator, denominator);
    clip.rate = {host.rate_numerator / common, denominator / common, false};
  }
  clip.start_time = host.start_time;
  clip.up = static_cast<UpAxis>(host.up);
  clip.metres_per_unit = host.metres_per_unit;
  for (size_t k = 0; k < 3; ++k) {
    check_argument(std::isfinite(host.origin[k]) && (host.origin[k] == 0 || !host.find_origin),
                   "the origin is not finite, or is to be found and given");
    clip.origin[k] = host.origin[k];
  }
  check_argument(
      host.frame_count > 0 ||
          (!host.loop && !host.times && host.event_count == 0 && !host.find_origin),
      "a live clip has no loop, times, events and origin that is found: they need all frames");
  clip.loop = host.loop;
  if (host.times) {
    clip.times.assign(host.times, host.times + host.frame_count);
    for (size_t f = 0; f < clip.times.size(); ++f)
      check_argument(std::isfinite(clip.times[f]) &&
                         (f == 0 ? clip.times[0] == 0 : clip.times[f] > clip.times[f - 1]),
                     "the times must begin with 0 and ascend");
  }
  ClipTiming timing = clips_of(clip)[0];
  for (uint32_t i = 0; i < host.event_count; ++i) {
    check_argument(host.event_names && host.event_names[i] && host.event_seconds,
                   "an event has no name or time");
    try {
      add_event({host.event_names[i], host.event_seconds[i]}, &timing);
    } catch (const Error& e) {
      check_argument(false, e.what());
    }
  }
  clip.events = std::move(timing.events);
  return clip;
}

ClipTiming timing_of(const MeshSequence& clip) {
  return {clip.name,  clip.frame_count, clip.rate,  clip.start_time,
          clip.times, clip.loop,        clip.events};
}

/// Appends a clip to those of a file.
void append_clip(const MeshSequence& next, MeshSequence* clip) {
  check_argument(next.up == clip->up && next.metres_per_unit == clip->metres_per_unit &&
                     next.origin == clip->origin,
                 "a clip has another up axis, unit or origin than the first");
  check_argument(clip->frame_count + next.frame_count <= kMostFrames,
                 "at most 2^24 - 1 frames are possible");
  if (clip->clips.empty())
    clip->clips.push_back(timing_of(*clip));
  clip->clips.push_back(timing_of(next));
  clip->times.clear();
  clip->frame_count += next.frame_count;
}

}  // namespace
}  // namespace anicodec

using namespace anicodec;

uint32_t anic_get_encoder_version(void) {
  return ANIC_VERSION_MAJOR << 16 | ANIC_VERSION_MINOR << 8 | ANIC_VERSION_PATCH;
}

anic_status anic_create_encoder(anic_encoder** out) {
  if (!out)
    return ANIC_E_ARGUMENT;
  *out = new (std::nothrow) anic_encoder;
  return *out ? ANIC_OK : ANIC_E_MEMORY;
}

void anic_destroy_encoder(anic_encoder* encoder) {
  delete encoder;
}

const char* anic_get_encoder_text(const anic_encoder* encoder) {
  return encoder ? encoder->text.c_str() : "there is no encoder";
}

anic_status anic_set_source_clip(anic_encoder* encoder, const anic_source_clip* clip) {
  if (!encoder)
    return ANIC_E_ARGUMENT;
  return guarded(&encoder->text, [&] {
    check_argument(clip, "there is no clip");
    const anic_source_clip host = taken(clip, "anic_source_clip");
    encoder->clip = clip_of(host);
    encoder->has_clip = true;
    encoder->find_origin = host.find_origin;
    encoder->meshes.clear();
  });
}

anic_status anic_add_source_clip(anic_encoder* encoder, const anic_source_clip* clip) {
  if (!encoder)
    return ANIC_E_ARGUMENT;
  return guarded(&encoder->text, [&] {
    check_argument(clip, "there is no clip");
    if (encoder->clip.frame_count == 0 || !encoder->meshes.empty())
      throw EncoderFailure(
          ANIC_E_STATE,
          "clips come behind the first, which is not a live one, and before the meshes");
    const MeshSequence next = clip_of(taken(clip, "anic_source_clip"));
    check_argument(next.frame_count > 0, "the clip has no frame");
    append_clip(next, &encoder->clip);
  });
}

anic_status anic_add_source_mesh(anic_encoder* encoder, const anic_source_mesh* mesh,
                                 uint32_t* number) {
  if (!encoder)
    return ANIC_E_ARGUMENT;
  return guarded(&encoder->text, [&] {
    check_argument(mesh, "there is no mesh");
    if (!encoder->has_clip)
      throw EncoderFailure(ANIC_E_STATE, "the clip comes before its meshes");
    encoder->meshes.push_back(
        take_mesh(taken(mesh, "anic_source_mesh"), encoder->clip.frame_count));
    if (number)
      *number = static_cast<uint32_t>(encoder->meshes.size() - 1);
  });
}

anic_status anic_add_source_attribute(anic_encoder* encoder, uint32_t mesh,
                                      const anic_source_attribute* attribute) {
  if (!encoder)
    return ANIC_E_ARGUMENT;
  return guarded(&encoder->text, [&] {
    check_argument(attribute, "there is no attribute");
    check_argument(mesh < encoder->meshes.size(), "there is no such mesh");
    take_attribute(taken(attribute, "anic_source_attribute"), &encoder->meshes[mesh].mesh.sequence);
  });
}

anic_status anic_encode(anic_encoder* encoder, const anic_encode_options* options,
                        anic_encoding* out) {
  if (!encoder || !is_sized(out))
    return ANIC_E_ARGUMENT;
  anic_encoding ours = ANIC_INIT(anic_encoding);
  const anic_status status = guarded(
      &encoder->text, [&] { run_encoding(encoder, taken(options, "anic_encode_options"), &ours); });
  give(ours, out);
  return status;
}
