// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/viewer_page.h"

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(ViewerPage, HoldsClipsAsBase64) {
  const std::string viewer = "<body><!-- the clip --></body>";
  EXPECT_EQ(viewer_page(viewer, {}), "<body></body>");
  const PageClip clips[] = {
      {"a\"<&.anic", "Man"}, {"b", std::string_view("\xff\0", 2)}, {"c", "x"}};
  EXPECT_EQ(viewer_page(viewer, clips),
            "<body>"
            "<script class=\"clip\" type=\"application/octet-stream\" "
            "data-name=\"a&quot;&lt;&amp;.anic\">TWFu</script>"
            "<script class=\"clip\" type=\"application/octet-stream\" data-name=\"b\">/wA=</script>"
            "<script class=\"clip\" type=\"application/octet-stream\" data-name=\"c\">eA==</script>"
            "</body>");
}

}  // namespace
}  // namespace anicodec::tools
