// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/glb_buffer.h"

#include "codec/sequence/error.h"
#include "tools/io/base/byte_order.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

namespace anicodec::tools {
namespace {

using OrderedJson = GlbBuffer::Json;

constexpr const char* kTooLarge = "the GLB would be larger than the 4 GiB that are possible";
constexpr int kUint16 = 5123, kUint32 = 5125, kFloat = 5126;

template <typename Number>
std::string bytes_of(std::span<const Number> numbers) {
  std::string out;
  out.reserve(numbers.size_bytes());
  for (Number x : numbers)
    append(x, std::endian::little, out);
  return out;
}

const char* type_name(size_t components) {
  constexpr const char* kNames[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kNames[components - 1];
}

struct PackedIndices {
  PackedIndices(std::span<const uint32_t> indices, uint32_t count)
      : type(count < UINT16_MAX ? kUint16 : kUint32) {
    if (type == kUint32) {
      bytes = bytes_of(indices);
      return;
    }
    const std::vector<uint16_t> small(indices.begin(), indices.end());
    bytes = bytes_of(std::span<const uint16_t>(small));
  }

  int type;
  std::string bytes;
};

OrderedJson describe(std::span<const float> values, size_t components, bool bounds) {
  OrderedJson accessor{{"componentType", kFloat},
                       {"count", values.size() / components},
                       {"type", type_name(components)}};
  if (!bounds)
    return accessor;
  std::vector<float> low(components, std::numeric_limits<float>::infinity());
  std::vector<float> high(components, -std::numeric_limits<float>::infinity());
  for (size_t i = 0; i < values.size(); ++i) {
    low[i % components] = std::min(low[i % components], values[i]);
    high[i % components] = std::max(high[i % components], values[i]);
  }
  // As double, which prints all digits.
  accessor["min"] = std::vector<double>(low.begin(), low.end());
  accessor["max"] = std::vector<double>(high.begin(), high.end());
  return accessor;
}

bool is_sparse_smaller(size_t elements, size_t count, size_t components) {
  constexpr size_t kDescription = 160;  // of the second view and the object, in JSON
  const size_t index = count < UINT16_MAX ? 2 : 4;
  return elements * (index + 4 * components) + kDescription < 4 * components * count;
}

}  // namespace

std::string pack_glb(std::string json, std::string_view binary) {
  constexpr size_t kHeader = 12, kChunkHeader = 8;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const size_t padded = (binary.size() + 3) / 4 * 4;
  const size_t size = kHeader + kChunkHeader + json.size() + kChunkHeader + padded;
  if (size > UINT32_MAX)
    throw Error(ErrorKind::kInput, kTooLarge);
  std::string out = "glTF";
  out.reserve(size);
  auto add = [&out](size_t x) { append(static_cast<uint32_t>(x), std::endian::little, out); };
  add(2);
  add(size);
  add(json.size());
  out += "JSON" + json;
  add(padded);
  out += std::string_view("BIN\0", 4);
  out += binary;
  out.resize(size);
  return out;
}

size_t GlbBuffer::add_indices(std::span<const uint32_t> indices, uint32_t vertices) {
  const PackedIndices packed(indices, vertices);
  const size_t view = add_view(packed.bytes, GlbTarget::kIndices);
  return add_accessor({{"bufferView", view},
                       {"componentType", packed.type},
                       {"count", indices.size()},
                       {"type", "SCALAR"}});
}

size_t GlbBuffer::add_floats(std::span<const float> values, size_t components, GlbTarget target,
                             bool bounds) {
  OrderedJson accessor = describe(values, components, bounds);
  accessor["bufferView"] = add_view(bytes_of(values), target);
  return add_accessor(std::move(accessor));
}

size_t GlbBuffer::add_differences(std::span<const float> values, size_t components) {
  std::vector<uint32_t> elements;
  for (uint32_t i = 0; i < values.size() / components; ++i) {
    auto element = values.subspan(i * components, components);
    if (std::any_of(element.begin(), element.end(), [](float x) { return x != 0; }))
      elements.push_back(i);
  }
  if (elements.empty()) {
    const auto [zeros, is_new] = zeros_.try_emplace({values.size(), components}, 0);
    if (is_new)
      zeros->second = add_accessor(describe(values, components, true));
    return zeros->second;
  }
  if (!is_sparse_smaller(elements.size(), values.size() / components, components))
    return add_floats(values, components, GlbTarget::kVertices, true);
  std::vector<float> kept;
  kept.reserve(elements.size() * components);
  for (uint32_t i : elements) {
    auto element = values.subspan(i * components, components);
    kept.insert(kept.end(), element.begin(), element.end());
  }
  return add_sparse(describe(values, components, true), elements, kept);
}

size_t GlbBuffer::add_sparse(uint64_t count, std::span<const uint32_t> elements,
                             std::span<const float> values) {
  return add_sparse({{"componentType", kFloat}, {"count", count}, {"type", "SCALAR"}}, elements,
                    values);
}

size_t GlbBuffer::add_sparse(OrderedJson accessor, std::span<const uint32_t> elements,
                             std::span<const float> values) {
  const PackedIndices packed(elements, accessor["count"].get<uint32_t>());
  const size_t index_view = add_view(packed.bytes, GlbTarget::kNone);
  const size_t value_view = add_view(bytes_of(values), GlbTarget::kNone);
  accessor["sparse"] = {{"count", elements.size()},
                        {"indices", {{"bufferView", index_view}, {"componentType", packed.type}}},
                        {"values", {{"bufferView", value_view}}}};
  return add_accessor(std::move(accessor));
}

void GlbBuffer::describe_in(OrderedJson& document) const {
  document["accessors"] = accessors_;
  document["bufferViews"] = views_;
  document["buffers"] = OrderedJson::array({{{"byteLength", bytes_.size()}}});
}

void GlbBuffer::check_size(uint64_t more) const {
  if (bytes_.size() + more > UINT32_MAX)
    throw Error(ErrorKind::kInput, kTooLarge);
}

size_t GlbBuffer::add_view(std::string_view bytes, GlbTarget target) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  check_size(bytes.size());
  OrderedJson view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
  if (target != GlbTarget::kNone)
    view["target"] = static_cast<int>(target);
  bytes_ += bytes;
  views_.push_back(std::move(view));
  return views_.size() - 1;
}

size_t GlbBuffer::add_accessor(OrderedJson accessor) {
  accessors_.push_back(std::move(accessor));
  return accessors_.size() - 1;
}

}  // namespace anicodec::tools
