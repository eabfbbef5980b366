// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Instances of clips, and the vertices that graphics cards need: for engines.
#include "bindings/python/binding/instance.h"

#include <utility>

namespace anicodec::python {
namespace {

/// False for a mesh that is not there; raises what else goes wrong.
bool is_present(anic_status status) {
  if (status != ANIC_E_ABSENT)
    check_status(status);
  return status == ANIC_OK;
}

anic_render_info info_of(const anic_render_plan* plan) {
  anic_render_info info = ANIC_INIT(anic_render_info);
  check_status(anic_get_render_info(plan, &info));
  return info;
}

}  // namespace

RenderPlan::RenderPlan(const anic_asset* asset, uint32_t mesh, double crease, uint32_t frame,
                       bool source_edges) {
  anic_render_plan_options options = ANIC_INIT(anic_render_plan_options);
  options.crease_angle = crease;
  options.reference_frame = frame;
  options.source_edges = source_edges;
  anic_render_plan* plan = nullptr;
  check_status(anic_create_render_plan(asset, mesh, &options, nullptr, &plan));
  plan_.reset(plan);
}

nb::dict RenderPlan::info() const {
  const anic_render_info info = info_of(get());
  nb::dict d;
  d["vertex_count"] = info.vertex_count;
  d["vertices"] = copied(info.vertices, info.vertex_count);
  d["indices"] = copied(info.indices, size_t{3} * info.triangle_count);
  d["group_materials"] = copied(info.group_materials, info.group_count);
  d["group_begin"] = copied(info.group_begin, size_t{info.group_count} + 1);
  return d;
}

void RenderPlan::write_normals(const Array<float>& positions, Writable<float> out) const {
  const uint32_t count = info_of(get()).vertex_count;
  if (positions.nbytes() < size_t{3} * sizeof(float) * count)
    check_status(ANIC_E_BUFFER_SIZE);
  anic_output output = ANIC_INIT(anic_output);
  output.data = out.data();
  output.size = out.nbytes();
  const WithoutInterpreter unlocked;
  check_status(anic_write_render_normals(get(), positions.data(), 0, 0, count, &output));
}

Instance::Instance(const anic_asset* asset, std::vector<uint32_t> clips)
    : clips_(std::move(clips)) {
  anic_context* context = nullptr;
  check_status(anic_create_context(asset, nullptr, &context));
  context_.reset(context);
}

void Instance::set_clip(uint32_t clip) {
  check_status(anic_set_clip(context_.get(), at_number(clips_, clip)));
}

void Instance::set_quality(double quality) {
  check_status(anic_set_quality(context_.get(), quality));
}

void Instance::seek(double seconds, int sampling, int wrap) {
  check_status(anic_seek_time(context_.get(), seconds, static_cast<anic_sampling>(sampling),
                              static_cast<anic_wrap>(wrap)));
}

void Instance::blend(uint32_t clip, double seconds, double weight, int sampling, int wrap) {
  check_status(anic_blend(context_.get(), at_number(clips_, clip), seconds,
                          static_cast<anic_sampling>(sampling), static_cast<anic_wrap>(wrap),
                          weight));
}

bool Instance::write_positions(const RenderPlan& plan, Writable<float> out) const {
  anic_output output = ANIC_INIT(anic_output);
  output.data = out.data();
  output.size = out.nbytes();
  const uint32_t count = info_of(plan.get()).vertex_count;
  const WithoutInterpreter unlocked;
  return is_present(anic_write_render_positions(plan.get(), context_.get(), ANIC_WHEN_CURRENT, 0,
                                                count, &output));
}

bool Instance::write_attribute(const RenderPlan& plan, uint32_t attribute, uint32_t components,
                               Writable<float> out) const {
  anic_value_output output = ANIC_INIT(anic_value_output);
  output.data = out.data();
  output.size = out.nbytes();
  output.components = components;
  const uint32_t count = info_of(plan.get()).vertex_count;
  const WithoutInterpreter unlocked;
  return is_present(anic_write_render_attribute(plan.get(), context_.get(), attribute,
                                                ANIC_WHEN_CURRENT, 0, count, &output));
}

void bind_instance(nb::module_& module) {
  nb::class_<RenderPlan>(module, "RenderPlan")
      .def("info", &RenderPlan::info)
      .def("write_normals", &RenderPlan::write_normals);
  nb::class_<Instance>(module, "Instance")
      .def("set_clip", &Instance::set_clip)
      .def("set_quality", &Instance::set_quality)
      .def("seek", &Instance::seek)
      .def("blend", &Instance::blend)
      .def("write_positions", &Instance::write_positions)
      .def("write_attribute", &Instance::write_attribute);
}

}  // namespace anicodec::python
