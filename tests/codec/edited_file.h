// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_CODEC_EDITED_FILE_H_
#define ANICODEC_TESTS_CODEC_EDITED_FILE_H_

#include "format/container.h"
#include "format/records.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace anicodec {

/// A file taken apart, to be changed and put together with checksums that fit.
struct EditedFile {
  struct Part {
    Chunk chunk;
    Bytes payload;
  };

  std::vector<Part> parts;
  uint64_t features = 0;

  /// Leaves out what cannot be read.
  explicit EditedFile(const Bytes& file) {
    ContainerReader reader;
    if (!reader.open(file).ok())
      return;
    features = reader.features();
    for (const Chunk& chunk : reader.chunks()) {
      ByteView view;
      if (reader.payload(chunk, &view).ok())
        parts.push_back({chunk, {view.data, view.data + view.size}});
    }
  }

  /// The first part of a type; there must be one.
  Part& part(const char (&type)[5]) {
    return *std::find_if(parts.begin(), parts.end(),
                         [&](const Part& p) { return p.chunk.type == chunk_type(type); });
  }

  template <class Change>
  void change_limits(Change change) {
    Limits limits;
    Limits::read(part("LIMI").payload, &limits);
    change(limits);
    part("LIMI").payload = limits.write();
    features = limits.features();
  }

  template <class Change>
  void change_clip(Change change) {
    Limits limits;
    Limits::read(part("LIMI").payload, &limits);
    ClipsRecord record;
    ClipsRecord::read(part("CLIP").payload, limits, &record);
    change(record);
    part("CLIP").payload = record.write();
  }

  /// `change(record)` of a record whose views lie in the old payload.
  template <class Record, class Change>
  void change_record(const char (&type)[5], Change change) {
    const Bytes old = part(type).payload;
    Record record;
    Record::read(old, &record);
    change(record);
    part(type).payload = record.write();
  }

  Bytes bytes() const {
    ContainerWriter writer;
    for (const Part& p : parts)
      writer.add(p.chunk, p.chunk.mesh, p.chunk.segment, p.payload);
    return writer.finish(features);
  }
};

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CODEC_EDITED_FILE_H_
