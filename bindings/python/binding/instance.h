// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PYTHON_BINDING_INSTANCE_H_
#define ANICODEC_SDK_PYTHON_BINDING_INSTANCE_H_

#include "bindings/python/binding/binding.h"

#include <memory>

namespace anicodec::python {

/// The vertices that a graphics card needs of a mesh.
class RenderPlan {
 public:
  RenderPlan(const anic_asset* asset, uint32_t mesh, double crease, uint32_t frame,
             bool source_edges);

  const anic_render_plan* get() const { return plan_.get(); }

  /// Counts, and copies of the arrays.
  nb::dict info() const;

  /// Fills render vertices x 3 from positions of the same shape.
  void write_normals(const Array<float>& positions, Writable<float> out) const;

 private:
  struct Destroy {
    void operator()(anic_render_plan* plan) const { anic_destroy_render_plan(plan); }
  };

  std::unique_ptr<anic_render_plan, Destroy> plan_;
};

/// Shows moments of a clip. One thread at a time.
class Instance {
 public:
  /// `clips`: numbers in the file of the opened clips.
  Instance(const anic_asset* asset, std::vector<uint32_t> clips);

  void set_clip(uint32_t clip);
  void set_quality(double quality);
  void seek(double seconds, int sampling, int wrap);
  void blend(uint32_t clip, double seconds, double weight, int sampling, int wrap);

  /// Fills render vertices x 3; false when the mesh is not there.
  bool write_positions(const RenderPlan& plan, Writable<float> out) const;

  /// Fills render vertices x components; false when the mesh is not there.
  bool write_attribute(const RenderPlan& plan, uint32_t attribute, uint32_t components,
                       Writable<float> out) const;

 private:
  struct Destroy {
    void operator()(anic_context* context) const { anic_destroy_context(context); }
  };

  std::unique_ptr<anic_context, Destroy> context_;
  std::vector<uint32_t> clips_;
};

void bind_instance(nb::module_& module);

}  // namespace anicodec::python

#endif  // ANICODEC_SDK_PYTHON_BINDING_INSTANCE_H_
