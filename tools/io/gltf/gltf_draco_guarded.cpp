// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/mesh.h"
#include "tools/io/gltf/gltf_compression.h"
#include "tools/io/guard/guard_message.h"
#include "tools/io/guard/guarded_call.h"

#include <algorithm>
#include <string_view>

namespace anicodec::tools {
namespace {

/// Empty for nothing.
std::string packed(const std::optional<DracoPrimitive>& primitive) {
  std::string out;
  if (!primitive)
    return out;
  append_values(primitive->indices, out);
  for (const auto& [name, values] : primitive->attributes) {
    append_one(values.components, out);
    append_one(values.normalizing_scale, out);
    append_values(values.values, out);
  }
  return out;
}

/// Takes apart what packed() made, trusting nothing of it.
std::optional<DracoPrimitive> unpacked(std::string_view bytes, const std::string& name,
                                       const DracoSource& source) {
  if (bytes.empty())
    return std::nullopt;
  GuardMessage in(bytes, name);
  DracoPrimitive out;
  out.points = source.points;
  in.values(out.indices);
  bool fits = out.indices.size() == source.indices &&
              std::ranges::all_of(out.indices, [&](uint32_t i) { return i < out.points; });
  for (const auto& [attribute, id] : source.attributes) {
    DracoPrimitive::Values& values = out.attributes[attribute];
    values.components = in.one<uint32_t>();
    values.normalizing_scale = in.one<float>();
    in.values(values.values);
    fits = fits && values.values.size() == uint64_t{source.points} * values.components;
  }
  if (!fits)
    in.fail();
  return out;
}

}  // namespace

std::optional<DracoPrimitive> decode_draco_guarded(const DracoSource& source,
                                                   const std::string& name, uint64_t memory_limit) {
  // Flat grids, which compress best, take a bit for about 40 points.
  constexpr uint64_t kMostForAByte = 1024;
  constexpr uint64_t kOfEach = 512, kOfAny = uint64_t{64} << 20;  // bytes of memory
  const uint64_t elements = uint64_t{source.points} + source.indices / 3;
  if (elements > kMostForAByte * source.bytes.size())
    fail_input(name, std::to_string(source.points) + " vertices and " +
                         std::to_string(source.indices / 3) + " triangles cannot come from " +
                         std::to_string(source.bytes.size()) + " bytes of Draco");
  const uint64_t needed = kOfAny + kOfEach * elements;
  const GuardLimits limits =
      GuardLimits::for_input(source.bytes.size(), std::min(needed, memory_limit));
  const std::string said = run_guarded(name, limits, [&] { return packed(decode_draco(source)); });
  return unpacked(said, name, source);
}

}  // namespace anicodec::tools
