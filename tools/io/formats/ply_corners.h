// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_PLY_CORNERS_H_
#define ANICODEC_TOOLS_IO_FORMATS_PLY_CORNERS_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/base/left_kinds.h"
#include "tools/io/formats/ply_header.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace anicodec::tools {

/// The properties of a PLY's faces that become attributes of corners: the lists texcoord (u, v of each
/// corner) and color (red, green, blue and perhaps alpha of each), and the colour red green blue alpha of the
/// whole face. Integers are fractions of the largest value of their type. A face with an empty list has
/// zeros; an attribute whose lists fit no face, or that has a number that is not finite, is left out.
class PlyCorners {
 public:
  /// No property is taken.
  PlyCorners() = default;

  explicit PlyCorners(const PlyElement& faces);

  /// Whether the values of a property are taken.
  bool takes(size_t property) const {
    return property < track_of_.size() && track_of_[property].track != kNone;
  }

  /// Takes a value of a property of the face at hand.
  void add(size_t property, double value);

  /// All properties of a face of so many corners have been given.
  void end_face(size_t corners);

  /// The attributes, one for each kind; adds what of the faces is none.
  std::vector<Attribute> finish(const PlyElement& faces, LeftKinds* left_out);

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// Values that become one attribute.
  struct Track {
    const char* name;
    AttributeKind kind;
    bool of_face;                   ///< one element for all corners
    uint32_t components;            ///< 0: not known yet, as the list of the first face says it
    std::vector<double> face = {};  ///< values of the face at hand
    FrameArray values = {};         ///< of corners
    size_t corners_before = 0;      ///< of faces without values before the components are known
    bool fits = true;
  };

  struct Place {
    uint32_t track = kNone;
    uint32_t component = 0;  ///< of a value that is no list
    double scale = 1;
  };

  std::vector<Place> track_of_;  ///< by property
  std::vector<Track> tracks_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_PLY_CORNERS_H_
