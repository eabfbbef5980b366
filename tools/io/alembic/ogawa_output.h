// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_OGAWA_OUTPUT_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_OGAWA_OUTPUT_H_

#include "tools/io/alembic/ogawa.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace anicodec::tools {

/// The destination of an archive: bytes at the end, and bytes in place of earlier ones.
struct AbcSink {
  std::function<void(std::string_view bytes)> append;
  std::function<void(uint64_t offset, std::string_view bytes)> rewrite;
};

/// Writes the container below Alembic, children before the groups that hold them. The file is
/// marked as unfinished until finish().
class OgawaOutput {
 public:
  explicit OgawaOutput(AbcSink sink);

  /// Data made of two pieces; empty data takes no bytes.
  OgawaChild data(std::string_view begin, std::string_view rest = {});

  /// A group; an empty one takes no bytes.
  OgawaChild group(std::span<const OgawaChild> children);

  void finish(OgawaChild root);

 private:
  void append(std::string_view bytes);

  AbcSink sink_;
  uint64_t size_ = 0;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_OGAWA_OUTPUT_H_
