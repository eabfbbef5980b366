// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_PRINTABLE_H_
#define ANICODEC_TOOLS_IO_BASE_PRINTABLE_H_

#include <string>
#include <string_view>

namespace anicodec::tools {

/// A text of unknown origin made fit for one line of a terminal, a document or a text format: UTF-8
/// stays as it is, but for what moves the cursor, ends a line or turns the direction of writing.
/// Such characters become \n, \r, \t, \x1b or \u202e, bytes that are no UTF-8 \xff. A text that
/// has been through here comes out the same once more.
std::string printable(std::string_view text);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_PRINTABLE_H_
