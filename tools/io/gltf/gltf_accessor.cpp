// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_accessor.h"

#include "tools/io/base/byte_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace anicodec::tools {
namespace {

template <typename Stored>
float scaled(const char* bytes, bool normalized) {
  auto x = static_cast<float>(load<Stored>(bytes, std::endian::little));
  if (!normalized)
    return x;
  return std::max(x / static_cast<float>(std::numeric_limits<Stored>::max()), -1.0F);
}

/// IEEE 754 binary16.
float half_at(const char* bytes) {
  constexpr int kBits = 10, kBias = 15, kMostExponent = 31;
  const auto bits = load<uint16_t>(bytes, std::endian::little);
  const int exponent = bits >> kBits & kMostExponent;
  const auto fraction = static_cast<float>(bits & ((1 << kBits) - 1));
  const float one = 1 << kBits;
  const float magnitude = exponent == kMostExponent ? std::numeric_limits<float>::infinity()
                          : exponent == 0           ? std::ldexp(fraction / one, 1 - kBias)
                                          : std::ldexp(1 + fraction / one, exponent - kBias);
  return bits >> 15 != 0 ? -magnitude : magnitude;
}

float float_at(const char* bytes, GltfComponent type, bool normalized) {
  switch (type) {
    case GltfComponent::kInt8:
      return scaled<int8_t>(bytes, normalized);
    case GltfComponent::kUint8:
      return scaled<uint8_t>(bytes, normalized);
    case GltfComponent::kInt16:
      return scaled<int16_t>(bytes, normalized);
    case GltfComponent::kUint16:
      return scaled<uint16_t>(bytes, normalized);
    case GltfComponent::kUint32:
      return scaled<uint32_t>(bytes, normalized);
    case GltfComponent::kHalf:
      return half_at(bytes);
    case GltfComponent::kFloat:
      break;
  }
  return load<float>(bytes, std::endian::little);
}

uint32_t unsigned_at(const char* bytes, GltfComponent type) {
  switch (type) {
    case GltfComponent::kUint8:
      return load<uint8_t>(bytes, std::endian::little);
    case GltfComponent::kUint16:
      return load<uint16_t>(bytes, std::endian::little);
    default:
      return load<uint32_t>(bytes, std::endian::little);
  }
}

/// Calls take(element, bytes) for each of the elements that stand in a view.
template <typename Take>
void for_each_element(const GltfView& view, uint64_t offset, uint32_t count, size_t element,
                      Take take) {
  const size_t stride = view.stride > 0 ? view.stride : element;
  for (uint32_t i = 0; i < count; ++i)
    take(i, view.bytes.data() + offset + i * stride);
}

/// Calls take(element, bytes) for all elements that are stored, sparse ones last.
template <typename Take>
void for_all_elements(const GltfDocument& document, const GltfAccessor& accessor,
                      const std::string& path, Take take) {
  const size_t element = size_t{size_of(accessor.type)} * accessor.components;
  if (accessor.view != kGltfNone)
    for_each_element(document.views[accessor.view], accessor.offset, accessor.count, element, take);
  if (!accessor.sparse)
    return;
  const GltfSparse& sparse = *accessor.sparse;
  std::vector<uint32_t> indices;
  for_each_element(document.views[sparse.index_view], sparse.index_offset, sparse.count,
                   size_of(sparse.index_type), [&](uint32_t, const char* bytes) {
                     indices.push_back(unsigned_at(bytes, sparse.index_type));
                     if (indices.back() >= accessor.count)
                       fail_gltf(document, path,
                                 "sparse index " + std::to_string(indices.back()) +
                                     " is out of bounds; the accessor has " +
                                     std::to_string(accessor.count) + " elements");
                   });
  for_each_element(document.views[sparse.value_view], sparse.value_offset, sparse.count, element,
                   [&](uint32_t i, const char* bytes) { take(indices[i], bytes); });
}

/// Accessors of zeros need no bytes, but accessors of vertices come with others that have bytes.
void check_zeros(const GltfDocument& document, uint32_t index, const std::string& path) {
  constexpr uint64_t kMostForAByte = 16;
  const GltfAccessor& accessor = document.accessors[index];
  if (accessor.view == kGltfNone && accessor.count > kMostForAByte * document.bytes)
    fail_gltf(document, path,
              "/accessors/" + std::to_string(index) + " has " + std::to_string(accessor.count) +
                  " elements and no buffer view, but the document has only " +
                  std::to_string(document.bytes) + " bytes");
}

}  // namespace

uint64_t bytes_as_floats(const GltfDocument& document, uint32_t accessor) {
  const GltfAccessor& a = document.accessors[accessor];
  return uint64_t{a.count} * a.components * sizeof(float);
}

std::vector<float> read_floats(const GltfDocument& document, uint32_t index,
                               const std::string& path) {
  check_zeros(document, index, path);
  const GltfAccessor& accessor = document.accessors[index];
  std::vector<float> out(size_t{accessor.count} * accessor.components);
  const size_t size = size_of(accessor.type);
  for_all_elements(document, accessor, path, [&](uint32_t i, const char* bytes) {
    for (size_t k = 0; k < accessor.components; ++k) {
      float x = float_at(bytes + k * size, accessor.type, accessor.normalized);
      if (!std::isfinite(x))
        fail_gltf(document, path,
                  "element " + std::to_string(i) + " is not finite (/accessors/" +
                      std::to_string(index) + ")");
      out[size_t{i} * accessor.components + k] = x;
    }
  });
  return out;
}

std::vector<uint32_t> read_unsigned(const GltfDocument& document, uint32_t index,
                                    const std::string& path) {
  const GltfAccessor& accessor = document.accessors[index];
  if (accessor.type != GltfComponent::kUint8 && accessor.type != GltfComponent::kUint16 &&
      accessor.type != GltfComponent::kUint32)
    fail_gltf(document, path,
              "/accessors/" + std::to_string(index) + " does not hold unsigned integers");
  check_zeros(document, index, path);
  std::vector<uint32_t> out(size_t{accessor.count} * accessor.components);
  const size_t size = size_of(accessor.type);
  for_all_elements(document, accessor, path, [&](uint32_t i, const char* bytes) {
    for (size_t k = 0; k < accessor.components; ++k)
      out[size_t{i} * accessor.components + k] = unsigned_at(bytes + k * size, accessor.type);
  });
  return out;
}

}  // namespace anicodec::tools
