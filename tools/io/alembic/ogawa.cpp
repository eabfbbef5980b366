// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/ogawa.h"

#include "codec/sequence/error.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

namespace anicodec::tools {
namespace {

constexpr std::string_view kMagic = "Ogawa";
constexpr std::string_view kHdf5Magic("\x89HDF\r\n\x1a\n", 8);
constexpr size_t kHeaderSize = 16;
// Each group is read a few times at most.
constexpr uint64_t kMaxGroupReads = 8, kFreeGroupBytes = 1 << 16;

}  // namespace

OgawaFile::OgawaFile(const ByteSource& source) : source_(source) {
  std::array<char, kHeaderSize> header = {};
  const size_t size = static_cast<size_t>(std::min<uint64_t>(source.size, kHeaderSize));
  source.read(0, std::span(header).first(size));
  const std::string_view begin(header.data(), size);
  if (begin.starts_with(kHdf5Magic))
    throw Error(ErrorKind::kUnsupported,
                source.name +
                    ": is an Alembic file of the older kind (HDF5), which is not read; convert it "
                    "with 'abcconvert -toOgawa', or export it again as Ogawa");
  if (!begin.starts_with(kMagic))
    fail_input(source.name, "is not an Alembic file: it does not begin with 'Ogawa'");
  if (size < kHeaderSize)
    fail_input(source.name, "truncated: the header of an Alembic file has " +
                                std::to_string(kHeaderSize) + " bytes, the file has " +
                                std::to_string(size));
  if (header[5] != '\xff')
    fail_input(source.name, "was not closed by the program that wrote it");
  const auto version = load<uint16_t>(header.data() + 6, std::endian::big);
  if (version != 1)
    throw Error(ErrorKind::kUnsupported,
                source.name + ": version " + std::to_string(version) + " of Ogawa is not known");
  root_ = load<uint64_t>(header.data() + 8, std::endian::little);
}

void OgawaFile::fail(const std::string& place, const std::string& text) const {
  fail_input(source_.name, printable(place + ": " + text));
}

uint64_t OgawaFile::number(uint64_t offset) const {
  std::array<char, 8> bytes;
  source_.read(offset, bytes);
  return load<uint64_t>(bytes.data(), std::endian::little);
}

std::vector<OgawaChild> OgawaFile::group(OgawaChild child, const std::string& place) const {
  if (is_data(child))
    fail(place, "data stands where a group is expected");
  if (child == 0)
    return {};
  if (child < kHeaderSize || child > source_.size - 8)
    fail(place, "the group at " + std::to_string(child) + " is outside the file of " +
                    std::to_string(source_.size) + " bytes");
  const uint64_t count = number(child);
  if (count > (source_.size - child - 8) / 8)
    fail(place, "a group of " + std::to_string(count) + " children at " + std::to_string(child) +
                    " does not fit the file of " + std::to_string(source_.size) + " bytes");
  group_bytes_ += 8 * count;
  if (group_bytes_ > kMaxGroupReads * source_.size + kFreeGroupBytes)
    fail(place, "the groups of the file contain one another again and again");
  std::vector<OgawaChild> children(count);
  source_.read(child + 8, {reinterpret_cast<char*>(children.data()), count * 8});
  if constexpr (std::endian::native == std::endian::big) {
    for (OgawaChild& c : children)
      c = load<uint64_t>(reinterpret_cast<const char*>(&c), std::endian::little);
  }
  return children;
}

OgawaBlock OgawaFile::data(OgawaChild child, const std::string& place) const {
  if (!is_data(child))
    fail(place, "a group stands where data is expected");
  const uint64_t position = child & ~kOgawaData;
  if (position == 0)
    return {};
  if (position < kHeaderSize || position > source_.size - 8)
    fail(place, "the data at " + std::to_string(position) + " is outside the file of " +
                    std::to_string(source_.size) + " bytes");
  const uint64_t size = number(position);
  if (size > source_.size - position - 8)
    fail(place, std::to_string(size) + " bytes of data at " + std::to_string(position) +
                    " do not fit the file of " + std::to_string(source_.size) + " bytes");
  return {position + 8, size};
}

void OgawaFile::read(const OgawaBlock& block, uint64_t from, std::span<char> bytes) const {
  if (!bytes.empty())
    source_.read(block.offset + from, bytes);
}

std::string OgawaFile::read(const OgawaBlock& block) const {
  std::string bytes(block.size, '\0');
  read(block, 0, bytes);
  return bytes;
}

}  // namespace anicodec::tools
