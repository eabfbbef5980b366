// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_output.h"

#include "tools/io/base/byte_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace anicodec::tools {
namespace {

constexpr size_t kMaxSharedText = 255;
constexpr size_t kMaxSharedTexts = 254;
// The release of the reference library whose ways these are: 1.8.6.
constexpr int32_t kLibraryVersion = 10806;

template <typename T>
void put(T x, std::string& out) {
  append(x, std::endian::little, out);
}

/// A number in 1, 2 or 4 bytes.
void put_sized(uint32_t x, uint32_t hint, std::string& out) {
  for (uint32_t i = 0; i < (1U << hint); ++i)
    out += static_cast<char>(x >> (8 * i));
}

uint32_t hint_for(uint64_t largest) {
  return largest < 256 ? 0 : largest < 65536 ? 1 : 2;
}

bool is_constant(const AbcProperty& header) {
  return header.first_changed == 0 && header.last_changed == 0;
}

/// Bits of a header that describe samples, beside name and metadata.
uint32_t info_of(const AbcProperty& header, bool is_scalar_like, bool is_homogeneous) {
  uint32_t info = header.shape == AbcShape::kScalar ? 1 : is_scalar_like ? 3 : 2;
  info |= uint32_t{static_cast<uint8_t>(header.type)} << 4;
  info |= header.sampling != 0 ? 0x100U : 0;
  if (is_constant(header))
    info |= 0x800;
  else if (header.first_changed != 1 || header.last_changed != header.samples - 1)
    info |= 0x200;
  info |= is_homogeneous ? 0x400U : 0;
  return info | header.extent << 12;
}

/// Elements in so many bytes of a sample; a text is one.
uint64_t elements_of(const AbcProperty& header, uint64_t bytes) {
  const uint64_t size = uint64_t{size_of(header.type)} * header.extent;
  return size == 0 ? 1 : bytes / size;
}

/// Name and, where it is not shared, metadata.
void put_texts(const AbcProperty& header, uint32_t metadata, uint32_t hint, std::string& out) {
  put_sized(static_cast<uint32_t>(header.name.size()), hint, out);
  out += header.name;
  if (metadata != kInlineMetadata)
    return;
  put_sized(static_cast<uint32_t>(header.metadata.size()), hint, out);
  out += header.metadata;
}

}  // namespace

AbcShared::AbcShared(AbcSink sink) : file_(std::move(sink)) {
  samplings_.push_back({AbcTime(1, {0})});
}

OgawaChild AbcShared::sample(std::string_view bytes, const AbcHash& digest) {
  if (bytes.empty())
    return kOgawaData;
  const auto [found, is_new] = samples_.try_emplace({digest, bytes.size()}, 0);
  if (is_new)
    found->second = file_.data(bytes_of(digest), bytes);
  return found->second;
}

uint32_t AbcShared::metadata(const std::string& text) {
  if (text.empty())
    return 0;
  const auto known = numbers_.find(text);
  if (known != numbers_.end())
    return known->second;
  if (text.size() > kMaxSharedText || texts_.size() >= kMaxSharedTexts)
    return kInlineMetadata;
  texts_.push_back(text);
  return numbers_[text] = static_cast<uint32_t>(texts_.size());
}

uint32_t AbcShared::sampling(const AbcTime& time) {
  const auto found = std::ranges::find_if(
      samplings_, [&](const Sampling& sampling) { return sampling.time == time; });
  const auto number = static_cast<uint32_t>(found - samplings_.begin());
  if (found == samplings_.end())
    samplings_.push_back({time});
  return number;
}

void AbcShared::count_samples(uint32_t sampling, uint32_t samples) {
  samplings_[sampling].most = std::max(samplings_[sampling].most, samples);
}

OgawaChild AbcShared::write_samplings() {
  std::string out;
  for (const Sampling& sampling : samplings_) {
    put(sampling.most, out);
    sampling.time.append_to(out);
  }
  return file_.data(out);
}

OgawaChild AbcShared::write_metadata() {
  std::string out;
  for (const std::string& text : texts_) {
    out += static_cast<char>(text.size());
    out += text;
  }
  return file_.data(out);
}

AbcPropertyOutput::AbcPropertyOutput(AbcShared& shared, AbcProperty header)
    : shared_(shared), header_(std::move(header)) {}

/// Puts the last sample among those that are stored.
void AbcPropertyOutput::store() {
  children_.push_back(last_);
  if (header_.shape == AbcShape::kArray)
    children_.push_back(kOgawaData);  // the number of elements is that of the bytes
}

/// The hash of a sample: of an array its number of elements counts, too.
AbcHash AbcPropertyOutput::digest_with_size() const {
  if (header_.shape == AbcShape::kScalar)
    return last_digest_;
  std::string bytes;
  put(elements_of(header_, last_size_), bytes);
  return spooky(bytes + bytes_of(last_digest_));
}

void AbcPropertyOutput::add(std::string_view bytes) {
  const AbcHash digest = murmur3(bytes);
  if (header_.samples > 0 && digest == last_digest_ && bytes.size() == last_size_)
    return repeat();
  if (header_.first_changed != 0) {  // the samples since the last change are no longer at the end
    for (uint32_t i = header_.last_changed + 1; i < header_.samples; ++i)
      store();
  }
  last_ = shared_.sample(bytes, digest);
  last_digest_ = digest;
  last_size_ = bytes.size();
  store();
  const uint64_t elements = elements_of(header_, bytes.size());
  is_scalar_like_ &= elements == 1;
  // The reference library compares numbers with elements.
  is_homogeneous_ &= header_.shape == AbcShape::kScalar || header_.extent == 1 || elements == 0;
  if (header_.first_changed == 0)
    header_.first_changed = header_.samples;
  header_.last_changed = header_.samples;
  gathered_ = header_.samples == 0 ? digest_with_size() : gather(gathered_, digest_with_size());
  ++header_.samples;
}

void AbcPropertyOutput::repeat() {
  gathered_ = gather(gathered_, digest_with_size());
  ++header_.samples;
}

AbcHash AbcPropertyOutput::finish(OgawaChild& group, std::string& headers) {
  group = shared_.file().group(children_);
  const uint32_t samples = header_.last_changed == 0 && header_.samples > 0 ? 1 : header_.samples;
  shared_.count_samples(header_.sampling, samples);

  const uint32_t metadata = shared_.metadata(header_.metadata);
  const uint32_t hint = hint_for(std::max({header_.metadata.size(), header_.name.size(),
                                           size_t{header_.samples}, size_t{header_.sampling}}));
  const uint32_t info = info_of(header_, is_scalar_like_, is_homogeneous_);
  put(info | hint << 2 | metadata << 20, headers);
  put_sized(header_.samples, hint, headers);
  if (info & 0x200) {
    put_sized(header_.first_changed, hint, headers);
    put_sized(header_.last_changed, hint, headers);
  }
  if (header_.sampling != 0)
    put_sized(header_.sampling, hint, headers);
  put_texts(header_, metadata, hint, headers);

  std::string hashed = header_.name + header_.metadata;
  hashed += static_cast<char>(header_.type);
  hashed += static_cast<char>(header_.extent);
  if (header_.shape == AbcShape::kScalar)
    hashed += '\0';
  shared_.time(header_.sampling).append_to(hashed);
  if (samples > 0)
    hashed += bytes_of(gathered_);
  return spooky(hashed);
}

AbcCompoundOutput::AbcCompoundOutput(AbcShared& shared, std::string name, std::string metadata)
    : shared_(shared) {
  header_.name = std::move(name);
  header_.metadata = std::move(metadata);
}

AbcPropertyOutput& AbcCompoundOutput::add(AbcProperty header) {
  members_.push_back({std::make_unique<AbcPropertyOutput>(shared_, std::move(header)), nullptr});
  return *members_.back().property;
}

AbcPropertyOutput& AbcCompoundOutput::scalar(std::string name, std::string metadata, AbcType type,
                                             uint32_t extent, uint32_t sampling) {
  AbcProperty header;
  header.name = std::move(name);
  header.metadata = std::move(metadata);
  header.shape = AbcShape::kScalar;
  header.type = type;
  header.extent = extent;
  header.sampling = sampling;
  return add(std::move(header));
}

AbcPropertyOutput& AbcCompoundOutput::array(std::string name, std::string metadata, AbcType type,
                                            uint32_t extent, uint32_t sampling) {
  AbcProperty header;
  header.name = std::move(name);
  header.metadata = std::move(metadata);
  header.shape = AbcShape::kArray;
  header.type = type;
  header.extent = extent;
  header.sampling = sampling;
  return add(std::move(header));
}

AbcCompoundOutput& AbcCompoundOutput::compound(std::string name, std::string metadata) {
  members_.push_back({nullptr, std::make_unique<AbcCompoundOutput>(shared_, std::move(name),
                                                                   std::move(metadata))});
  return *members_.back().compound;
}

std::string AbcCompoundOutput::finish(OgawaChild& group) {
  std::vector<OgawaChild> children;
  std::string headers, hashes;
  for (const Member& member : members_) {
    OgawaChild child = 0;
    hashes += bytes_of(member.property ? member.property->finish(child, headers)
                                       : member.compound->finish(child, headers));
    children.push_back(child);
  }
  if (!headers.empty())
    children.push_back(shared_.file().data(headers));
  group = shared_.file().group(children);
  return hashes;
}

AbcHash AbcCompoundOutput::finish(OgawaChild& group, std::string& headers) {
  const std::string hashes = finish(group);
  const uint32_t metadata = shared_.metadata(header_.metadata);
  const uint32_t hint = hint_for(std::max(header_.metadata.size(), header_.name.size()));
  put(hint << 2 | metadata << 20, headers);
  put_texts(header_, metadata, hint, headers);
  return spooky(hashes + header_.name + header_.metadata);
}

AbcObjectOutput::AbcObjectOutput(AbcShared& shared, std::string name, std::string metadata)
    : shared_(shared),
      name_(std::move(name)),
      metadata_(std::move(metadata)),
      properties_(shared, "", "") {}

AbcObjectOutput& AbcObjectOutput::child(std::string name, std::string metadata) {
  children_.push_back(
      std::make_unique<AbcObjectOutput>(shared_, std::move(name), std::move(metadata)));
  return *children_.back();
}

AbcObjectOutput* AbcObjectOutput::find(std::string_view name) const {
  const auto found =
      std::ranges::find_if(children_, [&](const auto& child) { return child->name_ == name; });
  return found == children_.end() ? nullptr : found->get();
}

AbcHash AbcObjectOutput::finish(OgawaChild& group) {
  std::vector<OgawaChild> children(1);
  const std::string property_hash = bytes_of(spooky(properties_.finish(children[0])));
  std::string headers, hashes;
  for (const auto& child : children_) {
    children.push_back(0);
    hashes += bytes_of(child->finish(children.back()));
    put(static_cast<uint32_t>(child->name_.size()), headers);
    headers += child->name_;
    const uint32_t metadata = shared_.metadata(child->metadata_);
    headers += static_cast<char>(metadata);
    if (metadata == kInlineMetadata) {
      put(static_cast<uint32_t>(child->metadata_.size()), headers);
      headers += child->metadata_;
    }
  }
  headers += property_hash;
  headers += hashes.empty() ? std::string(16, '\0') : bytes_of(spooky(hashes));
  children.push_back(shared_.file().data(headers));
  group = shared_.file().group(children);
  return spooky(hashes + property_hash + metadata_ + name_);
}

AbcArchiveOutput::AbcArchiveOutput(AbcSink sink, std::string metadata)
    : shared_(std::move(sink)), metadata_(std::move(metadata)), top_(shared_, "", "") {}

void AbcArchiveOutput::finish() {
  std::string format, library;
  put(int32_t{0}, format);
  put(kLibraryVersion, library);
  OgawaOutput& file = shared_.file();
  std::array<OgawaChild, 6> parts = {file.data(format), file.data(library)};
  top_.finish(parts[2]);
  parts[3] = file.data(metadata_);
  parts[4] = shared_.write_samplings();
  parts[5] = shared_.write_metadata();
  file.finish(file.group(parts));
}

}  // namespace anicodec::tools
