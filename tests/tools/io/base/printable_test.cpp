// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/printable.h"

#include <string>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(Printable, LeavesTextAlone) {
  for (const std::string text : {"", "walk \\ cycle", "Gelände", "歩く", "🚶"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatMovesTheCursorOrEndsALine) {
  EXPECT_EQ(printable("a\nb\r\tc"), R"(a\nb\r\tc)");
  EXPECT_EQ(printable("\x1b[31mred\x7f"), R"(\x1b[31mred\x7f)");
  EXPECT_EQ(printable(std::string("\0", 1)), R"(\x00)");
  EXPECT_EQ(printable("\u009b2J"), R"(\x9b2J)");
}

TEST(Printable, EscapesWhatTurnsOrEndsLinesInUnicode) {
  EXPECT_EQ(printable("a\u202egpj.exe"), R"(a\u202egpj.exe)");
  EXPECT_EQ(printable("a\u2028b\u2067c\ufeff"), R"(a\u2028b\u2067c\ufeff)");
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("caf\xe9"), R"(caf\xe9)");
  EXPECT_EQ(printable("\xc0\xaf"), R"(\xc0\xaf)");          // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), R"(\xed\xa0\x80)");  // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), R"(\xf4\x90\x80\x80)");
  EXPECT_EQ(printable("\xe6\xad"), R"(\xe6\xad)");  // cut off
}

TEST(Printable, IsDoneOnce) {
  const std::string once = printable("a\n\x1b\xff\u202e");
  EXPECT_EQ(printable(once), once);
}

}  // namespace
}  // namespace anicodec::tools
