// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/ogawa_output.h"

#include "tools/io/base/byte_order.h"

#include <bit>
#include <string>
#include <utility>

namespace anicodec::tools {
namespace {

std::string header(bool finished, OgawaChild root) {
  std::string out = "Ogawa";
  out += finished ? '\xff' : '\0';
  anicodec::tools::append(uint16_t{1}, std::endian::big, out);
  anicodec::tools::append(root, std::endian::little, out);
  return out;
}

}  // namespace

OgawaOutput::OgawaOutput(AbcSink sink) : sink_(std::move(sink)) {
  append(header(false, 0));
}

void OgawaOutput::append(std::string_view bytes) {
  sink_.append(bytes);
  size_ += bytes.size();
}

OgawaChild OgawaOutput::data(std::string_view begin, std::string_view rest) {
  if (begin.empty() && rest.empty())
    return kOgawaData;
  const uint64_t position = size_;
  std::string size;
  anicodec::tools::append(uint64_t{begin.size() + rest.size()}, std::endian::little, size);
  append(size);
  append(begin);
  append(rest);
  return position | kOgawaData;
}

OgawaChild OgawaOutput::group(std::span<const OgawaChild> children) {
  if (children.empty())
    return 0;
  const uint64_t position = size_;
  std::string bytes;
  anicodec::tools::append(uint64_t{children.size()}, std::endian::little, bytes);
  for (OgawaChild child : children)
    anicodec::tools::append(child, std::endian::little, bytes);
  append(bytes);
  return position;
}

void OgawaOutput::finish(OgawaChild root) {
  sink_.rewrite(0, header(true, root));
}

}  // namespace anicodec::tools
