// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_ARCHIVE_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_ARCHIVE_H_

#include "tools/io/alembic/abc_property.h"
#include "tools/io/alembic/abc_time.h"
#include "tools/io/alembic/ogawa.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace anicodec::tools {

inline constexpr uint32_t kAbcNone = UINT32_MAX;

/// Longest path of an object, in bytes.
inline constexpr size_t kAbcMaxPath = 4096;

/// The kind of an object, by the schema that its metadata names.
enum class AbcSchema : uint8_t { kOther, kXform, kPolyMesh, kSubD, kFaceSet };

/// An object of the hierarchy as stored.
struct AbcObject {
  std::string name;
  std::string path;  ///< "/body/arm/hand"; "/" for the topmost
  std::string metadata;
  AbcSchema schema = AbcSchema::kOther;
  uint32_t parent = kAbcNone;
  std::vector<uint32_t> children;
  OgawaChild properties = 0;    ///< the group of its properties
  std::string instance_source;  ///< path of the object that it repeats; empty: none
};

/// An Alembic archive: what it says of itself, its time samplings and its hierarchy of objects.
struct AbcArchive {
  /// Reads all but samples. Memory: O(size of headers and groups), bounded by the file. Throws
  /// Error(kInput) "file: object: reason", Error(kUnsupported) as OgawaFile. The source must
  /// outlive the archive.
  explicit AbcArchive(const ByteSource& source);
  AbcArchive(const AbcArchive&) = delete;
  AbcArchive& operator=(const AbcArchive&) = delete;

  OgawaFile file;
  std::string metadata;  ///< of the archive
  std::vector<AbcTime> samplings;
  std::vector<AbcObject> objects;  ///< the topmost first, parents before children

  /// The properties of an object, or within a compound of it.
  AbcCompound properties(const AbcObject& object) const;
  AbcCompound properties(const AbcProperty& compound) const;

  /// The time sampling of a property. Throws Error(kInput) where there is none of its number.
  const AbcTime& time_of(const AbcProperty& property) const;

  /// The sample of a property that holds at a time; 0 where it never changes.
  uint32_t sample_at(const AbcSamples& samples, double time) const;

  /// The object of a path, kAbcNone if there is none.
  uint32_t find(std::string_view path) const;

 private:
  void read_metadata(const std::vector<OgawaChild>& root);
  void read_objects(OgawaChild top);
  void read_children(uint32_t parent, const std::vector<OgawaChild>& group,
                     std::vector<OgawaChild>& groups);
  void add_object(uint32_t parent, std::string name, std::string metadata);

  std::vector<std::string> shared_metadata_;
  std::unordered_map<std::string_view, uint32_t> by_path_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_ARCHIVE_H_
