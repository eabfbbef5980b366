// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Vertex-animation textures: what goes in, what comes out, and how far it is off.
#ifndef ANICODEC_TOOLS_TEXTURES_VAT_H_
#define ANICODEC_TOOLS_TEXTURES_VAT_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/progress.h"
#include "tools/textures/data_texture.h"
#include "tools/textures/texel_mesh.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Frames that are played by a name.
struct VatClip {
  std::string name;
  uint32_t first_frame = 0,
           frame_count = 0;  ///< of a loop whose last frame repeats the first, without it
  double rate = 24;          ///< frames a second
  bool loop = false;
};

/// A clip as textures get it. `frames` gives the positions of the clip's vertices, y up, in metres, each as often as asked.
struct VatSource {
  std::string name;  ///< of the files
  const TexelMesh& mesh;
  FrameSource frames;
  uint32_t frame_count = 0;
  std::vector<VatClip> clips;  ///< one at least
};

struct VatOptions {
  bool png = false;  ///< 16-bit PNG in place of EXR
  bool normals = true;
  uint32_t max_size = 8192;  ///< of a side
  Progress progress = {};
};

/// Distances of positions, in metres, and angles of normals, in degrees: the largest, and root mean squares over all
/// vertices and frames.
class VatError {
 public:
  /// Three numbers a vertex; normals are unit vectors. No normals: they count nothing.
  void add(std::span<const float> positions, std::span<const double> shown_positions,
           std::span<const float> normals, std::span<const double> shown_normals);

  double largest() const { return largest_; }

  double rmse() const;

  double largest_angle() const { return largest_angle_; }

  double rms_angle() const;

  bool has_normals() const { return normals_ > 0; }

 private:
  double largest_ = 0, squares_ = 0, largest_angle_ = 0, squared_angles_ = 0;
  uint64_t positions_ = 0, normals_ = 0;
};

struct VatFile {
  std::string name;
  std::string bytes;
  uint32_t width = 0, height = 0;  ///< of a texture
  uint64_t memory = 0;             ///< bytes that it takes on a graphics card
};

/// Files to be written to one folder, and the error of what they show.
struct VatResult {
  std::vector<VatFile> files;
  VatError error;
  std::vector<std::string> left_out;  ///< what was asked for and is not so

  /// Writes a texture to a file and gives back what the file holds.
  DataTexture add_texture(const std::string& name, const DataTexture& texture, TexelKind kind);
};

/// Rows of texels, one a vertex.
struct TexelGrid {
  uint32_t width = 0, rows = 0;

  TexelGrid() = default;

  /// Fewest rows of at most `widest` texels, evenly filled.
  TexelGrid(uint32_t vertices, uint32_t widest)
      : rows(vertices == 0 ? 1 : (vertices - 1) / widest + 1) {
    width = vertices == 0 ? 1 : (vertices - 1) / rows + 1;
  }

  uint32_t x(uint32_t v) const { return v % width; }

  uint32_t y(uint32_t v) const { return v / width; }

  /// Middles of the vertices' texels in a texture of so many rows; `step`: rows from one row of the grid to the next.
  std::vector<TexelPlace> places(uint32_t vertices, uint64_t step, uint64_t height) const;
};

/// Throws Error(kInput) where rows would pass the limit.
void check_rows(const VatSource& source, uint64_t rows, const VatOptions& options);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_TEXTURES_VAT_H_
