// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/md3.h"

#include "tools/io/base/byte_order.h"
#include "tools/io/base/file_format.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"
#include "tools/io/files/byte_source.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace anicodec::tools {
namespace {

constexpr uint32_t kMd3Version = 15;
constexpr size_t kMd3NameSize = 64, kMd3HeaderSize = 108, kFrameSize = 56, kTagSize = 112,
                 kShaderSize = 68, kMd3VertexSize = 8;
constexpr double kUnitsOfPosition = 64;

/// Numbers of a file or of a surface in it.
class Md3Part {
 public:
  Md3Part(std::string_view bytes, const std::string& place) : bytes_(bytes), place_(place) {}

  const std::string& place() const { return place_; }

  template <typename T>
  T number(size_t offset) const {
    return load<T>(bytes(offset, 1, sizeof(T)).data(), std::endian::little);
  }

  /// `count` things of a size, checked to be there.
  std::string_view bytes(uint64_t offset, uint64_t count, uint64_t size) const {
    if (offset > bytes_.size() || count > (bytes_.size() - offset) / size)
      fail_input(place_, "truncated: " + std::to_string(count) + " x " + std::to_string(size) +
                             " bytes at offset " + std::to_string(offset) + " of " +
                             std::to_string(bytes_.size()));
    return bytes_.substr(offset, count * size);
  }

  std::string text(size_t offset) const {
    const std::string_view text = bytes(offset, 1, kMd3NameSize);
    return std::string(text.substr(0, text.find('\0')));
  }

 private:
  std::string_view bytes_;
  const std::string& place_;
};

struct Md3Surface {
  std::string place;
  std::string_view bytes;
  uint32_t vertices = 0;
};

void check_magic(const Md3Part& part, uint32_t version_at) {
  if (part.bytes(0, 1, 4) != "IDP3")
    fail_input(part.place(), "does not begin with IDP3");
  if (version_at > 0 && part.number<uint32_t>(version_at) != kMd3Version)
    fail_input(part.place(), "version " + std::to_string(part.number<uint32_t>(version_at)) +
                                 " of MD3 is not known");
}

/// A normal of two angles, 255 a turn.
void append_normal(uint16_t code, FrameArray& out) {
  const double turn = 2 * std::numbers::pi / 255;
  const double azimuth = (code >> 8) * turn, polar = (code & 255) * turn;
  for (const double x :
       {std::cos(azimuth) * std::sin(polar), std::sin(azimuth) * std::sin(polar), std::cos(polar)})
    out.push_back(static_cast<float>(x));
}

/// Faces, texture coordinates and the normals of the first frame.
void add_surface(const Md3Surface& surface, MeshSequence& out, Attribute& uv, Attribute& normals) {
  const Md3Part part(surface.bytes, surface.place);
  const auto triangles = part.number<uint32_t>(84);
  const Md3Part corners(part.bytes(part.number<uint32_t>(88), triangles, 12), surface.place);
  const auto label = static_cast<uint32_t>(out.parts.names.size());
  out.parts.names.push_back(part.text(4));
  const bool has_shader = part.number<uint32_t>(76) > 0;
  if (has_shader)
    out.materials.names.push_back(
        Md3Part(part.bytes(part.number<uint32_t>(92), 1, kShaderSize), surface.place).text(0));
  const auto material =
      has_shader ? static_cast<uint32_t>(out.materials.names.size() - 1) : kNoLabel;
  for (uint32_t t = 0; t < triangles; ++t) {
    std::vector<uint32_t> triangle;
    for (const size_t k : {0U, 2U, 1U}) {
      const auto v = corners.number<uint32_t>(12 * size_t{t} + 4 * k);
      if (v >= surface.vertices)
        fail_input(surface.place, "triangle " + std::to_string(t) + " uses vertex " +
                                      std::to_string(v) + " of " +
                                      std::to_string(surface.vertices));
      triangle.push_back(out.vertex_count + v);
    }
    out.polygons.add(triangle);
    out.parts.of_polygon.push_back(label);
    out.materials.of_polygon.push_back(material);
  }
  const Md3Part st(part.bytes(part.number<uint32_t>(96), surface.vertices, 8), surface.place);
  const Md3Part positions(part.bytes(part.number<uint32_t>(100), surface.vertices, kMd3VertexSize),
                          surface.place);
  for (size_t v = 0; v < surface.vertices; ++v) {
    const auto s = st.number<float>(8 * v), t = st.number<float>(8 * v + 4);
    if (!std::isfinite(s) || !std::isfinite(t))
      fail_input(surface.place,
                 "the texture coordinates of vertex " + std::to_string(v) + " are not finite");
    uv.values.push_back(s);
    uv.values.push_back(1 - t);
    append_normal(positions.number<uint16_t>(kMd3VertexSize * v + 6), normals.values);
  }
  out.vertex_count += surface.vertices;
}

void add_positions(const Md3Surface& surface, uint32_t frame, FrameArray& out) {
  const Md3Part part(surface.bytes, surface.place);
  const uint64_t size = uint64_t{kMd3VertexSize} * surface.vertices;
  const Md3Part positions(
      part.bytes(part.number<uint32_t>(100) + frame * size, surface.vertices, kMd3VertexSize),
      surface.place);
  for (size_t v = 0; v < surface.vertices; ++v) {
    for (size_t k = 0; k < 3; ++k)
      out.push_back(static_cast<float>(positions.number<int16_t>(kMd3VertexSize * v + 2 * k) /
                                       kUnitsOfPosition));
  }
}

}  // namespace

MeshSequence parse_md3(std::string_view bytes, const std::string& name,
                       const std::function<void(const std::string& text)>& note) {
  const Md3Part file(bytes, name);
  check_magic(file, 4);
  MeshSequence out;
  out.frame_count = file.number<uint32_t>(76);
  const auto tags = file.number<uint32_t>(80), surfaces = file.number<uint32_t>(84);
  if (out.frame_count == 0 || out.frame_count > kMaxFrames)
    fail_input(name, "has " + std::to_string(out.frame_count) + " frames");
  file.bytes(file.number<uint32_t>(92), out.frame_count, kFrameSize);
  file.bytes(file.number<uint32_t>(96), uint64_t{tags} * out.frame_count, kTagSize);
  std::vector<Md3Surface> found;
  uint64_t at = file.number<uint32_t>(100), vertices = 0;
  for (uint32_t s = 0; s < surfaces; ++s) {
    Md3Surface surface{.place = name + ": surface " + std::to_string(s), .bytes = {}};
    const Md3Part rest(at <= bytes.size() ? bytes.substr(at) : std::string_view(), surface.place);
    rest.bytes(0, 1, kMd3HeaderSize);
    check_magic(rest, 0);
    const auto size = rest.number<uint32_t>(104);
    if (size < kMd3HeaderSize)
      fail_input(surface.place, "has " + std::to_string(size) + " bytes");
    surface.bytes = rest.bytes(0, 1, size);
    surface.vertices = rest.number<uint32_t>(80);
    if (rest.number<uint32_t>(72) != out.frame_count)
      fail_input(surface.place, "has " + std::to_string(rest.number<uint32_t>(72)) +
                                    " frames, but the file " + std::to_string(out.frame_count));
    rest.bytes(rest.number<uint32_t>(100), uint64_t{surface.vertices} * out.frame_count,
               kMd3VertexSize);
    vertices += surface.vertices;
    at += size;
    found.push_back(std::move(surface));
  }
  if (vertices == 0)
    fail_input(name, "has no vertex");
  if (vertices > kMaxVertices)
    fail_input(name, "more than 2^31 - 1 vertices");
  Attribute uv{.kind = AttributeKind::kUv, .name = "uv", .components = 2, .values = {}};
  Attribute normals{
      .kind = AttributeKind::kNormal, .name = "normal", .components = 3, .values = {}};
  for (const Md3Surface& surface : found)
    add_surface(surface, out, uv, normals);
  if (out.materials.names.empty())
    out.materials.of_polygon.clear();
  out.attributes = {std::move(uv), std::move(normals)};
  out.positions.reserve(size_t{3} * out.vertex_count * out.frame_count);
  for (uint32_t f = 0; f < out.frame_count; ++f) {
    for (const Md3Surface& surface : found)
      add_positions(surface, f, out.positions);
  }
  if (note && tags > 0)
    note(name + ": left out: " + std::to_string(tags) + (tags == 1 ? " tag" : " tags") +
         ", at which other models are held");
  out.rate = {10, 1, true};
  out.up = UpAxis::kZ;
  return out;
}

const FileFormat kMd3 = {.name = "MD3",
                         .extensions = ".md3",
                         .role = FileRole::kArchive,
                         .read_clip = [](const InputFile& file, const LoadOptions& options) {
                           if (!options.mesh.empty())
                             fail_usage("--mesh " + options.mesh,
                                        "of an MD3 all surfaces are read");
                           std::string bytes;
                           read_file(file.name, bytes);
                           MeshSequence sequence = parse_md3(bytes, file.name, options.note);
                           move_origin(options, sequence.positions);
                           return sequence;
                         }};

}  // namespace anicodec::tools
