// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The records inside the chunks, each with its writer and its reader (spec/06-chunks.md). A reader
// checks every field against its range; relations between records are checked where they meet.
#ifndef ANICODEC_FORMAT_RECORDS_H_
#define ANICODEC_FORMAT_RECORDS_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"

#include <cstdint>
#include <optional>

namespace anicodec {

inline constexpr uint32_t kMaxVertices = (1U << 31) - 1;
inline constexpr uint32_t kMaxTriangles = UINT32_MAX / 3;  // corners are numbered with 32 bits
inline constexpr uint32_t kMaxFrames = (1U << 24) - 1;
inline constexpr uint32_t kMaxMeshes = 65535;
inline constexpr uint32_t kMaxComponents = 1U << 20;
inline constexpr uint32_t kMaxRegions = 8;
inline constexpr uint32_t kMaxAttributes = 256;
inline constexpr uint32_t kMaxAttributeComponents = 16;

/// In place of an attribute's number: the positions.
inline constexpr uint32_t kPositions = UINT32_MAX;

/// The elements of a mesh that have a value of an attribute each.
enum class AttributeDomain : uint8_t { kVertex = 0, kCorner = 1, kPolygon = 2 };

enum class BasisKind : uint8_t { kKeyframes = 0, kEigenshapes = 1, kEigentrajectories = 2 };

/// The numbers of a component of each kind: a vector at each vertex with one weight in a frame, or a number with three.
struct BasisTraits {
  uint32_t channels;         ///< numbers at a vertex
  uint32_t weight_channels;  ///< in a frame
};

inline constexpr BasisTraits kBasisTraits[] = {{3, 1}, {3, 1}, {1, 3}};

constexpr const BasisTraits& traits_of(BasisKind kind) {
  return kBasisTraits[static_cast<uint8_t>(kind)];
}

/// How a frame is made from key-frames: on straight lines, or by multi-scale geometry
/// interpolation.
enum class Reconstruction : uint8_t { kLinear = 0, kMsgi = 1 };

/// Chunk LIMI: all that a host needs to know how much memory opening and playing will take.
struct Limits {
  struct Mesh {
    uint32_t source_vertices = 0;   ///< what the user gets back
    uint32_t coded_vertices = 0;    ///< distinct trajectories
    uint32_t triangles = 0;         ///< of the coded faces
    uint32_t polygons = 0;          ///< what the user gets back
    uint32_t corners = 0;           ///< of those polygons
    uint32_t attributes = 0;        ///< 0: no chunk ATTR
    uint32_t attribute_labels = 0;  ///< of all attributes of polygons together
    uint32_t attribute_head = 0;  ///< bytes of ATTR that describe the attributes, before the values
    /// Values, labels or shared values of all elements of all attributes.
    uint64_t attribute_numbers = 0;

    uint32_t elements(AttributeDomain domain) const {
      return domain == AttributeDomain::kCorner    ? corners
             : domain == AttributeDomain::kPolygon ? polygons
                                                   : source_vertices;
    }

    bool operator==(const Mesh& other) const;
  };

  struct Segment {
    uint16_t mesh = 0;
    BasisKind kind = BasisKind::kKeyframes;
    uint32_t first_frame = 0;
    uint32_t frames = 0;
    uint32_t components = 0;
    uint32_t wide_components = 0;  ///< of those, resident as 32-bit integers; the others as 16-bit
    uint32_t regions = 1;          ///< of the surface, each with time weights of its own
    uint32_t corrections = 0;      ///< of vertices, copies included, over all frames
    uint32_t draco_points = 0;     ///< key-frames by Draco: vertices, non-manifold ones split
    uint32_t draco_bytes = 0;      ///< of the Draco bitstream; 0: the key-frames are native
    Reconstruction reconstruction = Reconstruction::kLinear;
    bool exact = false;  ///< the positions of its frames are there bit for bit (ExactRecord)
    /// Its models are kept for a segment that continues it (SegmentRecord::continued).
    bool learns = false;
    /// The quantity that it moves: positions, or three components of an attribute, in number from
    /// first_component on, a multiple of three.
    uint32_t attribute = kPositions;
    uint32_t first_component = 0;
    AttributeDomain domain = AttributeDomain::kVertex;  ///< of the attribute
    uint32_t entries = 0;  ///< of the attribute: distinct ones among its elements

    /// Whether two segments move the same: then they share no frame.
    bool same_track(const Segment& other) const {
      return mesh == other.mesh && attribute == other.attribute &&
             first_component == other.first_component;
    }

    /// The counts of what it is coded over: those of the mesh, or of an attribute's elements, entries and links.
    Mesh coded_over(const Mesh& whole) const {
      if (attribute == kPositions)
        return whole;
      Mesh of_attribute;
      of_attribute.source_vertices = whole.elements(domain);
      of_attribute.coded_vertices = entries;
      of_attribute.triangles = whole.corners;
      return of_attribute;
    }
  };

  uint32_t frames = 0;           ///< of all clips, one after the other
  Vector<uint32_t> clip_frames;  ///< of each clip; empty before it is written: one clip
  Vector<Mesh> meshes;
  Vector<Segment> segments;
  uint32_t root_frames = 0;  ///< of the clips whose motion as a whole is apart (RootRecord)
  /// mesh_hash() of the file that a continuation follows.
  std::optional<uint64_t> continued_meshes;

  /// The frames first .. first + count - 1, cut where a clip ends: how many frames each piece has.
  Vector<uint32_t> runs(uint32_t first, uint32_t count) const;

  /// The features that a file of such segments needs, as bits of the header (spec/13-extending.md).
  uint64_t features() const;

  /// Numbers of the segments of each mesh, or of each attribute of it, ascending by first frame.
  /// The meshes come first, then the attributes, both ascending. O(segments log segments).
  Vector<uint32_t> segments_by_frame() const;

  Bytes write() const;
  /// Checks that no two segments of the same track share a frame, too.
  static Status read(ByteView view, Limits* out);
};

enum class ErrorMetric : uint8_t {
  kNone = 0,
  kKg = 1,
  kMaxError = 2,
  kRmse = 3,
  kSize = 4,
  kBpfv = 5,
  kDisplacement = 6,  ///< the largest error of a move from frame to frame
  kSted = 7
};
enum class OrderMode : uint8_t { kVertices = 0, kFree = 1, kAll = 2 };

/// Errors that the encoder measured for an attribute that moves, in units of its values.
struct AttributeError {
  uint16_t mesh = 0;
  uint16_t attribute = 0;
  double max_error = 0;  ///< of a single number
  double rmse = 0;
};

/// A named time of a clip.
struct ClipEvent {
  String name;
  double seconds = 0;  ///< from the clip's first frame on, 0 or more
};

/// A clip: some frames that follow one another, their clock, and what the encoder promises of them.
struct ClipRecord {
  String name;
  uint32_t first_frame = 0;  ///< of the file; told by the limits, as is their number
  uint32_t frames = 0;
  uint32_t rate_numerator = 24;  ///< frames per second
  uint32_t rate_denominator = 1;
  bool rate_assumed = true;
  bool loop = false;
  bool closed = false;  ///< the last frame repeats the first
  bool massaged = false;
  double start_time = 0;  ///< seconds
  Vector<double> times;   ///< seconds from start_time, one per frame; empty when even

  ErrorMetric asked = ErrorMetric::kNone;
  double asked_value = 0;             ///< KG in per cent, lengths in scene units
  double max_error = 0;               ///< measured, scene units
  double rmse = 0;                    ///< measured, scene units
  double kg = 0;                      ///< measured, per cent
  double max_displacement_error = 0;  ///< measured, of a move from frame to frame, scene units
  double diagonal = 0;                ///< of the box around all frames
  double surface_error = 0;           ///< when massaged: how far the surface moved at most
  double surface_error_mean = 0;      ///< and on average
  Vector<AttributeError> attribute_errors;  ///< ascending by mesh and attribute
  Vector<ClipEvent> events;                 ///< ascending by time
};

/// Chunk CLIP: what holds for the whole file, and its clips.
struct ClipsRecord {
  String encoder;  ///< name and version of the encoder
  uint8_t up = 0;  ///< 0 unknown, 1 y, 2 z
  OrderMode order = OrderMode::kVertices;
  double metres_per_unit = 0;                        ///< 0 unknown
  double origin[3] = {0, 0, 0};                      ///< to be added to all positions
  Vector<ClipRecord> clips = Vector<ClipRecord>(1);  ///< in the order of their frames, at least one

  /// Number of the first clip of a name; clips.size() if there is none.
  size_t find(const char* name) const;

  bool has_origin() const { return origin[0] != 0 || origin[1] != 0 || origin[2] != 0; }

  bool same_origin(const ClipsRecord& other) const {
    return origin[0] == other.origin[0] && origin[1] == other.origin[1] &&
           origin[2] == other.origin[2];
  }

  /// Makes the clips follow one another from frame 0 on, by how many frames each has.
  void place();

  Bytes write() const;
  /// Reads as many clips as the limits announce.
  static Status read(ByteView view, const Limits& limits, ClipsRecord* out);
};

/// Chunk MESH: connectivity and what restores the source's vertices and polygons.
struct MeshRecord {
  String name;
  ByteView faces;  ///< polygons over vertices: entropy-coded

  Bytes write() const;
  static Status read(ByteView view, MeshRecord* out);
};

/// Chunk POSE: a reference pose on its grid. That of a mesh serves all its segments of eigenshapes
/// and eigentrajectories; one that names a segment serves that one.
struct PoseRecord {
  double origin[3] = {0, 0, 0};
  double step = 1;
  ByteView stream;

  Bytes write() const;
  static Status read(ByteView view, PoseRecord* out);
};

/// Chunk SEGM: one range of frames of one mesh.
struct SegmentRecord {
  uint64_t hash = 0;       ///< IntegerHash of the segment's decoded integers
  ByteView parameters;     ///< of the kind
  ByteView pose;           ///< key-frames
  ByteView motion;         ///< rigid motion, empty when there is none
  ByteView weights;        ///< time weights
  uint64_t continued = 0;  ///< segment_identity() of the one that this continues; 0: it begins anew

  Bytes write() const;
  static Status read(ByteView view, SegmentRecord* out);
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_RECORDS_H_
