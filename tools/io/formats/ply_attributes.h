// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_PLY_ATTRIBUTES_H_
#define ANICODEC_TOOLS_IO_FORMATS_PLY_ATTRIBUTES_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/base/left_kinds.h"
#include "tools/io/formats/ply_header.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// The largest value of a colour's type, which stands for 1.
double ply_range(PlyType type);

/// The properties of a PLY's vertices beside positions, and the attributes that they become: red,
/// green, blue and alpha are a colour (integers are fractions of their largest value), s t, u v or
/// texture_u texture_v texture coordinates, nx ny nz a normal; any other number is an attribute of
/// its own, by its name. Lists are none.
class PlyAttributes {
 public:
  /// No property of the vertices is taken.
  PlyAttributes() = default;

  explicit PlyAttributes(const PlyElement& vertices);

  /// Whether a property is taken.
  bool takes(size_t property) const {
    return property < places_.size() && places_[property].attribute != kNone;
  }

  /// Takes the value of a property of a vertex; vertices come in order.
  void add(size_t vertex, size_t property, double value);

  /// The attributes, but for those with a number that is not finite. Adds the properties that come with none of them.
  std::vector<Attribute> finish(const PlyElement& vertices, LeftKinds* left_out);

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  struct Place {
    uint32_t attribute = kNone;
    uint32_t component = 0;
    double scale = 1;
  };

  void group(const PlyElement& vertices, AttributeKind kind, const char* name,
             std::span<const char* const> names, size_t least);

  std::vector<Place> places_;  ///< by property
  std::vector<Attribute> attributes_;
};

/// How the attributes of vertices are written: the declarations of their properties, and for each
/// frame the values behind the position of each vertex. Colours are bytes where all their numbers
/// can be, else floats.
class PlyProperties {
 public:
  explicit PlyProperties(const std::vector<Attribute>& attributes);

  const std::string& declarations() const { return declarations_; }

  /// Appends the values of a vertex, of the frame that the attributes hold.
  void append(size_t vertex, bool ascii, std::string& out) const;

 private:
  struct Written {
    const Attribute* attribute;
    bool bytes;
  };

  std::string declarations_;
  std::vector<Written> written_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_PLY_ATTRIBUTES_H_
