// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_RENDER_HTML_TEXT_H_
#define ANICODEC_TOOLS_RENDER_HTML_TEXT_H_

#include <string>
#include <string_view>

namespace anicodec::tools {

/// Text that a page shows as it is, also in an attribute's quotes: markup and what cannot be printed
/// are escaped.
std::string html_text(std::string_view text);

/// Text whose markup alone is escaped, such as a page inside an attribute.
std::string escaped_markup(std::string_view text);

/// Bytes in base64, as data in a page is written.
std::string base64(std::string_view bytes);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_RENDER_HTML_TEXT_H_
