// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: statuses, memory, and opening.
#include "sdk/api/bounds.h"
#include "sdk/api/objects.h"
#include "sdk/clip/file_checks.h"
#include "sdk/clip/memory_estimate.h"
#include "sdk/clip/sample_size.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#if defined(_WIN32)
#include <malloc.h>
#endif

namespace anicodec {
namespace {

#if defined(_WIN32)
// Its C library has no aligned_alloc(): free() must know.
void* allocate_default(void*, size_t size, size_t alignment) {
  return _aligned_malloc(size, alignment);
}

void release_default(void*, void* memory, size_t) {
  _aligned_free(memory);
}
#else
void* allocate_default(void*, size_t size, size_t alignment) {
  // malloc() of WebAssembly and of 32-bit machines aligns to 8 bytes.
  if (alignment <= alignof(std::max_align_t))
    return std::malloc(size);
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void release_default(void*, void* memory, size_t) {
  std::free(memory);
}
#endif

/// Bytes that any file may take while it opens, and more for each byte of it: a kilobyte does not
/// get a gigabyte unless the host says so.
constexpr uint64_t kBytesAtLeast = uint64_t{1} << 28, kBytesPerByte = uint64_t{1} << 14;

/// The share of an opening that decoding takes, where boxes of all frames follow.
constexpr double kShareBeforeBoxes = 0.75;

/// Bytes that a block allocator may lose to fragmentation and bookkeeping: measured, with room to spare.
uint64_t block_bytes(uint64_t opening) {
  const uint64_t slack = opening / 4 + 65536;
  return opening + std::min(slack, UINT64_MAX - opening);
}

/// Triangles of polygons.
uint32_t triangle_count(const Topology& t) {
  uint64_t count = 0;
  for (size_t p = 0; p + 1 < t.polygon_offsets.size(); ++p) {
    const uint32_t corners = t.polygon_offsets[p + 1] - t.polygon_offsets[p];
    count += corners < 3 ? 0 : corners - 2;
  }
  return static_cast<uint32_t>(count);
}

uint64_t box_bytes(const Limits& limits) {
  return sizeof(anic_box) * (uint64_t{limits.frames} + 1) * limits.meshes.size();
}

/// Fills as much of `out` as the first bytes of a file tell.
Failure find_requirements(ByteView head, const anic_options& options, anic_requirements* out) {
  Memory memory = memory_of(&options.allocator);
  const MemoryScope scope(&memory);
  ContainerReader file;
  out->head_bytes = ContainerReader::head_bytes(head);
  if (head.size == 0)
    return {Status::kTruncated, 0, 0, "nothing to look at"};
  if (Failure failure = file.open_prefix(head); !failure.ok())
    return failure;
  out->file_bytes = file.file_size();
  if (const Chunk* limits_chunk = file.find("LIMI"))
    out->head_bytes = std::max(out->head_bytes, limits_chunk->offset + limits_chunk->size);
  Limits limits;
  const OpenOptions opening = open_options(options, file.file_size());
  if (Failure failure = read_limits(file, opening, &limits); !failure.ok())
    return failure;
  const MemoryEstimate estimate = estimate_memory(limits, opening.quality, opening.opens_exact());
  const bool boxes = options.flags & ANIC_OPEN_BOUNDS;
  const ContextSize context = context_size(limits, opening.quality);
  const uint64_t more = object_bytes<anic_asset>() + object_bytes<OpenedFile>() +
                        sizeof(uint32_t) * limits.meshes.size() + sizeof(size_t) * context.tracks +
                        (boxes ? box_bytes(limits) : 0);
  out->resident_bytes = estimate.resident + more;
  out->opening_bytes = estimate.opening + more;
  out->draco_bytes = estimate.draco;
  out->block_bytes = block_bytes(out->opening_bytes);
  out->context_bytes = object_bytes<anic_context>() + context.bytes();
  out->mesh_count = static_cast<uint32_t>(limits.meshes.size());
  out->segment_count = static_cast<uint32_t>(limits.segments.size());
  out->frame_count = limits.frames;
  for (const auto& mesh : limits.meshes)
    out->max_vertices = std::max(out->max_vertices, mesh.source_vertices);
  for (const auto& s : limits.segments)
    out->max_components = std::max(out->max_components, s.components);
  return {};
}

}  // namespace

bool take_options(const anic_options* host, anic_options* out) {
  if (!take(host, out))
    return false;
  for (uint32_t i = 0; out->clips && i < out->clip_count; ++i) {
    if (!out->clips[i])
      return false;
  }
  return true && out->quality >= 0 && out->quality <= 1 && (out->clips || out->clip_count == 0) &&
         (out->flags & ~static_cast<uint64_t>(ANIC_OPEN_BOUNDS | ANIC_OPEN_ANY_ORDER |
                                              ANIC_OPEN_IN_PLACE | ANIC_OPEN_INEXACT)) == 0 &&
         !out->allocator.allocate == !out->allocator.release;
}

anic_status report(const Failure& failure, anic_failure* out) {
  if (out) {
    anic_failure ours = ANIC_INIT(anic_failure);
    ours.status = c_status(failure.status);
    ours.offset = failure.offset;
    ours.detail = failure.detail;
    for (int i = 0; i < 4 && failure.chunk; ++i)
      ours.chunk[i] = static_cast<char>(failure.chunk >> (8 * i));
    give(ours, out);
  }
  return c_status(failure.status);
}

Memory memory_of(const anic_allocator* allocator) {
  Memory memory;
  memory.allocate = allocate_default;
  memory.release = release_default;
  if (allocator && allocator->allocate) {
    memory.user = allocator->user;
    memory.allocate = allocator->allocate;
    memory.release = allocator->release;
  }
  return memory;
}

OpenOptions open_options(const anic_options& options, uint64_t file_size) {
  OpenOptions result;
  result.any_order = options.flags & ANIC_OPEN_ANY_ORDER;
  result.in_place = options.flags & ANIC_OPEN_IN_PLACE;
  result.inexact = options.flags & ANIC_OPEN_INEXACT;
  HostLimits& limits = result.limits;
  limits.resident_bytes =
      kBytesAtLeast +
      std::min(file_size, (UINT64_MAX - kBytesAtLeast) / kBytesPerByte) * kBytesPerByte;
  auto set = [](uint64_t value, uint64_t* limit) {
    if (value != 0)
      *limit = value;
  };
  set(options.max_vertices, &limits.vertices);
  set(options.max_frames, &limits.frames);
  set(options.max_components, &limits.components);
  set(options.max_bytes, &limits.resident_bytes);
  // Sizes below fit in size_t, on machines of 32 bits too.
  limits.resident_bytes = std::min<uint64_t>(limits.resident_bytes, SIZE_MAX / 2);
  if (options.quality > 0)
    result.quality = options.quality;
  result.clips = {options.clips, options.clip_count};
  return result;
}

namespace {

/// Opens the file behind an asset.
Failure open_file(const ContainerReader& container, size_t size, const anic_options& options,
                  KeptMeshes* kept, KeptLearning* learning, OpenedFile* file) {
  // The bytes of a stream that have arrived count for the limit.
  OpenOptions opening = open_options(options, size);
  HostProgress progress(options.progress.report, options.progress.user);
  const bool boxes = options.flags & ANIC_OPEN_BOUNDS;
  opening.prefix = !container.is_complete();
  opening.progress = &progress;
  opening.kept = kept;
  opening.learning = learning;
  opening.threads = {options.threads.run, options.threads.user};
  opening.progress_end = boxes ? kShareBeforeBoxes : 1;
  const MemoryScope scope(&memory_of_object(file));
  if (Failure failure = file->clip.open(container, opening); !failure.ok())
    return failure;
  const Clip& clip = file->clip;
  file->quality = opening.quality;
  file->flags = options.flags;
  const ContextSize context = context_size(clip);
  file->context_bytes = object_bytes<anic_context>(static_cast<size_t>(context.bytes()));
  file->buffers.reserve(clip.tracks().size());
  for (uint32_t t = 0; t < clip.tracks().size(); ++t)
    file->buffers.push_back(static_cast<size_t>(sample_size(clip, t).buffer()));
  file->triangle_counts.reserve(clip.meshes().size());
  for (const Mesh& mesh : clip.meshes())
    file->triangle_counts.push_back(triangle_count(mesh.topology));
  if (boxes && !compute_boxes(file, opening.threads, &progress))
    return {Status::kCancelled, 0, 0, "the host stopped the opening"};
  return {};
}

/// One more asset of a file, for the clips that are wanted. Throws std::bad_alloc.
anic_asset* make_asset(OpenedFile* file, const Memory& memory, const Vector<uint8_t>& wanted) {
  auto* asset = create<anic_asset>(memory, 0, file, wanted);
  asset->resident_bytes = memory_of_object(asset).held;
  return asset;
}

Failure share_asset(const anic_asset& asset, const anic_options& options, anic_asset** out) {
  // The asset's memory may be in use by other threads: only where it comes from is taken.
  Memory memory =
      options.allocator.allocate ? memory_of(&options.allocator) : memory_of_object(&asset);
  memory.held = memory.peak = 0;
  Memory of_call = memory;
  const MemoryScope scope(&of_call);
  Vector<uint8_t> wanted;
  const ClipNames names = {options.clips, options.clip_count};
  if (Failure failure = wanted_clips(asset.clip.record(), names, &wanted); !failure.ok())
    return failure;
  for (size_t c = 0; c < wanted.size(); ++c) {
    if (names.count > 0 && wanted[c] && !asset.has_clip(static_cast<uint32_t>(c)))
      return {Status::kAbsent, 0, 0, "a clip asked for is not open in the asset that shares"};
    wanted[c] = wanted[c] && asset.has_clip(static_cast<uint32_t>(c));
  }
  *out = make_asset(asset.file, memory, wanted);
  const double quality = options.quality > 0 ? options.quality / asset.file->quality : 1;
  (*out)->quality = std::min(quality, asset.quality);
  return {};
}

}  // namespace

Failure open_asset(const ContainerReader& container, size_t size, const anic_options& options,
                   KeptMeshes* kept, KeptLearning* learning, anic_asset** out) {
  OpenedFile* file = create<OpenedFile>(memory_of(&options.allocator), 0);
  try {
    if (Failure failure = open_file(container, size, options, kept, learning, file);
        !failure.ok()) {
      destroy(file);
      return failure;
    }
    *out = make_asset(file, memory_of(&options.allocator), file->clip.wanted());
  } catch (...) {
    destroy(file);
    throw;
  }
  (*out)->resident_bytes += memory_of_object(file).held;
  return {};
}

Failure open_asset(ByteView bytes, const anic_options& options, KeptLearning* learning,
                   anic_asset** out) {
  Memory memory = memory_of(&options.allocator);
  const MemoryScope scope(&memory);
  ContainerReader container;
  if (Failure failure = container.open(bytes); !failure.ok())
    return failure;
  return open_asset(container, bytes.size, options, nullptr, learning, out);
}

}  // namespace anicodec

using namespace anicodec;

uint32_t anic_get_version(void) {
  return ANIC_VERSION_MAJOR << 16 | ANIC_VERSION_MINOR << 8 | ANIC_VERSION_PATCH;
}

const char* anic_get_status_text(anic_status status) {
  return status_string(static_cast<Status>(status));
}

anic_status anic_get_requirements(const void* head, size_t size, const anic_options* options,
                                  anic_requirements* out) {
  anic_options wanted;
  if (!is_sized(out) || (!head && size > 0) || !take_options(options, &wanted))
    return ANIC_E_ARGUMENT;
  anic_requirements needs = ANIC_INIT(anic_requirements);
  const Failure failure = guarded([&] {
    return find_requirements({static_cast<const uint8_t*>(head), size}, wanted, &needs);
  });
  give(needs, out);
  return c_status(failure.status);
}

anic_status anic_open_asset(const void* file, size_t size, const anic_options* options,
                            anic_asset** out, anic_failure* failure) {
  if (out)
    *out = nullptr;
  if (!is_failure(failure))
    return ANIC_E_ARGUMENT;
  anic_options wanted;
  if (!out || (!file && size > 0) || !take_options(options, &wanted))
    return report(kBadArgument, failure);
  return report(
      guarded([&] {
        return open_asset({static_cast<const uint8_t*>(file), size}, wanted, nullptr, out);
      }),
      failure);
}

anic_status anic_share_asset(const anic_asset* asset, const anic_options* options,
                             anic_asset** out) {
  if (out)
    *out = nullptr;
  anic_options wanted;
  if (!asset || !out || !take_options(options, &wanted) ||
      (options && wanted.flags != asset->file->flags))
    return ANIC_E_ARGUMENT;
  return c_status(guarded([&] { return share_asset(*asset, wanted, out); }).status);
}

void anic_close_asset(anic_asset* asset) {
  if (!asset)
    return;
  OpenedFile* file = asset->file;
  destroy(asset);
  if (file->assets.fetch_sub(1, std::memory_order_acq_rel) == 1)
    destroy(file);
}

anic_status anic_verify_asset(const anic_asset* asset) {
  if (!asset)
    return ANIC_E_ARGUMENT;
  if (asset->clip.is_partial() || asset->file->quality < 1)
    return ANIC_E_STATE;
  return c_status(asset->clip.check_hashes().status);
}
