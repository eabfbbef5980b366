// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_TEXT_CURSOR_H_
#define ANICODEC_TOOLS_IO_BASE_TEXT_CURSOR_H_

#include "tools/io/base/local_origin.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// Reads a text of lines of words and numbers, strictly and independently of the locale. A line
/// ends with LF, CRLF or CR. Every fault throws Error(kInput) "name:line: reason".
class TextCursor {
 public:
  struct Dialect {
    char comment = '\0';        ///< starts a comment that lasts to the end of the line; 0: none
    bool continuation = false;  ///< a backslash before the end of a line joins the next
  };

  TextCursor(std::string_view text, std::string_view name, Dialect dialect, size_t line = 1)
      : next_(text.data()),
        end_(text.data() + text.size()),
        name_(name),
        dialect_(dialect),
        line_(line) {}

  /// Moves over blank lines and comments; false at the end of the text. To be called at a line's
  /// end.
  bool next_line();

  /// True when no word is left on this line.
  bool at_line_end() {
    skip_blanks();
    return next_ == end_ || *next_ == '\n' || *next_ == '\r' || is_comment(*next_);
  }

  /// Throws when a word is left on this line.
  void end_line() {
    if (!at_line_end())
      fail("unexpected '" + shown_word() + "'");
  }

  /// Passes over the rest of this line, continuations included.
  void skip_line();

  /// The rest of this line without blanks around it, up to a comment. Joins no other line.
  std::string_view rest_of_line();

  /// The next word of this line; throws where there is none. `what` names it in the message.
  std::string_view word(const char* what);

  /// A finite coordinate of the vertex, correctly rounded to float.
  float coordinate(size_t vertex) {
    if (at_line_end())
      fail_missing("coordinate");
    const char* first = after_plus();
    float x = 0;
    auto [last, error] = std::from_chars(first, end_, x);
    if (error == std::errc() && std::isfinite(x) && is_word_end(last)) {
      next_ = last;
      return x;
    }
    return difficult_coordinate(vertex);
  }

  /// The same from a local origin.
  float coordinate(size_t vertex, size_t axis, LocalOrigin& origin) {
    if (origin.is_plain(axis) || at_line_end())
      return coordinate(vertex);
    double exact = 0;
    const bool is_number = std::from_chars(after_plus(), end_, exact).ec == std::errc();
    const float x = coordinate(vertex);
    return origin.rounded(is_number ? exact : static_cast<double>(x), axis);
  }

  /// A number of any size, "nan" and "inf" included; one that no double holds is not a number.
  double number(const char* what);

  /// Passes over such a number.
  void skip_number(const char* what) { number(what); }

  /// A whole number that ends the word.
  int64_t integer(const char* what) {
    int64_t n = integer_prefix(what);
    if (!is_word_end(next_))
      fail("unexpected '" + shown_word() + "' after a number");
    return n;
  }

  /// A whole number that any character may follow.
  int64_t integer_prefix(const char* what) {
    if (at_line_end())
      fail_missing(what);
    int64_t n = 0;
    auto [last, error] = std::from_chars(after_plus(), end_, n);
    if (error != std::errc())
      fail_number(what);
    next_ = last;
    return n;
  }

  /// Takes one character if it comes next.
  bool accept(char c) {
    if (next_ == end_ || *next_ != c)
      return false;
    ++next_;
    return true;
  }

  bool at_word_end() const { return is_word_end(next_); }

  size_t line() const { return line_; }

  size_t bytes_left() const { return static_cast<size_t>(end_ - next_); }

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  bool is_comment(char c) const { return c == dialect_.comment && c != '\0'; }

  bool is_word_end(const char* p) const {
    return p == end_ || *p == ' ' || *p == '\n' || *p == '\t' || *p == '\r' || is_comment(*p) ||
           continues(p);
  }

  /// True at a backslash that joins this line and the next.
  bool continues(const char* p) const {
    return dialect_.continuation && *p == '\\' && (p + 1 == end_ || p[1] == '\n' || p[1] == '\r');
  }

  void skip_blanks() {
    for (; next_ != end_; ++next_) {
      if (*next_ == ' ' || *next_ == '\t')
        continue;
      if (!continues(next_))
        return;
      ++next_;
      if (next_ == end_)
        return;
      take_newline();
      --next_;
    }
  }

  /// from_chars knows no plus sign; what follows it must be a digit or a point.
  const char* after_plus() const {
    bool plus = *next_ == '+' && next_ + 1 != end_ && next_[1] != '-';
    return plus ? next_ + 1 : next_;
  }

  void take_newline();
  float difficult_coordinate(size_t vertex);
  /// The word at hand, printable and short enough for a message.
  std::string shown_word() const;
  [[noreturn]] void fail_missing(const char* what) const;
  [[noreturn]] void fail_number(const char* what) const;

  const char* next_;
  const char* end_;
  std::string_view name_;
  Dialect dialect_;
  size_t line_;
};

/// A text made fit for a message: printable(), at most 40 bytes of it.
std::string shown(std::string_view text);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_TEXT_CURSOR_H_
