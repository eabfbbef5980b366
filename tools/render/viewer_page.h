// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips inside the viewer of bindings/web/viewer: one page to send.
#ifndef ANICODEC_TOOLS_RENDER_VIEWER_PAGE_H_
#define ANICODEC_TOOLS_RENDER_VIEWER_PAGE_H_

#include <span>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// An .anic file in memory, and what to call it.
struct PageClip {
  std::string name;
  std::string_view bytes;
};

/// The viewer's page, in share/anicodec/ beside the command or its folder; empty where there is none.
std::string find_viewer();

/// The same where it is needed. Throws Error(kUnsupported) where there is none.
std::string load_viewer();

/// Puts clips into the viewer. Its size is that of the viewer and 4/3 of the clips'.
std::string viewer_page(std::string_view viewer, std::span<const PageClip> clips);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_RENDER_VIEWER_PAGE_H_
