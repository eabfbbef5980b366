// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/viewer_page.h"

#include "codec/sequence/error.h"
#include "tools/io/files/own_file.h"
#include "tools/render/html_text.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace anicodec::tools {
namespace {

/// The place of the clips in the viewer's page.
constexpr std::string_view kMark = "<!-- the clip -->";

}  // namespace

std::string find_viewer() {
  const std::filesystem::path folder = own_file().parent_path(),
                              page_there = "share/anicodec/viewer.html";
  for (const std::filesystem::path& path :
       {folder / page_there, folder.parent_path() / page_there}) {
    std::ifstream file(path, std::ios::binary);
    std::string page{std::istreambuf_iterator<char>(file), {}};
    if (page.find(kMark) != std::string::npos)
      return page;
  }
  return {};
}

std::string load_viewer() {
  if (std::string page = find_viewer(); !page.empty())
    return page;
  throw Error(ErrorKind::kUnsupported,
              "this installation has no viewer for .html: share/anicodec/viewer.html is missing");
}

std::string viewer_page(std::string_view viewer, std::span<const PageClip> clips) {
  std::string scripts;
  for (const PageClip& clip : clips)
    scripts += "<script class=\"clip\" type=\"application/octet-stream\" data-name=\"" +
               html_text(clip.name) + "\">" + base64(clip.bytes) + "</script>";
  std::string page(viewer);
  return page.replace(page.find(kMark), kMark.size(), scripts);
}

}  // namespace anicodec::tools
