// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/peers/frame_deltas.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

#include <meshoptimizer.h>
#include <zstd.h>

namespace anicodec::peers {
namespace {

using Buffer = std::vector<unsigned char>;

constexpr int kSelectLevel = 3;
constexpr int kLevel = 19;

/// Triangles in an order that meshoptimizer codes well, and the vertices in their order of use.
struct Order {
  std::vector<uint32_t> triangles;  ///< over places
  std::vector<uint32_t> vertices;   ///< the vertex at each place
};

Order order_of(std::span<const uint32_t> triangles, uint32_t vertex_count, bool by_use) {
  Order order;
  order.triangles.resize(triangles.size());
  order.vertices.resize(vertex_count);
  std::iota(order.vertices.begin(), order.vertices.end(), 0);
  if (triangles.empty())
    return order;
  meshopt_optimizeVertexCache(order.triangles.data(), triangles.data(), triangles.size(),
                              vertex_count);
  if (!by_use)
    return order;
  std::vector<uint32_t> place(vertex_count);
  size_t used = meshopt_optimizeVertexFetchRemap(place.data(), order.triangles.data(),
                                                 order.triangles.size(), vertex_count);
  for (uint32_t v = 0; v < vertex_count; ++v) {
    if (place[v] == ~0U)
      place[v] = static_cast<uint32_t>(used++);
    order.vertices[place[v]] = v;
  }
  for (uint32_t& v : order.triangles)
    v = place[v];
  return order;
}

/// `Value` is unsigned; a vertex is padded to a multiple of four bytes.
template <class Value>
void append_frames(const GriddedClip& clip, const Order& order, bool folded, Buffer& out) {
  constexpr size_t kWidth = sizeof(Value) == 2 ? 4 : 3;
  constexpr int kBits = 8 * sizeof(Value);
  size_t count = order.vertices.size(), frame_width = 3 * count;
  std::vector<Value> before(frame_width, 0), deltas(kWidth * count, 0);
  Buffer buffer(meshopt_encodeVertexBufferBound(count, kWidth * sizeof(Value)));
  constexpr int kLevelOfMeshopt = 3, kVersion = 1;  // the smallest; that of KHR_meshopt_compression
  for (size_t begin = 0; begin < clip.values.size(); begin += frame_width) {
    for (size_t i = 0; i < count; ++i) {
      for (size_t c = 0; c < 3; ++c) {
        auto value = static_cast<Value>(clip.values[begin + size_t{3} * order.vertices[i] + c]);
        auto delta = static_cast<Value>(value - before[3 * i + c]);
        auto sign =
            static_cast<Value>(delta >> (kBits - 1) ? std::numeric_limits<Value>::max() : 0);
        deltas[kWidth * i + c] = folded ? static_cast<Value>(Value(delta << 1) ^ sign) : delta;
        before[3 * i + c] = value;
      }
    }
    size_t size =
        meshopt_encodeVertexBufferLevel(buffer.data(), buffer.size(), deltas.data(), count,
                                        kWidth * sizeof(Value), kLevelOfMeshopt, kVersion);
    out.insert(out.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
  }
}

Buffer encode(const GriddedClip& clip, const Order& order, bool folded) {
  Buffer out(meshopt_encodeIndexBufferBound(order.triangles.size(), order.vertices.size()));
  out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), order.triangles.data(),
                                       order.triangles.size()));
  if (clip.largest <= std::numeric_limits<uint16_t>::max())
    append_frames<uint16_t>(clip, order, folded, out);
  else
    append_frames<uint32_t>(clip, order, folded, out);
  return out;
}

uint64_t zstd_size(const Buffer& data, int level) {
  Buffer out(ZSTD_compressBound(data.size()));
  size_t size = ZSTD_compress(out.data(), out.size(), data.data(), data.size(), level);
  if (ZSTD_isError(size))
    throw Error(ErrorKind::kInternal, ZSTD_getErrorName(size));
  return size;
}

}  // namespace

FrameDeltaSize frame_delta_size(const GriddedClip& clip, uint32_t vertex_count,
                                std::span<const uint32_t> triangles) {
  Buffer smallest;
  uint64_t smallest_size = std::numeric_limits<uint64_t>::max();
  FrameDeltaSize result;
  for (bool by_use : {false, true}) {
    Order order = order_of(triangles, vertex_count, by_use);
    for (bool folded : {false, true}) {
      Buffer data = encode(clip, order, folded);
      if (uint64_t size = zstd_size(data, kSelectLevel); size < smallest_size) {
        smallest_size = size;
        smallest = std::move(data);
        result.variant = std::string(by_use ? "by use" : "as given") + (folded ? ", folded" : "");
      }
    }
  }
  result.bytes = zstd_size(smallest, kLevel);
  return result;
}

}  // namespace anicodec::peers
