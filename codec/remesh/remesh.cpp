// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/remesh.h"

#include "codec/remesh/decimate.h"
#include "codec/remesh/isotropic.h"
#include "codec/remesh/subdivide.h"
#include "codec/sequence/error.h"

#include <cstddef>
#include <utility>

namespace anicodec {
namespace {

constexpr uint32_t kSpare = 50;  // a part of the vertices more, of which decimation takes the rest

size_t vertices_of(const SurfaceFrame& mesh) {
  return mesh.positions.size() / 3;
}

RemeshMethod method_for(const SurfaceFrame& mesh, const RemeshOptions& options) {
  if (options.method != RemeshMethod::kAuto)
    return options.method;
  return options.vertices <= vertices_of(mesh) ? RemeshMethod::kDecimate : RemeshMethod::kIsotropic;
}

/// The mesh subdivided until it has enough vertices, once at least.
SurfaceFrame refined(const SurfaceFrame& mesh, uint32_t vertices, MeshRepairs* repairs) {
  SurfaceFrame fine = subdivide(mesh, 1, repairs);
  while (vertices_of(fine) < vertices)
    fine = subdivide(fine, 1);
  return fine;
}

}  // namespace

RemeshResult remesh(const SurfaceFrame& mesh, const RemeshOptions& options,
                    const Progress& progress) {
  RemeshResult result;
  result.method = method_for(mesh, options);
  DecimationOptions decimation;
  decimation.vertices = options.vertices;
  SurfaceFrame surface = mesh;
  if (result.method == RemeshMethod::kDecimate) {
    decimation.max_distance = options.max_distance;
    Decimation coarse = decimate(mesh, decimation, progress);
    result.repairs = coarse.repairs;
    result.mesh = std::move(coarse.mesh);
  } else if (options.vertices == 0) {
    throw Error(ErrorKind::kUsage, "only decimation finds the number of vertices itself");
  } else if (result.method == RemeshMethod::kLoop) {
    surface = refined(mesh, options.vertices, &result.repairs);
    result.mesh = decimate(surface, decimation, progress).mesh;
  } else {
    IsotropicOptions isotropic;
    isotropic.vertices = options.vertices + options.vertices / kSpare + 1;
    result.mesh = remesh_isotropic(mesh, isotropic, progress, &result.repairs);
    result.mesh = decimate(result.mesh, decimation, progress).mesh;
  }
  if (progress)
    progress("fitting", 0);
  if (options.fit) {
    try {
      result.fit = fit_remesh(result.mesh, surface);
    } catch (const Error& e) {
      result.no_fit = e.what();
    }
  }
  if (!options.fit || !result.no_fit.empty())
    result.fit = measure_mesh(result.mesh, surface);
  result.mesh.positions = result.fit.positions;
  return result;
}

}  // namespace anicodec
