// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_REPORT_PAGE_PARTS_H_
#define ANICODEC_TOOLS_REPORT_PAGE_PARTS_H_

#include "tools/render/image.h"

#include <string>

namespace anicodec::tools {

/// A page that needs nothing else: style, a heading, a quiet line below it, and a body of HTML.
std::string page_around(const std::string& heading, const std::string& below,
                        const std::string& body);

/// A picture inside the page, with its caption.
std::string figure_of(const std::string& caption, const Image& image);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_REPORT_PAGE_PARTS_H_
