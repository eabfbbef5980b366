// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The words by which options, `info` and `dump` name the enums of the format.
#ifndef ANICODEC_TOOLS_WORDS_NAMES_H_
#define ANICODEC_TOOLS_WORDS_NAMES_H_

#include "codec/sequence/mesh_sequence.h"
#include "format/attribute_record.h"
#include "format/records.h"
#include "tools/words/word_table.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// Unprintable characters as '?': a file may hold any name.
inline std::string printable(std::string_view name) {
  std::string text(name);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      c = '?';
  }
  return text;
}

inline constexpr Word<format::BasisKind> kBasisKinds[] = {
    {format::BasisKind::kKeyframes, "keyframes"},
    {format::BasisKind::kEigenshapes, "eigenshapes"},
    {format::BasisKind::kEigentrajectories, "eigentrajectories"}};

inline constexpr Word<format::CoderId> kCoders[] = {{format::CoderId::kDraco, "draco"},
                                                    {format::CoderId::kPlain, "plain"},
                                                    {format::CoderId::kPredictive, "predictive"}};

inline constexpr Word<format::Reconstruction> kReconstructions[] = {
    {format::Reconstruction::kLinear, "linear"}, {format::Reconstruction::kMsgi, "msgi"}};

inline constexpr Word<format::OrderMode> kOrderModes[] = {
    {format::OrderMode::kVertices, "vertices"},
    {format::OrderMode::kFree, "free"},
    {format::OrderMode::kAll, "all"}};

inline constexpr Word<format::ErrorMetric> kErrorMetrics[] = {
    {format::ErrorMetric::kNone, "none"},          {format::ErrorMetric::kKg, "kg"},
    {format::ErrorMetric::kMaxError, "max_error"}, {format::ErrorMetric::kRmse, "rmse"},
    {format::ErrorMetric::kSize, "size"},          {format::ErrorMetric::kBpfv, "bpfv"}};

inline constexpr Word<format::AttributeKind> kAttributeKinds[] = {
    {format::AttributeKind::kUv, "uv"},           {format::AttributeKind::kNormal, "normal"},
    {format::AttributeKind::kTangent, "tangent"}, {format::AttributeKind::kColour, "colour"},
    {format::AttributeKind::kCustom, "custom"},   {format::AttributeKind::kMaterial, "material"},
    {format::AttributeKind::kPart, "part"}};

inline constexpr Word<format::AttributeDomain> kAttributeDomains[] = {
    {format::AttributeDomain::kVertex, "vertices"},
    {format::AttributeDomain::kCorner, "corners"},
    {format::AttributeDomain::kPolygon, "faces"}};

inline constexpr Word<UpAxis> kUpAxes[] = {{UpAxis::kY, "y"}, {UpAxis::kZ, "z"}};

inline const char* name_of(format::BasisKind kind) {
  return word_of(kBasisKinds, kind);
}

inline const char* name_of(format::CoderId coder) {
  return word_of(kCoders, coder);
}

inline const char* name_of(format::Reconstruction reconstruction) {
  return word_of(kReconstructions, reconstruction);
}

inline const char* name_of(format::OrderMode order) {
  return word_of(kOrderModes, order);
}

inline const char* name_of(format::ErrorMetric metric) {
  return word_of(kErrorMetrics, metric);
}

inline const char* name_of(format::AttributeKind kind) {
  return word_of(kAttributeKinds, kind);
}

inline const char* name_of(format::AttributeDomain domain) {
  return word_of(kAttributeDomains, domain);
}

inline const char* name_of(UpAxis up) {
  return word_of(kUpAxes, up);
}

/// Of an axis as a file has it.
inline const char* up_name(uint8_t up) {
  return name_of(UpAxis{up});
}

/// What the components of a basis are, in the plural, for people.
inline const char* components_of(format::BasisKind kind) {
  return kind == format::BasisKind::kKeyframes ? "key-frames" : name_of(kind);
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_NAMES_H_
