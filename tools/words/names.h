// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The words by which options, `info` and `dump` name the enums of the format.
#ifndef ANICODEC_TOOLS_WORDS_NAMES_H_
#define ANICODEC_TOOLS_WORDS_NAMES_H_

#include "codec/sequence/mesh_sequence.h"
#include "format/attribute_record.h"
#include "format/container.h"
#include "format/records.h"
#include "tools/words/quantity.h"
#include "tools/words/word_table.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

inline constexpr Word<BasisKind> kBasisKinds[] = {
    {BasisKind::kKeyframes, "keyframes"},
    {BasisKind::kEigenshapes, "eigenshapes"},
    {BasisKind::kEigentrajectories, "eigentrajectories"}};

inline constexpr Word<Reconstruction> kReconstructions[] = {{Reconstruction::kLinear, "linear"},
                                                            {Reconstruction::kMsgi, "msgi"}};

inline constexpr Word<OrderMode> kOrderModes[] = {
    {OrderMode::kVertices, "vertices"}, {OrderMode::kFree, "free"}, {OrderMode::kAll, "all"}};

inline constexpr Word<ErrorMetric> kErrorMetrics[] = {{ErrorMetric::kNone, "none"},
                                                      {ErrorMetric::kKg, "kg"},
                                                      {ErrorMetric::kMaxError, "max_error"},
                                                      {ErrorMetric::kRmse, "rmse"},
                                                      {ErrorMetric::kDisplacement, "displacement"},
                                                      {ErrorMetric::kSted, "sted"},
                                                      {ErrorMetric::kSize, "size"},
                                                      {ErrorMetric::kBpfv, "bpfv"}};

inline constexpr Word<AttributeKind> kAttributeKinds[] = {
    {AttributeKind::kUv, "uv"},           {AttributeKind::kNormal, "normal"},
    {AttributeKind::kTangent, "tangent"}, {AttributeKind::kColour, "colour"},
    {AttributeKind::kCustom, "custom"},   {AttributeKind::kMaterial, "material"},
    {AttributeKind::kPart, "part"}};

inline constexpr Word<AlphaMode> kAlphaModes[] = {
    {AlphaMode::kOpaque, "opaque"}, {AlphaMode::kMask, "mask"}, {AlphaMode::kBlend, "blend"}};

inline constexpr Word<TextureSlot> kTextures[kTextureSlots] = {
    {TextureSlot::kBaseColour, "base_colour"},
    {TextureSlot::kMetallicRoughness, "metallic_roughness"},
    {TextureSlot::kNormal, "normal"},
    {TextureSlot::kOcclusion, "occlusion"},
    {TextureSlot::kEmissive, "emissive"}};

inline constexpr Word<AttributeDomain> kAttributeDomains[] = {
    {AttributeDomain::kVertex, "vertices"},
    {AttributeDomain::kCorner, "corners"},
    {AttributeDomain::kPolygon, "faces"}};

inline constexpr Word<UpAxis> kUpAxes[] = {{UpAxis::kY, "y"}, {UpAxis::kZ, "z"}};

inline constexpr Word<uint64_t> kFeatures[] = {{kContinuation, "continuation"},
                                               {kDracoFeature, "draco"},
                                               {kMsgiFeature, "msgi"},
                                               {kLearningFeature, "learning"}};

/// The names of the feature bits that are set.
inline std::vector<std::string> feature_list(uint64_t features) {
  std::vector<std::string> names;
  for (const Word<uint64_t>& feature : kFeatures) {
    if (features & feature.value)
      names.emplace_back(feature.text);
  }
  return names;
}

/// The same, separated by commas; "none" where there is none.
inline std::string feature_names(uint64_t features) {
  std::string names;
  for (const std::string& name : feature_list(features))
    names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

inline const char* name_of(BasisKind kind) {
  return word_of(kBasisKinds, kind);
}

inline const char* name_of(Reconstruction reconstruction) {
  return word_of(kReconstructions, reconstruction);
}

inline const char* name_of(OrderMode order) {
  return word_of(kOrderModes, order);
}

inline const char* name_of(ErrorMetric metric) {
  return word_of(kErrorMetrics, metric);
}

inline const char* name_of(AttributeKind kind) {
  return word_of(kAttributeKinds, kind);
}

inline const char* name_of(AttributeDomain domain) {
  return word_of(kAttributeDomains, domain);
}

inline const char* name_of(UpAxis up) {
  return word_of(kUpAxes, up);
}

/// The name of an axis as a file has it.
inline const char* up_name(uint8_t up) {
  return name_of(UpAxis{up});
}

/// "1 key-frame", "12 eigenshapes", "3 eigentrajectories": components of a basis, for people.
inline std::string counted_components(uint32_t number, BasisKind kind) {
  switch (kind) {
    case BasisKind::kKeyframes:
      return counted(number, "key-frame");
    case BasisKind::kEigentrajectories:
      return counted(number, "eigentrajectory", "eigentrajectories");
    default:
      return counted(number, "eigenshape");
  }
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_NAMES_H_
