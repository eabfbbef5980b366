// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_BINDINGS_USD_DECODED_VALUES_H_
#define ANICODEC_BINDINGS_USD_DECODED_VALUES_H_

#include "bindings/usd/opened_clip.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <typeinfo>

#include <pxr/vt/value.h>

namespace anicodec::usd {

/// Makes the value of a frame; empty, after an error was posted, where that fails.
using MakeValue = std::function<pxr::VtValue(uint32_t frame)>;

/// The type of a primvar, and its values of as many floats. More than four numbers of an element are an array of floats.
struct ValueType {
  const char* name;
  const std::type_info& info;
  pxr::VtValue (*make)(const float* values, size_t count);
};

ValueType value_type(anic_attribute_kind kind, uint32_t components);

/// Points of a mesh.
MakeValue make_positions(std::shared_ptr<const OpenedClip> file, uint32_t mesh);

/// The box of a mesh, as extent.
MakeValue make_extent(std::shared_ptr<const OpenedClip> file, uint32_t mesh, uint32_t clip);

/// Normals of a mesh, from its points: of corners where it has hard edges, else of vertices. `frame` is one that has the mesh.
MakeValue make_normals(std::shared_ptr<const OpenedClip> file, uint32_t mesh, uint32_t frame,
                       bool hard_edges);

/// Values of an attribute that moves.
MakeValue make_attribute(std::shared_ptr<const OpenedClip> file, uint32_t mesh, uint32_t attribute);

}  // namespace anicodec::usd

#endif  // ANICODEC_BINDINGS_USD_DECODED_VALUES_H_
