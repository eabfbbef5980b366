// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The words by which options, `info` and `dump` name the enums of the format.
#ifndef ANICODEC_TOOLS_WORDS_NAMES_H_
#define ANICODEC_TOOLS_WORDS_NAMES_H_

#include "format/attribute_record.h"
#include "format/records.h"

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

inline const char* name_of(format::BasisKind kind) {
  switch (kind) {
    case format::BasisKind::kKeyframes:
      return "keyframes";
    case format::BasisKind::kEigenshapes:
      return "eigenshapes";
    case format::BasisKind::kEigentrajectories:
      return "eigentrajectories";
  }
  return "unknown";
}

/// What the components of a basis are, in the plural, for people.
inline const char* components_of(format::BasisKind kind) {
  return kind == format::BasisKind::kKeyframes ? "key-frames" : name_of(kind);
}

inline const char* name_of(format::CoderId coder) {
  switch (coder) {
    case format::CoderId::kPlain:
      return "plain";
    case format::CoderId::kDraco:
      return "draco";
    case format::CoderId::kPredictive:
      return "predictive";
  }
  return "unknown";
}

inline const char* name_of(format::Reconstruction reconstruction) {
  return reconstruction == format::Reconstruction::kLinear ? "linear" : "msgi";
}

inline const char* name_of(format::OrderMode order) {
  switch (order) {
    case format::OrderMode::kVertices:
      return "vertices";
    case format::OrderMode::kFree:
      return "free";
    case format::OrderMode::kAll:
      return "all";
  }
  return "unknown";
}

inline const char* name_of(format::ErrorMetric metric) {
  switch (metric) {
    case format::ErrorMetric::kNone:
      return "none";
    case format::ErrorMetric::kKg:
      return "kg";
    case format::ErrorMetric::kMaxError:
      return "max_error";
    case format::ErrorMetric::kRmse:
      return "rmse";
    case format::ErrorMetric::kSize:
      return "size";
    case format::ErrorMetric::kBpfv:
      return "bpfv";
  }
  return "unknown";
}

inline const char* name_of(format::AttributeKind kind) {
  switch (kind) {
    case format::AttributeKind::kUv:
      return "uv";
    case format::AttributeKind::kNormal:
      return "normal";
    case format::AttributeKind::kTangent:
      return "tangent";
    case format::AttributeKind::kColour:
      return "colour";
    case format::AttributeKind::kCustom:
      return "custom";
    case format::AttributeKind::kMaterial:
      return "material";
    case format::AttributeKind::kPart:
      return "part";
  }
  return "unknown";
}

inline const char* name_of(format::AttributeDomain domain) {
  switch (domain) {
    case format::AttributeDomain::kVertex:
      return "vertices";
    case format::AttributeDomain::kCorner:
      return "corners";
    case format::AttributeDomain::kPolygon:
      return "faces";
  }
  return "unknown";
}

inline const char* up_name(uint8_t up) {
  return up == 1 ? "y" : up == 2 ? "z" : "unknown";
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_NAMES_H_
