// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_MESH_SEQUENCE_H_
#define ANICODEC_CODEC_SEQUENCE_MESH_SEQUENCE_H_

#include "codec/sequence/frame_array.h"
#include "format/attribute_record.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace anicodec {

/// Polygons over vertices, as imported: degenerate, duplicate and non-manifold ones included.
struct Polygons {
  std::vector<uint32_t> offsets{0};  ///< polygon p has corners offsets[p] .. offsets[p+1]-1
  std::vector<uint32_t> corners;     ///< vertex index of each corner

  size_t size() const { return offsets.size() - 1; }

  std::span<const uint32_t> operator[](size_t p) const {
    return {corners.data() + offsets[p], offsets[p + 1] - offsets[p]};
  }

  void add(std::span<const uint32_t> polygon) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    offsets.push_back(static_cast<uint32_t>(corners.size()));
  }

  bool operator==(const Polygons&) const = default;
};

/// Frames per second as a rational; assumed says that the source named none.
struct FrameRate {
  uint32_t numerator = 24;
  uint32_t denominator = 1;
  bool assumed = true;

  double value() const { return static_cast<double>(numerator) / denominator; }
};

/// x, y, z in the units of a clip.
using Point = std::array<double, 3>;

enum class UpAxis : uint8_t { kUnknown = 0, kY = 1, kZ = 2 };

/// The largest error that numbers of an attribute may have: in units of its values, in per cent of its range over all
/// frames, or none of whole numbers.
struct AttributeBound {
  enum class Measure : uint8_t { kUnits, kPercent, kExact };
  Measure measure = Measure::kUnits;
  double value = 0;  ///< above 0 but for kExact

  bool operator==(const AttributeBound&) const = default;
};

/// Values that stand beside the positions: of each vertex, of each corner of the polygons, or of each polygon.
struct Attribute {
  AttributeKind kind = AttributeKind::kUv;
  std::string name;  ///< as in the source, "TEXCOORD_0"
  AttributeDomain domain = AttributeDomain::kVertex;
  uint32_t components = 2;  ///< 2 for UV, 3 for normals, 4 for tangents, 3 or 4 for colours
  uint32_t frames = 1;      ///< 1: static, or as in the first frame; else as many as the sequence
  FrameArray values;        ///< frames x elements x components, row-major
  std::optional<AttributeBound> bound = {};  ///< its own; nothing: that of all attributes
  std::string unit = {};                     ///< of the values, as "K"; empty: unknown

  bool per_vertex() const { return domain == AttributeDomain::kVertex; }

  bool per_corner() const { return domain == AttributeDomain::kCorner; }
};

inline constexpr uint32_t kNoLabel = UINT32_MAX;

/// Names, each of some polygons.
struct PolygonLabels {
  std::vector<std::string> names;
  std::vector<uint32_t> of_polygon;      ///< a name's number or kNoLabel; empty: none has any
  std::vector<MaterialLook> looks = {};  ///< of materials: one for each name; empty: none is known

  bool operator==(const PolygonLabels&) const = default;
};

/// Attributes: all that a mesh has beside positions.
struct MeshDetails {
  std::string mesh_name;  ///< where a clip has several meshes
  std::vector<Attribute> attributes;
  /// A number for each corner of the polygons: corners at one place with the same number share a normal,
  /// whatever it is, so that edges between different ones are hard. Empty: unknown, or told by a
  /// normal among the attributes.
  std::vector<uint32_t> shared_normals;
  PolygonLabels materials;
  PolygonLabels parts;  ///< meshes or objects of the source
};

/// A named time of a clip.
struct NamedTime {
  std::string name;
  double seconds = 0;  ///< from the clip's first frame on
};

/// A clip of a sequence: some of its frames, with a name and a clock of their own.
struct ClipTiming {
  std::string name;
  uint32_t frame_count = 0;
  FrameRate rate;
  double start_time = 0;      ///< seconds
  std::vector<double> times;  ///< as in MeshSequence
  bool loop = false;
  std::vector<NamedTime> events = {};  ///< ascending by time
};

/// An animated mesh: one connectivity, a position per vertex per frame. Positions are kept as
/// given: nothing is rotated or scaled.
struct MeshSequence : MeshDetails {
  std::string name;  ///< of the clip, never a path
  Polygons polygons;
  uint32_t vertex_count = 0;
  uint32_t frame_count = 0;
  FrameArray positions;  ///< frame_count x vertex_count x 3, row-major
  FrameRate rate;
  double start_time = 0;  ///< seconds
  /// `frame_count` seconds from start_time for uneven sampling, else empty.
  std::vector<double> times;
  UpAxis up = UpAxis::kUnknown;
  double metres_per_unit = 0;     ///< 0: unknown
  Point origin{};                 ///< where positions count from, in the coordinates of the source
  bool loop = false;              ///< meant to be repeated
  std::vector<NamedTime> events;  ///< ascending by time
  /// Several clips, one after the other: all frames together; name, rate, start, times, loop and events of
  /// the sequence are then without meaning. Empty: it is one clip.
  std::vector<ClipTiming> clips;

  /// Positions of one frame: vertex_count x 3.
  std::span<const float> frame(size_t f) const {
    return {positions.data() + f * vertex_count * 3, size_t{vertex_count} * 3};
  }

  std::span<float> frame(size_t f) {
    return {positions.data() + f * vertex_count * 3, size_t{vertex_count} * 3};
  }
};

/// How many values a domain has for each component and frame.
inline size_t element_count(const MeshSequence& mesh, AttributeDomain domain) {
  return domain == AttributeDomain::kCorner    ? mesh.polygons.corners.size()
         : domain == AttributeDomain::kPolygon ? mesh.polygons.size()
                                               : mesh.vertex_count;
}

/// Frames that follow one another.
struct FrameRun {
  uint32_t first = 0;
  uint32_t count = 0;

  bool operator==(const FrameRun&) const = default;
};

/// The clips of a sequence, one at least.
std::vector<ClipTiming> clips_of(const MeshSequence& sequence);

/// Adds an event in the order of times. Throws Error(kUsage) for a time that is outside the clip, which lasts
/// until its last frame has had its time, and for an empty name.
void add_event(const NamedTime& event, ClipTiming* clip);

/// Throws Error(kInput) naming the first fault: no frame, no vertex, a size that does not fit, a
/// corner out of range, a position that is not finite (with frame and vertex), an attribute that
/// moves in some frames only, clips that do not fit the frames or share a name.
void check(const MeshSequence& sequence);

/// Length of the diagonal of the box around all vertices of all frames, in scene units.
double diagonal(const MeshSequence& sequence);

/// The same of each clip.
std::vector<double> clip_diagonals(const MeshSequence& sequence);

/// Whether the last of some frames has the positions of the first.
bool is_closed(const MeshSequence& sequence, const FrameRun& frames);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_MESH_SEQUENCE_H_
