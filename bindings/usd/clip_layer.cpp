// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/usd/clip_layer.h"

#include <algorithm>

#include <pxr/sdf/schema.h>
#include <pxr/sdf/types.h>
#include <pxr/tf/diagnostic.h>

// Macros of OpenUSD name what is in it without saying so.
using namespace pxr;  // NOLINT

namespace anicodec::usd {

namespace {

const pxr::TfToken& default_field() {
  static const pxr::TfToken token("default");
  return token;
}

const pxr::TfToken& samples_field() {
  static const pxr::TfToken token("timeSamples");
  return token;
}

void refuse() {
  TF_CODING_ERROR("layers of .anic files are read-only");
}

/// The samples on both sides of a time; the nearest one twice outside.
bool bracket(const Samples& samples, double time, double* lower, double* upper) {
  const size_t size = samples.size();
  if (size == 0)
    return false;
  const size_t behind = samples.find(time);
  const bool exact = behind < size && samples.code(behind) == time;
  *upper = samples.code(std::min(behind, size - 1));
  *lower = exact || behind == 0 ? *upper : samples.code(behind - 1);
  if (behind == size)
    *lower = *upper;
  return true;
}

pxr::VtValue all_of(const Samples& samples) {
  pxr::SdfTimeSampleMap map;
  for (size_t i = 0; i < samples.size(); ++i)
    map[samples.code(i)] = samples.value(i);
  return pxr::VtValue(map);
}

}  // namespace

void ClipLayer::add_spec(const pxr::SdfPath& path, pxr::SdfSpecType type) {
  if (specs_.emplace(path, Spec{}).second)
    order_.push_back(path);
  specs_[path].type = type;
}

void ClipLayer::set_field(const pxr::SdfPath& path, const char* name, pxr::VtValue value) {
  const pxr::TfToken token(name);
  for (auto& [field, held] : specs_[path].fields) {
    if (field == token) {
      held = std::move(value);
      return;
    }
  }
  specs_[path].fields.emplace_back(token, std::move(value));
}

void ClipLayer::set_samples(const pxr::SdfPath& path, std::shared_ptr<const Samples> samples) {
  specs_[path].samples = std::move(samples);
}

void ClipLayer::set_resting(const pxr::SdfPath& path, std::shared_ptr<const Samples> samples) {
  specs_[path].samples = std::move(samples);
  specs_[path].rests = true;
}

const ClipLayer::Spec* ClipLayer::find(const pxr::SdfPath& path) const {
  const auto found = specs_.find(path);
  return found == specs_.end() ? nullptr : &found->second;
}

const Samples* ClipLayer::moving(const pxr::SdfPath& path) const {
  const Spec* spec = find(path);
  return spec != nullptr && !spec->rests ? spec->samples.get() : nullptr;
}

pxr::SdfSpecType ClipLayer::GetSpecType(const pxr::SdfPath& path) const {
  const Spec* spec = find(path);
  return spec == nullptr ? pxr::SdfSpecTypeUnknown : spec->type;
}

bool ClipLayer::Has(const pxr::SdfPath& path, const pxr::TfToken& field,
                    pxr::SdfAbstractDataValue* value) const {
  pxr::VtValue held;
  return Has(path, field, value == nullptr ? nullptr : &held) &&
         (value == nullptr || value->StoreValue(held));
}

bool ClipLayer::Has(const pxr::SdfPath& path, const pxr::TfToken& field,
                    pxr::VtValue* value) const {
  const Spec* spec = find(path);
  if (spec == nullptr)
    return false;
  if (spec->samples != nullptr && field == (spec->rests ? default_field() : samples_field())) {
    if (value != nullptr)
      *value = spec->rests ? spec->samples->value(0) : all_of(*spec->samples);
    return true;
  }
  for (const auto& [name, held] : spec->fields) {
    if (name == field) {
      if (value != nullptr)
        *value = held;
      return true;
    }
  }
  return false;
}

pxr::VtValue ClipLayer::Get(const pxr::SdfPath& path, const pxr::TfToken& field) const {
  pxr::VtValue value;
  Has(path, field, &value);
  return value;
}

const std::type_info& ClipLayer::GetTypeid(const pxr::SdfPath& path,
                                           const pxr::TfToken& field) const {
  const Spec* spec = find(path);
  if (spec == nullptr)
    return typeid(void);
  if (spec->samples != nullptr && field == (spec->rests ? default_field() : samples_field()))
    return spec->rests ? spec->samples->type(0) : typeid(pxr::SdfTimeSampleMap);
  for (const auto& [name, held] : spec->fields) {
    if (name == field)
      return held.GetTypeid();
  }
  return typeid(void);
}

std::vector<pxr::TfToken> ClipLayer::List(const pxr::SdfPath& path) const {
  std::vector<pxr::TfToken> names;
  if (const Spec* spec = find(path)) {
    for (const auto& field : spec->fields)
      names.push_back(field.first);
    if (spec->samples != nullptr)
      names.push_back(spec->rests ? default_field() : samples_field());
  }
  return names;
}

std::set<double> ClipLayer::ListAllTimeSamples() const {
  std::set<double> codes;
  for (const auto& [path, spec] : specs_) {
    if (spec.samples != nullptr && !spec.rests)
      codes.merge(ListTimeSamplesForPath(path));
  }
  return codes;
}

std::set<double> ClipLayer::ListTimeSamplesForPath(const pxr::SdfPath& path) const {
  std::set<double> codes;
  if (const Samples* samples = moving(path)) {
    for (size_t i = 0; i < samples->size(); ++i)
      codes.insert(codes.end(), samples->code(i));
  }
  return codes;
}

bool ClipLayer::GetBracketingTimeSamples(double time, double* lower, double* upper) const {
  bool any = false;
  for (const auto& [path, spec] : specs_) {
    double below = 0;
    double above = 0;
    if (spec.samples == nullptr || spec.rests || !bracket(*spec.samples, time, &below, &above))
      continue;
    // The nearest on each side; a sample on the wrong side counts only while there is no other.
    const auto nearer = [&](double now, double found, bool below_time) {
      const bool right_now = below_time ? now <= time : now >= time;
      const bool right_found = below_time ? found <= time : found >= time;
      return right_found && (!right_now || (below_time ? found > now : found < now));
    };
    if (!any || nearer(*lower, below, true))
      *lower = below;
    if (!any || nearer(*upper, above, false))
      *upper = above;
    any = true;
  }
  return any;
}

size_t ClipLayer::GetNumTimeSamplesForPath(const pxr::SdfPath& path) const {
  const Samples* samples = moving(path);
  return samples == nullptr ? 0 : samples->size();
}

bool ClipLayer::GetBracketingTimeSamplesForPath(const pxr::SdfPath& path, double time,
                                                double* lower, double* upper) const {
  const Samples* samples = moving(path);
  return samples != nullptr && bracket(*samples, time, lower, upper);
}

bool ClipLayer::GetPreviousTimeSampleForPath(const pxr::SdfPath& path, double time,
                                             double* previous) const {
  const Samples* samples = moving(path);
  const size_t behind = samples == nullptr ? 0 : samples->find(time);
  if (behind == 0)
    return false;
  *previous = samples->code(behind - 1);
  return true;
}

bool ClipLayer::QueryTimeSample(const pxr::SdfPath& path, double time,
                                pxr::SdfAbstractDataValue* value) const {
  pxr::VtValue held;
  return QueryTimeSample(path, time, value == nullptr ? nullptr : &held) &&
         (value == nullptr || value->StoreValue(held));
}

bool ClipLayer::QueryTimeSample(const pxr::SdfPath& path, double time, pxr::VtValue* value) const {
  const Samples* samples = moving(path);
  const size_t i = samples == nullptr ? 0 : samples->find(time);
  if (samples == nullptr || i == samples->size() || samples->code(i) != time)
    return false;
  if (value != nullptr)
    *value = samples->value(i);
  return value == nullptr || !value->IsEmpty();
}

const std::type_info& ClipLayer::QueryTimeSampleTypeid(const pxr::SdfPath& path,
                                                       double time) const {
  const Samples* samples = moving(path);
  const size_t i = samples == nullptr ? 0 : samples->find(time);
  return samples == nullptr || i == samples->size() || samples->code(i) != time ? typeid(void)
                                                                                : samples->type(i);
}

void ClipLayer::CreateSpec(const pxr::SdfPath& /*path*/, pxr::SdfSpecType /*type*/) {
  refuse();
}

void ClipLayer::EraseSpec(const pxr::SdfPath& /*path*/) {
  refuse();
}

void ClipLayer::MoveSpec(const pxr::SdfPath& /*from*/, const pxr::SdfPath& /*to*/) {
  refuse();
}

void ClipLayer::Set(const pxr::SdfPath& /*path*/, const pxr::TfToken& /*field*/,
                    const pxr::VtValue& /*value*/) {
  refuse();
}

void ClipLayer::Set(const pxr::SdfPath& /*path*/, const pxr::TfToken& /*field*/,
                    const pxr::SdfAbstractDataConstValue& /*value*/) {
  refuse();
}

void ClipLayer::Erase(const pxr::SdfPath& /*path*/, const pxr::TfToken& /*field*/) {
  refuse();
}

void ClipLayer::SetTimeSample(const pxr::SdfPath& /*path*/, double /*time*/,
                              const pxr::VtValue& /*value*/) {
  refuse();
}

void ClipLayer::EraseTimeSample(const pxr::SdfPath& /*path*/, double /*time*/) {
  refuse();
}

void ClipLayer::_VisitSpecs(pxr::SdfAbstractDataSpecVisitor* visitor) const {
  for (const pxr::SdfPath& path : order_) {
    if (!visitor->VisitSpec(*this, path))
      return;
  }
}

}  // namespace anicodec::usd
