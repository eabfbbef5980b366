// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_XFORM_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_XFORM_H_

#include "tools/io/alembic/abc_archive.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace anicodec::tools {

/// Three rows of a matrix for column vectors: p' = left 3x3 * p + last column.
using AbcTransform = Eigen::Matrix<double, 3, 4>;

AbcTransform identity_transform();

/// First `inner`, then `outer`.
AbcTransform after(const AbcTransform& outer, const AbcTransform& inner);

/// A number that may change over time, such as a switch.
class AbcFlag {
 public:
  /// `value` where the compound has no such property. The archive must outlive it.
  AbcFlag(const AbcArchive& archive, const AbcCompound& compound, std::string_view name, int value);

  /// That of the last sample that is not after a time.
  int at(double time);

  /// Null where it does not change.
  const AbcProperty* timed() const { return samples_ ? &samples_->property() : nullptr; }

 private:
  const AbcArchive& archive_;
  std::optional<AbcSamples> samples_;
  uint32_t sample_ = kAbcNone;  ///< that value_ is of
  int value_;
};

/// The transform of an object of the Xform schema: a stack of operations, of which the last is
/// applied first.
class AbcXform {
 public:
  /// Throws Error(kInput) for operations that are not known or whose values are not there. The
  /// archive must outlive it.
  AbcXform(const AbcArchive& archive, const AbcObject& object);

  /// The last sample that is not after a time.
  const AbcTransform& at(double time);

  /// False where all ancestors are to be ignored.
  bool inherits(double time) { return inherits_.at(time) != 0; }

  /// Properties with samples, for the times of a clip.
  std::vector<const AbcProperty*> timed() const;

 private:
  AbcXform(const AbcArchive& archive, const AbcObject& object, const AbcCompound& compound);

  AbcTransform transform(uint32_t sample) const;

  const AbcArchive& archive_;
  std::vector<uint8_t> operations_;  ///< kinds
  std::optional<AbcSamples> values_;
  AbcFlag inherits_;
  uint32_t sample_ = kAbcNone;  ///< that transform_ is of
  AbcTransform transform_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_XFORM_H_
