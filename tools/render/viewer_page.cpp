// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/viewer_page.h"

#include "codec/sequence/error.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace anicodec::tools {
namespace {

/// Where the viewer's page has room for clips.
constexpr std::string_view kMark = "<!-- the clip -->";

std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0U);
    for (size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace

std::string find_viewer() {
  std::error_code none;
  const std::filesystem::path command = std::filesystem::read_symlink("/proc/self/exe", none);
  for (const std::filesystem::path& path :
       {command.parent_path().parent_path() / "share/anicodec/viewer.html",
        std::filesystem::path(ANICODEC_VIEWER)}) {
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
              "this build has no viewer for .html: build the preset wasm (sdk/web/README.md)");
}

std::string viewer_page(std::string_view viewer, std::span<const PageClip> clips) {
  std::string scripts;
  for (const PageClip& clip : clips)
    scripts += "<script class=\"clip\" type=\"application/octet-stream\" data-name=\"" +
               escaped(clip.name) + "\">" + base64(clip.bytes) + "</script>";
  std::string page(viewer);
  return page.replace(page.find(kMark), kMark.size(), scripts);
}

}  // namespace anicodec::tools
