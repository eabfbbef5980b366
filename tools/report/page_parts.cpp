// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/report/page_parts.h"

#include "tools/render/html_text.h"
#include "tools/report/chart.h"

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr const char* kStyle = R"(
:root{--text:#1c2430;--card:#f6f8fa}
@media(prefers-color-scheme:dark){:root{--text:#e6eaf0;--card:#1a2028}}
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--text);font:16px/1.5 system-ui,sans-serif}
main{max-width:1080px;margin:0 auto;padding:24px 16px 64px}
h1{font-size:1.7rem;margin:0 0 4px}h2{font-size:1.2rem;margin:40px 0 8px;border-top:1px solid var(--rule);padding-top:20px}
p{max-width:46em}.quiet{color:var(--quiet)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(140px,1fr));gap:12px;margin:20px 0}
.tiles div{background:var(--card);border-radius:8px;padding:12px 14px}
.tiles b{display:block;font-size:1.35rem;font-variant-numeric:tabular-nums}
.charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(420px,100%),1fr));gap:16px}
figure{margin:0;min-width:0}figure p{margin:0 0 4px}iframe{width:100%;height:520px;border:0;border-radius:8px}svg{width:100%;height:auto;display:block}
.legend{font-size:.85rem;line-height:1.9}.legend span{white-space:nowrap;margin-right:12px}
.legend i{display:inline-block;width:18px;border-top:3px solid;margin-right:5px;vertical-align:middle}
.legend .dashed i{border-top-style:dashed}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{padding:4px 12px 4px 0;text-align:right;white-space:nowrap;border-bottom:1px solid var(--rule)}
th:first-child,td:first-child{text-align:left}
.bar{height:26px;display:flex;border-radius:6px;overflow:hidden;margin:12px 0}
.bar span{background:currentColor;min-width:1px}
img{max-width:100%;height:auto;border-radius:8px;display:block}
.pictures figure{margin:0 0 16px}.sheet{display:grid;grid-template-columns:repeat(auto-fill,minmax(140px,1fr));gap:10px}
figcaption{color:var(--quiet);font-size:.85rem;margin-top:4px}
)";

}  // namespace

std::string page_around(const std::string& heading, const std::string& below,
                        const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
      "<title>{0} – anicodec</title><style>{1}{2}</style></head><body><main><h1>{0}</h1>"
      "<p class=\"quiet\">{3}</p>{4}</main></body></html>\n",
      html_text(heading), kChartStyle, kStyle, html_text(below), body);
}

std::string figure_of(const std::string& caption, const Image& image) {
  return fmt::format(
      "<figure><img alt=\"{0}\" width=\"{1}\" height=\"{2}\" src=\"data:image/png;base64,{3}\">"
      "<figcaption>{0}</figcaption></figure>",
      html_text(caption), image.width, image.height, base64(png_bytes(image)));
}

}  // namespace anicodec::tools
