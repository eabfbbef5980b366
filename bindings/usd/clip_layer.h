// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_BINDINGS_USD_CLIP_LAYER_H_
#define ANICODEC_BINDINGS_USD_CLIP_LAYER_H_

#include "bindings/usd/samples.h"

#include <memory>
#include <set>
#include <string>
#include <typeinfo>
#include <unordered_map>
#include <utility>
#include <vector>

#include <pxr/sdf/abstractData.h>

namespace anicodec::usd {

/// The contents of a layer: prims and attributes with their fields, and samples that are made when they are asked for. Read only.
///
/// Field names are tokens of its own: the members of SdfFieldKeys move when a release adds one. It derives from SdfAbstractData,
/// which has no members, so that none of SdfData's layout counts.
class ClipLayer : public pxr::SdfAbstractData {
 public:
  void add_spec(const pxr::SdfPath& path, pxr::SdfSpecType type);

  bool has_spec(const pxr::SdfPath& path) const { return specs_.count(path) != 0; }

  /// Sets a field, or replaces it.
  void set_field(const pxr::SdfPath& path, const char* name, pxr::VtValue value);

  void set_samples(const pxr::SdfPath& path, std::shared_ptr<const Samples> samples);

  /// Field "default" has the first of the samples, and no time code counts: of what rests.
  void set_resting(const pxr::SdfPath& path, std::shared_ptr<const Samples> samples);

  bool StreamsData() const override { return true; }

  bool HasSpec(const pxr::SdfPath& path) const override { return has_spec(path); }

  pxr::SdfSpecType GetSpecType(const pxr::SdfPath& path) const override;
  bool Has(const pxr::SdfPath& path, const pxr::TfToken& field,
           pxr::SdfAbstractDataValue* value) const override;
  bool Has(const pxr::SdfPath& path, const pxr::TfToken& field,
           pxr::VtValue* value = nullptr) const override;
  pxr::VtValue Get(const pxr::SdfPath& path, const pxr::TfToken& field) const override;
  const std::type_info& GetTypeid(const pxr::SdfPath& path,
                                  const pxr::TfToken& field) const override;
  std::vector<pxr::TfToken> List(const pxr::SdfPath& path) const override;

  std::set<double> ListAllTimeSamples() const override;
  std::set<double> ListTimeSamplesForPath(const pxr::SdfPath& path) const override;
  bool GetBracketingTimeSamples(double time, double* lower, double* upper) const override;
  size_t GetNumTimeSamplesForPath(const pxr::SdfPath& path) const override;
  bool GetBracketingTimeSamplesForPath(const pxr::SdfPath& path, double time, double* lower,
                                       double* upper) const override;
  bool GetPreviousTimeSampleForPath(const pxr::SdfPath& path, double time,
                                    double* previous) const override;
  bool QueryTimeSample(const pxr::SdfPath& path, double time,
                       pxr::SdfAbstractDataValue* value) const override;
  bool QueryTimeSample(const pxr::SdfPath& path, double time,
                       pxr::VtValue* value = nullptr) const override;
  const std::type_info& QueryTimeSampleTypeid(const pxr::SdfPath& path, double time) const override;

  void CreateSpec(const pxr::SdfPath& path, pxr::SdfSpecType type) override;
  void EraseSpec(const pxr::SdfPath& path) override;
  void MoveSpec(const pxr::SdfPath& from, const pxr::SdfPath& to) override;
  void Set(const pxr::SdfPath& path, const pxr::TfToken& field, const pxr::VtValue& value) override;
  void Set(const pxr::SdfPath& path, const pxr::TfToken& field,
           const pxr::SdfAbstractDataConstValue& value) override;
  void Erase(const pxr::SdfPath& path, const pxr::TfToken& field) override;
  void SetTimeSample(const pxr::SdfPath& path, double time, const pxr::VtValue& value) override;
  void EraseTimeSample(const pxr::SdfPath& path, double time) override;

 protected:
  void _VisitSpecs(pxr::SdfAbstractDataSpecVisitor* visitor) const override;

 private:
  struct Spec {
    pxr::SdfSpecType type = pxr::SdfSpecTypeUnknown;
    std::vector<std::pair<pxr::TfToken, pxr::VtValue>> fields;
    std::shared_ptr<const Samples> samples;
    bool rests = false;
  };

  const Spec* find(const pxr::SdfPath& path) const;
  /// The samples of an attribute that moves, or null.
  const Samples* moving(const pxr::SdfPath& path) const;

  std::unordered_map<pxr::SdfPath, Spec, pxr::SdfPath::Hash> specs_;
  std::vector<pxr::SdfPath> order_;  ///< of specs, as they were added
};

}  // namespace anicodec::usd

#endif  // ANICODEC_BINDINGS_USD_CLIP_LAYER_H_
