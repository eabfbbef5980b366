// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_OBJ_H_
#define ANICODEC_TOOLS_IO_FORMATS_OBJ_H_

#include "codec/sequence/frame_normals.h"
#include "tools/io/base/mesh.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

class AtomicFile;
struct FileFormat;
struct OutputClip;

/// Reads Wavefront OBJ: vertices and polygons, in the file's order and number. Faces may be v, v/t,
/// v//n or v/t/n with positive or negative indices and may precede their vertices. `details`, where
/// given, receives texture coordinates and normals of corners, colours of vertices, and the
/// materials (usemtl) and objects (o) of polygons; a corner without texture coordinates in a mesh
/// that has some gets 0 0. All other statements of the format are skipped by name. Throws
/// Error(kInput) "name:line: reason" for anything else. `libraries`, where given, receives the names of
/// the libraries of materials (mtllib), for parse_mtl().
void parse_obj(std::string_view text, std::string_view name, Mesh& mesh,
               MeshDetails* details = nullptr, std::vector<std::string>* libraries = nullptr);

/// The parts that the OBJ files of a clip's frames have in common, prepared once: texture coordinates,
/// colours, materials, objects, and which corners share a normal.
class ObjDetails {
 public:
  /// `clip` must outlive it. `group_faces`: they are written object by object and in each material by
  /// material, so that no program makes two objects of one; else in their order.
  explicit ObjDetails(const MeshSequence& clip, bool group_faces = false);

  /// Files written from now on name this library of materials.
  void set_library(const std::string& file);

  /// Takes texture coordinates and colours of a frame of its own.
  void set_attributes(const std::vector<Attribute>& attributes);

 private:
  friend void append_obj(const Polygons&, std::span<const float>, std::string&, const ObjDetails*,
                         const Point&);

  struct Names {
    std::vector<std::string> lines;    ///< "usemtl NAME"
    std::string none;                  ///< "usemtl (null)"
    std::vector<uint32_t> of_polygon;  ///< or kNoLabel
  };

  static Names names(const char* keyword, const PolygonLabels& labels);

  void group_polygons();

  const MeshSequence& clip_;
  std::vector<uint32_t> order_;          ///< in which polygons are written
  std::string library_;                  ///< line of mtllib, or empty
  std::string texture_coordinates_;      ///< lines of vt
  std::vector<uint32_t> uv_;             ///< of each corner, or empty
  std::vector<float> colours_;           ///< vertices x 3, or empty
  std::optional<FrameNormals> normals_;  ///< of clips that know their hard edges
  Names objects_, materials_;
};

/// Appends an OBJ of one frame, its positions from a local origin; coordinates read back to the same floats. Normals
/// are those of the frame.
void append_obj(const Polygons& polygons, std::span<const float> positions, std::string& out,
                const ObjDetails* details = nullptr, const Point& origin = {});

/// Writes the library of materials whose looks are known beside an OBJ, which then names it.
void add_library(const std::string& mesh, const OutputClip& output, ObjDetails& details,
                 std::vector<AtomicFile>& files);

extern const FileFormat kObj;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_OBJ_H_
