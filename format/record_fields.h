// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Optional fields at the end of a record, by which it grows (spec/06-chunks.md, section 1).
#ifndef ANICODEC_FORMAT_RECORD_FIELDS_H_
#define ANICODEC_FORMAT_RECORD_FIELDS_H_

#include "format/bytes.h"

#include <cstdint>

namespace anicodec {

/// An optional field: a tag, and the bytes of its value.
struct RecordField {
  uint32_t tag = 0;
  ByteView value;
};

/// Reads the next field; `field` is the one before it, or new. False at the end of the record, and where the next
/// field is malformed: then the reader has failed.
inline bool read_field(ByteReader& r, RecordField* field) {
  if (!r.ok() || r.remaining() == 0)
    return false;
  const uint32_t before = field->tag;
  field->tag = r.varint32();
  field->value = r.block();
  if (field->tag <= before)
    r.fail();
  return r.ok();
}

/// Skips fields that are not known. False: one is malformed.
inline bool skip_fields(ByteReader& r) {
  RecordField field;
  while (read_field(r, &field)) {
  }
  return r.finished();
}

inline void write_field(ByteWriter& w, uint32_t tag, ByteView value) {
  w.varint(tag);
  w.block(value);
}

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_RECORD_FIELDS_H_
