// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/byte_order.h"
#include "tools/io/base/mesh.h"
#include "tools/io/gltf/gltf_compression.h"
#include "tools/io/guard/guarded_call.h"

#include <algorithm>
#include <bit>

namespace anicodec::tools {
namespace {

template <typename T>
void append_all(const std::vector<T>& values, std::string& out) {
  append(uint64_t{values.size()}, std::endian::native, out);
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Empty for nothing.
std::string packed(const std::optional<DracoPrimitive>& primitive) {
  std::string out;
  if (!primitive)
    return out;
  append_all(primitive->indices, out);
  for (const auto& [name, values] : primitive->attributes) {
    append(values.components, std::endian::native, out);
    append(values.normalizing_scale, std::endian::native, out);
    append_all(values.values, out);
  }
  return out;
}

/// Takes apart what packed() made, trusting nothing of it.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  T number() {
    if (bytes_.size() < sizeof(T)) {
      is_good_ = false;
      return {};
    }
    const T x = load<T>(bytes_.data(), std::endian::native);
    bytes_.remove_prefix(sizeof(T));
    return x;
  }

  template <typename T>
  std::vector<T> numbers(uint64_t expected) {
    std::vector<T> out;
    if (number<uint64_t>() != expected || bytes_.size() / sizeof(T) < expected) {
      is_good_ = false;
      return out;
    }
    out.resize(expected);
    std::copy_n(bytes_.data(), expected * sizeof(T), reinterpret_cast<char*>(out.data()));
    bytes_.remove_prefix(expected * sizeof(T));
    return out;
  }

  bool is_good() const { return is_good_; }

 private:
  std::string_view bytes_;
  bool is_good_ = true;
};

std::optional<DracoPrimitive> unpacked(std::string_view bytes, const DracoSource& source) {
  Unpacker in(bytes);
  DracoPrimitive out;
  out.points = source.points;
  out.indices = in.numbers<uint32_t>(source.indices);
  for (const auto& [name, id] : source.attributes) {
    DracoPrimitive::Values& values = out.attributes[name];
    values.components = in.number<uint32_t>();
    values.normalizing_scale = in.number<float>();
    values.values = in.numbers<float>(uint64_t{source.points} * values.components);
  }
  const bool within = std::ranges::all_of(out.indices, [&](uint32_t i) { return i < out.points; });
  if (!in.is_good() || !within)
    return std::nullopt;
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
  return unpacked(run_guarded(name, limits, [&] { return packed(decode_draco(source)); }), source);
}

}  // namespace anicodec::tools
