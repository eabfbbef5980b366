// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_property.h"

#include "tools/io/base/byte_order.h"
#include "tools/io/base/mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

namespace anicodec::tools {
namespace {

constexpr size_t kDigestSize = 16;
constexpr uint32_t kTypes = 14;

/// Numbers and texts in the headers of properties, each of which says how many bytes its numbers
/// have.
class HeaderCursor {
 public:
  HeaderCursor(const OgawaFile& file, const std::string& place, std::string_view bytes)
      : file_(file), place_(place), bytes_(bytes) {}

  bool at_end() const { return bytes_.empty(); }

  uint32_t number(size_t bytes) {
    const std::string_view raw = take(bytes);
    uint32_t value = 0;
    for (size_t i = 0; i < bytes; ++i)
      value |= uint32_t{static_cast<uint8_t>(raw[i])} << (8 * i);
    return value;
  }

  std::string text(size_t size) { return std::string(take(size)); }

 private:
  std::string_view take(size_t size) {
    if (size > bytes_.size())
      file_.fail(place_, "the headers of the properties are truncated");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  const OgawaFile& file_;
  const std::string& place_;
  std::string_view bytes_;
};

float from_half(uint16_t bits) {
  const int exponent = (bits >> 10) & 31;
  const auto fraction = static_cast<float>(bits & 1023);
  const float sign = bits >> 15 ? -1.0F : 1.0F;
  if (exponent == 31)
    return (bits & 1023) != 0 ? std::numeric_limits<float>::quiet_NaN()
                              : sign * std::numeric_limits<float>::infinity();
  return sign * (exponent == 0 ? std::ldexp(fraction, -24)
                               : std::ldexp(1 + fraction / 1024, exponent - 15));
}

template <typename From, typename To>
void convert(const char* bytes, std::span<To> out) {
  for (size_t i = 0; i < out.size(); ++i) {
    const From x = load<From>(bytes + i * sizeof(From), std::endian::little);
    out[i] = static_cast<To>(x);
  }
}

template <typename To>
void convert_halves(const char* bytes, std::span<To> out) {
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<To>(from_half(load<uint16_t>(bytes + 2 * i, std::endian::little)));
}

template <typename To>
void convert(AbcType type, const char* bytes, std::span<To> out) {
  switch (type) {
    case AbcType::kBool:
    case AbcType::kUint8:
      return convert<uint8_t>(bytes, out);
    case AbcType::kInt8:
      return convert<int8_t>(bytes, out);
    case AbcType::kUint16:
      return convert<uint16_t>(bytes, out);
    case AbcType::kInt16:
      return convert<int16_t>(bytes, out);
    case AbcType::kUint32:
      return convert<uint32_t>(bytes, out);
    case AbcType::kInt32:
      return convert<int32_t>(bytes, out);
    case AbcType::kUint64:
      return convert<uint64_t>(bytes, out);
    case AbcType::kInt64:
      return convert<int64_t>(bytes, out);
    case AbcType::kFloat16:
      return convert_halves(bytes, out);
    case AbcType::kFloat32:
      return convert<float>(bytes, out);
    default:
      return convert<double>(bytes, out);
  }
}

void read_samples_header(HeaderCursor& cursor, uint32_t info, size_t number_size,
                         AbcProperty& property) {
  property.samples = cursor.number(number_size);
  if (info & 0x200) {
    property.first_changed = cursor.number(number_size);
    property.last_changed = cursor.number(number_size);
  } else if (!(info & 0x800)) {
    property.first_changed = 1;
    property.last_changed = property.samples > 0 ? property.samples - 1 : 0;
  }
  if (info & 0x100)
    property.sampling = cursor.number(number_size);
}

}  // namespace

std::string_view metadata_value(std::string_view metadata, std::string_view key) {
  while (!metadata.empty()) {
    const std::string_view entry = metadata.substr(0, metadata.find(';'));
    if (entry.size() > key.size() && entry.starts_with(key) && entry[key.size()] == '=')
      return entry.substr(key.size() + 1);
    metadata.remove_prefix(std::min(metadata.size(), entry.size() + 1));
  }
  return {};
}

uint32_t size_of(AbcType type) {
  constexpr uint32_t kSizes[kTypes] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8, 0, 0};
  return kSizes[static_cast<uint8_t>(type)];
}

const AbcProperty* AbcCompound::find(std::string_view name) const {
  const auto found =
      std::ranges::find_if(properties, [&](const AbcProperty& p) { return p.name == name; });
  return found == properties.end() ? nullptr : &*found;
}

AbcCompound read_compound(const OgawaFile& file, OgawaChild group, const std::string& place,
                          const std::vector<std::string>& shared) {
  AbcCompound compound;
  const std::vector<OgawaChild> children = file.group(group, place);
  if (children.empty() || !is_data(children.back()))
    return compound;
  const std::string bytes = file.read(file.data(children.back(), place));
  HeaderCursor cursor(file, place, bytes);
  const auto owner = std::make_shared<const std::string>(place);
  while (!cursor.at_end()) {
    if (compound.properties.size() + 1 >= children.size())
      file.fail(place, "there are headers of more properties than the " +
                           std::to_string(children.size() - 1) + " of the group");
    AbcProperty property;
    const uint32_t info = cursor.number(4);
    const uint32_t shape = info & 3, hint = (info >> 2) & 3, type = (info >> 4) & 15;
    if (hint > 2)
      file.fail(place, "a property's header has numbers of an unknown size");
    const size_t number_size = size_t{1} << hint;
    property.shape = shape == 0   ? AbcShape::kCompound
                     : shape == 1 ? AbcShape::kScalar
                                  : AbcShape::kArray;
    if (property.shape != AbcShape::kCompound) {
      property.type = static_cast<AbcType>(type);
      property.extent = (info >> 12) & 255;
      read_samples_header(cursor, info, number_size, property);
    }
    property.name = cursor.text(cursor.number(number_size));
    property.owner = owner;
    const uint32_t metadata = (info >> 20) & 255;
    if (metadata == kInlineMetadata)
      property.metadata = cursor.text(cursor.number(number_size));
    else if (metadata < shared.size())
      property.metadata = shared[metadata];
    else
      file.fail(property.place(), "metadata " + std::to_string(metadata) + " of " +
                                      std::to_string(shared.size()) + " is not there");
    if (property.shape != AbcShape::kCompound) {
      if (type >= kTypes || property.extent == 0)
        file.fail(property.place(), "the type of the property is unknown");
      if (property.samples > kMaxFrames)
        file.fail(property.place(),
                  std::to_string(property.samples) + " samples; at most 2^24 - 1 are possible");
      if (property.last_changed < property.first_changed ||
          (property.samples > 0 && property.last_changed >= property.samples))
        file.fail(property.place(), "samples " + std::to_string(property.first_changed) + " to " +
                                        std::to_string(property.last_changed) + " change of " +
                                        std::to_string(property.samples));
    }
    property.child = children[compound.properties.size()];
    compound.properties.push_back(std::move(property));
  }
  return compound;
}

AbcSamples::AbcSamples(const OgawaFile& file, const AbcProperty& property)
    : file_(&file), property_(property) {
  if (property.shape == AbcShape::kCompound)
    fail("a compound stands where samples are expected");
  children_ = file.group(property.child, property.place());
  const size_t stored = property.samples == 0 ? 0
                        : property.last_changed == 0
                            ? 1
                            : property.last_changed - property.first_changed + 2;
  const size_t per_sample = property.shape == AbcShape::kScalar ? 1 : 2;
  if (children_.size() / per_sample < stored)
    fail(std::to_string(property.samples) + " samples need " + std::to_string(stored) +
         " that are stored, there are " + std::to_string(children_.size() / per_sample));
}

OgawaBlock AbcSamples::block(uint32_t sample) const {
  if (property_.samples == 0)
    fail("the property has no sample");
  sample = std::min(sample, property_.samples - 1);
  size_t stored = 0;
  if (property_.last_changed > 0 && sample >= property_.last_changed)
    stored = property_.last_changed - property_.first_changed + 1;
  else if (property_.last_changed > 0 && sample >= property_.first_changed)
    stored = sample - property_.first_changed + 1;
  OgawaBlock block = file_->data(
      children_[property_.shape == AbcShape::kScalar ? stored : 2 * stored], property_.place());
  if (block.size == 0)
    return block;
  if (block.size < kDigestSize)
    fail("sample " + std::to_string(sample) + " has " + std::to_string(block.size) +
         " bytes, less than its digest");
  return {block.offset + kDigestSize, block.size - kDigestSize};
}

OgawaBlock AbcSamples::numbers(uint32_t sample) const {
  const uint32_t bytes = size_of(property_.type);
  if (bytes == 0)
    fail("text stands where numbers are expected");
  const OgawaBlock found = block(sample);
  if (found.size % (bytes * property_.extent) != 0)
    fail("sample " + std::to_string(sample) + " has " + std::to_string(found.size) +
         " bytes, no multiple of " + std::to_string(bytes * property_.extent));
  return found;
}

size_t AbcSamples::size(uint32_t sample) const {
  return numbers(sample).size / size_of(property_.type);
}

void AbcSamples::read(uint32_t sample, std::span<float> out) const {
  const OgawaBlock block = numbers(sample);
  const uint32_t bytes = size_of(property_.type);
  if (block.size / bytes != out.size())
    fail("sample " + std::to_string(sample) + " has " + std::to_string(block.size / bytes) +
         " numbers, not " + std::to_string(out.size()));
  if (property_.type == AbcType::kFloat32 && std::endian::native == std::endian::little)
    return file_->read(block, 0, {reinterpret_cast<char*>(out.data()), out.size_bytes()});
  const std::string raw = file_->read(block);
  convert(property_.type, raw.data(), out);
}

std::vector<float> AbcSamples::floats(uint32_t sample) const {
  std::vector<float> out(numbers(sample).size / size_of(property_.type));
  read(sample, out);
  return out;
}

std::vector<double> AbcSamples::doubles(uint32_t sample) const {
  const OgawaBlock block = numbers(sample);
  const std::string raw = file_->read(block);
  std::vector<double> out(block.size / size_of(property_.type));
  convert(property_.type, raw.data(), std::span(out));
  return out;
}

std::vector<int32_t> AbcSamples::integers(uint32_t sample) const {
  if (property_.type >= AbcType::kFloat16)
    fail("integers are expected");
  const OgawaBlock block = numbers(sample);
  std::vector<int32_t> out(block.size / size_of(property_.type));
  if (size_of(property_.type) == 4 && std::endian::native == std::endian::little) {
    file_->read(block, 0, {reinterpret_cast<char*>(out.data()), block.size});
    return out;
  }
  const std::string raw = file_->read(block);
  convert(property_.type, raw.data(), std::span(out));
  return out;
}

std::string AbcSamples::text(uint32_t sample) const {
  if (property_.type != AbcType::kString)
    fail("text is expected");
  const std::string raw = file_->read(block(sample));
  return raw.substr(0, raw.find('\0'));
}

}  // namespace anicodec::tools
