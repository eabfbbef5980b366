// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/html_text.h"

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(HtmlText, IsNoMarkup) {
  EXPECT_EQ(html_text("a <b title=\"x\"> & 'c'"),
            "a &lt;b title=&quot;x&quot;&gt; &amp; &#39;c&#39;");
  EXPECT_EQ(html_text("Füße"), "Füße");
  EXPECT_EQ(html_text("two\nlines"), "two\\nlines");
}

TEST(HtmlText, HoldsBytesInBase64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

}  // namespace
}  // namespace anicodec::tools
