// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/glb_output.h"

#include "codec/sequence/error.h"
#include "codec/sequence/frame_normals.h"
#include "tools/io/gltf/glb_buffer.h"
#include "tools/io/gltf/glb_vertices.h"
#include "tools/io/gltf/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace anicodec::tools {
namespace {

using OrderedJson = GlbBuffer::Json;

constexpr int kPoints = 0, kTriangles = 4;

}  // namespace

class GlbOutput::Writer {
  /// An attribute at the vertices of the GLB, in one frame.
  struct Written {
    std::string name;
    size_t components = 0;
    bool in_every_target = false;  ///< otherwise where it differs from the first frame
    std::vector<float> values;

    /// The values of one object.
    std::span<const float> of(const GlbObject& object) const {
      return std::span(values).subspan(components * object.first, components * object.count);
    }
  };

  /// A mesh of the GLB.
  struct Output {
    OrderedJson attributes, targets = OrderedJson::array();
    std::vector<bool> moves;  ///< of each attribute written: whether a target has it
  };

 public:
  Writer(const MeshSequence& clip, bool step, std::span<const GltfImage> images,
         const std::vector<Attribute>* attributes)
      : clip_(clip),
        vertices_(clip, attributes ? *attributes : clip.attributes),
        step_(step),
        images_(images),
        meshes_(vertices_.objects().size()) {
    if (!clip.shared_normals.empty() && !GlbVertices::is_flat(clip))
      normals_.emplace(clip);
    if (clip.frame_count > UINT16_MAX)
      throw Error(ErrorKind::kInput,
                  "a GLB of " + std::to_string(clip.frame_count) +
                      " frames; at most 65535 are possible, whose weights are a table of 2^32");
  }

  void add_frame(std::span<const float> positions, std::span<const Attribute> attributes) {
    std::vector<Written> frame = written(positions, attributes);
    if (first_.empty()) {
      first_ = frame;
      triangles_ = vertices_.triangles(clip_, positions);
      for (size_t m = 0; m < meshes_.size(); ++m)
        add_first(vertices_.objects()[m], meshes_[m]);
    }
    if (clip_.frame_count == 1)
      return;
    for (size_t i = 0; i < frame.size(); ++i) {
      for (size_t k = 0; k < frame[i].values.size(); ++k)
        frame[i].values[k] -= first_[i].values[k];
    }
    for (size_t m = 0; m < meshes_.size(); ++m)
      add_target(frame, vertices_.objects()[m], meshes_[m]);
  }

  std::string finish(std::span<const float> times) {
    for (size_t m = 0; m < meshes_.size(); ++m)
      complete_targets(vertices_.objects()[m], meshes_[m]);
    OrderedJson document;
    document["asset"] = {{"version", "2.0"}, {"generator", "anicodec"}};
    document["scene"] = 0;
    document["scenes"] = OrderedJson::array({{{"nodes", {0}}}});
    document["nodes"] = nodes();
    document["meshes"] = meshes();
    if (!clip_.materials.of_polygon.empty())
      add_materials(document);
    if (clip_.frame_count > 1)
      document["animations"] = animations(times);
    buffer_.describe_in(document);
    return pack_glb(document.dump(-1, ' ', false, OrderedJson::error_handler_t::replace),
                    buffer_.bytes());
  }

 private:
  /// The values of a frame: positions, normals if the clip knows its hard edges, then attributes.
  std::vector<Written> written(std::span<const float> positions,
                               std::span<const Attribute> attributes) const {
    std::vector<Written> result{{"POSITION", 3, true, vertices_.of_vertices(positions, 3)}};
    if (normals_)
      result.push_back({"NORMAL", 3, true, normals_of(positions)});
    std::map<AttributeKind, int> sets;
    for (const Attribute& attribute : attributes) {
      if (!GlbVertices::is_written(attribute))
        continue;
      const size_t n = attribute.components;
      const std::string name = (attribute.kind == AttributeKind::kUv ? "TEXCOORD_" : "COLOR_") +
                               std::to_string(sets[attribute.kind]++);
      std::vector<float> values = attribute.per_corner()
                                      ? vertices_.of_corners(attribute.values, n)
                                      : vertices_.of_vertices(attribute.values, n);
      if (attribute.kind == AttributeKind::kUv) {  // glTF's v points down
        for (size_t i = 1; i < values.size(); i += 2)
          values[i] = 1 - values[i];
      }
      result.push_back({name, n, false, std::move(values)});
    }
    return result;
  }

  std::vector<float> normals_of(std::span<const float> positions) const {
    const std::vector<float> normals = normals_->compute(positions);
    std::vector<float> out;
    out.reserve(3 * vertices_.corners().size());
    for (uint32_t c : vertices_.corners()) {
      if (c == GlbVertices::kNoCorner) {
        out.insert(out.end(), {0, 0, 1});
        continue;
      }
      const float* normal = normals.data() + size_t{3} * normals_->of_corner(c);
      out.insert(out.end(), normal, normal + 3);
    }
    return out;
  }

  void add_first(const GlbObject& object, Output& mesh) {
    for (const Written& w : first_)
      mesh.attributes[w.name] = buffer_.add_floats(w.of(object), w.components, GlbTarget::kVertices,
                                                   w.name == "POSITION");
    mesh.moves.resize(first_.size());
  }

  /// A target of differences to the first frame.
  void add_target(const std::vector<Written>& frame, const GlbObject& object, Output& mesh) {
    OrderedJson target;
    for (size_t i = 0; i < frame.size(); ++i) {
      const std::span<const float> values = frame[i].of(object);
      if (!frame[i].in_every_target && std::ranges::all_of(values, [](float x) { return x == 0; }))
        continue;
      mesh.moves[i] = true;
      target[frame[i].name] = buffer_.add_differences(values, frame[i].components);
    }
    mesh.targets.push_back(std::move(target));
  }

  /// Every target has the differences of an attribute that moves, those that are 0 too.
  void complete_targets(const GlbObject& object, Output& mesh) {
    for (size_t i = 0; i < first_.size(); ++i) {
      if (!mesh.moves[i])
        continue;
      const std::vector<float> zeros(first_[i].components * object.count);
      for (OrderedJson& target : mesh.targets) {
        if (!target.contains(first_[i].name))
          target[first_[i].name] = buffer_.add_differences(zeros, first_[i].components);
      }
    }
  }

  /// Empty for what is in no part of several.
  std::string name_of(const GlbObject& object) const {
    if (object.part != kNoLabel)
      return clip_.parts.names[object.part];
    return meshes_.size() == 1 ? clip_.name : "";
  }

  /// The object, or a node with the objects below it.
  OrderedJson nodes() const {
    OrderedJson nodes = OrderedJson::array();
    const bool several = meshes_.size() > 1;
    if (several)
      nodes.push_back({{"name", clip_.name}, {"children", OrderedJson::array()}});
    for (size_t m = 0; m < meshes_.size(); ++m) {
      if (several)
        nodes[0]["children"].push_back(nodes.size());
      nodes.push_back({{"name", name_of(vertices_.objects()[m])}, {"mesh", m}});
    }
    OrderedJson& root = nodes[0];
    if (clip_.up == UpAxis::kZ)  // the axes of glTF: Y up
      root["rotation"] = {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
    if (const double unit = clip_.metres_per_unit; unit > 0 && unit != 1)
      root["scale"] = {unit, unit, unit};
    if (clip_.origin != Point()) {
      const double unit = clip_.metres_per_unit > 0 ? clip_.metres_per_unit : 1;
      const auto& [x, y, z] = clip_.origin;
      const Point place = clip_.up == UpAxis::kZ ? Point{x, z, -y} : clip_.origin;
      root["translation"] = {unit * place[0], unit * place[1], unit * place[2]};
    }
    return nodes;
  }

  OrderedJson meshes() {
    OrderedJson result = OrderedJson::array();
    for (const GlbObject& object : vertices_.objects())
      result.push_back({{"name", name_of(object)}, {"primitives", OrderedJson::array()}});
    for (const auto& [object, material, corners] : triangles_) {
      OrderedJson& primitive = result[object]["primitives"].emplace_back(OrderedJson::object());
      primitive["mode"] = kTriangles;
      primitive["indices"] = buffer_.add_indices(corners, vertices_.objects()[object].count);
      if (material != kNoLabel)
        primitive["material"] = material;
    }
    for (size_t m = 0; m < meshes_.size(); ++m) {
      OrderedJson& primitives = result[m]["primitives"];
      if (primitives.empty())
        primitives.push_back({{"mode", kPoints}});
      for (OrderedJson& primitive : primitives) {
        primitive["attributes"] = meshes_[m].attributes;
        if (!meshes_[m].targets.empty())
          primitive["targets"] = meshes_[m].targets;
      }
    }
    return result;
  }

  void add_materials(OrderedJson& document) {
    const bool textured = std::ranges::any_of(
        clip_.attributes, [](const Attribute& a) { return a.kind == AttributeKind::kUv; });
    GltfMaterials materials(textured ? GltfTextures::kFiles : GltfTextures::kNone, images_,
                            [&](std::string_view bytes) { return buffer_.add_bytes(bytes); });
    const std::vector<MaterialLook>& looks = clip_.materials.looks;
    for (size_t i = 0; i < clip_.materials.names.size(); ++i)
      materials.add(clip_.materials.names[i], looks.empty() ? MaterialLook() : looks[i]);
    materials.describe_in(document);
  }

  /// One, or of several clips one for each.
  OrderedJson animations(std::span<const float> times) {
    if (clip_.clips.empty())
      return OrderedJson::array({animation(clip_.name, 0, {times.begin(), times.end()},
                                           clip_.times.empty() ? &clip_.rate : nullptr)});
    OrderedJson result = OrderedJson::array();
    uint32_t first = 0;
    for (const ClipTiming& clip : clip_.clips) {
      std::vector<float> own;
      for (uint32_t f = 0; f < clip.frame_count; ++f)
        own.push_back(static_cast<float>(
            clip.start_time + (clip.times.empty() ? f / clip.rate.value() : clip.times[f])));
      result.push_back(
          animation(clip.name, first, std::move(own), clip.times.empty() ? &clip.rate : nullptr));
      first += clip.frame_count;
    }
    return result;
  }

  /// The weight of a frame is 1 at its time and 0 at those of all others. `input`: times of the frames
  /// from the first on. `rate`: null for uneven ones.
  OrderedJson animation(const std::string& name, uint32_t first, std::vector<float> input,
                        const FrameRate* rate) {
    const uint64_t frames = clip_.frame_count, own = input.size();
    const float begin = std::min(input[0], 0.0F);
    for (float& t : input)
      t -= begin;
    std::vector<uint32_t> elements;
    for (uint32_t f = 0; f < own; ++f)
      elements.push_back(static_cast<uint32_t>(f * frames + first + f));
    const std::vector<float> ones(own, 1.0F);
    OrderedJson sampler{{"input", buffer_.add_floats(input, 1, GlbTarget::kNone, true)},
                        {"interpolation", step_ ? "STEP" : "LINEAR"},
                        {"output", buffer_.add_sparse(own * frames, elements, ones)}};
    OrderedJson animation{{"name", name}};
    animation["samplers"] = OrderedJson::array({std::move(sampler)});
    const size_t first_node = meshes_.size() > 1 ? 1 : 0;
    for (size_t m = 0; m < meshes_.size(); ++m)
      animation["channels"].push_back(
          {{"sampler", 0}, {"target", {{"node", first_node + m}, {"path", "weights"}}}});
    if (rate)
      animation["extras"]["anicodec"]["rate"] =
          std::to_string(rate->numerator) + "/" + std::to_string(rate->denominator);
    return animation;
  }

  const MeshSequence& clip_;
  const GlbVertices vertices_;
  std::optional<FrameNormals> normals_;  ///< of clips that know their hard edges
  const bool step_;
  const std::span<const GltfImage> images_;
  GlbBuffer buffer_;
  std::vector<Written> first_;
  std::vector<GlbTriangles> triangles_;
  std::vector<Output> meshes_;
};

GlbOutput::GlbOutput(const MeshSequence& clip, bool step, std::span<const GltfImage> images,
                     const std::vector<Attribute>* attributes)
    : writer_(std::make_unique<Writer>(clip, step, images, attributes)) {}

GlbOutput::~GlbOutput() = default;

void GlbOutput::add_frame(std::span<const float> positions, std::span<const Attribute> attributes) {
  writer_->add_frame(positions, attributes);
}

std::string GlbOutput::finish(std::span<const float> times) {
  return writer_->finish(times);
}

}  // namespace anicodec::tools
