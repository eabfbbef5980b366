// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_OGAWA_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_OGAWA_H_

#include "tools/io/files/byte_source.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Child of an Ogawa group: the position of a group, or with the top bit set that of data.
using OgawaChild = uint64_t;

inline constexpr OgawaChild kOgawaData = OgawaChild{1} << 63;

inline bool is_data(OgawaChild child) {
  return (child & kOgawaData) != 0;
}

/// Bytes of a file.
struct OgawaBlock {
  uint64_t offset = 0;
  uint64_t size = 0;

  bool operator==(const OgawaBlock&) const = default;
};

/// The container below Alembic: groups of groups and of data. Every position and size is checked
/// against the file before it is used; nothing is held but what a call returns. All calls throw
/// Error(kInput) "file: place: reason"; `place` names the object or property at hand.
class OgawaFile {
 public:
  /// Checks the header. Throws Error(kUnsupported) for the older kind of file (HDF5) and for other
  /// versions. The source must outlive the file.
  explicit OgawaFile(const ByteSource& source);

  const std::string& name() const { return source_.name; }

  uint64_t size() const { return source_.size; }

  OgawaChild root() const { return root_; }

  /// The children of a group. All groups that are read together may not take more than a multiple
  /// of the file's size, as groups that are shared again and again would.
  std::vector<OgawaChild> group(OgawaChild child, const std::string& place) const;

  /// The bytes of data.
  OgawaBlock data(OgawaChild child, const std::string& place) const;

  /// Reads a part of a block that data() has given.
  void read(const OgawaBlock& block, uint64_t from, std::span<char> bytes) const;

  /// Reads all of one.
  std::string read(const OgawaBlock& block) const;

  [[noreturn]] void fail(const std::string& place, const std::string& text) const;

 private:
  uint64_t number(uint64_t offset) const;

  const ByteSource& source_;
  OgawaChild root_ = 0;
  mutable uint64_t group_bytes_ = 0;  ///< read so far
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_OGAWA_H_
