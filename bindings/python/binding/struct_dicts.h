// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Structs of the C interface as dicts: numbers, bools, texts, tuples, and words of enumerations. Arrays at addresses and
// their sizes in bytes are left out. bindings/generate wrote this from the headers.
#ifndef ANICODEC_BINDINGS_PYTHON_BINDING_STRUCT_DICTS_H_
#define ANICODEC_BINDINGS_PYTHON_BINDING_STRUCT_DICTS_H_

#include "bindings/python/binding/binding.h"

#include <anicodec/encode.h>

#include <cstddef>
#include <cstdint>

// clang-format off
namespace anicodec::python {

/// A word of an enumeration; a number that this version has no word for as it is.
template <size_t kCount>
nb::object word_of(int32_t number, const char* const (&words)[kCount]) {
  if (number >= 0 && static_cast<size_t>(number) < kCount)
    return nb::str(words[number]);
  return nb::int_(number);
}

template <class Number, size_t kCount>
nb::tuple tuple_of(const Number (&numbers)[kCount]) {
  nb::list all;
  for (const Number number : numbers)
    all.append(number);
  return nb::tuple(all);
}

inline constexpr const char* kUpAxisWords[] = {"unknown", "y", "z"};

inline constexpr const char* kOrderWords[] = {"vertices", "free", "all"};

inline constexpr const char* kAttributeKindWords[] = {"uv", "normal", "tangent", "colour", "custom", "material", "part"};

inline constexpr const char* kDomainWords[] = {"vertices", "corners", "polygons"};

inline constexpr const char* kAlphaWords[] = {"opaque", "mask", "blend"};

inline constexpr const char* kBasisKindWords[] = {"keyframes", "eigenshapes", "eigentrajectories"};

inline nb::dict dict_of(const anic_asset_info& s) {
  nb::dict d;
  d["name"] = text_of(s.name);
  d["encoder"] = text_of(s.encoder);
  d["mesh_count"] = s.mesh_count;
  d["segment_count"] = s.segment_count;
  d["frame_count"] = s.frame_count;
  d["rate"] = nb::make_tuple(s.rate_numerator, s.rate_denominator);
  d["up"] = word_of(s.up, kUpAxisWords);
  d["order"] = word_of(s.order, kOrderWords);
  d["rate_assumed"] = s.rate_assumed != 0;
  d["uneven"] = s.uneven != 0;
  d["loop"] = s.loop != 0;
  d["closed"] = s.closed != 0;
  d["massaged"] = s.massaged != 0;
  d["partial"] = s.partial != 0;
  d["start_time"] = s.start_time;
  d["duration"] = s.duration;
  d["loop_duration"] = s.loop_duration;
  d["metres_per_unit"] = s.metres_per_unit;
  d["diagonal"] = s.diagonal;
  d["max_error"] = s.max_error;
  d["rmse"] = s.rmse;
  d["kg"] = s.kg;
  d["surface_error"] = s.surface_error;
  d["surface_error_mean"] = s.surface_error_mean;
  d["resident_bytes"] = s.resident_bytes;
  d["context_bytes"] = s.context_bytes;
  d["max_displacement_error"] = s.max_displacement_error;
  d["origin"] = tuple_of(s.origin);
  return d;
}

inline nb::dict dict_of(const anic_clip& s) {
  nb::dict d;
  d["name"] = text_of(s.name);
  d["first_frame"] = s.first_frame;
  d["frame_count"] = s.frame_count;
  d["rate"] = nb::make_tuple(s.rate_numerator, s.rate_denominator);
  d["rate_assumed"] = s.rate_assumed != 0;
  d["uneven"] = s.uneven != 0;
  d["loop"] = s.loop != 0;
  d["closed"] = s.closed != 0;
  d["massaged"] = s.massaged != 0;
  d["open"] = s.open != 0;
  d["start_time"] = s.start_time;
  d["duration"] = s.duration;
  d["loop_duration"] = s.loop_duration;
  d["diagonal"] = s.diagonal;
  d["max_error"] = s.max_error;
  d["rmse"] = s.rmse;
  d["kg"] = s.kg;
  d["surface_error"] = s.surface_error;
  d["surface_error_mean"] = s.surface_error_mean;
  d["max_displacement_error"] = s.max_displacement_error;
  return d;
}

inline nb::dict dict_of(const anic_mesh& s) {
  nb::dict d;
  d["name"] = text_of(s.name);
  d["vertex_count"] = s.vertex_count;
  d["coded_vertex_count"] = s.coded_vertex_count;
  d["polygon_count"] = s.polygon_count;
  d["corner_count"] = s.corner_count;
  d["triangle_count"] = s.triangle_count;
  d["attribute_count"] = s.attribute_count;
  return d;
}

inline nb::dict dict_of(const anic_attribute& s) {
  nb::dict d;
  d["name"] = text_of(s.name);
  d["kind"] = word_of(s.kind, kAttributeKindWords);
  d["domain"] = word_of(s.domain, kDomainWords);
  d["count"] = s.count;
  d["components"] = s.components;
  d["label_count"] = s.label_count;
  d["moves"] = s.moves != 0;
  return d;
}

inline nb::dict dict_of(const anic_material& s) {
  nb::dict d;
  d["name"] = text_of(s.name);
  d["base_colour"] = tuple_of(s.base_colour);
  d["metallic"] = s.metallic;
  d["roughness"] = s.roughness;
  d["emissive"] = tuple_of(s.emissive);
  d["alpha"] = word_of(s.alpha, kAlphaWords);
  d["alpha_cutoff"] = s.alpha_cutoff;
  d["double_sided"] = s.double_sided != 0;
  d["base_colour_texture"] = text_of(s.base_colour_texture);
  d["metallic_roughness_texture"] = text_of(s.metallic_roughness_texture);
  d["normal_texture"] = text_of(s.normal_texture);
  d["occlusion_texture"] = text_of(s.occlusion_texture);
  d["emissive_texture"] = text_of(s.emissive_texture);
  return d;
}

inline nb::dict dict_of(const anic_root_motion& s) {
  nb::dict d;
  d["moves"] = s.moves != 0;
  d["turns"] = s.turns != 0;
  d["turn"] = s.turn;
  d["move"] = tuple_of(s.move);
  d["pivot"] = tuple_of(s.pivot);
  d["matrix"] = tuple_of(s.matrix);
  return d;
}

inline nb::dict dict_of(const anic_encoding& s) {
  nb::dict d;
  d["max_error"] = s.max_error;
  d["rmse"] = s.rmse;
  d["kg"] = s.kg;
  d["diagonal"] = s.diagonal;
  d["surface_error"] = s.surface_error;
  d["components"] = s.components;
  d["basis"] = word_of(s.basis, kBasisKindWords);
  d["massaged"] = s.massaged != 0;
  d["max_displacement_error"] = s.max_displacement_error;
  return d;
}

inline nb::dict dict_of(const anic_live_piece& s) {
  nb::dict d;
  d["first_frame"] = s.first_frame;
  d["start_time"] = s.start_time;
  d["encode_seconds"] = s.encode_seconds;
  d["max_error"] = s.max_error;
  d["rmse"] = s.rmse;
  d["kg"] = s.kg;
  d["frame_count"] = s.frame_count;
  d["key"] = s.key != 0;
  d["has_mesh"] = s.has_mesh != 0;
  return d;
}

inline nb::dict dict_of(const anic_live_info& s) {
  nb::dict d;
  d["pushed_frames"] = s.pushed_frames;
  d["waiting_frames"] = s.waiting_frames;
  d["late_frames"] = s.late_frames;
  d["waiting_pieces"] = s.waiting_pieces;
  d["encode_seconds"] = s.encode_seconds;
  d["piece_frames"] = s.piece_frames;
  d["ended"] = s.ended != 0;
  return d;
}

/// Calls set(name, field) for each number of the struct.
template <class Set>
void each_number(anic_encode_options& s, const Set& set) {
  set("goal", s.goal);
  set("order", s.order);
  set("goal_value", s.goal_value);
  set("max_error", s.max_error);
  set("flags", s.flags);
  set("max_bytes", s.max_bytes);
  set("threads", s.threads);
  set("effort", s.effort);
  set("basis", s.basis);
  set("keyframes", s.keyframes);
  set("selection", s.selection);
  set("interpolation", s.interpolation);
  set("keyframe_coder", s.keyframe_coder);
  set("massage", s.massage);
  set("uv_bits", s.uv_bits);
  set("colour_bits", s.colour_bits);
  set("massage_strength", s.massage_strength);
  set("massage_tolerance", s.massage_tolerance);
  set("attribute_error", s.attribute_error);
  set("normal_error", s.normal_error);
}

}  // namespace anicodec::python

#endif  // ANICODEC_BINDINGS_PYTHON_BINDING_STRUCT_DICTS_H_
