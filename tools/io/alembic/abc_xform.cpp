// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_xform.h"

#include <cmath>
#include <numbers>
#include <span>

#include <Eigen/Geometry>

namespace anicodec::tools {
namespace {

enum Operation : uint8_t { kScale, kTranslate, kRotate, kMatrix, kRotateX, kRotateY, kRotateZ };

constexpr size_t kChannels[] = {3, 3, 4, 16, 1, 1, 1};

Eigen::Matrix3d rotation(double degrees, const Eigen::Vector3d& axis) {
  const double length = axis.norm();
  if (length == 0)
    return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis / length).toRotationMatrix();
}

AbcTransform operation(uint8_t kind, const double* v) {
  AbcTransform out = identity_transform();
  switch (kind) {
    case kScale:
      out.leftCols<3>().diagonal() << v[0], v[1], v[2];
      break;
    case kTranslate:
      out.col(3) << v[0], v[1], v[2];
      break;
    case kRotate:
      out.leftCols<3>() = rotation(v[3], {v[0], v[1], v[2]});
      break;
    case kMatrix:  // rows for row vectors are columns for column vectors
      out = Eigen::Map<const Eigen::Matrix4d>(v).topRows<3>();
      break;
    default:
      out.leftCols<3>() = rotation(v[0], Eigen::Vector3d::Unit(kind - kRotateX));
  }
  return out;
}

std::optional<AbcSamples> samples_of(const AbcArchive& archive, const AbcCompound& compound,
                                     std::string_view name) {
  const AbcProperty* property = compound.find(name);
  if (property == nullptr || property->samples == 0)
    return std::nullopt;
  archive.time_of(*property);  // there is one
  return AbcSamples(archive.file, *property);
}

AbcCompound xform_of(const AbcArchive& archive, const AbcObject& object) {
  const AbcCompound properties = archive.properties(object);
  const AbcProperty* xform = properties.find(".xform");
  return xform == nullptr ? AbcCompound() : archive.properties(*xform);
}

}  // namespace

AbcTransform identity_transform() {
  AbcTransform out;
  out << Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero();
  return out;
}

AbcTransform after(const AbcTransform& outer, const AbcTransform& inner) {
  AbcTransform out;
  out.leftCols<3>() = outer.leftCols<3>() * inner.leftCols<3>();
  out.col(3) = outer.leftCols<3>() * inner.col(3) + outer.col(3);
  return out;
}

AbcFlag::AbcFlag(const AbcArchive& archive, const AbcCompound& compound, std::string_view name,
                 int value)
    : archive_(archive), samples_(samples_of(archive, compound, name)), value_(value) {}

int AbcFlag::at(double time) {
  if (!samples_)
    return value_;
  const uint32_t sample = archive_.sample_at(*samples_, time);
  if (sample != sample_) {
    const std::vector<int32_t> values = samples_->integers(sample);
    if (values.empty())
      archive_.file.fail(samples_->property().place(), "a sample is empty");
    value_ = values[0];
    sample_ = sample;
  }
  return value_;
}

AbcXform::AbcXform(const AbcArchive& archive, const AbcObject& object)
    : AbcXform(archive, object, xform_of(archive, object)) {}

AbcXform::AbcXform(const AbcArchive& archive, const AbcObject& object, const AbcCompound& compound)
    : archive_(archive),
      values_(samples_of(archive, compound, ".vals")),
      inherits_(archive, compound, ".inherits", 1),
      transform_(identity_transform()) {
  const std::optional<AbcSamples> operations = samples_of(archive, compound, ".ops");
  size_t channels = 0;
  for (int32_t code : operations ? operations->integers(0) : std::vector<int32_t>()) {
    const auto kind = static_cast<uint8_t>((code & 255) >> 4);
    if (kind > kRotateZ)
      archive.file.fail(object.path, "operation " + std::to_string(code) + " is not known");
    operations_.push_back(kind);
    channels += kChannels[kind];
  }
  if (channels > 0 && !values_)
    archive.file.fail(object.path, "the operations have no values");
  if (operations_.empty())
    values_.reset();
}

AbcTransform AbcXform::transform(uint32_t sample) const {
  const std::vector<double> values = values_->doubles(sample);
  AbcTransform out = identity_transform();
  size_t channel = 0;
  for (uint8_t kind : operations_) {
    if (values.size() - channel < kChannels[kind])
      archive_.file.fail(values_->property().place(), "has " + std::to_string(values.size()) +
                                                          " values, too few for the operations");
    out = after(out, operation(kind, values.data() + channel));
    channel += kChannels[kind];
  }
  return out;
}

const AbcTransform& AbcXform::at(double time) {
  if (!values_)
    return transform_;
  const uint32_t sample = archive_.sample_at(*values_, time);
  if (sample != sample_) {
    transform_ = transform(sample);
    sample_ = sample;
  }
  return transform_;
}

std::vector<const AbcProperty*> AbcXform::timed() const {
  std::vector<const AbcProperty*> out;
  if (values_)
    out.push_back(&values_->property());
  if (inherits_.timed())
    out.push_back(inherits_.timed());
  return out;
}

}  // namespace anicodec::tools
