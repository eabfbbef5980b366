// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/vat.h"

#include "codec/sequence/error.h"
#include "tools/words/quantity.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace anicodec::tools {

void VatError::add(std::span<const float> positions, std::span<const double> shown_positions,
                   std::span<const float> normals, std::span<const double> shown_normals) {
  for (size_t i = 0; i < positions.size(); i += 3) {
    double square = 0;
    for (size_t c = i; c < i + 3; ++c)
      square += std::pow(shown_positions[c] - double{positions[c]}, 2);
    squares_ += square;
    largest_ = std::max(largest_, std::sqrt(square));
  }
  positions_ += positions.size() / 3;
  for (size_t i = 0; i < normals.size(); i += 3) {
    double dot = 0, cross = 0;
    for (size_t c = 0; c < 3; ++c) {
      const size_t j = i + (c + 1) % 3, k = i + (c + 2) % 3;
      dot += double{normals[i + c]} * shown_normals[i + c];
      cross += std::pow(
          double{normals[j]} * shown_normals[k] - double{normals[k]} * shown_normals[j], 2);
    }
    const double angle = std::atan2(std::sqrt(cross), dot) * 180 / std::numbers::pi;
    squared_angles_ += angle * angle;
    largest_angle_ = std::max(largest_angle_, angle);
  }
  normals_ += normals.size() / 3;
}

double VatError::rmse() const {
  return positions_ == 0 ? 0 : std::sqrt(squares_ / static_cast<double>(positions_));
}

double VatError::rms_angle() const {
  return normals_ == 0 ? 0 : std::sqrt(squared_angles_ / static_cast<double>(normals_));
}

DataTexture VatResult::add_texture(const std::string& name, const DataTexture& texture,
                                   TexelKind kind) {
  files.push_back({name + (kind == TexelKind::kPng16 ? ".png" : ".exr"),
                   texture_bytes(texture, kind), texture.width, texture.height,
                   uint64_t{8} * texture.width * texture.height});
  return read_texture(files.back().bytes, kind);
}

std::vector<TexelPlace> TexelGrid::places(uint32_t vertices, uint64_t step, uint64_t height) const {
  std::vector<TexelPlace> all;
  for (uint32_t v = 0; v < vertices; ++v)
    all.emplace_back((x(v) + 0.5) / width,
                     (static_cast<double>(y(v) * step) + 0.5) / static_cast<double>(height));
  return all;
}

void check_rows(const VatSource& source, uint64_t rows, const VatOptions& options) {
  if (rows > options.max_size)
    throw Error(
        ErrorKind::kInput,
        fmt::format("{}: {} vertices in {} would take a texture of {} rows, and {} are the most; "
                    "--frames takes some or every other one, --form basis takes fewer texels",
                    source.name, grouped(source.mesh.vertex_count()),
                    counted(source.frame_count, "frame"), grouped(rows),
                    grouped(options.max_size)));
}

}  // namespace anicodec::tools
