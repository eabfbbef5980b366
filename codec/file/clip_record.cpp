// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/clip_record.h"

namespace anicodec {

ClipRecord clip_record(const MeshSequence& sequence, const EncodeOptions& options,
                       const Target& target, double clip_diagonal) {
  ClipRecord record;
  record.name = sequence.name;
  record.encoder = options.encoder;
  record.rate_numerator = sequence.rate.numerator;
  record.rate_denominator = sequence.rate.denominator;
  record.rate_assumed = sequence.rate.assumed;
  record.loop = sequence.loop;
  record.up = static_cast<uint8_t>(sequence.up);
  record.order = options.order;
  record.start_time = sequence.start_time;
  record.metres_per_unit = sequence.metres_per_unit;
  record.times.assign(sequence.times.begin(), sequence.times.end());
  record.massaged = options.surface_change.has_value();
  if (record.massaged) {
    record.surface_error = options.surface_change->max;
    record.surface_error_mean = options.surface_change->mean;
  }
  record.asked = target.metric;
  record.asked_value = target.value;
  record.diagonal = clip_diagonal;
  return record;
}

}  // namespace anicodec
