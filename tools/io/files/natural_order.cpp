// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/natural_order.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace anicodec::tools {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

size_t digits_at(std::string_view text, size_t first) {
  size_t last = first;
  while (last < text.size() && is_digit(text[last]))
    ++last;
  return last - first;
}

/// A number or a single other character.
struct Piece {
  std::string_view text;
  bool negative = false;
  std::string_view whole = {}, decimals = {};  ///< without zeros that say nothing

  bool is_number() const { return text.size() > 1 || is_digit(text[0]); }

  /// Numbers stand where their sign or their digits do.
  char place() const { return negative ? '-' : is_number() ? '0' : text[0]; }
};

/// Takes the piece that comes first; `before` is the character before it.
Piece take_piece(std::string_view& text, char before, bool fractions) {
  const bool negative =
      text[0] == '-' && !is_digit(before) && !is_letter(before) && digits_at(text, 1) > 0;
  const size_t first = negative ? 1 : 0, digits = digits_at(text, first);
  size_t size = std::max<size_t>(first + digits, 1);
  Piece piece{.text = {}, .negative = negative};
  if (digits > 0) {
    piece.whole = text.substr(first, digits);
    piece.whole.remove_prefix(std::min(piece.whole.find_first_not_of('0'), digits));
    const size_t more =
        fractions && size < text.size() && text[size] == '.' ? digits_at(text, size + 1) : 0;
    if (more > 0) {
      piece.decimals = text.substr(size + 1, more);
      piece.decimals = piece.decimals.substr(0, piece.decimals.find_last_not_of('0') + 1);
      size += 1 + more;
    }
  }
  piece.text = text.substr(0, size);
  text.remove_prefix(size);
  return piece;
}

/// Less than 0 where the magnitude of `a` is the smaller one.
int compare_magnitudes(const Piece& a, const Piece& b) {
  if (a.whole.size() != b.whole.size())
    return a.whole.size() < b.whole.size() ? -1 : 1;
  const int whole = a.whole.compare(b.whole);
  return whole != 0 ? whole : a.decimals.compare(b.decimals);
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b, bool fractions) {
  std::string_view rest_a = a, rest_b = b;
  char before_a = '\0', before_b = '\0';
  int zeros = 0;  // of the first numbers that differ in nothing else
  while (!rest_a.empty() && !rest_b.empty()) {
    const Piece x = take_piece(rest_a, before_a, fractions),
                y = take_piece(rest_b, before_b, fractions);
    before_a = x.text.back();
    before_b = y.text.back();
    if (x.place() != y.place())
      return x.place() < y.place();
    if (x.is_number() != y.is_number())
      return x.is_number();
    if (!x.is_number())
      continue;
    if (const int order = compare_magnitudes(x, y); order != 0)
      return x.negative ? order > 0 : order < 0;
    if (zeros == 0 && x.text.size() != y.text.size())
      zeros = x.text.size() < y.text.size() ? -1 : 1;
  }
  if (rest_a.empty() != rest_b.empty())
    return rest_a.empty();
  return zeros < 0;
}

bool have_fractions(const std::vector<std::string>& names) {
  struct Group {
    bool whole = false;            ///< a name has no decimals
    std::set<std::string> wholes;  ///< of those with some
    std::set<size_t> lengths;      ///< of their decimals
    bool zeros = false;            ///< decimals end in one, as numbers of frames do
  };

  std::map<std::string, Group> groups;  // by what comes before the number
  for (const std::string& name : names) {
    const std::string stem = std::filesystem::path(name).replace_extension().string();
    const size_t last = stem.find_last_not_of("0123456789") + 1;
    if (last == stem.size())
      continue;
    groups[stem.substr(0, last)].whole = true;
    if (last < 2 || stem[last - 1] != '.' || !is_digit(stem[last - 2]))
      continue;
    const std::string before = stem.substr(0, last - 1);
    const size_t first = before.find_last_not_of("0123456789") + 1;
    Group& group = groups[before.substr(0, first)];
    group.wholes.insert(before.substr(first));
    group.lengths.insert(stem.size() - last);
    group.zeros |= stem.size() - last > 1 && stem.back() == '0';
  }
  return std::ranges::any_of(groups, [](const auto& entry) {
    const Group& g = entry.second;
    return !g.wholes.empty() &&
           (g.whole || (g.wholes.size() > 1 && g.lengths.size() > 1 && !g.zeros));
  });
}

void sort_naturally(std::vector<std::string>& names) {
  std::ranges::sort(
      names, [fractions = have_fractions(names)](const std::string& a, const std::string& b) {
        return natural_less(a, b, fractions);
      });
}

}  // namespace anicodec::tools
