// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/vertex_cache.h"

#include "tools/io/base/byte_order.h"
#include "tools/io/base/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace anicodec::tools {
namespace {

constexpr std::string_view kPc2Magic("POINTCACHE2\0", 12);
constexpr size_t kPc2HeaderSize = 32;
constexpr size_t kMddHeaderSize = 8;

void set_counts(uint32_t vertices, uint32_t frames, const std::string& name, VertexCache& cache) {
  if (vertices == 0 || frames == 0)
    fail_input(name, "the cache is empty: " + std::to_string(vertices) + " vertices, " +
                         std::to_string(frames) + " frames");
  if (vertices > kMaxVertices || frames > kMaxFrames)
    fail_input(name, "impossible counts: " + std::to_string(vertices) + " vertices, " +
                         std::to_string(frames) + " frames");
  cache.vertex_count = vertices;
  cache.frame_count = frames;
}

void check_file_size(const VertexCache& cache, const ByteSource& source) {
  uint64_t expected =
      cache.data_offset + uint64_t{cache.vertex_count} * cache.frame_count * 3 * sizeof(float);
  if (source.size != expected)
    fail_input(source.name, (source.size < expected ? "truncated: " : "trailing bytes: ") +
                                std::to_string(cache.vertex_count) + " vertices x " +
                                std::to_string(cache.frame_count) + " frames take " +
                                std::to_string(expected) + " bytes, but the file has " +
                                std::to_string(source.size));
}

void check_header_size(const ByteSource& source, size_t size, const char* format) {
  if (source.size < size)
    fail_input(source.name, "truncated: the header of " + std::string(format) + " has " +
                                std::to_string(size) + " bytes, the file has " +
                                std::to_string(source.size));
}

}  // namespace

VertexCache open_pc2(const ByteSource& source) {
  check_header_size(source, kPc2HeaderSize, "a PC2");
  std::array<char, kPc2HeaderSize> header;
  source.read(0, header);
  if (!std::equal(kPc2Magic.begin(), kPc2Magic.end(), header.begin()))
    fail_input(source.name, "is not a PC2: it does not begin with POINTCACHE2");
  auto number = [&](size_t offset) {
    return load<uint32_t>(header.data() + offset, std::endian::little);
  };
  if (number(12) != 1)
    fail_input(source.name, "version " + std::to_string(number(12)) + " of PC2 is not known");
  VertexCache cache;
  cache.data_offset = kPc2HeaderSize;
  set_counts(number(16), number(28), source.name, cache);
  cache.first_frame = load<float>(header.data() + 20, std::endian::little);
  cache.frames_per_sample = load<float>(header.data() + 24, std::endian::little);
  check_file_size(cache, source);
  return cache;
}

VertexCache open_mdd(const ByteSource& source) {
  check_header_size(source, kMddHeaderSize, "an MDD");
  std::array<char, kMddHeaderSize> header;
  source.read(0, header);
  VertexCache cache;
  cache.order = std::endian::big;
  set_counts(load<uint32_t>(header.data() + 4, cache.order),
             load<uint32_t>(header.data(), cache.order), source.name, cache);
  cache.data_offset = kMddHeaderSize + uint64_t{cache.frame_count} * sizeof(float);
  check_file_size(cache, source);
  std::vector<char> times(cache.frame_count * sizeof(float));
  source.read(kMddHeaderSize, times);
  for (size_t f = 0; f < cache.frame_count; ++f)
    cache.times.push_back(load<float>(times.data() + f * sizeof(float), cache.order));
  return cache;
}

void read_positions(const VertexCache& cache, const ByteSource& source, std::span<float> positions,
                    const Progress& progress) {
  constexpr size_t kPiece = size_t{1} << 18;
  size_t per_frame = size_t{cache.vertex_count} * 3;
  for (size_t first = 0; first < positions.size(); first += kPiece) {
    std::span<float> piece = positions.subspan(first, std::min(kPiece, positions.size() - first));
    char* bytes = reinterpret_cast<char*>(piece.data());
    source.read(cache.data_offset + first * sizeof(float), {bytes, piece.size_bytes()});
    for (size_t i = 0; i < piece.size(); ++i) {
      if (cache.order != std::endian::native)
        piece[i] = load<float>(bytes + i * sizeof(float), cache.order);
      if (!std::isfinite(piece[i]))
        fail_input(source.name, "frame " + std::to_string((first + i) / per_frame) + ", vertex " +
                                    std::to_string((first + i) % per_frame / 3) +
                                    ": the position is not finite");
    }
    if (progress)
      progress("reading",
               static_cast<double>(first + piece.size()) / static_cast<double>(positions.size()));
  }
}

void append_pc2_header(uint32_t vertex_count, uint32_t frame_count, std::string& out) {
  out += kPc2Magic;
  append(uint32_t{1}, std::endian::little, out);
  append(vertex_count, std::endian::little, out);
  append(0.0F, std::endian::little, out);
  append(1.0F, std::endian::little, out);
  append(frame_count, std::endian::little, out);
}

void append_mdd_header(uint32_t vertex_count, std::span<const float> times, std::string& out) {
  append(static_cast<uint32_t>(times.size()), std::endian::big, out);
  append(vertex_count, std::endian::big, out);
  for (float t : times)
    append(t, std::endian::big, out);
}

}  // namespace anicodec::tools
