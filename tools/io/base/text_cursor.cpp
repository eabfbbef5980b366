// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/text_cursor.h"

#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"

#include <algorithm>

namespace anicodec::tools {
namespace {

/// A number that from_chars reports as out of range is zero, to float precision, if it is tiny and
/// not huge.
bool is_tiny(std::string_view number) {
  size_t exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos)
    return number.substr(exponent + 1, 1) == "-";
  size_t first = number.find_first_not_of("+-");
  return first != std::string_view::npos && (number[first] == '0' || number[first] == '.');
}

}  // namespace

bool TextCursor::next_line() {
  for (;;) {
    skip_blanks();
    if (next_ == end_)
      return false;
    if (is_comment(*next_)) {
      next_ = std::find_if(next_, end_, [](char c) { return c == '\n' || c == '\r'; });
    } else if (*next_ == '\n' || *next_ == '\r') {
      take_newline();
    } else {
      return true;
    }
  }
}

void TextCursor::skip_line() {
  for (; next_ != end_ && *next_ != '\n' && *next_ != '\r'; ++next_) {
    if (continues(next_) && next_ + 1 != end_) {
      ++next_;
      take_newline();
      --next_;
    }
  }
}

std::string_view TextCursor::rest_of_line() {
  if (at_line_end())
    return {};
  const char *first = next_, *last = next_;
  for (; next_ != end_ && *next_ != '\n' && *next_ != '\r' && !is_comment(*next_); ++next_) {
    if (*next_ != ' ' && *next_ != '\t')
      last = next_ + 1;
  }
  return {first, static_cast<size_t>(last - first)};
}

std::string_view TextCursor::word(const char* what) {
  if (at_line_end())
    fail_missing(what);
  const char* first = next_;
  while (!is_word_end(next_))
    ++next_;
  return {first, static_cast<size_t>(next_ - first)};
}

double TextCursor::number(const char* what) {
  if (at_line_end())
    fail_missing(what);
  double x = std::numeric_limits<double>::quiet_NaN();
  auto [last, error] = std::from_chars(after_plus(), end_, x);
  if (error == std::errc::invalid_argument || !is_word_end(last))
    fail_number(what);
  next_ = last;
  return x;
}

float TextCursor::difficult_coordinate(size_t vertex) {
  const char* first = after_plus();
  double x = 0;
  auto [last, error] = std::from_chars(first, end_, x);
  if (error == std::errc::invalid_argument || !is_word_end(last))
    fail_number("coordinate");
  std::string place = "coordinate " + shown_word() + " of vertex " + std::to_string(vertex);
  if (error == std::errc() && !std::isfinite(x))
    fail(place + " is not finite");
  if (error == std::errc::result_out_of_range) {
    std::string_view number(first, static_cast<size_t>(last - first));
    x = std::copysign(is_tiny(number) ? 0.0 : HUGE_VAL, *first == '-' ? -1.0 : 1.0);
  }
  float rounded = static_cast<float>(x);
  if (!std::isfinite(rounded))
    fail(place + " exceeds the range of 32-bit numbers");
  next_ = last;
  return rounded;
}

void TextCursor::take_newline() {
  if (*next_ == '\r' && next_ + 1 != end_ && next_[1] == '\n')
    ++next_;
  ++next_;
  ++line_;
}

std::string TextCursor::shown_word() const {
  const char* last = next_;
  while (!is_word_end(last))
    ++last;
  return shown({next_, static_cast<size_t>(last - next_)});
}

void TextCursor::fail_missing(const char* what) const {
  fail(std::string(next_ == end_ ? "the file ends" : "the line ends") + " where a " + what +
       " is expected");
}

void TextCursor::fail_number(const char* what) const {
  fail("'" + shown_word() + "' is not a " + what);
}

void TextCursor::fail(const std::string& reason) const {
  fail_input(std::string(name_) + ":" + std::to_string(line_), reason);
}

std::string shown(std::string_view text) {
  constexpr size_t kLongest = 40;
  if (text.size() <= kLongest)
    return printable(text);
  size_t end = kLongest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
    --end;  // not within a character
  return printable(text.substr(0, end)) + "...";
}

}  // namespace anicodec::tools
