// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/assimp/assimp_scene.h"

#include "codec/sequence/error.h"
#include "tools/io/assimp/assimp_plugin.h"
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

namespace anicodec::tools {
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

std::string imported(ImportWithAssimp import, const std::string& path, uint32_t frames,
                     bool allow_outside) {
  std::string bytes;
  const auto take = [](void* user, const char* from, size_t size) {
    static_cast<std::string*>(user)->assign(from, size);
  };
  if (import(path.c_str(), frames, allow_outside ? 1 : 0, &bytes, take) != 0)
    throw Error(ErrorKind::kInput, bytes);
  return bytes;
}

/// Takes apart what the plug-in gave, trusting nothing of it; scenes point into it.
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

/// What a file holds.
struct AssimpFile {
  std::string bytes;
  std::vector<std::string_view> scenes;  ///< of `bytes`
  UpAxis up = UpAxis::kUnknown;
  double metres_per_unit = 0;  ///< 0: unknown

  void set_axes(MeshSequence& out) const {
    out.up = up;
    out.metres_per_unit = metres_per_unit;
  }
};

AssimpFile read_file_by_assimp(const std::string& path, uint32_t frames,
                               const GltfOptions& options) {
  const GuardLimits limits = GuardLimits::for_input(file_source(path).size, options.memory_limit);
  const ImportWithAssimp import = assimp_plugin(path);
  AssimpFile file;
  file.bytes = run_guarded(path, limits,
                           [&] { return imported(import, path, frames, options.allow_outside); });
  Unpacker in(file.bytes, path);
  file.up = axis_of(in.number<uint32_t>());
  const auto metres = in.number<double>();
  file.metres_per_unit = std::isfinite(metres) && metres >= 0 ? metres : 0;
  while (!in.at_end())
    file.scenes.push_back(in.scene());
  if (file.scenes.empty())
    fail_input(path, "holds no scene");
  return file;
}

}  // namespace

MeshSequence load_assimp(const std::string& path, const GltfOptions& options) {
  constexpr FrameRate kQuakeRate{10, 1, true};
  const uint32_t frames = stored_frames(path);
  const AssimpFile file = read_file_by_assimp(path, frames, options);
  GltfOptions one = options;
  one.flat_without_normals = false;  // a rule of glTF alone
  if (frames > 0)
    one.clip = "none";
  MeshSequence out = parse_gltf(file.scenes[0], path, {}, one);
  for (size_t i = 1; i < file.scenes.size(); ++i)
    add_stored_frame(parse_gltf(file.scenes[i], path, {}, one), path, out);
  if (frames > 0)
    out.rate = options.rate.value_or(kQuakeRate);
  file.set_axes(out);
  return out;
}

std::vector<MeshSequence> load_assimp_clips(const std::string& path, const GltfOptions& options,
                                            const std::vector<std::string>& names) {
  if (stored_frames(path) > 0) {
    if (!names.empty())
      throw Error(ErrorKind::kUsage, path + ": has frames, and no clips");
    return {load_assimp(path, options)};
  }
  const AssimpFile file = read_file_by_assimp(path, 0, options);
  GltfOptions all = options;
  all.flat_without_normals = false;
  std::vector<MeshSequence> clips = parse_gltf_clips(file.scenes[0], path, {}, all, names);
  for (MeshSequence& clip : clips)
    file.set_axes(clip);
  return clips;
}

}  // namespace anicodec::tools
