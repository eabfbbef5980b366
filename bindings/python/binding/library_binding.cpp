// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Measures, interpolation and massage.
#include "bindings/python/binding/binding.h"
#include "codec/massage/massage.h"
#include "codec/metrics/hausdorff.h"
#include "codec/metrics/metrics.h"

#include <cstddef>
#include <memory>

namespace anicodec::python {
namespace {

/// A sequence of frames x vertices x 3.
MeshSequence sequence_of(const Array<float>& positions, const Array<uint32_t>& offsets,
                         const Array<uint32_t>& corners) {
  MeshSequence result;
  result.frame_count = static_cast<uint32_t>(positions.shape(0));
  result.vertex_count = static_cast<uint32_t>(positions.shape(1));
  result.positions.assign(positions.data(), positions.data() + positions.size());
  result.polygons = polygons_of(offsets, corners);
  check(result);
  return result;
}

nb::dict compare_clips(const Array<float>& a, const Array<float>& b, const Array<uint32_t>& offsets,
                       const Array<uint32_t>& corners, bool sted) {
  Comparison c;
  {
    const WithoutInterpreter unlocked;
    const MeshSequence first = sequence_of(a, offsets, corners);
    const MeshSequence second = sequence_of(b, offsets, corners);
    CompareOptions options;
    options.sted = sted;
    c = compare(first, second, options);
  }
  nb::dict d;
  d["kg"] = c.kg;
  d["rmse"] = c.rmse;
  d["max_error"] = c.max_error;
  d["max_frame"] = c.max_frame;
  d["max_vertex"] = c.max_vertex;
  d["diagonal"] = c.diagonal;
  d["psnr"] = c.psnr;
  d["displacement_error"] = c.displacement_error;
  d["max_displacement_error"] = c.max_displacement_error;
  if (c.has_sted)
    d["sted"] = c.sted.sted;
  return d;
}

nb::dict hausdorff_of(const Array<float>& a, const Array<uint32_t>& a_offsets,
                      const Array<uint32_t>& a_corners, const Array<float>& b,
                      const Array<uint32_t>& b_offsets, const Array<uint32_t>& b_corners) {
  HausdorffDistance h;
  {
    const WithoutInterpreter unlocked;
    const MeshSequence first = sequence_of(a, a_offsets, a_corners);
    const MeshSequence second = sequence_of(b, b_offsets, b_corners);
    h = hausdorff(first.polygons, first.frame(0), second.polygons, second.frame(0));
  }
  nb::dict d;
  d["mean"] = h.mean();
  d["rms"] = h.rms();
  d["max"] = h.max();
  return d;
}

Numpy32 massaged(const Array<float>& positions, const Array<uint32_t>& offsets,
                 const Array<uint32_t>& corners, uint32_t reference, double strength,
                 double tolerance, bool remove_noise) {
  FrameArray moved;
  {
    const WithoutInterpreter unlocked;
    MassageOptions options;
    options.reference = reference;
    options.strength = strength;
    options.tolerance = tolerance;
    options.remove_noise = remove_noise;
    moved = massage(sequence_of(positions, offsets, corners), options).sequence.positions;
  }
  auto result = new_array<float>({positions.shape(0), positions.shape(1), 3});
  std::memcpy(result.data(), moved.data(), moved.size() * sizeof(float));
  return result;
}

struct DestroyMorpher {
  void operator()(anic_morpher* morpher) const { anic_destroy_morpher(morpher); }
};

/// Meshes of one connectivity to be blended.
class Morpher {
 public:
  Morpher(const Array<float>& meshes, const Array<uint32_t>& triangles, uint32_t leaf_faces,
          uint32_t sweeps)
      : vertices_(meshes.shape(1)) {
    std::vector<const float*> pointers;
    for (size_t m = 0; m < meshes.shape(0); ++m)
      pointers.push_back(meshes.data() + m * vertices_ * 3);
    anic_morpher_options options = ANIC_INIT(anic_morpher_options);
    options.leaf_faces = leaf_faces;
    options.sweeps = sweeps;
    anic_morpher* morpher = nullptr;
    const WithoutInterpreter unlocked;
    check_status(anic_create_morpher(triangles.data(), static_cast<uint32_t>(triangles.size() / 3),
                                     static_cast<uint32_t>(vertices_), pointers.data(),
                                     static_cast<uint32_t>(pointers.size()), &options, nullptr,
                                     &morpher));
    morpher_.reset(morpher);
    anic_get_morpher_info(morpher, &info_);
  }

  Numpy32 at(const std::vector<double>& weights) const {
    auto result = new_array<float>({vertices_, 3});
    {
      const WithoutInterpreter unlocked;
      if (weights.size() != info_.mesh_count)
        raise(ANIC_E_ARGUMENT, "there must be a weight for each mesh");
      std::vector<std::max_align_t> scratch(info_.scratch_bytes / sizeof(std::max_align_t) + 1);
      check_status(anic_morph(morpher_.get(), weights.data(), nullptr, nullptr, scratch.data(),
                              scratch.size() * sizeof(std::max_align_t), result.data()));
    }
    return result;
  }

 private:
  size_t vertices_;
  std::unique_ptr<anic_morpher, DestroyMorpher> morpher_;
  anic_morpher_info info_ = ANIC_INIT(anic_morpher_info);
};

}  // namespace

void bind_library(nb::module_& module) {
  module.def("compare", compare_clips);
  module.def("hausdorff", hausdorff_of);
  module.def("massage", massaged);
  nb::class_<Morpher>(module, "Morpher")
      .def(nb::init<const Array<float>&, const Array<uint32_t>&, uint32_t, uint32_t>())
      .def("at", &Morpher::at);
}

}  // namespace anicodec::python
