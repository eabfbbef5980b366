// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/assimp/assimp_scene.h"

#include "codec/sequence/error.h"

#ifdef ANICODEC_ASSIMP
#include "tools/io/assimp/assimp_import.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/base/mesh.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/guard/guarded_call.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#endif

namespace anicodec::tools {

#ifdef ANICODEC_ASSIMP

namespace {

/// How many frames an MD2 or MD3 holds, as its header says; 0 for others.
uint32_t stored_frames(const std::string& path) {
  constexpr std::pair<const char*, uint64_t> kPlaces[] = {{"IDP2", 40}, {"IDP3", 76}};
  const ByteSource source = file_source(path);
  for (const auto& [magic, place] : kPlaces) {
    if (source.size < place + 4)
      continue;
    char head[4], count[4];
    source.read(0, head);
    source.read(place, count);
    if (std::equal(head, head + 4, magic))
      return load<uint32_t>(count, std::endian::little);
  }
  return 0;
}

std::string packed(const AssimpImport& imported) {
  std::string out;
  append(static_cast<uint32_t>(imported.up), std::endian::native, out);
  append(imported.metres_per_unit, std::endian::native, out);
  for (const std::string& scene : imported.scenes) {
    append(uint64_t{scene.size()}, std::endian::native, out);
    out += scene;
  }
  return out;
}

/// Takes apart what packed() made, trusting nothing of it; scenes point into it.
class Unpacker {
 public:
  Unpacker(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  template <typename T>
  T number() {
    const std::string_view bytes = take(sizeof(T));
    return load<T>(bytes.data(), std::endian::native);
  }

  std::string_view scene() { return take(number<uint64_t>()); }

  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view take(uint64_t size) {
    if (size > bytes_.size())
      fail_input(path_, "the process that reads it says nothing that makes sense");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  std::string_view bytes_;
  const std::string& path_;
};

UpAxis axis_of(uint32_t number) {
  return number == static_cast<uint32_t>(UpAxis::kY)   ? UpAxis::kY
         : number == static_cast<uint32_t>(UpAxis::kZ) ? UpAxis::kZ
                                                       : UpAxis::kUnknown;
}

/// Adds a stored frame to those before it.
void add_stored_frame(MeshSequence frame, const std::string& path, MeshSequence& out) {
  if (frame.polygons != out.polygons || frame.vertex_count != out.vertex_count)
    fail_input(path, "frame " + std::to_string(out.frame_count) +
                         " has other vertices or faces than frame 0");
  out.positions.insert(out.positions.end(), frame.positions.begin(), frame.positions.end());
  ++out.frame_count;
}

}  // namespace

MeshSequence load_assimp(const std::string& path, const GltfOptions& options) {
  constexpr FrameRate kQuakeRate{10, 1, true};
  const uint32_t frames = stored_frames(path);
  const GuardLimits limits = GuardLimits::for_input(file_source(path).size, options.memory_limit);
  const std::string bytes = run_guarded(path, limits, [&] {
    return packed(import_with_assimp(path, frames, options.allow_outside));
  });
  GltfOptions one = options;
  if (frames > 0)
    one.clip = "none";
  Unpacker in(bytes, path);
  const auto up = in.number<uint32_t>();
  const auto metres = in.number<double>();
  MeshSequence out;
  while (!in.at_end()) {
    MeshSequence next = parse_gltf(in.scene(), path, {}, one);
    if (out.frame_count == 0)
      out = std::move(next);
    else
      add_stored_frame(std::move(next), path, out);
  }
  if (frames > 0)
    out.rate = options.rate.value_or(kQuakeRate);
  out.up = axis_of(up);
  out.metres_per_unit = std::isfinite(metres) && metres >= 0 ? metres : 0;
  return out;
}

#else

MeshSequence load_assimp(const std::string& path, const GltfOptions&) {
  throw Error(ErrorKind::kUnsupported,
              path +
                  ": this build is without assimp, which reads this format; export the clip as "
                  "glTF, or as OBJ with PC2 or MDD");
}

#endif

}  // namespace anicodec::tools
