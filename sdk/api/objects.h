// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The objects behind the handles of the C interface, and helpers of its functions. Internal to sdk/,
// but for the encoder, which opens what it has made and goes on learning.
#ifndef ANICODEC_SDK_API_OBJECTS_H_
#define ANICODEC_SDK_API_OBJECTS_H_

#include "sdk/api/versioned.h"
#include "sdk/clip/clip.h"
#include "sdk/clip/clock.h"
#include "sdk/clip/sample.h"

#include <anicodec/anicodec.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <utility>

namespace anicodec {

inline anic_status c_status(Status status) {
  return static_cast<anic_status>(status);
}

/// Takes the options that a host gives; null: the defaults. False when they make no sense.
bool take_options(const anic_options* host, anic_options* out);

/// The status that every opening function returns for arguments that make no sense.
inline constexpr Failure kBadArgument = {Status::kArgument, 0, 0, "an argument makes no sense"};

/// Whether a failure may be written to: null is none to write.
inline bool is_failure(const anic_failure* failure) {
  return !failure || is_sized(failure);
}

/// Fills a failure, if there is one to fill (is_failure()), and returns its status.
anic_status report(const Failure& failure, anic_failure* out);

/// The memory of a host's allocator; null, or without functions: malloc() and free().
Memory memory_of(const anic_allocator* allocator);

/// The decoder's options from the host's, for a file of this size.
OpenOptions open_options(const anic_options& options, uint64_t file_size);

/// A stride of 0 and scales of 0 replaced. Errors: kArgument; kBufferSize: it does not hold `count`
/// elements.
Status check_output(const anic_output* out, uint32_t count, VertexOutput* result);

/// Runs what may throw at the edge of the interface: nothing leaves it.
template <class Function>
Failure guarded(Function function) noexcept {
  const Failure no_memory = {Status::kMemory, 0, 0, "the allocator had no memory"};
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return no_memory;
  } catch (const std::length_error&) {  // a container that no memory could hold
    return no_memory;
  } catch (...) {
    return {Status::kInternal, 0, 0, "an unexpected exception"};
  }
}

/// Bytes before an object that create() makes: the memory it came from.
inline constexpr size_t kObjectHead = (sizeof(Memory) + 15) / 16 * 16;

/// Bytes that create() takes for an object.
template <class T>
constexpr size_t object_bytes(size_t extra = 0) {
  return kObjectHead + sizeof(T) + extra;
}

/// Makes an object, with `extra` bytes behind it, in memory that it owns a copy of: containers that
/// it is made with take theirs from there. Throws std::bad_alloc.
template <class T, class... Arguments>
T* create(Memory memory, size_t extra, Arguments&&... arguments) {
  static_assert(alignof(T) <= 16 && alignof(Memory) <= 16);
  auto* head = static_cast<unsigned char*>(memory.take(object_bytes<T>(extra), 16));
  auto* kept = new (head) Memory(memory);
  const MemoryScope scope(kept);
  try {
    return new (head + kObjectHead) T(std::forward<Arguments>(arguments)...);
  } catch (...) {
    memory.give_back(head, object_bytes<T>(extra));
    throw;
  }
}

/// The memory of an object that create() made.
template <class T>
Memory& memory_of_object(T* object) {
  return *reinterpret_cast<Memory*>(reinterpret_cast<unsigned char*>(object) - kObjectHead);
}

template <class T>
const Memory& memory_of_object(const T* object) {
  return *reinterpret_cast<const Memory*>(reinterpret_cast<const unsigned char*>(object) -
                                          kObjectHead);
}

template <class T>
void destroy(T* object, size_t extra = 0) {
  if (!object)
    return;
  Memory memory = memory_of_object(object);
  object->~T();
  memory.give_back(reinterpret_cast<unsigned char*>(object) - kObjectHead, object_bytes<T>(extra));
}

}  // namespace anicodec

namespace anicodec {

/// State shared by the assets of an opened file. It goes with the last of them.
struct OpenedFile {
  Clip clip;
  double quality = 1;
  uint64_t flags = 0;
  size_t context_bytes = 0;
  Vector<uint32_t> triangle_counts;  ///< by mesh
  Vector<size_t> buffers;            ///< by track: SampleSize::buffer()
  /// By mesh and frame, then one more for each mesh: around all frames. Empty when not asked for.
  Vector<anic_box> boxes;
  std::atomic<uint32_t> assets{0};
};

}  // namespace anicodec

struct anic_asset {
  anicodec::OpenedFile* file;
  const anicodec::Clip& clip;        ///< of the file
  anicodec::Vector<uint8_t> wanted;  ///< by clip: whether the host wants it
  double quality = 1;                ///< share of the file's components that is played
  size_t resident_bytes = 0;         ///< of this object, and of the file if it opened it

  anic_asset(anicodec::OpenedFile* opened, const anicodec::Vector<uint8_t>& clips)
      : file(opened), clip(opened->clip), wanted(clips.begin(), clips.end()) {
    file->assets.fetch_add(1, std::memory_order_relaxed);
  }

  bool has_clip(uint32_t number) const { return wanted[number] != 0; }
};

struct anic_context {
  struct State {
    anicodec::Sample* samples;  ///< by track
    float* weights;             ///< anic_asset::buffers of the tracks one after another
    anicodec::RootState root;   ///< the motion of the whole
    uint8_t holds = 0;          ///< what of it a clip shown holds: RootRecord::kMoves, kTurns
  };

  const anic_asset* asset;
  size_t extra;       ///< bytes behind this object
  uint32_t clip = 0;  ///< that times are of
  bool chosen = false;
  double quality = 1;      ///< of what is chosen next
  anicodec::FrameMix mix;  ///< what is shown now
  State states[2];         ///< by anic_when
  float* scratch;          ///< of make_sample()
};

namespace anicodec {

/// The sample that a call is about, after checking what all of them check. ANIC_E_ABSENT comes with
/// the sample.
anic_status find_sample(const anic_context* context, uint32_t mesh, anic_when when,
                        const Sample** out);

/// The attribute of vertices that a call is about, if the mesh is there.
anic_status find_attribute(const anic_context* context, uint32_t mesh, uint32_t attribute,
                           anic_when when, const MeshAttribute** out);

/// Opens an asset of a file whose header and table have been read, or of its first bytes. `size`: how many bytes are
/// there; `kept` and `learning` as in OpenOptions. Throws std::bad_alloc.
Failure open_asset(const ContainerReader& file, size_t size, const anic_options& options,
                   KeptMeshes* kept, KeptLearning* learning, anic_asset** out);

/// The body of anic_open_asset(), with OpenOptions::learning. Throws std::bad_alloc.
Failure open_asset(ByteView bytes, const anic_options& options, KeptLearning* learning,
                   anic_asset** out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_API_OBJECTS_H_
