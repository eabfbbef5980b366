// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/usd/decoded_values.h"

#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

#include <pxr/gf/vec2f.h>
#include <pxr/gf/vec3f.h>
#include <pxr/gf/vec4f.h>
#include <pxr/tf/diagnostic.h>
#include <pxr/vt/array.h>

// Macros of OpenUSD name what is in it without saying so.
using namespace pxr;  // NOLINT

namespace anicodec::usd {

namespace {

template <class Element>
VtValue array_of(const float* values, size_t count) {
  VtArray<Element> array(count * sizeof(float) / sizeof(Element));
  if (!array.empty())
    std::memcpy(array.data(), values, array.size() * sizeof(Element));
  return VtValue::Take(array);
}

VtValue failed(anic_status status, uint32_t frame) {
  TF_RUNTIME_ERROR(".anic: frame %u: %s", frame, anic_get_status_text(status));
  return {};
}

VtValue positions_of(const OpenedClip& file, uint32_t mesh, uint32_t frame) {
  VtVec3fArray points(file.asset().mesh(mesh).vertex_count);
  const anic_status status =
      file.write_positions(mesh, frame, points.empty() ? nullptr : points.data()->data());
  return status == ANIC_OK ? VtValue::Take(points) : failed(status, frame);
}

/// Normals of one mesh. The plan is made when they are first asked for.
class NormalMaker {
 public:
  NormalMaker(std::shared_ptr<const OpenedClip> file, uint32_t mesh, uint32_t frame,
              bool hard_edges)
      : file_(std::move(file)), mesh_(mesh), frame_(frame), hard_edges_(hard_edges) {}

  VtValue make(uint32_t frame) {
    std::call_once(once_, [&] {
      anic_normal_plan_options options = ANIC_INIT(anic_normal_plan_options);
      options.per_corner = options.source_edges = hard_edges_ ? 1 : 0;
      options.reference_frame = frame_;
      status_ = plan_.create(file_->asset(), &options, mesh_).code();
    });
    if (status_ != ANIC_OK)
      return failed(status_, frame);
    const VtValue points = positions_of(*file_, mesh_, frame);
    VtVec3fArray normals(plan_.size());
    if (points.IsEmpty() || normals.empty())
      return points.IsEmpty() ? VtValue() : VtValue::Take(normals);
    const float* positions = points.UncheckedGet<VtVec3fArray>().cdata()->data();
    const anic_output output = anic::output({normals.data()->data(), 3 * normals.size()});
    const anic::Status status = plan_.write_normals(positions, output, 0, plan_.size());
    return status ? VtValue::Take(normals) : failed(status.code(), frame);
  }

 private:
  std::shared_ptr<const OpenedClip> file_;
  uint32_t mesh_;
  uint32_t frame_;
  bool hard_edges_;
  std::once_flag once_;
  anic_status status_ = ANIC_OK;
  anic::NormalPlan plan_;
};

}  // namespace

ValueType value_type(anic_attribute_kind kind, uint32_t components) {
  const bool is_colour = kind == ANIC_ATTRIBUTE_COLOUR;
  switch (components) {
    case 2:
      return {kind == ANIC_ATTRIBUTE_UV ? "texCoord2f[]" : "float2[]", typeid(VtVec2fArray),
              array_of<GfVec2f>};
    case 3:
      return {is_colour                       ? "color3f[]"
              : kind == ANIC_ATTRIBUTE_NORMAL ? "normal3f[]"
                                              : "float3[]",
              typeid(VtVec3fArray), array_of<GfVec3f>};
    case 4:
      return {is_colour ? "color4f[]" : "float4[]", typeid(VtVec4fArray), array_of<GfVec4f>};
    default:
      return {"float[]", typeid(VtFloatArray), array_of<float>};
  }
}

MakeValue make_positions(std::shared_ptr<const OpenedClip> file, uint32_t mesh) {
  return
      [file = std::move(file), mesh](uint32_t frame) { return positions_of(*file, mesh, frame); };
}

MakeValue make_extent(std::shared_ptr<const OpenedClip> file, uint32_t mesh, uint32_t clip) {
  return [file = std::move(file), mesh, clip](uint32_t frame) {
    const anic_box box = file->box(mesh, clip, frame);
    VtVec3fArray extent(2);
    extent[0] = GfVec3f(box.min);
    extent[1] = GfVec3f(box.max);
    return VtValue::Take(extent);
  };
}

MakeValue make_normals(std::shared_ptr<const OpenedClip> file, uint32_t mesh, uint32_t frame,
                       bool hard_edges) {
  const auto maker = std::make_shared<NormalMaker>(std::move(file), mesh, frame, hard_edges);
  return [maker](uint32_t asked) { return maker->make(asked); };
}

MakeValue make_attribute(std::shared_ptr<const OpenedClip> file, uint32_t mesh,
                         uint32_t attribute) {
  return [file = std::move(file), mesh, attribute](uint32_t frame) {
    const anic_attribute what = file->asset().attribute(attribute, mesh);
    std::vector<float> values(size_t{what.count} * what.components);
    const anic_status status = file->write_attribute(mesh, attribute, frame, values.data());
    return status == ANIC_OK
               ? value_type(what.kind, what.components).make(values.data(), values.size())
               : failed(status, frame);
  };
}

}  // namespace anicodec::usd
