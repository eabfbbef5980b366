// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_PROPERTY_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_PROPERTY_H_

#include "tools/io/alembic/ogawa.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// Number that a header has in place of a shared metadata: its own text follows.
inline constexpr uint8_t kInlineMetadata = 255;

/// "key=value;key=value" beside objects and properties.
std::string_view metadata_value(std::string_view metadata, std::string_view key);

/// The type of a property's numbers.
enum class AbcType : uint8_t {
  kBool = 0,
  kUint8 = 1,
  kInt8 = 2,
  kUint16 = 3,
  kInt16 = 4,
  kUint32 = 5,
  kInt32 = 6,
  kUint64 = 7,
  kInt64 = 8,
  kFloat16 = 9,
  kFloat32 = 10,
  kFloat64 = 11,
  kString = 12,
  kWideString = 13
};

/// Bytes of a number, 0 of text.
uint32_t size_of(AbcType type);

enum class AbcShape : uint8_t { kCompound, kScalar, kArray };

/// The header of a property: of a compound of properties, or of samples over time.
struct AbcProperty {
  std::string name;
  std::string metadata;
  std::shared_ptr<const std::string> owner;  ///< path of the object or compound that has it
  AbcShape shape = AbcShape::kCompound;
  AbcType type = AbcType::kFloat32;
  uint32_t extent = 1;    ///< numbers that belong together: 3 for a point
  uint32_t sampling = 0;  ///< number of the time sampling
  uint32_t samples = 0;   ///< as declared; repeats at both ends are not stored
  uint32_t first_changed = 0, last_changed = 0;
  OgawaChild child = 0;  ///< the group of its samples or properties

  /// Path of object and property, for messages.
  std::string place() const { return *owner + "/" + name; }

  /// True if all samples are the same as stored.
  bool is_constant() const { return samples <= 1 || last_changed == 0; }
};

/// Properties by name.
struct AbcCompound {
  std::vector<AbcProperty> properties;

  /// Null if there is none of that name.
  const AbcProperty* find(std::string_view name) const;
};

/// Reads the properties of a compound's group. `shared` are the texts of metadata that headers
/// refer to. Throws Error(kInput).
AbcCompound read_compound(const OgawaFile& file, OgawaChild group, const std::string& place,
                          const std::vector<std::string>& shared);

/// The samples of a scalar or array property. Each has a block of numbers, little-endian, which
/// several samples and properties may share. The file must outlive it. Throws Error(kInput).
class AbcSamples {
 public:
  AbcSamples(const OgawaFile& file, const AbcProperty& property);

  const AbcProperty& property() const { return property_; }

  /// The numbers of a sample, without the digest before them. Samples beyond the last are the last.
  OgawaBlock block(uint32_t sample) const;

  /// How many numbers a sample has, extent included.
  size_t size(uint32_t sample) const;

  /// Any number as float or double; integers beyond their precision are rounded.
  void read(uint32_t sample, std::span<float> out) const;
  std::vector<float> floats(uint32_t sample) const;
  std::vector<double> doubles(uint32_t sample) const;

  /// Integers of any kind that fit 32 bits.
  std::vector<int32_t> integers(uint32_t sample) const;

  /// The first text of a sample.
  std::string text(uint32_t sample) const;

 private:
  OgawaBlock numbers(uint32_t sample) const;

  [[noreturn]] void fail(const std::string& text) const { file_->fail(property_.place(), text); }

  const OgawaFile* file_;
  AbcProperty property_;
  std::vector<OgawaChild> children_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_PROPERTY_H_
