// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/glb_output.h"

#include "codec/error.h"
#include "codec/frame_normals.h"
#include "tools/io/byte_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr int kUint16 = 5123, kUint32 = 5125, kFloat = 5126;
constexpr int kPoints = 0, kTriangles = 4;

template <typename Number>
std::string bytes_of(std::span<const Number> numbers) {
  std::string out;
  out.reserve(numbers.size_bytes());
  for (Number x : numbers)
    append(x, std::endian::little, out);
  return out;
}

const char* type_name(size_t components) {
  constexpr const char* kNames[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kNames[components - 1];
}

/// Indices in the smallest type that has no value to spare as a restart.
struct PackedIndices {
  PackedIndices(std::span<const uint32_t> indices, uint32_t count)
      : type(count < UINT16_MAX ? kUint16 : kUint32) {
    if (type == kUint32) {
      bytes = bytes_of(indices);
      return;
    }
    const std::vector<uint16_t> small(indices.begin(), indices.end());
    bytes = bytes_of(std::span<const uint16_t>(small));
  }

  int type;
  std::string bytes;
};

/// Binary data with the views and accessors that describe them.
class Buffer {
 public:
  size_t add_indices(std::span<const uint32_t> indices, uint32_t vertices) {
    const PackedIndices packed(indices, vertices);
    const size_t view = add_view(packed.bytes, kIndexTarget);
    return add_accessor({{"bufferView", view},
                         {"componentType", packed.type},
                         {"count", indices.size()},
                         {"type", "SCALAR"}});
  }

  /// `target` says what the buffer view is for, 0: an animation.
  size_t add_floats(std::span<const float> values, size_t components, int target, bool bounds) {
    Json accessor = describe(values, components, bounds);
    accessor["bufferView"] = add_view(bytes_of(values), target);
    return add_accessor(std::move(accessor));
  }

  /// The same, elements of zeros left out where that is smaller.
  size_t add_differences(std::span<const float> values, size_t components) {
    std::vector<uint32_t> elements;
    for (uint32_t i = 0; i < values.size() / components; ++i) {
      auto element = values.subspan(i * components, components);
      if (std::any_of(element.begin(), element.end(), [](float x) { return x != 0; }))
        elements.push_back(i);
    }
    if (!is_sparse_smaller(elements.size(), values.size() / components, components))
      return add_floats(values, components, kVertexTarget, true);
    std::vector<float> kept;
    kept.reserve(elements.size() * components);
    for (uint32_t i : elements) {
      auto element = values.subspan(i * components, components);
      kept.insert(kept.end(), element.begin(), element.end());
    }
    return add_sparse(describe(values, components, true), elements, kept);
  }

  /// An accessor of zeros but for these elements, in ascending order.
  size_t add_sparse(Json accessor, std::span<const uint32_t> elements,
                    std::span<const float> values) {
    if (!elements.empty()) {
      const PackedIndices packed(elements, accessor["count"].get<uint32_t>());
      const size_t index_view = add_view(packed.bytes, 0);
      const size_t value_view = add_view(bytes_of(values), 0);
      accessor["sparse"] = {
          {"count", elements.size()},
          {"indices", {{"bufferView", index_view}, {"componentType", packed.type}}},
          {"values", {{"bufferView", value_view}}}};
    }
    return add_accessor(std::move(accessor));
  }

  static Json describe(std::span<const float> values, size_t components, bool bounds) {
    Json accessor{{"componentType", kFloat},
                  {"count", values.size() / components},
                  {"type", type_name(components)}};
    if (!bounds)
      return accessor;
    std::vector<float> low(components, std::numeric_limits<float>::infinity());
    std::vector<float> high(components, -std::numeric_limits<float>::infinity());
    for (size_t i = 0; i < values.size(); ++i) {
      low[i % components] = std::min(low[i % components], values[i]);
      high[i % components] = std::max(high[i % components], values[i]);
    }
    // As double, which prints all digits.
    accessor["min"] = std::vector<double>(low.begin(), low.end());
    accessor["max"] = std::vector<double>(high.begin(), high.end());
    return accessor;
  }

  const std::string& bytes() const { return bytes_; }

  void describe_in(Json& document) const {
    document["accessors"] = accessors_;
    document["bufferViews"] = views_;
    document["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  }

  /// Throws when a GLB of this and `more` bytes would be larger than can be.
  void check_size(uint64_t more) const {
    if (bytes_.size() + more > UINT32_MAX)
      throw Error(ErrorKind::kInput, "the GLB would be larger than the 4 GiB that are possible");
  }

 private:
  size_t add_view(std::string_view bytes, int target) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    check_size(bytes.size());
    Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
    if (target != 0)
      view["target"] = target;
    bytes_ += bytes;
    views_.push_back(std::move(view));
    return views_.size() - 1;
  }

  size_t add_accessor(Json accessor) {
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
  }

  static bool is_sparse_smaller(size_t elements, size_t count, size_t components) {
    constexpr size_t kDescription = 160;  // of the second view and the object, in JSON
    const size_t index = count < UINT16_MAX ? 2 : 4;
    const size_t sparse = elements == 0 ? 0 : elements * (index + 4 * components) + kDescription;
    return sparse < 4 * components * count;
  }

  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

/// The vertices of the GLB: those of the clip, where corners at one have different attributes or
/// normals more than once.
struct GlbVertices {
  explicit GlbVertices(const MeshSequence& clip) : of_corner(clip.polygons.corners.size()) {
    std::vector<std::span<const float>> of_corners;
    for (const Attribute& a : clip.attributes) {
      if (a.per_corner && is_written(a))
        of_corners.emplace_back(a.values);
    }
    source.resize(clip.vertex_count);
    std::iota(source.begin(), source.end(), 0U);
    corner.assign(clip.vertex_count, kNoCorner);
    std::vector<std::vector<uint32_t>> at(clip.vertex_count);  // copies of each vertex
    for (uint32_t c = 0; c < of_corner.size(); ++c) {
      const uint32_t v = clip.polygons.corners[c];
      auto same = [&](uint32_t copy) {
        const uint32_t d = corner[copy];
        if (!clip.shared_normals.empty() && clip.shared_normals[c] != clip.shared_normals[d])
          return false;
        return std::ranges::all_of(of_corners, [&](std::span<const float> values) {
          const size_t n = values.size() / of_corner.size();
          return std::ranges::equal(values.subspan(n * c, n), values.subspan(n * d, n));
        });
      };
      const auto found = std::ranges::find_if(at[v], same);
      if (found != at[v].end()) {
        of_corner[c] = *found;
        continue;
      }
      of_corner[c] = at[v].empty() ? v : static_cast<uint32_t>(source.size());
      if (!at[v].empty()) {
        source.push_back(v);
        corner.push_back(c);
      }
      corner[of_corner[c]] = c;
      at[v].push_back(of_corner[c]);
    }
  }

  static bool is_written(const Attribute& a) {
    return (a.kind == AttributeKind::kUv && a.components == 2) ||
           (a.kind == AttributeKind::kColour && (a.components == 3 || a.components == 4));
  }

  uint32_t count() const { return static_cast<uint32_t>(source.size()); }

  /// Values of the clip's vertices at those of the GLB.
  std::vector<float> of_vertices(std::span<const float> values, size_t components) const {
    std::vector<float> out;
    out.reserve(components * source.size());
    for (uint32_t v : source)
      out.insert(out.end(), values.begin() + static_cast<ptrdiff_t>(components * v),
                 values.begin() + static_cast<ptrdiff_t>(components * (v + size_t{1})));
    return out;
  }

  /// Values of corners at the vertices of the GLB; 0 where there is no corner.
  std::vector<float> of_corners(std::span<const float> values, size_t components) const {
    std::vector<float> out;
    out.reserve(components * source.size());
    for (uint32_t c : corner) {
      for (size_t i = 0; i < components; ++i)
        out.push_back(c == kNoCorner ? 0 : values[components * c + i]);
    }
    return out;
  }

  static constexpr uint32_t kNoCorner = UINT32_MAX;
  std::vector<uint32_t> source;     ///< vertex of the clip
  std::vector<uint32_t> corner;     ///< a corner of the clip, or kNoCorner
  std::vector<uint32_t> of_corner;  ///< vertex of the GLB at each corner of the clip
};

/// Corners of the triangles of each material, in order of their first polygon.
std::vector<std::pair<uint32_t, std::vector<uint32_t>>> triangles_of(const MeshSequence& clip,
                                                                     const GlbVertices& vertices) {
  std::vector<std::pair<uint32_t, std::vector<uint32_t>>> groups;
  std::map<uint32_t, size_t> group_of;
  const std::vector<uint32_t>& materials = clip.materials.of_polygon;
  for (size_t p = 0; p < clip.polygons.size(); ++p) {
    const uint32_t material = materials.empty() ? kNoLabel : materials[p];
    auto [found, is_new] = group_of.try_emplace(material, groups.size());
    if (is_new)
      groups.push_back({material, {}});
    std::vector<uint32_t>& corners = groups[found->second].second;
    const uint32_t* polygon = vertices.of_corner.data() + clip.polygons.offsets[p];
    for (size_t i = 2; i < clip.polygons[p].size(); ++i)
      corners.insert(corners.end(), {polygon[0], polygon[i - 1], polygon[i]});
  }
  return groups;
}

}  // namespace

class GlbOutput::Writer {
 public:
  Writer(const MeshSequence& clip, bool step) : clip_(clip), vertices_(clip), step_(step) {
    if (!clip.shared_normals.empty())
      normals_.emplace(clip);
    if (clip.frame_count > UINT16_MAX)
      throw Error(ErrorKind::kInput,
                  "a GLB of " + std::to_string(clip.frame_count) +
                      " frames; at most 65535 are possible, whose weights are a table of 2^32");
  }

  void add_frame(std::span<const float> of_clip, std::span<const Attribute> attributes) {
    std::vector<float> positions = vertices_.of_vertices(of_clip, 3);
    std::vector<float> normals = normals_of(of_clip);
    if (first_positions_.empty()) {
      attributes_["POSITION"] = buffer_.add_floats(positions, 3, kVertexTarget, true);
      if (!normals.empty())
        attributes_["NORMAL"] = buffer_.add_floats(normals, 3, kVertexTarget, false);
      for (WrittenValues& values : written(attributes)) {
        attributes_[values.name] =
            buffer_.add_floats(values.values, values.components, kVertexTarget, false);
        first_values_.push_back(std::move(values));
      }
      first_positions_ = positions;
      first_normals_ = normals;
      if (clip_.frame_count == 1)
        return;
    }
    Json target{{"POSITION", add_differences(std::move(positions), first_positions_)}};
    if (!normals.empty())
      target["NORMAL"] = add_differences(std::move(normals), first_normals_);
    std::vector<WrittenValues> values = written(attributes);
    for (size_t i = 0; i < values.size(); ++i) {
      WrittenValues& first = first_values_[i];
      if (values[i].values == first.values)
        continue;
      first.moves = true;
      target[first.name] =
          add_differences(std::move(values[i].values), first.values, first.components);
    }
    targets_.push_back(std::move(target));
  }

  std::string finish(std::span<const float> times) {
    complete_targets();
    Json document;
    document["asset"] = {{"version", "2.0"}, {"generator", "anicodec"}};
    document["scene"] = 0;
    document["scenes"] = Json::array({{{"nodes", {0}}}});
    document["nodes"] = Json::array({node()});
    document["meshes"] = Json::array({mesh()});
    if (!clip_.materials.of_polygon.empty()) {
      for (const std::string& name : clip_.materials.names)
        document["materials"].push_back({{"name", name}});
    }
    if (clip_.frame_count > 1)
      document["animations"] = Json::array({animation(times)});
    buffer_.describe_in(document);
    return packed(document);
  }

 private:
  /// An attribute at the vertices of the GLB, in one frame.
  struct WrittenValues {
    std::string name;
    size_t components = 0;
    std::vector<float> values;
    bool moves = false;
  };

  std::vector<WrittenValues> written(std::span<const Attribute> attributes) const {
    std::map<AttributeKind, int> sets;
    std::vector<WrittenValues> result;
    for (const Attribute& attribute : attributes) {
      if (!GlbVertices::is_written(attribute))
        continue;
      const size_t n = attribute.components;
      const std::string name = (attribute.kind == AttributeKind::kUv ? "TEXCOORD_" : "COLOR_") +
                               std::to_string(sets[attribute.kind]++);
      std::vector<float> values = attribute.per_corner ? vertices_.of_corners(attribute.values, n)
                                                       : vertices_.of_vertices(attribute.values, n);
      if (attribute.kind == AttributeKind::kUv) {  // glTF's v points down
        for (size_t i = 1; i < values.size(); i += 2)
          values[i] = 1 - values[i];
      }
      result.push_back({name, n, std::move(values)});
    }
    return result;
  }

  size_t add_differences(std::vector<float> values, const std::vector<float>& from,
                         size_t components = 3) {
    for (size_t i = 0; i < values.size(); ++i)
      values[i] -= from[i];
    return buffer_.add_differences(values, components);
  }

  /// Of an attribute that moves every target has the differences, those that are 0 too.
  void complete_targets() {
    for (const WrittenValues& first : first_values_) {
      if (!first.moves)
        continue;
      const std::vector<float> zeros(first.values.size());
      const size_t none = buffer_.add_differences(zeros, first.components);
      for (Json& target : targets_) {
        if (!target.contains(first.name))
          target[first.name] = none;
      }
    }
  }

  /// Normals of the GLB's vertices, none where the clip does not know its hard edges.
  std::vector<float> normals_of(std::span<const float> of_clip) const {
    std::vector<float> out;
    if (!normals_)
      return out;
    const std::vector<float> normals = normals_->compute(of_clip);
    out.reserve(3 * vertices_.corner.size());
    for (uint32_t c : vertices_.corner) {
      if (c == GlbVertices::kNoCorner) {
        out.insert(out.end(), {0, 0, 1});
        continue;
      }
      const float* normal = normals.data() + size_t{3} * normals_->of_corner(c);
      out.insert(out.end(), normal, normal + 3);
    }
    return out;
  }

  Json node() const {
    Json node{{"name", clip_.name}, {"mesh", 0}};
    if (clip_.up == UpAxis::kZ)  // the axes of glTF: Y up
      node["rotation"] = {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
    if (const double unit = clip_.metres_per_unit; unit > 0 && unit != 1)
      node["scale"] = {unit, unit, unit};
    return node;
  }

  Json mesh() {
    Json mesh{{"name", clip_.name}, {"primitives", Json::array()}};
    for (const auto& [material, corners] : triangles_of(clip_, vertices_)) {
      Json& primitive = mesh["primitives"].emplace_back(Json::object());
      primitive["mode"] = kTriangles;
      primitive["indices"] = buffer_.add_indices(corners, vertices_.count());
      if (material != kNoLabel)
        primitive["material"] = material;
    }
    if (mesh["primitives"].empty())
      mesh["primitives"].push_back({{"mode", kPoints}});
    for (Json& primitive : mesh["primitives"]) {
      primitive["attributes"] = attributes_;
      if (!targets_.empty())
        primitive["targets"] = targets_;
    }
    return mesh;
  }

  /// The weight of a frame is 1 at its time and 0 at those of all others.
  Json animation(std::span<const float> times) {
    const uint32_t frames = clip_.frame_count;
    std::vector<float> input(times.begin(), times.end());
    for (float& t : input)
      t -= std::min(times[0], 0.0F);
    std::vector<uint32_t> elements;
    for (uint32_t f = 0; f < frames; ++f)
      elements.push_back(f * frames + f);
    const std::vector<float> ones(frames, 1.0F);
    const Json weights{
        {"componentType", kFloat}, {"count", uint64_t{frames} * frames}, {"type", "SCALAR"}};
    Json sampler{{"input", buffer_.add_floats(input, 1, 0, true)},
                 {"interpolation", step_ ? "STEP" : "LINEAR"},
                 {"output", buffer_.add_sparse(weights, elements, ones)}};
    Json animation{{"name", clip_.name}};
    animation["samplers"] = Json::array({std::move(sampler)});
    animation["channels"] =
        Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}});
    if (clip_.times.empty())
      animation["extras"]["anicodec"]["rate"] =
          std::to_string(clip_.rate.numerator) + "/" + std::to_string(clip_.rate.denominator);
    return animation;
  }

  std::string packed(const Json& document) const {
    std::string json = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    constexpr uint32_t kHeader = 12, kChunkHeader = 8;
    const size_t binary = (buffer_.bytes().size() + 3) / 4 * 4;
    buffer_.check_size(json.size() + kHeader + 2 * kChunkHeader + 3);
    std::string out = "glTF";
    auto add = [&out](size_t x) { append(static_cast<uint32_t>(x), std::endian::little, out); };
    add(2);
    add(kHeader + kChunkHeader + json.size() + kChunkHeader + binary);
    add(json.size());
    out += "JSON" + json;
    add(binary);
    out += std::string_view("BIN\0", 4);
    out += buffer_.bytes();
    out.resize(out.size() + binary - buffer_.bytes().size());
    return out;
  }

  const MeshSequence& clip_;
  const GlbVertices vertices_;
  std::optional<FrameNormals> normals_;  ///< of clips that know their hard edges
  const bool step_;
  Buffer buffer_;
  std::vector<float> first_positions_, first_normals_;
  std::vector<WrittenValues> first_values_;
  Json attributes_, targets_ = Json::array();
};

GlbOutput::GlbOutput(const MeshSequence& clip, bool step)
    : writer_(std::make_unique<Writer>(clip, step)) {}

GlbOutput::~GlbOutput() = default;

void GlbOutput::add_frame(std::span<const float> positions, std::span<const Attribute> attributes) {
  writer_->add_frame(positions, attributes);
}

std::string GlbOutput::finish(std::span<const float> times) {
  return writer_->finish(times);
}

}  // namespace anicodec::tools
